#include "cli/evaluate/run/run_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(RunFolder, FindsWhatWasKeptUnderTheSameKey) {
  const auto run = RunFolder::temporary();
  ASSERT_TRUE(run);
  const json key = {{"quality", 50}, {"source", "a.mkv"}};
  EXPECT_FALSE(run->find("point", key));
  ASSERT_TRUE(run->keep("point", key, {1, 2, 3}));
  EXPECT_EQ(run->find("point", key), json({1, 2, 3}));
  EXPECT_FALSE(run->find("point", {{"quality", 60}, {"source", "a.mkv"}}));
  EXPECT_FALSE(run->find("other", key));
}

TEST(RunFolder, DoesNotTakeHalfAFileForDone) {
  const auto run = RunFolder::temporary();
  ASSERT_TRUE(run);
  ASSERT_TRUE(run->keep("point", 1, "value"));
  ASSERT_TRUE(run->find("point", 1));
  fs::resize_file(run->path("point.json"), fs::file_size(run->path("point.json")) - 4);
  EXPECT_FALSE(run->find("point", 1));
}

TEST(RunFolder, TemporaryOneIsRemovedWithAllInIt) {
  auto run = RunFolder::temporary();
  ASSERT_TRUE(run);
  const std::string path = run->path("");
  {
    std::optional<RunFolder> moved(std::move(*run));
    std::ofstream(moved->path("file")) << "x";
    EXPECT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(RunFolder, SaysWhyItCannotBeMade) {
  const auto run = RunFolder::temporary();
  ASSERT_TRUE(run);
  std::ofstream(run->path("file")) << "x";
  const auto inside = RunFolder::open(run->path("file") + "/folder");
  ASSERT_FALSE(inside);
  EXPECT_NE(inside.error().text.find("cannot make the folder"), std::string::npos);
}

}  // namespace
}  // namespace fbs::cli
