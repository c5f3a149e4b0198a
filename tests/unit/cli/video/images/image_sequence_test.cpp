#include "cli/video/images/image_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fbs {
namespace {

namespace fs = std::filesystem;

class ImageSequence : public ::testing::Test {
 protected:
  ImageSequence() { fs::create_directories(folder_); }
  ~ImageSequence() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_image_sequence_test_" + std::to_string(getpid()));
};

TEST_F(ImageSequence, FilesAreInOrderOfNumber) {
  for (const char* name : {"f9.png", "f10.png", "f2.png", "f1.txt", "g1.png"})
    std::ofstream(path(name)) << "x";
  const auto files = image_sequence_files(path("f%d.png"), nullptr);
  ASSERT_TRUE(files);
  EXPECT_EQ(*files, (std::vector{path("f2.png"), path("f9.png"), path("f10.png")}));
  const auto all = image_sequence_files(path("?*.png"), nullptr);
  ASSERT_TRUE(all);
  EXPECT_EQ(*all, (std::vector{path("f2.png"), path("f9.png"), path("f10.png"), path("g1.png")}));
}

}  // namespace
}  // namespace fbs
