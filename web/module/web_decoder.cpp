#include "web/module/web_decoder.h"

#include "bitstream/sound_time.h"
#include "decoder/scene/scene_face.h"
#include "decoder/stream/scene_index.h"
#include "library/face_data.h"

namespace fbs::web {
namespace {

std::unique_ptr<StreamDecoder> new_decoder() {
  auto out = std::make_unique<StreamDecoder>();
  out->limit_pixels(kMaxPixels);
  return out;
}

}  // namespace

WebDecoder::WebDecoder() : decoder_(new_decoder()) {}

std::span<std::uint8_t> WebDecoder::room(std::size_t size) {
  stream_.resize(fed_ + size);
  return std::span(stream_).subspan(fed_);
}

void WebDecoder::feed() {
  const auto bytes = std::span<const std::uint8_t>(stream_).subspan(fed_);
  fed_ = stream_.size();
  decoder_->feed(bytes);
  sound_.add(bytes);
  count_sound(bytes);
}

void WebDecoder::finish() {
  finished_ = true;
  decoder_->close();
}

bool WebDecoder::seek(std::uint64_t time) {
  const auto bytes = std::span<const std::uint8_t>(stream_).first(fed_);
  const auto scenes = index_scenes(bytes);
  const SceneEntry* const scene = scene_at(scenes, time);
  if (scene == nullptr) return false;
  decoder_ = new_decoder();
  decoder_->feed(kSignature);
  decoder_->feed(bytes.subspan(scene->offset));
  if (finished_) decoder_->close();
  sound_.seek(sound_time(static_cast<std::int64_t>(time)));
  return true;
}

State WebDecoder::edited(const SceneGeometry& face) const {
  return edit_.applied(decoder_->state(), face.geometry());
}

Result<const Picture*> WebDecoder::draw() {
  const SceneGeometry* const face = face_of(decoder_->scene());
  const auto drawn = face != nullptr && edit_.any()
                         ? decoder_->render_state(edited(*face), std::nullopt, picture_)
                         : decoder_->render(picture_);
  if (!drawn) return fail(drawn.error());
  return &picture_;
}

const WebDecoder::Face* WebDecoder::face() {
  const SceneGeometry* const face = face_of(decoder_->scene());
  if (face == nullptr) return nullptr;
  const State state = edited(*face);
  face_.state = face_state(state);
  write_landmarks(*face, state, face_.landmarks);
  face_.blendshapes = measure_(face->geometry(), state);
  return &face_;
}

void WebDecoder::count_sound(std::span<const std::uint8_t> bytes) {
  packets_.feed(bytes);
  for (;;) {
    const auto read = packets_.next();
    if (!read) continue;
    if (read->status != ReadStatus::kPacket) return;
    const PacketType type = read->packet.type;
    if (type == PacketType::kSound || type == PacketType::kSoundSetup) sound_bytes_ += read->packet.size;
  }
}

}  // namespace fbs::web
