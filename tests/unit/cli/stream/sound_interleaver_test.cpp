#include "cli/stream/sound_interleaver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "decoder/stream/packet_list.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes vector_file(const std::string& name) {
  std::ifstream file(FBS_VECTORS "/" + name, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

constexpr SoundSetup kVoice{SoundCodec::kOpus, 1, 0, 960, 312};

/// Frames of 20 ms that contain their number; without end.
class Counting {
 public:
  std::vector<SoundGroup> operator()(std::int64_t before) {
    SoundGroup group{next_, {}};
    for (; next_ * kVoice.duration - kVoice.skip < before; ++next_)
      group.frames.push_back({static_cast<std::uint8_t>(next_), static_cast<std::uint8_t>(next_ >> 8)});
    return group.frames.empty() ? std::vector<SoundGroup>() : std::vector<SoundGroup>{group};
  }

 private:
  std::int64_t next_ = 0;
};

Bytes with_sound(const Bytes& stream, std::size_t piece) {
  Counting count;
  SoundInterleaver interleaver(kVoice, [&](std::int64_t before) { return count(before); });
  Bytes out;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    const auto added = interleaver.add(std::span(stream).subspan(at, std::min(piece, stream.size() - at)));
    EXPECT_TRUE(added) << added.error().text;
    out.insert(out.end(), added->begin(), added->end());
  }
  return out;
}

struct Seen {
  std::vector<State> states;
  std::vector<SoundPart> sound;
  std::uint64_t time = 0;  ///< end of the last picture
};

/// Also checks that no sound comes later than it is heard.
Seen decoded(const Bytes& stream, bool has_sound) {
  StreamDecoder decoder;
  decoder.keep_sound();
  decoder.feed(stream);
  decoder.close();
  Seen out;
  std::int64_t heard = 0;
  for (;;) {
    const auto status = decoder.next();
    EXPECT_TRUE(status) << status.error().text;
    for (SoundPart& part : decoder.take_sound()) {
      EXPECT_EQ(part.setup, kVoice);
      heard = (part.group.first + static_cast<std::int64_t>(part.group.frames.size())) * kVoice.duration -
              kVoice.skip;
      out.sound.push_back(std::move(part));
    }
    if (!status || *status != DecodeStatus::kPicture) break;
    out.states.push_back(decoder.state());
    out.time = decoder.position().time + decoder.duration();
    if (has_sound) {
      EXPECT_GE(heard * kTicksPerSecond, static_cast<std::int64_t>(out.time) * kSoundClock);
    }
  }
  EXPECT_EQ(decoder.bytes().total, stream.size());
  return out;
}

TEST(SoundInterleaver, PutsSoundBeforeItsPicturesAndChangesNothingElse) {
  for (const char* name : {"talk.fbs", "patterns.fbs", "two_heads.fbs", "durations.fbs"}) {
    const Bytes plain = vector_file(name), stream = with_sound(plain, plain.size());
    const Seen before = decoded(plain, false), after = decoded(stream, true);
    EXPECT_EQ(before.states, after.states) << name;
    EXPECT_TRUE(before.sound.empty());
    std::int64_t next = 0;
    for (const SoundPart& part : after.sound) {
      EXPECT_EQ(part.group.first, next);
      for (const auto& frame : part.group.frames) EXPECT_EQ(frame[0] | frame[1] << 8, next++);
    }
    const auto end = static_cast<std::int64_t>(after.time * kSoundClock / kTicksPerSecond);
    EXPECT_GE(next * kVoice.duration - kVoice.skip, end);
    EXPECT_LT((next - 1) * kVoice.duration - kVoice.skip, end) << "sound after the last picture";
  }
}

TEST(SoundInterleaver, TakesPiecesOfAnySize) {
  const Bytes plain = vector_file("patterns.fbs");
  EXPECT_EQ(with_sound(plain, 7), with_sound(plain, plain.size()));
}

TEST(SoundInterleaver, RefusesAStreamThatHasSound) {
  const Bytes twice = with_sound(vector_file("talk.fbs"), 100000);
  SoundInterleaver interleaver(kVoice, [](std::int64_t) { return std::vector<SoundGroup>(); });
  const auto added = interleaver.add(twice);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::kInvalidArgument);
}

TEST(SoundInterleaver, ListsSound) {
  const auto entries = list_packets(with_sound(vector_file("talk.fbs"), 100000));
  ASSERT_GT(entries.size(), 4U);
  EXPECT_EQ(entries[1].type, "sound setup");
  std::uint64_t last = 0;
  for (const PacketEntry& entry : entries) {
    EXPECT_EQ(entry.error, "");
    if (entry.type != "sound") continue;
    EXPECT_GE(*entry.time, last);
    last = *entry.time;
  }
  EXPECT_GT(last, 0U);
}

}  // namespace
}  // namespace fbs::cli
