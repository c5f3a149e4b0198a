#include <gtest/gtest.h>

#include "tests/vectors/sound_digest.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

const std::string kFolder = FBS_VECTORS;

TEST(SoundVectors, GiveTheirDigests) {
  const auto vectors = read_sound_vectors(kFolder);
  ASSERT_EQ(vectors.size(), 4U);
  for (const SoundVector& v : vectors) {
    const SoundDigest got = sound_digest_of(read_bytes(kFolder + "/" + v.file));
    EXPECT_EQ(got.frames, v.expected.frames) << v.file;
    EXPECT_EQ(got.samples, v.expected.samples) << v.file;
    EXPECT_EQ(got.md5, v.expected.md5) << v.file;
  }
}

TEST(SoundVectors, SoundChangesNoPicture) {
  const auto digest = [](const char* file) { return digest_of(read_bytes(kFolder + "/" + file)); };
  for (const char* file : {"sound_codec2.fbs", "sound_gaps.fbs"}) EXPECT_EQ(digest(file), digest("talk.fbs"));
  for (const char* file : {"sound_opus.fbs", "sound_unknown.fbs"})
    EXPECT_EQ(digest(file), digest("late.fbs"));
}

TEST(SoundVectors, OthersAreSilent) {
  EXPECT_EQ(sound_digest_of(read_bytes(kFolder + "/talk.fbs")).frames, 0U);
}

}  // namespace
}  // namespace fbs
