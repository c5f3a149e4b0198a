#include "bitstream/entropy/trained_contexts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "bitstream/blend/blend_syntax.h"
#include "bitstream/entropy/bit_counter.h"
#include "bitstream/motion/motion_syntax.h"
#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

template <class Memory>
std::size_t count_of_contexts() {
  Memory memory;
  std::size_t count = 0;
  for_each_context(memory, [&](AdaptiveBit&) { ++count; });
  return count;
}

TEST(TrainedContexts, TablesHaveAnEntryForEachContext) {
  EXPECT_EQ(trained_motion().size(), count_of_contexts<MotionMemory>());
  EXPECT_EQ(trained_blends().size(), count_of_contexts<BlendMemory>());
}

TEST(TrainedContexts, EntriesAreWithinTheirRanges) {
  for (const auto table : {trained_motion(), trained_blends()})
    EXPECT_TRUE(std::all_of(table.begin(), table.end(),
                            [](const TrainedContext& c) { return c.zero > 0 && c.bits <= 128; }));
}

TEST(TrainedContexts, BeginAsTheirTableSays) {
  const auto memory = trained<BlendMemory>(trained_blends());
  EXPECT_EQ(memory.other_count.zero(), std::uint32_t{trained_blends()[0].zero} << 8);
  EXPECT_EQ(memory.other_count.count(), trained_blends()[0].bits);
  EXPECT_EQ(memory.tree[1][15].count(), trained_blends().back().bits);
}

// The talker was not among the videos.
TEST(TrainedContexts, SaveBitsOfAStreamThatTheyHaveNotSeen) {
  const auto bytes = vector_bytes("talk.fbs");
  PacketReader packets(bytes);
  SceneReader reader;
  std::optional<MotionReference> trained, untrained;
  BitCounter with, without;
  for (auto read = packets.next(); read && read->status == ReadStatus::kPacket; read = packets.next()) {
    const auto syntax = reader.read(read->packet);
    ASSERT_TRUE(syntax);
    if (const auto* const patterns = std::get_if<std::vector<ScenePattern>>(&*syntax); patterns && !trained) {
      trained.emplace(reader.setup(), patterns->front().coded.state);
      untrained = trained;
      untrained->memory.tracks = {};
    }
    if (const auto* const group = std::get_if<MotionGroup>(&*syntax)) {
      code_body(with, *trained, *group, [](std::size_t) {});
      code_body(without, *untrained, *group, [](std::size_t) {});
    }
  }
  EXPECT_LT(with.bits_x256(), without.bits_x256());
}

}  // namespace
}  // namespace fbs
