#include "encoder/retarget/motion_record.h"

#include <algorithm>

#include "decoder/scene/scene_face.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {

Result<MotionRecord> read_motion_record(std::span<const std::uint8_t> stream) {
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  MotionRecord record;
  for (;;) {
    const auto status = decoder.next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) break;
    const Scene& scene = decoder.scene();
    record.parts = static_cast<PartMask>(record.parts | scene.setup.parts);
    if (const SceneGeometry* face = face_of(scene)) {
      if (record.geometries.empty()) {
        record.steps = scene.setup.steps;
        record.rest = scene.patterns.front().seen;
        // Pictures before the face appears show it at rest.
        for (MotionRecord::Entry& entry : record.pictures) entry.state = record.rest;
      }
      if (record.geometries.empty() || record.geometries.back() != face->geometry())
        record.geometries.push_back(face->geometry());
      record.pictures.push_back({decoder.state(), decoder.duration(), record.geometries.size() - 1});
    } else {
      const State held = record.pictures.empty() ? State{} : record.pictures.back().state;
      const std::size_t last = record.geometries.empty() ? 0 : record.geometries.size() - 1;
      record.pictures.push_back({held, decoder.duration(), last});
    }
    record.frame_rate = scene.setup.format.frame_rate;
  }
  if (record.geometries.empty()) return fail(ErrorCode::kDegenerateInput, "has no face");
  return record;
}

}  // namespace fbs
