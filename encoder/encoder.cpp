#include "encoder/encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "encoder/find/found_marks.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/face_scene.h"
#include "encoder/scene/planar_scene.h"
#include "encoder/scene/scene_span.h"
#include "encoder/scene/still_scene.h"
#include "encoder/segment/pass_settings.h"
#include "encoder/shots/shot_watch.h"

namespace fbs {
namespace {

/// Where a face that lies is looked for: seconds, some apart, since the first picture may be black.
constexpr std::array kTurnLooks{0.0, 2.0};

/// Relative to a bitrate; a larger deviation is reported.
constexpr double kRateTolerance = 0.1;

/// Longest span of scenes that a video goes to and fro between, s.
constexpr double kSpanSeconds = 120;

/// Scenes that are coded to their ends at the same time, where there are threads for it: each needs memory.
constexpr int kScenesTogether = 2;

constexpr const char* kEnded = "the stream has ended";

/// Whether a number is at least zero and finite; NaN is not.
bool is_size(double value) {
  return value >= 0 && std::isfinite(value);
}

Result<void> check_start(const EncoderSettings& settings) {
  const double start = settings.start.value_or(0);
  if (!is_size(start))
    return fail(ErrorCode::kInvalidArgument, "a time to start that is negative or not finite");
  if (start == 0) return {};
  if (settings.bitrate == 0) return fail(ErrorCode::kInvalidArgument, "a time to start needs a bitrate");
  if (settings.patterns == 1)
    return fail(ErrorCode::kInvalidArgument, "a time to start needs more than one pattern");
  if (settings.live && settings.live->relies_on_first())
    return fail(ErrorCode::kInvalidArgument,
                "no time to start with strong resilience or a time to join, which rely on the first pattern");
  return {};
}

Result<void> check_settings(const EncoderSettings& settings) {
  if (settings.quality < 0 || settings.quality > 100)
    return fail(ErrorCode::kInvalidArgument, "quality outside 0..100");
  if (settings.group_pictures < 0 || settings.group_pictures > kMaxGroupPictures)
    return fail(ErrorCode::kInvalidArgument, "pictures in a group outside 1..256");
  if (!is_size(settings.bitrate) || !is_size(settings.seconds) || !is_size(settings.motion_bitrate))
    return fail(ErrorCode::kInvalidArgument, "a rate or length that is negative or not finite");
  if (auto start = check_start(settings); !start) return start;
  if (settings.patterns < 0 || settings.patterns > kMaxPatterns)
    return fail(ErrorCode::kInvalidArgument, "number of patterns outside 0..64");
  if (settings.pattern_quantiser < -1 || settings.pattern_quantiser > 63)
    return fail(ErrorCode::kInvalidArgument, "quantiser of patterns outside 0..63");
  if (settings.live && !(is_size(settings.live->delay) && settings.live->delay > 0 &&
                         is_size(settings.live->buffer) && settings.live->buffer > 0))
    return fail(ErrorCode::kInvalidArgument, "a delay or buffer that is not positive and finite");
  if (settings.live && !is_size(settings.live->join))
    return fail(ErrorCode::kInvalidArgument, "a time to join that is negative or not finite");
  if (settings.live && settings.patterns > 1)
    return fail(ErrorCode::kInvalidArgument, "live encoding takes 1 pattern, or 0 to choose their number");
  if (!is_size(settings.key_interval))
    return fail(ErrorCode::kInvalidArgument, "a key interval that is negative or not finite");
  if (settings.effort < 0 || settings.effort > Effort::kMost)
    return fail(ErrorCode::kInvalidArgument, "effort outside 0..9");
  if (settings.threads < 0) return fail(ErrorCode::kInvalidArgument, "a negative number of threads");
  if (settings.first_pattern && settings.patterns != 1)
    return fail(ErrorCode::kInvalidArgument, "a first pattern needs the number of patterns to be 1");
  if (settings.track_only && settings.landmarks)
    return fail(ErrorCode::kInvalidArgument, "landmarks are a start of the fit, and there is none");
  if (settings.track_only && !(settings.expression && settings.contours))
    return fail(ErrorCode::kInvalidArgument, "tracking alone, but of no contours");
  if (settings.face < 0) return fail(ErrorCode::kInvalidArgument, "a negative number of a face");
  return {};
}

/// Whether a plane has a size, and all its samples.
bool is_plane(const Plane& plane, int width, int height) {
  return plane.width == width && plane.height == height &&
         plane.samples.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

Result<void> check_picture(const Picture& picture, const VideoFormat& format, const PictureTime& when) {
  if (picture.width() != format.width || picture.height() != format.height)
    return fail(ErrorCode::kInvalidArgument, "the picture size changes inside the video");
  const int width = (format.width + 1) / 2, height = (format.height + 1) / 2;
  if (!is_plane(picture.y, format.width, format.height) || !is_plane(picture.u, width, height) ||
      !is_plane(picture.v, width, height))
    return fail(ErrorCode::kInvalidArgument, "a picture is not 4:2:0");
  if (when.duration > kMaxDuration)
    return fail(ErrorCode::kInvalidArgument, "a picture lasts more than a minute");
  return {};
}

}  // namespace

struct Encoder::Impl {
  VideoFormat format;
  EncoderSettings settings;
  FaceFinder finder;
  ShotWatch shots;
  SceneSpan scenes;
  std::vector<std::uint8_t> ready{};
  bool face_seen = false;      ///< in any picture
  std::size_t turn_looks = 0;  ///< done
  int turn = 0;                ///< degrees clockwise
  EncodingReport report{};
  StreamPosition position{};  ///< behind the last picture; where `timed`, its time is what is expected
  bool timed = false;         ///< pictures have times to begin
  bool analysing = false;     ///< the last picture may be so yet
  bool has_ended = false;     ///< the stream has its end packet
  PictureAnalysis nothing{};
  std::uint64_t lost = 0;   ///< pictures, the last ones, whose face was not followed
  std::uint64_t bytes = 0;  ///< of the scenes so far

  void take_from_scenes() {
    const auto taken = scenes.take();
    ready.insert(ready.end(), taken.begin(), taken.end());
    bytes += taken.size();
  }

  /// Ensures, before a scene begins, that its position is right: only the scene before knows which of its
  /// pictures could still end in time.
  void end_picture_at(const std::optional<std::uint64_t>& begin) {
    if (timed && scenes.present() != nullptr) position = scenes.present()->end_picture(begin);
  }

  /// Counts a picture that has been pushed.
  void add(const PictureTime& when) {
    const std::uint32_t duration = when.duration > 0 ? when.duration : nominal_duration(format.frame_rate);
    const std::uint64_t begin = std::max(position.time, when.begin.value_or(0));
    position = {position.pictures + 1, begin + duration};
  }

  /// Logs what happens at the picture of this number.
  void say(LogLevel level, std::uint64_t picture, const std::string& text) const {
    if (settings.hooks.logs()) settings.hooks.say(level, "picture " + std::to_string(picture) + ": " + text);
  }

  /// Marks of the face to track, if the picture shows one.
  /// @return kTooFewFaces when there are faces, but not so many as are asked for
  [[nodiscard]] Result<std::optional<Marks>> look_for_face(const Picture& picture, bool all_sizes) {
    if (settings.marks && report.pictures == 0) return settings.marks;
    const auto number = static_cast<std::size_t>(settings.face);
    const auto faces = finder.find(
        picture, number + 1, all_sizes ? FaceFinder::Effort::kAllSizes : FaceFinder::Effort::kUsualSizes);
    if (faces.empty() || faces.front().landmarks.belief < FaceFinder::kClear) look_for_turned_face(picture);
    if (faces.empty()) return std::nullopt;
    if (faces.size() > number) return marks_of(faces[number]);
    if (face_seen) return marks_of(faces.front());  // in another shot others may be alone
    return fail(ErrorCode::kTooFewFaces, "no face " + std::to_string(number) + ": picture " +
                                             std::to_string(report.pictures) + " shows " +
                                             std::to_string(faces.size()) + ", and the largest is face 0");
  }

  void look_for_turned_face(const Picture& picture) {
    if (settings.live || turn != 0 || turn_looks == kTurnLooks.size()) return;
    if (static_cast<double>(report.pictures) < kTurnLooks[turn_looks] * fps_of(format)) return;
    ++turn_looks;
    turn = finder.turn_to_upright(picture, thread_count(settings));
  }

  Result<void> begin_scene(const Picture& picture, const std::optional<Marks>& marks) {
    auto begun = marks ? FaceScene::begin(format, settings, finder, picture, *marks, position)
                 : settings.patterns == 1 ? StillScene::begin(format, settings, picture, position)
                                          : PlanarScene::begin(format, settings, position);
    if (!begun) return fail(begun.error());
    if (auto shown = scenes.begin(std::move(*begun), position.pictures); !shown) return shown;
    take_from_scenes();
    shots.begin_scene({marks.has_value(), scenes.present()->carries_shots()});
    if (marks) {
      face_seen = true;
      settings.first_pattern.reset();  // later scenes have another first picture
    }
    ++report.scenes;
    lost = 0;
    say(LogLevel::kInfo, report.pictures,
        marks ? "a scene begins, with a face" : "a scene begins, without a face");
    return {};
  }

  /// Goes on with an earlier scene, if the picture shows its person.
  Result<bool> return_to_scene(const Picture& picture) {
    auto returned = scenes.return_to(picture, position);
    if (!returned || !*returned) return returned;
    shots.begin_scene({true, scenes.present()->carries_shots()});
    shots.recognised();
    lost = 0;
    say(LogLevel::kInfo, report.pictures, "an earlier scene goes on");
    return true;
  }

  /// Ensures, before a picture, that there is a scene for it.
  Result<void> choose_scene(const Picture& picture, const std::optional<std::uint64_t>& begin) {
    const ShotWatch::Step step = shots.next();
    if (step.cut) {
      ++report.cuts;
      say(LogLevel::kInfo, report.pictures, "a cut");
      scenes.present()->cut();
    }
    if (!step.searches) return {};
    if (step.recognises && scenes.present()->recognises(picture)) {
      shots.recognised();
      return {};
    }
    const auto marks = look_for_face(picture, step.all_sizes);
    if (!marks) return fail(marks.error());
    end_picture_at(begin);
    const auto returned = *marks ? return_to_scene(picture) : Result<bool>(false);
    if (!returned) return fail(returned.error());
    if (*returned) return {};
    return shots.scene_begins(marks->has_value()) ? begin_scene(picture, *marks) : Result<void>{};
  }

  /// Landmarks of the next picture by another tracker, if it has some.
  void give_landmarks() {
    if (!settings.landmarks) return;
    if (const auto seen = settings.landmarks->find(report.pictures); seen != settings.landmarks->end())
      scenes.present()->give_landmarks(seen->second);
  }

  /// Logs where the face is lost, and found again.
  void note_face(const PictureAnalysis& seen) {
    const std::uint64_t picture = report.pictures - 1;
    if (seen.followed) {
      if (lost > 0) say(LogLevel::kInfo, picture, "the face is found again, after " + std::to_string(lost));
      lost = 0;
    } else if (seen.face && lost++ == 0) {
      say(LogLevel::kWarning, picture, "the face is lost");
    }
  }

  /// Logs a bitrate that a file has not met.
  void note_rate() const {
    if (settings.live) return;
    const double seconds = static_cast<double>(position.time) / kTicksPerSecond;
    const double kbps = 8e-3 * static_cast<double>(bytes) / seconds;
    if (!misses_bitrate(settings, kbps, seconds)) return;
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "target %.2f kbit/s not reachable, got %.2f", settings.bitrate,
                  kbps);
    settings.hooks.say(LogLevel::kWarning, text.data());
  }

  /// SceneEncoder::change() of the present scene, if there is one.
  Result<void> change(const std::function<void(SceneLedger&)>& how) const {
    if (has_ended) return fail(ErrorCode::kInvalidArgument, kEnded);
    if (scenes.present() == nullptr) return {};
    auto changed = scenes.present()->change(how);
    if (changed || changed.error().code != ErrorCode::kInvalidArgument) return changed;
    return fail(ErrorCode::kInternal, changed.error().text);  // of the coding: not that nothing has changed
  }

  /// Waits until the scene has analysed the picture pushed last.
  void end_picture() {
    if (!std::exchange(analysing, false)) return;
    const PictureAnalysis& seen = scenes.present()->analysis();
    shots.end_picture(seen.followed);
    note_face(seen);
    if (!seen.followed) ++report.without_face;
    if (seen.had_landmarks) ++report.with_landmarks;
    if (seen.from_landmarks) ++report.from_landmarks;
  }
};

Encoder::Encoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;
Encoder::~Encoder() = default;

Result<Encoder> Encoder::create(const VideoFormat& format, const EncoderSettings& settings) {
  if (auto checked = check_settings(settings); !checked) return fail(checked.error());
  Setup setup;
  setup.format = format;
  if (auto checked = check_setup(setup); !checked) return fail(checked.error());
  if (settings.first_pattern)
    if (auto checked = check_picture(*settings.first_pattern, format, {}); !checked)
      return fail(checked.error());
  auto finder = FaceFinder::create();
  if (!finder) return fail(finder.error());
  auto impl = std::unique_ptr<Impl>(
      new Impl{format, settings, std::move(*finder), ShotWatch(fps_of(format)),
               SceneSpan(static_cast<std::uint64_t>(kSpanSeconds * fps_of(format)),
                         settings.live ? 1 : std::min(kScenesTogether, thread_count(settings)))});
  write_signature(impl->ready);
  return Encoder(std::move(impl));
}

Result<void> Encoder::push(const Picture& picture, const PictureTime& when) {
  Impl& i = *impl_;
  if (i.has_ended) return fail(ErrorCode::kInvalidArgument, kEnded);
  if (auto checked = check_picture(picture, i.format, when); !checked) return checked;
  i.timed = i.timed || when.begin;
  i.shots.see(picture);  // while the picture before is analysed
  i.end_picture();
  if (auto ended = i.scenes.end_span(i.position.pictures); !ended) return ended;
  if (auto chosen = i.choose_scene(picture, when.begin); !chosen) return chosen;
  i.give_landmarks();
  if (auto pushed = i.scenes.present()->push(picture, when); !pushed) return pushed;
  i.take_from_scenes();
  i.analysing = true;
  ++i.report.pictures;
  i.add(when);
  return {};
}

Result<void> Encoder::request_scene() {
  Impl& i = *impl_;
  if (!i.settings.live)
    return fail(ErrorCode::kInvalidArgument, "scenes come on request in live encoding only");
  return i.change([](SceneLedger& ledger) { ledger.request_scene(); });
}

Result<void> Encoder::lose_patterns() {
  Impl& i = *impl_;
  if (!i.settings.live) return fail(ErrorCode::kInvalidArgument, "patterns are lost in live encoding only");
  return i.change([](SceneLedger& ledger) { ledger.lose_patterns(); });
}

Result<void> Encoder::set_bitrate(double kbps) {
  Impl& i = *impl_;
  if (!i.settings.live || i.settings.bitrate <= 0)
    return fail(ErrorCode::kInvalidArgument, "the bitrate changes in live encoding with a bitrate only");
  if (!(kbps > 0) || !is_size(kbps))
    return fail(ErrorCode::kInvalidArgument, "the bitrate is above 0 kbit/s");
  i.settings.bitrate = kbps;
  return i.change([kbps](SceneLedger& ledger) { ledger.set_bitrate(kbps); });
}

Result<void> Encoder::finish() {
  Impl& i = *impl_;
  if (i.has_ended) return fail(ErrorCode::kInvalidArgument, kEnded);
  if (i.report.pictures == 0) return fail(ErrorCode::kInvalidArgument, "no pictures");
  if (!i.face_seen && !i.settings.allow_no_face)
    return fail(ErrorCode::kNoFace, i.turn == 0 ? "no face found in any picture"
                                                : "no face found in any picture; turned clockwise by " +
                                                      std::to_string(i.turn) + " degrees they show one");
  if (auto ended = i.scenes.finish(); !ended) return ended;
  i.end_picture();
  i.take_from_scenes();
  i.note_rate();
  PacketWriter().write(i.ready, PacketType::kEnd, encode_end({i.report.pictures}));
  i.has_ended = true;
  return {};
}

std::vector<std::uint8_t> Encoder::take() {
  impl_->take_from_scenes();
  return std::exchange(impl_->ready, {});
}

bool Encoder::is_coding() const {
  return impl_->scenes.is_coding();
}

bool Encoder::wait(std::chrono::steady_clock::time_point until) {
  Impl& i = *impl_;
  for (bool waits = true;;) {
    const std::uint64_t rings = i.scenes.bell().rings();
    waits = waits && i.scenes.is_coding();  // before taking: it may end in between
    i.take_from_scenes();
    if (!i.ready.empty() || !waits) return !i.ready.empty();
    waits = i.scenes.bell().wait(rings, until);
  }
}

int Encoder::turn_to_upright() const {
  return impl_->turn;
}

const PictureAnalysis& Encoder::analysis() const {
  const SceneEncoder* const scene = impl_->scenes.present();
  return scene != nullptr ? scene->analysis() : impl_->nothing;
}

const EncodingReport& Encoder::report() const {
  impl_->end_picture();
  return impl_->report;
}

bool misses_bitrate(const EncoderSettings& settings, double kbps, double seconds) {
  if (settings.bitrate <= 0 || seconds <= 0) return false;
  const double waiting = settings.live ? settings.live->buffer / seconds : 0;
  const double more = kbps / settings.bitrate - 1;
  return more < -kRateTolerance || more > kRateTolerance + waiting;
}

}  // namespace fbs
