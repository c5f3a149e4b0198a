#include "library/boundary.h"

#include <algorithm>
#include <cstring>

namespace fbs {

fbs_status status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return FBS_ERROR_ARGUMENT;
    case ErrorCode::kNotFbs:
      return FBS_ERROR_NOT_FBS;
    case ErrorCode::kTruncated:
      return FBS_ERROR_TRUNCATED;
    case ErrorCode::kInvalidStream:
      return FBS_ERROR_DAMAGED;
    case ErrorCode::kUnsupported:
      return FBS_ERROR_UNSUPPORTED;
    case ErrorCode::kTooLarge:
      return FBS_ERROR_TOO_LARGE;
    case ErrorCode::kNoFace:
    case ErrorCode::kTooFewFaces:
      return FBS_ERROR_NO_FACE;
    case ErrorCode::kIo:
      return FBS_ERROR_IO;
    case ErrorCode::kDegenerateInput:
    case ErrorCode::kInternal:
      return FBS_ERROR_INTERNAL;
  }
  return FBS_ERROR_INTERNAL;
}

fbs_status LastError::set(fbs_status status, const char* text, std::uint64_t offset) {
  const std::lock_guard lock(mutex_);
  const std::size_t size = std::min(std::strlen(text), text_.size() - 1);
  std::copy_n(text, size, text_.begin());
  text_[size] = '\0';
  std::replace(text_.begin(), text_.begin() + size, '\n', ' ');
  offset_ = offset;
  return status;
}

}  // namespace fbs
