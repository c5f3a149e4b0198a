#include "tests/fuzz/stream_mutator.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>

#include "bitstream/packet.h"
#include "bitstream/payload/setup_payload.h"
#include "tests/fuzz/setup_fields.h"
#include "tests/vectors/stream_digest.h"

namespace fbs::fuzz {
namespace {

Bytes vector_named(const std::string& name) {
  return read_bytes(FBS_VECTORS "/" + name);
}

std::vector<Bytes> vectors() {
  std::vector<Bytes> out;
  for (const Vector& v : read_vectors(FBS_VECTORS)) out.push_back(vector_named(v.file));
  return out;
}

/// The packets that a reader finds; nothing if it finds damage before the end.
std::optional<std::vector<LoosePacket>> read_to_end(const Bytes& stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  std::vector<LoosePacket> out;
  for (;;) {
    const auto read = reader.next();
    if (!read) return std::nullopt;
    if (read->status == ReadStatus::kEnd) return out;
    const Packet& p = read->packet;
    out.push_back({static_cast<std::uint8_t>(p.type), Bytes(p.payload.begin(), p.payload.end())});
  }
}

fbs::Setup small_setup() {
  fbs::Setup setup;
  setup.format.width = 100;
  setup.format.height = 80;
  return setup;
}

TEST(StreamMutator, WritesWhatItReads) {
  const auto streams = vectors();
  ASSERT_GT(streams.size(), 40u);
  for (const char* name : {"talk.fbs", "blends.fbs", "late.fbs", "later_writer.fbs"}) {
    const Bytes stream = vector_named(name);
    EXPECT_EQ(write_loose(read_loose(stream)), stream) << name;
  }
}

TEST(StreamMutator, ChangedPacketsParseToTheEnd) {
  const auto streams = vectors();
  Random random(1);
  for (const Bytes& bytes : streams) {
    for (int round = 0; round < 100; ++round) {
      LooseStream stream = read_loose(bytes);
      change_packets(stream, read_loose(streams[random() % streams.size()]), random, mutate_bytes);
      stream.rest.clear();
      const auto read = read_to_end(write_loose(stream));
      ASSERT_TRUE(read);
      EXPECT_EQ(*read, stream.packets);
    }
  }
}

TEST(StreamMutator, RepairedChecksParseToTheEnd) {
  Bytes stream = vector_named("talk.fbs");
  const auto borders = packet_borders(stream);
  ASSERT_EQ(borders.back(), stream.size());
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) stream[borders[i + 1] - 3] ^= 0x10;  // in each payload
  stream[0] = 0;
  EXPECT_FALSE(read_to_end(stream));
  repair_checks(stream);
  EXPECT_TRUE(read_to_end(stream));
}

TEST(StreamMutator, RepairsWhatIsTooShortForAPacket) {
  for (std::size_t size = 0; size < 8; ++size) {
    Bytes stream(size, 0xFF);
    repair_checks(stream);
    EXPECT_EQ(stream.size(), size);
  }
}

TEST(StreamMutator, MostStreamsHaveRightChecksAndSomeDoNot) {
  const Bytes stream = vector_named("blends.fbs"), other = vector_named("talk.fbs");
  Random random(3);
  constexpr int kStreams = 2000;
  int whole = 0;
  std::set<std::string> different;
  for (int i = 0; i < kStreams; ++i) {
    const Bytes changed = mutate_stream(stream, other, random);
    whole += read_to_end(changed).has_value() ? 1 : 0;
    different.emplace(changed.begin(), changed.end());
  }
  EXPECT_GT(whole, kStreams * 6 / 10);
  EXPECT_LT(whole, kStreams * 95 / 100);
  EXPECT_GT(different.size(), kStreams * 9 / 10);
}

TEST(StreamMutator, MutationsRepeatWithTheirSeed) {
  const Bytes stream = vector_named("patterns.fbs");
  Random one(5), same(5), other(6);
  const Bytes first = mutate_stream(stream, stream, one);
  EXPECT_EQ(mutate_stream(stream, stream, same), first);
  EXPECT_NE(mutate_stream(stream, stream, other), first);
}

TEST(SetupFields, AreThoseOfTheSetup) {
  auto setup = small_setup();
  for (const bool optional : {false, true}) {
    if (optional) setup.keeps = SceneKeeping::kAside;
    const Bytes payload = *encode_setup(setup);
    SetupFields fields = read_setup_fields(payload);
    EXPECT_EQ(fields.values.size(), optional ? 27u : 23u);
    EXPECT_TRUE(fields.rest.empty());
    EXPECT_EQ(write_setup_fields(fields), payload);
    fields.values[4] = 120;
    EXPECT_EQ(decode_setup(write_setup_fields(fields))->format.width, 120);
  }
}

TEST(SetupFields, ChangesReachBothSidesOfTheLimits) {
  const SetupFields fields = read_setup_fields(*encode_setup(small_setup()));
  Random random(1);
  std::set<ErrorCode> errors;
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    SetupFields changed = fields;
    change_setup(changed, random);
    const auto read = decode_setup(write_setup_fields(changed));
    valid += read ? 1 : 0;
    if (!read) errors.insert(read.error().code);
  }
  EXPECT_GT(valid, 500);
  EXPECT_EQ(errors, (std::set{ErrorCode::kInvalidStream, ErrorCode::kUnsupported, ErrorCode::kTooLarge}));
}

}  // namespace
}  // namespace fbs::fuzz
