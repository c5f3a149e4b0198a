// Sound of video files through libav. Part of the module fbs_av.
#pragma once

#include <memory>
#include <string>

#include "cli/video/sound_source.h"

namespace fbs {

/// As open_sound_source; `input` is a file or address that libav reads.
Result<std::unique_ptr<SoundSource>> open_av_sound_source(const std::string& input,
                                                          const SoundSourceOptions& options);

}  // namespace fbs
