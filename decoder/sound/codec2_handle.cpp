#include "decoder/sound/codec2_handle.h"

namespace fbs {
namespace {

/// libcodec2's number for a mode; -1 when it has none.
int id_of(const Codec2Mode& mode) {
  switch (mode.bitrate) {
    case 3200:
      return CODEC2_MODE_3200;
    case 2400:
      return CODEC2_MODE_2400;
    case 1600:
      return CODEC2_MODE_1600;
    case 1400:
      return CODEC2_MODE_1400;
    case 1300:
      return CODEC2_MODE_1300;
    case 1200:
      return CODEC2_MODE_1200;
    default:
      return -1;
  }
}

}  // namespace

Codec2Handle create_codec2(const Codec2Mode& mode) {
  const int id = id_of(mode);
  return id < 0 ? nullptr : Codec2Handle(codec2_create(id));
}

}  // namespace fbs
