// Rejects pictures outside the size limits of the codec.
#pragma once

#include <string>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// @return ErrorCode::kTooLarge when a side is outside kMinPictureSize..kMaxPictureSize
inline Result<void> check_picture_size(const std::string& input, int width, int height) {
  const auto fits = [](int side) { return side >= kMinPictureSize && side <= kMaxPictureSize; };
  if (fits(width) && fits(height)) return {};
  return fail(ErrorCode::kTooLarge, input + ": pictures of " + std::to_string(width) + "x" +
                                        std::to_string(height) + "; sides from " +
                                        std::to_string(kMinPictureSize) + " to " +
                                        std::to_string(kMaxPictureSize) + " are supported");
}

/// The error of a video whose pictures change size midway.
inline tl::unexpected<Error> size_change(const std::string& input, const VideoFormat& format, int width,
                                         int height) {
  return fail(ErrorCode::kUnsupported, input + ": picture size changes from " + std::to_string(format.width) +
                                           "x" + std::to_string(format.height) + " to " +
                                           std::to_string(width) + "x" + std::to_string(height));
}

}  // namespace fbs
