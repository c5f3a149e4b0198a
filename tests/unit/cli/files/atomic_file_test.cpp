#include "cli/files/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace fbs {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  AtomicFileTest() { fs::create_directories(folder_); }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_atomic_file_test_" + std::to_string(getpid()));
};

std::string content(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST_F(AtomicFileTest, AppearsOnCommitWithAllBytes) {
  auto file = AtomicFile::create(path("a.fbs"));
  ASSERT_TRUE(file);
  const std::string large(1000000, 'x');
  ASSERT_TRUE(file->write(bytes_of("head")));
  ASSERT_TRUE(file->write(bytes_of(large)));
  ASSERT_TRUE(file->write(bytes_of("tail")));
  ASSERT_TRUE(file->seek(0));
  ASSERT_TRUE(file->write(bytes_of("HEAD")));
  EXPECT_FALSE(fs::exists(path("a.fbs")));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path("a.fbs")), "HEAD" + large + "tail");
  EXPECT_FALSE(fs::exists(path("a.fbs.part")));
}

TEST_F(AtomicFileTest, ReplacesTheTargetOfALink) {
  std::ofstream(path("target")) << "old";
  fs::create_symlink(path("target"), path("link"));
  auto file = AtomicFile::create(path("link"));
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write(bytes_of("new")));
  ASSERT_TRUE(file->commit());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("target")), "new");
}

TEST_F(AtomicFileTest, SecondWriterIsRefusedUntilTheFirstHasFinished) {
  auto first = AtomicFile::create(path("a.fbs"));
  ASSERT_TRUE(first);
  ASSERT_TRUE(first->write(bytes_of("first")));
  const auto refused = AtomicFile::create(path("a.fbs"));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("another process is writing"), std::string::npos)
      << refused.error().text;
  ASSERT_TRUE(first->close());
  EXPECT_FALSE(AtomicFile::create(path("a.fbs"))) << "the lock must last until the file has its name";
  ASSERT_TRUE(first->commit());
  EXPECT_EQ(content(path("a.fbs")), "first");
  EXPECT_TRUE(AtomicFile::create(path("a.fbs")));
}

TEST_F(AtomicFileTest, LeftoverIsReplacedAndNotWrittenInto) {
  std::ofstream(path("precious")) << "precious";
  fs::create_hard_link(path("precious"), path("a.fbs.part"));
  auto file = AtomicFile::create(path("a.fbs"));
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->replaced_leftover());
  ASSERT_TRUE(file->write(bytes_of("new")));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path("a.fbs")), "new");
  EXPECT_EQ(content(path("precious")), "precious");
}

TEST_F(AtomicFileTest, LinkInPlaceOfThePartIsRefused) {
  std::ofstream(path("precious")) << "precious";
  fs::create_symlink(path("precious"), path("a.fbs.part"));
  EXPECT_FALSE(AtomicFile::create(path("a.fbs")));
  EXPECT_EQ(content(path("precious")), "precious");
}

TEST_F(AtomicFileTest, FlushedBytesAreInThePart) {
  auto file = AtomicFile::create(path("a.fbs"));
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->replaced_leftover());
  ASSERT_TRUE(file->write(bytes_of("packet")));
  ASSERT_TRUE(file->flush());
  EXPECT_EQ(content(path("a.fbs.part")), "packet");
}

TEST_F(AtomicFileTest, LeavesDevicesInPlace) {
  auto file = AtomicFile::create("/dev/null");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write(bytes_of("bytes")));
  ASSERT_TRUE(file->commit());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace fbs
