#include "cli/source/stream_meter.h"

#include "cli/source/face_outline.h"

namespace fbs::cli {

Result<void> StreamMeter::compare(const Picture& source) {
  sum_.seconds += static_cast<double>(decoder_.duration()) / kTicksPerSecond;
  ++sum_.pictures;
  if (auto drawn = decoder_.render(drawn_); !drawn) return drawn;
  sum_.frame += squared_error(source.y, drawn_.y);
  const FaceOutline outline = face_outline(decoder_);
  if (outline.empty()) return {};
  if (mask_.samples.size() != source.y.samples.size()) mask_ = Plane(source.width(), source.height());
  draw_face(outline, mask_);
  sum_.face += squared_error(source.y, drawn_.y, mask_);
  return {};
}

Measure StreamMeter::result() const {
  Measure m = sum_;
  m.bytes = decoder_.bytes();
  return m;
}

}  // namespace fbs::cli
