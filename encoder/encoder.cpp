#include "encoder/encoder.h"

#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "encoder/face_scene.h"
#include "encoder/find/found_marks.h"
#include "encoder/still_scene.h"

namespace fbs {
namespace {

// Pictures, until the first face: between searches, and between those for small faces too.
constexpr int kSearchEvery = 5, kSearchAllEvery = 30;

}  // namespace

struct Encoder::Impl {
  VideoFormat format;
  EncoderSettings settings;
  FaceFinder finder;
  std::unique_ptr<SceneEncoder> scene;
  bool face_seen = false;
  StreamPosition position;  ///< behind the last picture
  std::vector<std::uint8_t> ready;
  PictureAnalysis nothing;

  void take_from_scene() {
    const auto bytes = scene->take();
    ready.insert(ready.end(), bytes.begin(), bytes.end());
  }

  /// Marks of the face to follow, if the picture shows one.
  [[nodiscard]] std::optional<Marks> look_for_face(const Picture& picture) const {
    if (settings.marks) return settings.marks;
    const auto number = static_cast<std::size_t>(settings.face);
    const auto effort = position.pictures % kSearchAllEvery == 0 ? FaceFinder::Effort::kAllSizes
                                                                 : FaceFinder::Effort::kUsualSizes;
    const auto faces = finder.find(picture, number + 1, effort);
    if (faces.size() <= number) return std::nullopt;
    return marks_of(faces[number]);
  }

  Result<void> begin_scene(const Picture& picture, const std::optional<Marks>& marks) {
    if (scene) {
      if (auto ended = scene->finish(); !ended) return ended;
      take_from_scene();
    }
    auto begun = marks ? FaceScene::begin(format, settings, finder, picture, *marks, position)
                       : StillScene::begin(format, settings, picture, position);
    if (!begun) return fail(begun.error());
    scene = std::move(*begun);
    face_seen = face_seen || marks.has_value();
    return {};
  }
};

Encoder::Encoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;
Encoder::~Encoder() = default;

Result<Encoder> Encoder::create(const VideoFormat& format, const EncoderSettings& settings) {
  if (settings.quality < 0 || settings.quality > 100)
    return fail(ErrorCode::kInvalidArgument, "quality outside 0..100");
  if (settings.group_pictures < 0 || settings.group_pictures > kMaxGroupPictures)
    return fail(ErrorCode::kInvalidArgument, "pictures in a group outside 1..256");
  if (settings.bitrate < 0 || settings.seconds < 0 || settings.motion_bitrate < 0)
    return fail(ErrorCode::kInvalidArgument, "a negative rate or length");
  if (settings.patterns < 0 || settings.patterns > kMaxPatterns)
    return fail(ErrorCode::kInvalidArgument, "number of patterns outside 0..64");
  if (settings.pattern_quantiser < -1 || settings.pattern_quantiser > 63)
    return fail(ErrorCode::kInvalidArgument, "quantiser of patterns outside 0..63");
  if (settings.effort < 0) return fail(ErrorCode::kInvalidArgument, "a negative effort");
  if (settings.face < 0) return fail(ErrorCode::kInvalidArgument, "a negative number of a face");
  Setup setup;
  setup.format = format;
  if (auto checked = check_setup(setup); !checked) return fail(checked.error());
  auto finder = FaceFinder::create();
  if (!finder) return fail(finder.error());
  auto impl = std::unique_ptr<Impl>(new Impl{format, settings, std::move(*finder), {}, false, {}, {}, {}});
  write_signature(impl->ready);
  return Encoder(std::move(impl));
}

Result<void> Encoder::push(const Picture& picture, std::uint32_t duration) {
  Impl& i = *impl_;
  if (picture.width() != i.format.width || picture.height() != i.format.height)
    return fail(ErrorCode::kInvalidArgument, "the picture size changes inside the video");
  if (!i.face_seen && i.position.pictures % kSearchEvery == 0) {
    const auto marks = i.look_for_face(picture);
    if (marks || !i.scene)
      if (auto begun = i.begin_scene(picture, marks); !begun) return begun;
  }
  if (auto pushed = i.scene->push(picture, duration); !pushed) return pushed;
  i.take_from_scene();
  ++i.position.pictures;
  i.position.time += duration > 0 ? duration : nominal_duration(i.format.frame_rate);
  return {};
}

Result<void> Encoder::finish() {
  Impl& i = *impl_;
  if (i.position.pictures == 0) return fail(ErrorCode::kInvalidArgument, "no pictures");
  if (!i.face_seen && !i.settings.allow_no_face)
    return fail(ErrorCode::kNoFace, "no face found in any picture");
  if (auto ended = i.scene->finish(); !ended) return ended;
  i.take_from_scene();
  write_packet(i.ready, PacketType::kEnd, encode_end({i.position.pictures}));
  return {};
}

std::vector<std::uint8_t> Encoder::take() {
  return std::exchange(impl_->ready, {});
}

const PictureAnalysis& Encoder::analysis() const {
  return impl_->scene ? impl_->scene->analysis() : impl_->nothing;
}

}  // namespace fbs
