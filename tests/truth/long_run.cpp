// long_run: a talker's clip played forwards and backwards for six minutes. Does the state drift?
//
//   long_run [--pictures 9000] [--clip 150] [--size 176x144] [--noise 2] [--seed 1] [--quality 50]
//
// Each picture gets its own noise, so that no two are identical and drift can accumulate. The pictures are
// encoded and decoded, and the states compared with the states of the second round at the same phase. (In the
// first round, parts without a contour, such as pupils, are still converging.) Exit code 1 when the end
// differs from the beginning.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "encoder/model/pose.h"
#include "tests/talker/talker_noise.h"
#include "tests/talker/talker_render.h"
#include "tests/unit/encode_decode.h"

namespace {

using namespace fbs;

constexpr double kMostDegrees = 0.3, kMostPixels = 0.3;

/// The last two seconds, backwards, show the same as the first two. Single poses jitter: in each round one is
/// off by nearly two degrees.
constexpr int kEndPictures = 60;
constexpr double kDegrees = 57.29577951308232;

struct Options {
  int pictures = 9000;
  talker::Settings talker;
  int quality = 50;
  int noise = 2;

  Options() { talker.width = 176, talker.height = 144, talker.frame_count = 150; }
};

bool number(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= 0;
}

std::optional<Options> parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i], value = argv[i + 1];
    int seed = 1;
    const auto cross = value.find('x');
    const bool read = name == "--pictures"  ? number(value, o.pictures) && o.pictures > 0
                      : name == "--clip"    ? number(value, o.talker.frame_count) && o.talker.frame_count > 1
                      : name == "--noise"   ? number(value, o.noise)
                      : name == "--quality" ? number(value, o.quality)
                      : name == "--seed"    ? number(value, seed)
                      : name == "--size"    ? cross != std::string_view::npos &&
                                               number(value.substr(0, cross), o.talker.width) &&
                                               number(value.substr(cross + 1), o.talker.height)
                                         : false;
    if (!read) return std::nullopt;
    if (name == "--seed") o.talker.seed = static_cast<std::uint32_t>(seed);
  }
  return argc % 2 == 1 ? std::optional(o) : std::nullopt;
}

/// The clip forwards and backwards: picture i, with noise that never repeats.
class ToAndFro {
 public:
  explicit ToAndFro(const Options& o) : noise_(o.noise) {
    const talker::Talker talker(o.talker);
    for (int i = 0; i < o.talker.frame_count; ++i) clip_.push_back(talker.picture(i));
    for (std::uint32_t i = 0; i < kTable; ++i)
      table_.push_back(static_cast<int>(
          std::lround(static_cast<float>(o.noise) * talker::normal_noise(i, o.talker.seed, 0, 0))));
  }

  /// Pictures in one round.
  [[nodiscard]] int round() const { return 2 * (static_cast<int>(clip_.size()) - 1); }

  [[nodiscard]] Picture at(int i) const {
    const int phase = i % round(), last = static_cast<int>(clip_.size()) - 1;
    Picture p = clip_[phase <= last ? phase : round() - phase];
    if (noise_ == 0) return p;
    auto place = talker::hash(static_cast<std::uint32_t>(i));
    for (Plane* plane : {&p.y, &p.u, &p.v})
      for (std::uint8_t& s : plane->samples)
        s = static_cast<std::uint8_t>(std::clamp(s + table_[++place % kTable], 0, 255));
    return p;
  }

 private:
  static constexpr std::uint32_t kTable = 65521;  // a prime, so that rows do not align with it
  int noise_;
  std::vector<Picture> clip_;
  std::vector<int> table_;
};

/// A decoded state: pose and positions of the vertices.
struct Shown {
  Pose pose;
  std::array<glm::dvec2, kVertexCount> vertices{};

  explicit Shown(const StreamDecoder& decoder) : pose(pose_of(decoder.state())) {
    const auto projected = decoder.scene().geometry->project_vertices(decoder.state());
    for (std::size_t v = 0; v < kVertexCount; ++v)
      vertices[v] = glm::dvec2(projected[v].x, projected[v].y) / 64.0;
  }
};

/// Difference between two pictures.
struct Apart {
  double degrees = 0, shift_px = 0, vertices_px = 0;

  Apart() = default;
  Apart(const Shown& a, const Shown& b)
      : degrees(kDegrees *
                std::hypot(a.pose.pitch - b.pose.pitch, a.pose.yaw - b.pose.yaw, a.pose.roll - b.pose.roll)),
        shift_px(glm::length(a.pose.shift - b.pose.shift)) {
    for (std::size_t v = 0; v < kVertexCount; ++v)
      vertices_px += glm::length(a.vertices[v] - b.vertices[v]) / static_cast<double>(kVertexCount);
  }
  void take_worst(const Apart& a) {
    degrees = std::max(degrees, a.degrees);
    shift_px = std::max(shift_px, a.shift_px);
    vertices_px = std::max(vertices_px, a.vertices_px);
  }
};

/// Differences between one round and the second.
struct Round {
  int pictures = 0;
  Apart sum, worst;
  glm::dvec3 turn{0};  ///< sums of signed differences: drift does not average out
  glm::dvec2 shift{0};
  std::array<glm::dvec2, kVertexCount> moved{};  ///< the same sums for each vertex, with the pose

  void take(const Shown& now, const Shown& first) {
    const Apart a(now, first);
    worst.take_worst(a);
    sum.degrees += a.degrees, sum.shift_px += a.shift_px, sum.vertices_px += a.vertices_px;
    turn += glm::dvec3(now.pose.pitch - first.pose.pitch, now.pose.yaw - first.pose.yaw,
                       now.pose.roll - first.pose.roll);
    shift += now.pose.shift - first.pose.shift;
    for (std::size_t v = 0; v < kVertexCount; ++v) moved[v] += now.vertices[v] - first.vertices[v];
    ++pictures;
  }
  [[nodiscard]] double drift_degrees() const { return kDegrees * glm::length(turn) / pictures; }
  [[nodiscard]] double drift_px() const { return glm::length(shift) / pictures; }
  /// The vertex that has drifted farthest: a single bad vertex would vanish in a mean over 105.
  [[nodiscard]] std::size_t strayed() const {
    const auto far = [](glm::dvec2 a, glm::dvec2 b) { return glm::length(a) < glm::length(b); };
    return static_cast<std::size_t>(std::max_element(moved.begin(), moved.end(), far) - moved.begin());
  }
  [[nodiscard]] double strayed_px() const { return glm::length(moved[strayed()]) / pictures; }
  [[nodiscard]] bool drifted() const {
    return drift_degrees() > kMostDegrees || drift_px() > kMostPixels || strayed_px() > kMostPixels;
  }
  void print(const std::string& name) const {
    std::printf("%6s %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f  %s\n", name.c_str(),
                sum.degrees / pictures, sum.shift_px / pictures, sum.vertices_px / pictures, worst.degrees,
                worst.shift_px, worst.vertices_px, drift_degrees(), drift_px(), strayed_px(),
                std::string(generic_head().vertices[strayed()].name).c_str());
  }
};

/// Encodes and decodes; `see` gets every decoded picture.
template <class See>
std::optional<Error> run(const Options& o, const ToAndFro& source, int pictures, See see) {
  VideoFormat format;
  format.width = o.talker.width;
  format.height = o.talker.height;
  format.frame_rate = o.talker.frame_rate;
  EncoderSettings settings;
  settings.quality = o.quality;
  settings.patterns = 1;  // states do not depend on them
  const auto stream = encode_pictures(format, settings, pictures, [&](int i) { return source.at(i); });
  if (!stream) return stream.error();
  std::optional<Error> error;
  const auto end = decode_pictures(*stream, [&](const StreamDecoder& decoder) {
    if (decoder.scene().geometry)
      see(Shown(decoder));
    else
      error = Error{ErrorCode::kNoFace, "no face in the first picture"};
  });
  if (!end) error = end.error();
  return error;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) {
    std::fputs(
        "usage: long_run [--pictures N] [--clip N] [--size WxH] [--noise N] [--seed N] [--quality N]\n",
        stderr);
    return 2;
  }
  const ToAndFro source(*options);
  const int rounds = (options->pictures + source.round() - 1) / source.round();
  std::vector<Shown> second;
  std::vector<Round> seen(static_cast<std::size_t>(rounds) + 1);
  std::vector<Shown> beginning;
  std::deque<Shown> end;  // latest first
  int i = 0;
  const auto error = run(*options, source, rounds * source.round() + 1, [&](const Shown& now) {
    if (i / source.round() == 1) second.push_back(now);
    if (i >= source.round()) seen[i / source.round()].take(now, second[i % source.round()]);
    if (i < kEndPictures) beginning.push_back(now);
    end.push_front(now);
    if (end.size() > kEndPictures) end.pop_back();
    ++i;
  });
  if (error) {
    std::fprintf(stderr, "long_run: %s\n", error->text.c_str());
    return 1;
  }
  std::puts(
      "against the second round at the same phase: mean, worst, and drift (mean of signed differences;");
  std::puts("the last column is that of the vertex that drifted farthest)");
  std::puts(
      " round   degrees  shift px  verts px   degrees  shift px  verts px   degrees  shift px   vert px");
  for (int r = 2; r < rounds; ++r)
    if (r == 2 || r == rounds - 1 || r % std::max(1, rounds / 10) == 0) seen[r].print(std::to_string(r + 1));
  Round ends;
  for (std::size_t k = 0; k < beginning.size(); ++k) ends.take(end[k], beginning[k]);
  std::puts("the last two seconds, backwards, against the first:");
  ends.print("end");
  const bool drifted = ends.drifted() || (rounds > 2 && seen[static_cast<std::size_t>(rounds) - 1].drifted());
  if (drifted) std::puts("FAILED: it does not end where it began");
  return drifted ? 1 : 0;
}
