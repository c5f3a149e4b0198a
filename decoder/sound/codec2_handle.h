// A coder or decoder of libcodec2.
#pragma once

#include <codec2/codec2.h>

#include <memory>

#include "bitstream/codec2_mode.h"

namespace fbs {

struct Codec2Deleter {
  void operator()(CODEC2* codec) const { codec2_destroy(codec); }
};
using Codec2Handle = std::unique_ptr<CODEC2, Codec2Deleter>;

/// @return null when this libcodec2 lacks the mode, or there is no memory
[[nodiscard]] Codec2Handle create_codec2(const Codec2Mode& mode);

}  // namespace fbs
