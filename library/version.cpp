// The functions of fbs/fbs.h about the library itself.
#include <cstring>

#include "bitstream/syntax.h"
#include "common/generic_head.h"
#include "common/picture.h"
#include "fbs/fbs.h"

// The header's numbers are ours.
static_assert(FBS_MIN_SIDE == fbs::kMinPictureSize && FBS_MAX_SIDE == fbs::kMaxPictureSize);
static_assert(FBS_TICKS_PER_SECOND == fbs::kTicksPerSecond);
static_assert(FBS_LANDMARKS == fbs::kLandmarkCount && FBS_MAX_VERTICES == fbs::kMaxWireFrameVertices);
static_assert(FBS_CONTROL_POINTS == fbs::kControlCount);
static_assert(FBS_MATRIX_BT601 == static_cast<int>(fbs::ColourMatrix::kBt601));
static_assert(FBS_MATRIX_BT709 == static_cast<int>(fbs::ColourMatrix::kBt709));

const char* fbs_version_string(void) {
  return FBS_VERSION;
}

uint32_t fbs_version_number(void) {
  return FBS_VERSION_MAJOR << 16 | FBS_VERSION_MINOR << 8 | FBS_VERSION_PATCH;
}

uint32_t fbs_format_version(void) {
  return fbs::kFormatVersion;
}

const char* fbs_status_text(fbs_status status) {
  int number = 0;  // a caller may pass any value, an enumeration cannot hold it
  static_assert(sizeof number == sizeof status);
  std::memcpy(&number, &status, sizeof number);
  switch (number) {
    case FBS_OK:
      return "no error";
    case FBS_NEED_DATA:
      return "more data is needed";
    case FBS_END:
      return "the end";
    case FBS_ERROR_ARGUMENT:
      return "an argument is out of its range, or the call comes at the wrong time";
    case FBS_ERROR_NOT_FBS:
      return "not an fbs stream";
    case FBS_ERROR_DAMAGED:
      return "damaged stream";
    case FBS_ERROR_TRUNCATED:
      return "the stream is cut off";
    case FBS_ERROR_UNSUPPORTED:
      return "not supported by this version";
    case FBS_ERROR_TOO_LARGE:
      return "too large";
    case FBS_ERROR_NO_MEMORY:
      return "out of memory";
    case FBS_ERROR_NO_FACE:
      return "no face";
    case FBS_ERROR_IO:
      return "a temporary file cannot be used";
    case FBS_ERROR_INTERNAL:
      return "internal error";
    default:
      return "unknown status";
  }
}
