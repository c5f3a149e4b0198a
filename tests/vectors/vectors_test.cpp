#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "common/md5.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = FBS_VECTORS;

std::string md5_of(const std::string& text) {
  Md5 md5;
  md5.add({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return md5.hex();
}

// RFC 1321, appendix A.5
TEST(Md5, MatchesItsStandard) {
  EXPECT_EQ(md5_of(""), "d41d8cd98f00b204e9800998ecf8427e");
  EXPECT_EQ(md5_of("abc"), "900150983cd24fb0d6963f7d28e17f72");
  EXPECT_EQ(md5_of("abcdefghijklmnopqrstuvwxyz"), "c3fcd3d76192e4007dfb496cca67e13b");
  std::string digits;
  for (int i = 0; i < 8; ++i) digits += "1234567890";
  EXPECT_EQ(md5_of(digits), "57edf4a22be3c955ac49da2e2107b67a");
}

TEST(Vectors, DecodeToTheirDigests) {
  const auto vectors = read_vectors(kFolder);
  ASSERT_FALSE(vectors.empty());
  for (const Vector& v : vectors) {
    const StreamDigest got = digest_of(read_bytes(kFolder + "/" + v.file));
    EXPECT_EQ(got.error, v.expected.error) << v.file;
    EXPECT_EQ(got.pictures, v.expected.pictures) << v.file;
    EXPECT_EQ(got.md5, v.expected.md5) << v.file;
  }
}

TEST(Vectors, TableReadmeAndFolderAgree) {
  std::ifstream file(kFolder + "/README.md");
  std::stringstream readme;
  readme << file.rdbuf();
  std::set<std::string> listed;
  for (const Vector& v : read_vectors(kFolder)) {
    listed.insert(v.file);
    EXPECT_NE(readme.str().find("`" + v.file + "` |"), std::string::npos)
        << v.file << " has no line in README.md";
  }
  std::set<std::string> present;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".fbs") present.insert(entry.path().filename().string());
  EXPECT_EQ(listed, present);
}

TEST(Vectors, AreSmall) {
  for (const Vector& v : read_vectors(kFolder))
    EXPECT_LT(fs::file_size(kFolder + "/" + v.file), 8192u) << v.file;
}

// An old reader on the stream of a later writer.
TEST(Vectors, AdditionsOfALaterWriterChangeNoPicture) {
  EXPECT_EQ(digest_of(read_bytes(kFolder + "/later_writer.fbs")),
            digest_of(read_bytes(kFolder + "/talk.fbs")));
}

}  // namespace
}  // namespace fbs
