#include "cli/play/key_map.h"

#include <gtest/gtest.h>

#include <set>

namespace fbs::cli {
namespace {

TEST(KeyMap, NoKeyDoesTwoThings) {
  std::set<std::string_view> names;
  for (const KeyLine& line : key_lines())
    for (const Key& key : line.keys) EXPECT_TRUE(names.insert(key.name).second) << key.name;
}

TEST(KeyMap, EveryActionHasAKey) {
  std::set<Action> actions;
  for (const KeyLine& line : key_lines()) {
    EXPECT_FALSE(line.keys.empty());
    actions.insert(line.action);
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(Action::kQuit) + 1);
}

TEST(KeyMap, EveryKeyIsFoundByItsName) {
  for (const KeyLine& line : key_lines())
    for (const Key& key : line.keys) EXPECT_EQ(find_key(key.name), (KeyPress{line.action, key.amount}));
  EXPECT_FALSE(find_key("Shift+F7"));
  EXPECT_FALSE(find_key(""));
}

// In a line with two different keys, the one for less or backwards comes first, or has Shift.
TEST(KeyMap, OppositeKeysHaveOppositeAmounts) {
  EXPECT_EQ(find_key("m")->amount, -find_key("Shift+m")->amount);
  EXPECT_EQ(find_key(".")->amount, -find_key(",")->amount);
  EXPECT_EQ(find_key("Up")->amount, -find_key("Down")->amount);
  EXPECT_EQ(find_key("3")->amount, 3);
}

TEST(KeyMap, HelpListsEveryKeyWithItsText) {
  const std::string help = key_help();
  for (const KeyLine& line : key_lines()) {
    EXPECT_NE(help.find("  " + line.names() + " "), std::string::npos) << line.names();
    EXPECT_NE(help.find(line.text), std::string::npos) << line.text;
  }
}

}  // namespace
}  // namespace fbs::cli
