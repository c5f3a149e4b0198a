#include "tests/figures/footage.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "cli/video/open/open_video.h"
#include "encoder/model/pose.h"
#include "encoder/track/feature_tracker.h"
#include "tests/talker/talker_render.h"
#include "tests/unit/encode_decode.h"

namespace fbs::figures {
namespace {

constexpr std::size_t kMostPictures = 150;  // of a clip: five seconds hold a word, a blink and a frown
constexpr std::size_t kLeastPictures = 4;
constexpr double kTrusted = 0.7;  // confidence from which on what was tracked may choose a picture

/// The mesh's landmarks; lips and brows by their snakes, which show what was seen and not what was coded.
Landmarks landmarks_of(const PictureAnalysis& analysis) {
  Landmarks out;
  for (std::size_t k = 0; k < kLandmarkCount; ++k) out[k] = analysis.vertices[vertex_of_landmark(k)];
  const auto& lips = snake_of(analysis, FeatureId::kMouthOuter);
  const auto &right = snake_of(analysis, FeatureId::kBrowRight),
             &left = snake_of(analysis, FeatureId::kBrowLeft);
  out[51] = lips[lips.size() / 4];
  out[57] = lips[lips.size() * 3 / 4];
  out[19] = right[right.size() / 2];
  out[24] = left[left.size() / 2];
  return out;
}

}  // namespace

Footage talker_footage(const std::string& name, std::uint32_t seed) {
  talker::Settings s;
  s.width = s.height = 288;
  s.frame_count = 120;
  s.seed = seed;
  s.eye_distance = 0.19F;
  s.motion = talker::Motion::kDefault;
  const talker::Talker talker(s);
  Footage out{name, {}, {}, {}};
  out.format.width = s.width;
  out.format.height = s.height;
  out.format.frame_rate = s.frame_rate;
  for (int i = 0; i < s.frame_count; ++i) {
    out.pictures.push_back(talker.picture(i));
    const auto points = talker.points(i);
    Landmarks& truth = out.truth.emplace_back();
    // The talker counts from the first pixel's centre.
    for (std::size_t k = 0; k < truth.size(); ++k) truth[k] = glm::dvec2(points[k]) + 0.5;
  }
  return out;
}

Result<Footage> clip_footage(const std::string& path) {
  auto source = open_video_source(path);
  if (!source) return fail(source.error());
  Footage out{std::filesystem::path(path).stem().string(), (*source)->format(), {}, {}};
  while (out.pictures.size() < kMostPictures) {
    auto next = (*source)->next();
    if (!next) return fail(next.error());
    if (!*next) break;
    out.pictures.push_back(std::move((*next)->picture));
  }
  if (out.pictures.size() < kLeastPictures)
    return fail(ErrorCode::kDegenerateInput, "fewer pictures than a figure shows");
  return out;
}

EncoderSettings paper_settings() {
  EncoderSettings settings;
  settings.patterns = 1;
  settings.track_only = true;
  return settings;
}

Result<Followed> follow(const Footage& footage, const EncoderSettings& settings) {
  auto encoder = Encoder::create(footage.format, settings);
  if (!encoder) return fail(encoder.error());
  Followed out;
  for (const Picture& p : footage.pictures) {
    if (auto pushed = encoder->push(p); !pushed) return fail(pushed.error());
    if (!encoder->analysis().face)
      return fail(ErrorCode::kNoFace, "no face in the first picture of " + footage.name);
    out.analysis.push_back(encoder->analysis());
  }
  if (auto finished = encoder->finish(); !finished) return fail(finished.error());
  out.stream = encoder->take();

  const auto end = decode_pictures(out.stream, [&](const StreamDecoder& decoder) {
    out.scene = decoder.scene();
    out.states.push_back(decoder.state());
  });
  if (!end) return fail(end.error());
  return out;
}

Result<std::vector<Picture>> decode(const std::vector<std::uint8_t>& stream,
                                    const std::vector<int>& numbers) {
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  std::vector<Picture> out;
  for (int i = 0; out.size() < numbers.size(); ++i) {
    const auto status = decoder.next();
    if (!status) return fail(status.error());
    if (*status != DecodeStatus::kPicture) return fail(ErrorCode::kInternal, "the stream lacks pictures");
    if (numbers[out.size()] != i) continue;
    if (auto drawn = decoder.render(out.emplace_back()); !drawn) return fail(drawn.error());
  }
  return out;
}

const std::vector<glm::dvec2>& snake_of(const PictureAnalysis& analysis, FeatureId id) {
  const auto at = std::find(kSnakeFeatures.begin(), kSnakeFeatures.end(), id) - kSnakeFeatures.begin();
  return analysis.snakes[at].points;
}

std::vector<double> measure(const Footage& footage, const Followed& followed, double FaceMotion::*what) {
  std::vector<double> out;
  for (const Landmarks& truth : footage.truth) out.push_back(face_motion(truth).*what);
  if (!out.empty()) return out;
  for (const PictureAnalysis& a : followed.analysis)
    out.push_back(a.confidence < kTrusted ? std::numeric_limits<double>::quiet_NaN()
                                          : face_motion(landmarks_of(a)).*what);
  return out;
}

}  // namespace fbs::figures
