// Converts the settings of fbs/encoder.h to the encoder's.
#pragma once

#include <cstddef>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/settings.h"
#include "fbs/encoder.h"

namespace fbs {

inline constexpr fbs_encoder_settings kEncoderDefaults = {sizeof(fbs_encoder_settings),
                                                          {0, 0, 25, 1, 1, 1, FBS_MATRIX_UNSPECIFIED, 0},
                                                          50,
                                                          0,
                                                          0,
                                                          fbs::Effort::kDefault,
                                                          0,
                                                          0,
                                                          0,
                                                          0,
                                                          0,
                                                          0.2,
                                                          2,
                                                          0,
                                                          FBS_TUNE_EYE,
                                                          FBS_RESILIENCE_NONE,
                                                          0,
                                                          nullptr,
                                                          nullptr,
                                                          nullptr,
                                                          -1,
                                                          nullptr};

/// sizeof(fbs_encoder_settings) in version 0.1.
inline constexpr std::size_t kFirstEncoderSettingsSize =
    offsetof(fbs_encoder_settings, threads) + sizeof(int);

struct EncoderInput {
  VideoFormat format;
  EncoderSettings settings;
};

/// @return kInvalidArgument for values that would not survive the conversion; Encoder::create() checks the
/// rest
[[nodiscard]] Result<EncoderInput> encoder_input(const fbs_encoder_settings& settings);

}  // namespace fbs
