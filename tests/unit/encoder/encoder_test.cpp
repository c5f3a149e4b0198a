// From pictures to stream to pictures: the whole codec on the generated talker.
#include "encoder/encoder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "common/quality.h"
#include "tests/unit/encode_decode.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

using Pictures = std::vector<Picture>;

Pictures pictures_of(TalkerClip clip) {
  Pictures out;
  for (int i = 0; i < clip.count(); ++i) out.push_back(clip[i]);
  return out;
}

VideoFormat format_of(const Pictures& pictures, Rational rate = {15, 1}) {
  VideoFormat f;
  f.width = pictures[0].width();
  f.height = pictures[0].height();
  f.frame_rate = rate;
  return f;
}

struct Coded {
  std::vector<std::uint8_t> stream;
  Pictures pictures;
  std::vector<std::uint32_t> durations;
  ByteCount bytes;

  [[nodiscard]] double psnr(const Pictures& source) const {
    SquaredError e;
    for (std::size_t i = 0; i < source.size(); ++i) e += squared_error(pictures[i].y, source[i].y);
    return e.psnr();
  }
};

Result<std::vector<std::uint8_t>> encoded(const Pictures& source, const VideoFormat& format,
                                          const EncoderSettings& settings,
                                          const std::vector<std::uint32_t>& durations = {}) {
  return encode_pictures(format, settings, source, durations);
}

Coded decoded(std::vector<std::uint8_t> stream) {
  Coded out;
  out.stream = std::move(stream);
  StreamDecoder decoder;
  decoder.feed(out.stream);
  decoder.close();
  const auto end = decode_pictures(decoder, [&](StreamDecoder&) {
    out.pictures.emplace_back();
    EXPECT_TRUE(decoder.render(out.pictures.back()));
    out.durations.push_back(decoder.duration());
  });
  EXPECT_TRUE(end) << end.error().text;
  out.bytes = decoder.bytes();
  EXPECT_EQ(decoder.announced_pictures(), out.pictures.size());
  return out;
}

Coded coded(const Pictures& source, const EncoderSettings& settings = {}) {
  auto stream = encoded(source, format_of(source), settings);
  EXPECT_TRUE(stream) << stream.error().text;
  return decoded(stream ? *stream : std::vector<std::uint8_t>{});
}

constexpr Rational kRate{15, 1};

const Pictures& talking() {
  static const Pictures p = [] {
    auto settings = talker_settings(128, 96, 45);  // more than the encoder looks ahead
    settings.frame_rate = kRate;
    settings.eye_distance = 0.2F;
    return pictures_of(TalkerClip(settings));
  }();
  return p;
}

const Pictures& shortly() {
  static const Pictures p(talking().begin(), talking().begin() + 10);
  return p;
}

const Coded& coded_talk() {
  static const Coded c = coded(talking());
  return c;
}

EncoderSettings quality(int q) {
  EncoderSettings s;
  s.quality = q;
  return s;
}

TEST(Encoder, EveryPictureComesBack) {
  const Coded& c = coded_talk();
  ASSERT_EQ(c.pictures.size(), talking().size());
  for (const Picture& p : c.pictures) {
    EXPECT_EQ(p.width(), 128);
    EXPECT_EQ(p.height(), 96);
  }
  EXPECT_EQ(c.bytes.total, c.stream.size());
  EXPECT_EQ(c.bytes.geometry + c.bytes.patterns + c.bytes.motion + c.bytes.other, c.bytes.total);
}

TEST(Encoder, ReachesItsFloorOfQuality) {
  const Coded& c = coded_talk();
  EXPECT_GT(c.psnr(talking()), 30);
  EXPECT_GT(squared_error(c.pictures[0].y, talking()[0].y).psnr(), 31) << "the first picture is its pattern";
}

// The purpose of the model: far better than the first picture held, for a few bytes per picture.
TEST(Encoder, MotionBeatsTheFirstPictureHeld) {
  const Coded& c = coded_talk();
  SquaredError held;
  for (const Picture& p : talking()) held += squared_error(c.pictures[0].y, p.y);
  EXPECT_GT(c.psnr(talking()), held.psnr() + 3);
  EXPECT_LT(static_cast<double>(c.bytes.motion) / 45, 15) << "bytes a picture";
}

TEST(Encoder, QualityOrdersBytesAndPsnr) {
  std::size_t bytes = 0;
  double psnr = 0;
  for (const int q : {10, 50, 90}) {
    const Coded c = coded(shortly(), quality(q));
    EXPECT_GT(c.stream.size(), bytes) << q;
    EXPECT_GT(c.psnr(shortly()), psnr) << q;
    bytes = c.stream.size();
    psnr = c.psnr(shortly());
  }
}

TEST(Encoder, SameInputGivesTheSameBytes) {
  EXPECT_EQ(*encoded(shortly(), format_of(shortly()), {}), *encoded(shortly(), format_of(shortly()), {}));
}

TEST(Encoder, TakesOddSizes) {
  for (const auto& [w, h] : {std::pair{67, 65}, {64, 64}, {129, 97}}) {
    const Pictures p = pictures_of(TalkerClip(talker_settings(w, h, 4)));
    const Coded c = coded(p);
    ASSERT_EQ(c.pictures.size(), 4u) << w << 'x' << h;
    EXPECT_EQ(c.pictures[3].width(), w);
    EXPECT_EQ(c.pictures[3].u.height, (h + 1) / 2);
    EXPECT_GT(c.psnr(p), 28) << w << 'x' << h;
  }
}

TEST(Encoder, CodesAClipOfOnePicture) {
  const Pictures one(talking().begin(), talking().begin() + 1);
  const Coded c = coded(one);
  ASSERT_EQ(c.pictures.size(), 1u);
  EXPECT_GT(c.psnr(one), 29.5);
  EncoderSettings settings;
  settings.tune = Tune::kPsnr;
  EXPECT_GT(coded(one, settings).psnr(one), 30);
}

TEST(Encoder, RefusesAClipWithoutAFace) {
  const Pictures nobody(8, Picture(96, 96));
  const auto stream = encoded(nobody, format_of(nobody), {});
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, ErrorCode::kNoFace);
}

TEST(Encoder, CodesAClipWithoutAFaceWhenAllowed) {
  Picture ramp(96, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) ramp.y.row(y)[x] = static_cast<std::uint8_t>(60 + x);
  const Pictures nobody(8, ramp);
  EncoderSettings settings;
  settings.allow_no_face = true;
  const Coded c = coded(nobody, settings);
  ASSERT_EQ(c.pictures.size(), 8u);
  EXPECT_GT(c.psnr(nobody), 35);
  EXPECT_EQ(c.bytes.geometry, 0u);
}

TEST(Encoder, RefusesNoPicturesAtAll) {
  VideoFormat format;
  format.width = format.height = 64;
  auto encoder = Encoder::create(format, {});
  ASSERT_TRUE(encoder);
  EXPECT_EQ(encoder->finish().error().code, ErrorCode::kInvalidArgument);
}

// A title before the talk: pictures until a face is found go as a scene without geometry. The decoder checks
// the position of the second scene.
TEST(Encoder, FaceMayAppearLate) {
  Pictures p(7, Picture(128, 96));
  for (Picture& grey : p)
    for (auto& s : grey.y.samples) s = 100;
  p.insert(p.end(), talking().begin(), talking().begin() + 12);
  std::vector<std::uint32_t> durations(p.size());  // 0: nominal
  durations[2] = 9000;
  const auto stream = encoded(p, format_of(p), {}, durations);
  ASSERT_TRUE(stream);
  const Coded c = decoded(*stream);
  ASSERT_EQ(c.pictures.size(), p.size());
  EXPECT_GT(c.bytes.geometry, 0u);
  EXPECT_GT(squared_error(c.pictures[0].y, p[0].y).psnr(), 40);
  SquaredError late;
  for (std::size_t i = 12; i < p.size(); ++i) late += squared_error(c.pictures[i].y, p[i].y);
  EXPECT_GT(late.psnr(), 28);
}

// Something before the camera: the state is held, and the face found again.
TEST(Encoder, FaceMayBeLostAndComeBack) {
  Pictures p(talking().begin(), talking().begin() + 30);
  for (std::size_t i = 10; i < 15; ++i)
    for (int y = 10; y < 96; ++y) std::fill_n(p[i].y.row(y) + 20, 88, std::uint8_t{90});
  const Coded c = coded(p);
  ASSERT_EQ(c.pictures.size(), p.size());
  SquaredError after;
  for (std::size_t i = 22; i < 30; ++i) after += squared_error(c.pictures[i].y, p[i].y);
  EXPECT_GT(after.psnr(), 25);
  // Shown is what covers the face, or the face that is held.
  for (std::size_t i = 10; i < 15; ++i)
    EXPECT_GT(std::max(squared_error(c.pictures[i].y, talking()[i].y).psnr(),
                       squared_error(c.pictures[i].y, p[i].y).psnr()),
              20)
        << "never a wild face: picture " << i;
}

Picture slide() {
  Picture out(128, 96);
  for (auto& s : out.y.samples) s = 230;
  for (int y = 12; y < 84; y += 12)
    for (int line = 0; line < 5; ++line)
      for (int x = 10; x < 110; ++x)
        out.y.row(y + line)[x] = static_cast<std::uint8_t>((x * (y + 7) / 29 + line) % 3 == 0 ? 40 : 230);
  return out;
}

/// A talker of 20 pictures, something else, and 20 of the talker again.
Pictures interrupted(const Pictures& by) {
  Pictures p(talking().begin(), talking().begin() + 20);
  p.insert(p.end(), by.begin(), by.end());
  p.insert(p.end(), talking().begin() + 20, talking().begin() + 40);
  return p;
}

double psnr_from(const Coded& c, const Pictures& source, std::size_t first, std::size_t count) {
  SquaredError e;
  for (std::size_t i = first; i < first + count; ++i) e += squared_error(c.pictures[i].y, source[i].y);
  return e.psnr();
}

struct Watched {
  Coded coded;
  EncodingReport report;
};

Watched watched(const Pictures& source, const EncoderSettings& settings = {}) {
  auto encoder = Encoder::create(format_of(source), settings);
  EXPECT_TRUE(encoder);
  for (const Picture& picture : source) EXPECT_TRUE(encoder->push(picture));
  EXPECT_TRUE(encoder->finish());
  return {decoded(encoder->take()), encoder->report()};
}

// The scene's patterns carry a slide, and the face is found again after it.
TEST(Encoder, SlideAndBackStayOneScene) {
  const Pictures source = interrupted(Pictures(12, slide()));
  const Watched w = watched(source);
  EXPECT_EQ(w.report.pictures, 52U);
  EXPECT_EQ(w.report.cuts, 2U);
  EXPECT_EQ(w.report.scenes, 1U);
  EXPECT_EQ(w.report.without_face, 12U);
  ASSERT_EQ(w.coded.pictures.size(), 52U);
  EXPECT_GT(psnr_from(w.coded, source, 0, 20), 28);
  EXPECT_GT(psnr_from(w.coded, source, 21, 10), 20);
  EXPECT_GT(psnr_from(w.coded, source, 33, 19), 28);
}

// A slide that stays is worth a scene, with finer patterns than a face.
TEST(Encoder, SlideThatStaysIsASceneOfItsOwn) {
  const Pictures source = interrupted(Pictures(60, slide()));
  const Watched w = watched(source);
  EXPECT_EQ(w.report.cuts, 2U);
  EXPECT_EQ(w.report.scenes, 2U) << "the face returns to its own";
  EXPECT_EQ(w.report.without_face, 60U);
  ASSERT_EQ(w.coded.pictures.size(), 100U);
  EXPECT_GT(psnr_from(w.coded, source, 55, 25), psnr_from(w.coded, source, 21, 20) + 3);
  EXPECT_GT(psnr_from(w.coded, source, 81, 19), 28);
}

// Patterns of dark pictures are too coarse for bright ones.
TEST(Encoder, FaceOutOfTheDarkHasASceneOfItsOwn) {
  constexpr int kFade = 15;
  Pictures p = talking();
  for (int t = 0; t < kFade; ++t)
    for (Plane* plane : {&p[t].y, &p[t].u, &p[t].v}) {
      const int black = plane == &p[t].y ? 16 : 128;
      for (auto& s : plane->samples) s = static_cast<std::uint8_t>(black + (s - black) * t / kFade);
    }
  const Watched w = watched(p);
  EXPECT_EQ(w.report.scenes, 2U);
  EXPECT_LE(w.report.without_face, kFade + 8U);
  EXPECT_GT(psnr_from(w.coded, p, 0, kFade), 29);
  const Pictures lit(p.begin() + kFade, p.end());
  EXPECT_GT(psnr_from(w.coded, p, 24, 21), psnr_from(coded(lit), lit, 24 - kFade, 21) - 0.5) << "alone";
}

TEST(Encoder, AnotherPersonIsAnotherScene) {
  auto settings = talker_settings(128, 96, 20);
  settings.frame_rate = kRate;
  settings.eye_distance = 0.3F;
  settings.seed = 6;
  const Pictures source = interrupted(pictures_of(TalkerClip(settings)));
  const Watched w = watched(source);
  EXPECT_EQ(w.report.cuts, 2U);
  EXPECT_EQ(w.report.scenes, 2U) << "the first person returns";
  EXPECT_LE(w.report.without_face, 5U);
  for (const std::size_t first : {0, 20, 40}) EXPECT_GT(psnr_from(w.coded, source, first, 20), 28) << first;
}

// As where a talk is cut between two framings.
TEST(Encoder, SamePersonFramedCloserStaysInTheScene) {
  auto settings = talker_settings(128, 96, 20);
  settings.frame_rate = kRate;
  settings.eye_distance = 0.34F;
  const Pictures source = interrupted(pictures_of(TalkerClip(settings)));
  const Watched w = watched(source);
  EXPECT_EQ(w.report.cuts, 2U);
  EXPECT_EQ(w.report.scenes, 1U);
  EXPECT_EQ(w.report.without_face, 0U);
  for (const std::size_t first : {0, 20, 40}) EXPECT_GT(psnr_from(w.coded, source, first, 20), 28) << first;
  EncoderSettings live;
  live.live.emplace();
  EXPECT_EQ(watched(source, live).report.scenes, 3U);
}

// With one pattern a scene has nothing to carry a slide with.
TEST(Encoder, CutsOfASinglePatternAreScenes) {
  EncoderSettings settings;
  settings.patterns = 1;
  const Pictures source = interrupted(Pictures(20, slide()));
  const Watched w = watched(source, settings);
  EXPECT_EQ(w.report.cuts, 2U);
  EXPECT_EQ(w.report.scenes, 3U);
  EXPECT_GT(psnr_from(w.coded, source, 20, 20), 20);
  EXPECT_GT(psnr_from(w.coded, source, 40, 20), 25);
}

TEST(Encoder, SaysAtOnceThatThereIsNoSuchFace) {
  auto encoder = Encoder::create(format_of(talking()), [] {
    EncoderSettings s;
    s.face = 1;
    return s;
  }());
  ASSERT_TRUE(encoder);
  const auto pushed = encoder->push(talking()[0]);
  ASSERT_FALSE(pushed);
  EXPECT_EQ(pushed.error().code, ErrorCode::kTooFewFaces);
  EXPECT_EQ(pushed.error().text, "no face 1: picture 0 shows 1, and the largest is face 0");
}

TEST(Encoder, FollowsTheFaceMarkedByHand) {
  TalkerClip clip(talker_settings(128, 96, 1));
  EncoderSettings settings;
  settings.marks = clip.marks(0);
  auto encoder = Encoder::create(clip.format(), settings);
  ASSERT_TRUE(encoder);
  ASSERT_TRUE(encoder->push(clip[0]));
  const PictureAnalysis& seen = encoder->analysis();
  EXPECT_TRUE(seen.face);
  EXPECT_FALSE(seen.snakes.empty());
  EXPECT_TRUE(seen.snakes.front().closed) << "outer lips";
  for (const SnakeOutline& s : seen.snakes) EXPECT_GT(s.points.size(), 8U);
  EXPECT_FALSE(seen.snakes.back().closed) << "a lid";
  for (int k = 0; k < kLandmarkCount; ++k) {
    const glm::dvec2 mark = *settings.marks->landmark(k);
    const glm::dvec2 vertex = seen.vertices[vertex_of_landmark(k)];
    EXPECT_LT(std::hypot(mark.x - vertex.x, mark.y - vertex.y), 0.04 * clip.pose(0).eye_distance_px()) << k;
  }
}

TEST(Encoder, KeepsDurations) {
  std::vector<std::uint32_t> durations;
  for (std::size_t i = 0; i < shortly().size(); ++i) durations.push_back(i % 5 == 4 ? 6006 : 3003);
  const auto stream = encoded(shortly(), format_of(shortly(), {30000, 1001}), {}, durations);
  ASSERT_TRUE(stream);
  EXPECT_EQ(decoded(*stream).durations, durations);
}

// The first picture is a group of its own: a viewer need not wait for more.
TEST(Encoder, GroupsHoldAsManyPicturesAsAsked) {
  EncoderSettings settings;
  for (const int group : {1, 4, 256}) {
    settings.group_pictures = group;
    const Coded c = coded(shortly(), settings);
    EXPECT_EQ(c.pictures.size(), shortly().size()) << group;
    PacketReader reader;
    reader.feed(c.stream);
    reader.close();
    int motion = 0;
    for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next())
      motion += read->packet.type == PacketType::kMotion || read->packet.type == PacketType::kUnit ? 1 : 0;
    const int later = static_cast<int>(shortly().size()) - 1;
    EXPECT_EQ(motion, 1 + (later + group - 1) / group);
  }
}

TEST(Encoder, TheExpressionCanBeLeftOut) {
  EncoderSettings settings;
  settings.expression = false;
  const Coded c = coded(shortly(), settings);
  EXPECT_EQ(c.pictures.size(), shortly().size());
}

TEST(Encoder, SurvivesNoise) {
  std::mt19937 random(1);
  Pictures p(talking().begin(), talking().begin() + 8);
  for (std::size_t i = 3; i < 8; ++i)
    for (auto& s : p[i].y.samples) s = static_cast<std::uint8_t>(random());
  EXPECT_EQ(coded(p).pictures.size(), p.size());
}

TEST(Encoder, RefusesAPictureOfAnotherSize) {
  auto encoder = Encoder::create(format_of(shortly()), {});
  ASSERT_TRUE(encoder);
  ASSERT_TRUE(encoder->push(shortly()[0]));
  EXPECT_EQ(encoder->push(Picture(128, 94)).error().code, ErrorCode::kInvalidArgument);
}

TEST(Encoder, RefusesAPictureThatLastsTooLongOrLacksSamples) {
  const Pictures p = shortly();
  auto encoder = Encoder::create(format_of(p), {});
  ASSERT_TRUE(encoder);
  const auto refuses = [&](const Picture& picture, std::uint32_t duration) {
    const auto pushed = encoder->push(picture, duration);
    return !pushed && pushed.error().code == ErrorCode::kInvalidArgument;
  };
  Picture thin = p[0], dense = p[0], cut = p[0];
  thin.u = Plane(1, 1);
  dense.v = Plane(p[0].width(), p[0].height());
  cut.y.samples.pop_back();
  EXPECT_TRUE(refuses(p[0], kMaxDuration + 1));
  for (const Picture& picture : {thin, dense, cut}) EXPECT_TRUE(refuses(picture, 0));
  // A refused picture changes nothing.
  ASSERT_TRUE(encoder->push(p[0], kMaxDuration));
  ASSERT_TRUE(encoder->finish());
  EXPECT_EQ(decoded(encoder->take()).durations, std::vector<std::uint32_t>{kMaxDuration});
}

TEST(Encoder, RefusesWhatComesAfterTheEnd) {
  const Pictures p = shortly();
  auto encoder = Encoder::create(format_of(p), {});
  ASSERT_TRUE(encoder->push(p[0]));
  ASSERT_TRUE(encoder->finish());
  EXPECT_FALSE(encoder->take().empty());
  EXPECT_EQ(encoder->push(p[1]).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(encoder->finish().error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(encoder->take().empty());
}

}  // namespace
}  // namespace fbs
