// A measured point of a rate-distortion curve: a stream of fbs, or of another codec.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/evaluate/quality/picture_quality.h"
#include "common/result.h"
#include "decoder/stream/stream_decoder.h"
#include "encoder/encoder.h"

namespace fbs::cli {

struct RdPoint {
  std::string label;  ///< "quality 50", the name of a stream, "x265 1/2 size, 1/3 rate, crf 45"
  std::string codec;  ///< "fbs", "x264", ...
  std::string file;   ///< the stream
  ByteCount bytes;    ///< for other codecs only the total
  double seconds = 0;
  int step = 1;                          ///< codes one of this many pictures of the source
  std::optional<EncodingReport> report;  ///< if fbs encoded the stream for this
  std::vector<PictureQuality> pictures;  ///< in order
  std::optional<double> vmaf;            ///< of the frame; nothing if ffmpeg cannot compute it

  [[nodiscard]] double rate(std::uint64_t of_bytes) const {
    return seconds > 0 ? 8e-3 * static_cast<double>(of_bytes) / seconds : 0;
  }
  /// Rate of the pictures, without their sound, for comparison with other codecs.
  [[nodiscard]] double kbps() const { return rate(bytes.total - bytes.sound); }
  [[nodiscard]] double sound_kbps() const { return rate(bytes.sound); }
};

/// The results of measuring a stream, pictures and VMAF, as the run folder keeps them.
[[nodiscard]] nlohmann::json quality_json(const RdPoint& point);

/// @return false, changing nothing, when `json` was not written by quality_json()
[[nodiscard]] bool read_quality(const nlohmann::json& json, RdPoint& point);

}  // namespace fbs::cli
