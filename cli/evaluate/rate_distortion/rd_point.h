// A measured point of a rate-distortion curve: a stream of fbs, or one of another codec.
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
  ByteCount bytes;    ///< of other codecs only the total
  double seconds = 0;
  int step = 1;                          ///< every how many pictures of the source one is coded
  std::optional<EncodingReport> report;  ///< of streams that fbs encoded for this
  std::vector<PictureQuality> pictures;  ///< in their order
  std::optional<double> vmaf;            ///< of the frame; nothing where ffmpeg cannot tell

  [[nodiscard]] double rate(std::uint64_t of_bytes) const {
    return seconds > 0 ? 8e-3 * static_cast<double>(of_bytes) / seconds : 0;
  }
  /// Of the pictures, without their sound: what other codecs are compared with.
  [[nodiscard]] double kbps() const { return rate(bytes.total - bytes.sound); }
  [[nodiscard]] double sound_kbps() const { return rate(bytes.sound); }
};

/// What measuring a stream adds to it: pictures and VMAF, as the run folder keeps them.
[[nodiscard]] nlohmann::json quality_json(const RdPoint& point);

/// @return false, and nothing is changed, when `json` is not what quality_json() writes
[[nodiscard]] bool read_quality(const nlohmann::json& json, RdPoint& point);

}  // namespace fbs::cli
