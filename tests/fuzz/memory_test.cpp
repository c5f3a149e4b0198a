// Decoding allocates within bounds set by the bytes that have arrived and the limits of the format, not by a
// stream's claims. Counts all allocations by operator new, in Draco too, and dav1d's requests.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "bitstream/track.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/stream_mutator.h"
#include "tests/vectors/stream_digest.h"

namespace {

std::size_t held = 0, most_held = 0;  // bytes from operator new, now and at most
std::size_t aligned = 0;              // bytes that dav1d has asked for, released or not

void* allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(memory);
  most_held = std::max(most_held, held);
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}

// Visible, so that dav1d calls it: everything else of ours is hidden.
extern "C" [[gnu::visibility("default")]] int posix_memalign(void** memory, std::size_t alignment,
                                                             std::size_t size) noexcept {
  using Function = int (*)(void**, std::size_t, std::size_t);
  static const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "posix_memalign"));
  aligned += size;
  return next(memory, alignment, size);
}

namespace fbs::fuzz {
namespace {

constexpr std::size_t kMiB = 1 << 20;

/// Counts from its construction on.
class Meter {
 public:
  Meter() : before_(held) {
    most_held = held;
    aligned = 0;
  }
  [[nodiscard]] std::size_t peak() const { return most_held - before_; }
  [[nodiscard]] static std::size_t of_dav1d() { return aligned; }

 private:
  std::size_t before_;
};

Bytes vector_named(const std::string& name) {
  return read_bytes(FBS_VECTORS "/" + name);
}

/// The setup of talk.fbs with another size.
Bytes setup_of_size(int width, int height, int patterns = 1) {
  auto setup = *decode_setup(payloads_of(vector_named("talk.fbs"), PacketType::kSetup).front());
  setup.format.width = width;
  setup.format.height = height;
  setup.patterns = patterns;
  return *encode_setup(setup);
}

/// talk.fbs with another setup packet.
Bytes talk_with(const Bytes& setup) {
  LooseStream stream = read_loose(vector_named("talk.fbs"));
  stream.packets.front().payload = setup;
  return write_loose(stream);
}

/// Decodes to the end without drawing.
/// @return number of pictures
std::uint64_t decode(StreamDecoder& decoder, std::span<const std::uint8_t> stream) {
  decoder.feed(stream);
  decoder.close();
  for (;;)
    if (const auto status = decoder.next(); status && *status == DecodeStatus::kEnd)
      return decoder.pictures();
}

/// Removes all that follows the patterns.
/// @return the first motion packet, a key group of one picture
LoosePacket take_motion(LooseStream& stream) {
  const auto is_of_pictures = [](const LoosePacket& p) {
    return p.type > static_cast<std::uint8_t>(PacketType::kPattern);
  };
  const LoosePacket key = *std::ranges::find_if(stream.packets, is_of_pictures);
  std::erase_if(stream.packets, is_of_pictures);
  return key;
}

TEST(Memory, MeterSeesAllocationsAndDav1d) {
  const Meter meter;
  const auto large = std::make_unique<Bytes>(3 * kMiB);
  EXPECT_GE(meter.peak(), 3 * kMiB);
  StreamDecoder decoder;
  EXPECT_GT(decode(decoder, vector_named("talk.fbs")), 0u);
  EXPECT_GT(Meter::of_dav1d(), 1000u);
}

TEST(Memory, SetupOfLargePicturesTakesNone) {
  const Bytes small = talk_with(setup_of_size(64, 64)), large = talk_with(setup_of_size(8192, 8192, 64));
  const auto peak = [](const Bytes& stream) {
    const Meter meter;
    StreamDecoder decoder;
    EXPECT_EQ(decode(decoder, stream), 0u) << "the patterns are of another size";
    return meter.peak();
  };
  EXPECT_LE(peak(large), peak(small) + 1000);
  EXPECT_LT(Meter::of_dav1d(), 4 * kMiB);
}

TEST(Memory, FrameLargerThanTheSetupTakesNone) {
  const SceneFrames scene = frames_of(vector_named("talk.fbs")).front();
  const auto picture_bytes =
      static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height) * 3 / 2;
  ASSERT_GT(scene.width * scene.height, 64 * 64);
  const auto taken = [&](int width, int height) {
    auto decoder = PatternDecoder::create(width, height);
    const Meter meter;
    EXPECT_EQ(decoder->decode_frame(scene.frames.front()).has_value(), width == scene.width);
    return Meter::of_dav1d();
  };
  EXPECT_GT(taken(scene.width, scene.height), picture_bytes);
  EXPECT_LT(taken(64, 64), picture_bytes);
}

TEST(Memory, PacketOfClaimedLengthTakesOnlyWhatHasArrived) {
  Bytes stream = vector_named("talk.fbs");
  stream.resize(4);
  stream.insert(stream.end(), {5, 0x80, 0x80, 0x80, 0x08});  // a motion packet of 2^24 bytes
  const Meter meter;
  PacketReader reader;
  reader.feed(stream);
  EXPECT_EQ(reader.next()->status, ReadStatus::kNeedMore);
  EXPECT_LT(meter.peak(), 4096u);
}

TEST(Memory, SearchPastDamageForgetsWhatItHasSeen) {
  const Bytes piece(1 << 16, 1);  // nothing but candidates of setup packets
  const Meter meter;
  PacketReader reader;
  reader.feed(Bytes(8, 0));
  EXPECT_FALSE(reader.next());
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(reader.next()->status, ReadStatus::kNeedMore);
    reader.feed(piece);
  }
  EXPECT_LT(meter.peak(), kMiB / 2);
}

TEST(Memory, WireFramesAreBounded) {
  Random random(1);
  std::size_t peak = 0;
  for (const char* name : {"wire_frame.fbs", "random_wire_frame.fbs"}) {
    const auto payloads = payloads_of(vector_named(name), PacketType::kWireFrame);
    ASSERT_EQ(payloads.size(), 1u);
    for (int i = 0; i < 1000; ++i) {
      Bytes changed = payloads.front();
      mutate_bytes(changed, random);
      if (i % 4 == 0) changed.resize(kMaxWireFramePayload, static_cast<std::uint8_t>(random()));
      const Meter meter;
      (void)decode_wire_frame(changed);
      peak = std::max(peak, meter.peak());
    }
  }
  EXPECT_GT(peak, kMiB / 32) << "the tables of wire_frame.fbs";
  EXPECT_LT(peak, kMiB);
}

TEST(Memory, DracoIsBounded) {
  // Draco's tables follow numbers of its stream: 64 symbols for each byte of the payload, and 2^20 entries of
  // the table that symbols are looked up in.
  constexpr std::size_t kMost = 16 * kMiB;
  std::vector<Bytes> payloads;
  for (const char* name : {"talk.fbs", "blends.fbs", "limits.fbs", "odd.fbs"})
    for (const Bytes& payload : payloads_of(vector_named(name), PacketType::kGeometry))
      payloads.push_back(payload);
  ASSERT_GE(payloads.size(), 4u);
  Random random(1);
  std::size_t peak = 0;
  for (const Bytes& payload : payloads) {
    for (int i = 0; i < 4000; ++i) {
      Bytes changed = payload;
      mutate_bytes(changed, random);
      if (i % 4 == 0) changed.resize(kMaxGeometryPayload, static_cast<std::uint8_t>(random()));
      const Meter meter;
      (void)decode_geometry(changed);
      peak = std::max(peak, meter.peak());
    }
  }
  EXPECT_LT(peak, kMost);
}

TEST(Memory, DracoWithATableOfManySymbolsIsBounded) {
  // Sequential integers, difference, wrap; coded as symbols: raw, 18 bits; a number of symbols as a varint.
  Bytes payload = {0x80, 0x20, 0x80, 0x20, 0x80, 0x20, 1, 0, 1, 0, 1, 1, 1, 18};
  for (const std::uint32_t symbols : {64U << 10, 64U << 13, 1U << 20, 1U << 31}) {
    Bytes claims = payload;
    for (std::uint32_t left = symbols; left > 0; left >>= 7)
      claims.push_back(static_cast<std::uint8_t>((left & 0x7F) | (left > 0x7F ? 0x80 : 0)));
    claims.resize(kMaxGeometryPayload, 0xFF);
    const Meter meter;
    EXPECT_FALSE(decode_geometry(claims));
    EXPECT_LT(meter.peak(), 16 * kMiB) << symbols;
  }
}

TEST(Memory, PatternOfClaimedLengthTakesOnlyWhatHasArrived) {
  // Whatever the bytes, no frame is longer than its code.
  const auto setup = *decode_setup(setup_of_size(64, 64, 64));
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    Bytes payload(random() % 64);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? 0xFF : random());
    const Meter meter;
    PatternPacketReader reader;
    (void)reader.decode(payload, setup, 0);
    EXPECT_LT(meter.peak(), 64 * 1024u);
  }
}

/// Adds groups of one picture in which nothing moves.
void add_still(LooseStream& stream, const Setup& setup, int groups) {
  MotionEncoder coder(setup, {});
  for (int i = 0; i < groups; ++i) {
    MotionGroup group = knots_everywhere(coder.anchor(), {coder.anchor()}, setup.parts);
    group.key = i == 0;
    group.first = coder.next();
    stream.packets.push_back({static_cast<std::uint8_t>(PacketType::kMotion), *coder.encode(group)});
  }
}

TEST(Memory, WaitingPicturesAreBounded) {
  // A scene of two slots whose blend packets never come, with motion for 100 times as many pictures as may
  // wait.
  const SceneFrames talk = frames_of(vector_named("talk.fbs")).front();
  LooseStream stream = read_loose(talk_with(setup_of_size(talk.width, talk.height, 2)));
  (void)take_motion(stream);
  add_still(stream, *decode_setup(setup_of_size(talk.width, talk.height, 2)), 100 * kMaxWaitingPictures);
  const Bytes bytes = write_loose(stream);
  const Meter meter;
  StreamDecoder decoder;
  std::size_t too_large = 0;
  decoder.feed(bytes);
  decoder.close();
  for (;;) {
    const auto status = decoder.next();
    if (status) {
      EXPECT_EQ(*status, DecodeStatus::kEnd);
      break;
    }
    too_large += status.error().code == ErrorCode::kTooLarge ? 1 : 0;
  }
  EXPECT_EQ(too_large, 1u);
  EXPECT_LT(meter.peak(), bytes.size() + kMaxWaitingPictures * 2 * sizeof(Timeline::Entry) + kMiB);
}

TEST(Memory, ScenesThatAreSetAsideAreBounded) {
  LooseStream head = read_loose(vector_named("talk.fbs"));
  (void)take_motion(head);
  auto setup = *decode_setup(head.packets.front().payload);
  setup.keeps = SceneKeeping::kAndPresent;
  head.packets.front().payload = *encode_setup(setup);
  const auto peak_of = [&](std::size_t scenes) {
    LooseStream many;
    for (std::size_t k = 0; k < scenes; ++k)
      many.packets.insert(many.packets.end(), head.packets.begin(), head.packets.end());
    const Bytes bytes = write_loose(many);
    const Meter meter;
    StreamDecoder decoder;
    (void)decode(decoder, bytes);
    return meter.peak() - bytes.size();
  };
  const std::size_t kept = peak_of(kKeptScenes + 2);
  EXPECT_GT(kept, peak_of(1)) << "they are set aside";
  EXPECT_LT(peak_of(10 * kKeptScenes), kept + kMiB / 8);
}

TEST(Memory, KeptPicturesAreBounded) {
  // Many groups of a scene of one pattern: each is shown and then forgotten, except for kKeptPictures.
  LooseStream stream = read_loose(vector_named("talk.fbs"));
  (void)take_motion(stream);
  const auto peak_of = [&](int groups) {
    LooseStream many = stream;
    add_still(many, *decode_setup(many.packets.front().payload), groups);
    const Bytes bytes = write_loose(many);
    const Meter meter;
    StreamDecoder decoder;
    EXPECT_EQ(decode(decoder, bytes), static_cast<std::uint64_t>(groups));
    return meter.peak() - bytes.size();
  };
  EXPECT_LT(peak_of(50000), peak_of(1000) + kMiB / 8);
}

TEST(Memory, HeldPicturesTakeNone) {
  LooseStream stream = read_loose(vector_named("talk.fbs"));
  stream.packets.back().payload = {0x80, 0x80, 0x01};  // an end after 2^14 pictures
  const auto peak_of = [](const Bytes& bytes) {
    const Meter meter;
    StreamDecoder decoder;
    const std::uint64_t pictures = decode(decoder, bytes);
    return std::pair(meter.peak(), pictures);
  };
  const auto [plain, few] = peak_of(vector_named("talk.fbs"));
  const auto [held_many, many] = peak_of(write_loose(stream));
  EXPECT_EQ(many, 1u << 14);
  EXPECT_LT(few, 100u);
  EXPECT_LT(held_many, plain + 4096);
}

TEST(Memory, LargestSurroundIsBounded) {
  SurroundMap map{kMaxSurroundCells, kMaxSurroundCells, {}, {}};
  map.head.assign((kMaxSurroundCells + 1) * (kMaxSurroundCells + 1), 0);
  map.body = map.head;
  const Bytes payload = *encode_surround(map);
  EXPECT_LT(payload.size(), 40u);
  LooseStream stream = read_loose(vector_named("talk.fbs"));
  for (LoosePacket& packet : stream.packets)
    if (packet.type == static_cast<std::uint8_t>(PacketType::kSurround)) packet.payload = payload;
  const Bytes bytes = write_loose(stream);
  const Meter meter;
  StreamDecoder decoder;
  EXPECT_GT(decode(decoder, bytes), 0u);
  EXPECT_LT(meter.peak(), 8 * kMiB);
}

}  // namespace
}  // namespace fbs::fuzz
