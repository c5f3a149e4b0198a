#include "cli/program/module.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(Module, MissingModuleIsAnErrorNamingIt) {
  const auto symbol = load_module_symbol("fbs_none", "fbs_open_source");
  ASSERT_FALSE(symbol);
  EXPECT_EQ(symbol.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(symbol.error().text.find("fbs_none.so"), std::string::npos) << symbol.error().text;
}

}  // namespace
}  // namespace fbs
