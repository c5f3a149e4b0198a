#include "encoder/scene/face_coder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/surround/surround_fit.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kFps = 5;
constexpr std::uint64_t kLookahead = 2 * kFps;

/// A head at rest, of which the analysis has seen every picture.
class RestingHead {
 public:
  explicit RestingHead(const EncoderSettings& settings) : coder_(settings, start(settings)) {
    std::vector<std::uint8_t> signature;
    write_signature(signature);
    reader_.feed(signature);
  }

  void add(int pictures) {
    for (int t = 0; t < pictures; ++t) {
      FaceAnalysis::Observation seen{toy_state(),
                                     true,
                                     {},
                                     scene_.geometry->project_vertices(toy_state()),
                                     pose_of(toy_state()),
                                     pose_of(toy_state()).eye_distance_px()};
      const CodedState rest = coded_pose(toy_state());
      std::copy(rest.begin(), rest.end(), seen.cost.fit.begin());
      seen.cost.layers.push_back(
          {CostLayer::kHead, 0, 0, cv::Mat1d::zeros(kParameterCount, kParameterCount)});
      const auto added = coder_.add(picture_, std::move(seen), 0);
      ASSERT_TRUE(added) << added.error().text;
    }
  }
  /// The packets that are ready.
  std::vector<PacketType> taken() {
    reader_.feed(coder_.ledger().packets().take());
    std::vector<PacketType> out;
    for (auto read = reader_.next(); read && read->status == ReadStatus::kPacket; read = reader_.next()) {
      out.push_back(read->packet.type);
      if (out.back() == PacketType::kSetup)
        if (const auto setup = decode_setup(read->packet.payload)) before_ = setup->before.pictures;
    }
    return out;
  }
  /// Pictures before the scene whose setup was taken last.
  [[nodiscard]] std::uint64_t before() const { return before_; }
  FaceCoder& coder() { return coder_; }

 private:
  FaceCoder::Start start(const EncoderSettings& settings) {
    const CodedState rest = coded_pose(toy_state());
    scene_.setup.format.frame_rate = {kFps, 1};
    auto geometry = encode_geometry(toy_geometry());
    EXPECT_TRUE(geometry);
    SurroundObservations observations(scene_.setup.format);
    observations.set_first(picture_, toy_state());
    FirstPattern first(scene_.setup.format, picture_);
    auto coded = first.take(50);
    EXPECT_TRUE(coded);
    auto pattern = encode_first_pattern({0, 0, rest, std::move(coded->av1)}, scene_.setup);
    EXPECT_TRUE(pattern);
    return {scene_,
            rest,
            32,
            RatePlan{OperatingPoint::at(settings.quality, 32), 0},
            std::move(geometry->payload),
            std::move(*pattern),
            std::move(observations)};
  }

  Picture picture_ = picture_of(smooth_plane, 160, 128, 1);
  Scene scene_ = toy_scene(picture_);
  std::uint64_t before_ = 0;
  PacketReader reader_;  ///< of all that has been taken
  FaceCoder coder_;
};

EncoderSettings one_pattern() {
  EncoderSettings out;
  out.patterns = 1;
  return out;
}

/// Groups of two pictures.
EncoderSettings live(EncoderSettings settings) {
  settings.live.emplace();
  settings.live->delay = 2.0 / kFps;
  return settings;
}

using enum PacketType;
const std::vector<PacketType> kHead = {kSetup, kGeometry, kSurround, kPattern};

std::vector<PacketType> then(std::vector<PacketType> head, std::size_t motion) {
  head.insert(head.end(), motion, kMotion);
  return head;
}

TEST(FaceCoder, TheHeadWaitsForTheLookaheadAndMotionForTheHead) {
  RestingHead head(one_pattern());
  head.add(kLookahead - 1);
  EXPECT_TRUE(head.taken().empty());
  head.add(1);
  EXPECT_EQ(head.taken(), then(kHead, 2)) << "the first picture, then a second's";
  ASSERT_TRUE(head.coder().finish());
  EXPECT_EQ(head.taken(), std::vector{kMotion});
}

TEST(FaceCoder, ALiveSceneBeginsWithItsFirstPicture) {
  RestingHead head(live(one_pattern()));
  head.add(1);
  EXPECT_EQ(head.taken(), then(kHead, 1));
  head.add(2);
  EXPECT_EQ(head.taken(), std::vector{kMotion});
}

TEST(FaceCoder, AnotherSceneBeginsAfterTheKeyInterval) {
  EncoderSettings settings = one_pattern();
  settings.key_interval = 3;
  RestingHead head(settings);
  head.add(3 * kFps);
  EXPECT_EQ(head.taken().front(), kSetup);
  head.add(kLookahead);
  EXPECT_EQ(head.taken().front(), kSetup);
  EXPECT_EQ(head.before(), 3U * kFps);
}

TEST(FaceCoder, ARequestEndsALiveSceneOnce) {
  RestingHead head(live({}));
  head.add(3);
  head.coder().ledger().request_scene();
  head.add(2);
  head.coder().ledger().request_scene();
  head.add(3);
  const auto packets = head.taken();
  EXPECT_EQ(std::count(packets.begin(), packets.end(), kSetup), 2) << "it had ended already";
  EXPECT_EQ(head.before(), 5U);
}

TEST(FaceCoder, LivePatternsBringAUnitWithEachGroup) {
  RestingHead head(live({}));
  ASSERT_TRUE(head.coder().has_several_patterns());
  head.add(1);
  EXPECT_EQ(head.taken(), (std::vector{kSetup, kGeometry, kSurround, kPattern, kUnit}));
  head.add(2);
  EXPECT_EQ(head.taken(), (std::vector{kUnit}));
}

TEST(FaceCoder, SeveralPatternsComeWhenTheirSegmentEnds) {
  RestingHead head({});
  head.add(static_cast<int>(2 * kLookahead));
  EXPECT_TRUE(head.taken().empty());
  ASSERT_TRUE(head.coder().finish());
  const auto packets = head.taken();
  ASSERT_GT(packets.size(), 4U);
  EXPECT_EQ(packets.front(), kSetup);
  EXPECT_EQ(std::ranges::count(packets, kBlend), std::ranges::count(packets, kMotion));
}

}  // namespace
}  // namespace fbs
