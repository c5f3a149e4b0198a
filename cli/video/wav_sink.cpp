#include "cli/video/wav_sink.h"

#include <array>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace fbs {
namespace {

constexpr std::uint32_t kUnknownSize = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kHeaderBytes = 44;
constexpr int kSampleBytes = 2;
constexpr int kPcm = 1;  // WAVE_FORMAT_PCM

/// Little-endian, like everything in RIFF.
class HeaderBytes {
 public:
  void text(std::string_view name) { bytes_.insert(bytes_.end(), name.begin(), name.end()); }
  void number(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::uint32_t size_or_unknown(std::uint64_t size) {
  return size < kUnknownSize ? static_cast<std::uint32_t>(size) : kUnknownSize;
}

}  // namespace

Result<std::unique_ptr<WavSink>> WavSink::create(const std::string& name, int sample_rate, int channels) {
  auto file = AtomicFile::create(name);
  if (!file) return fail(file.error());
  std::unique_ptr<WavSink> sink(new WavSink(std::move(*file), sample_rate, channels));
  if (auto written = sink->write_header(kUnknownSize); !written) return fail(written.error());
  return sink;
}

Result<void> WavSink::write_header(std::uint64_t data_bytes) {
  const auto frame = static_cast<std::uint32_t>(channels_ * kSampleBytes);
  const auto rate = static_cast<std::uint32_t>(sample_rate_);
  HeaderBytes header;
  header.text("RIFF");
  header.number(size_or_unknown(data_bytes + kHeaderBytes - 8), 4);
  header.text("WAVEfmt ");
  header.number(16, 4);
  header.number(kPcm, 2);
  header.number(static_cast<std::uint32_t>(channels_), 2);
  header.number(rate, 4);
  header.number(rate * frame, 4);
  header.number(frame, 2);
  header.number(8 * kSampleBytes, 2);
  header.text("data");
  header.number(size_or_unknown(data_bytes), 4);
  return file_.write(header.bytes());
}

Result<void> WavSink::write(std::span<const std::int16_t> samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size() * kSampleBytes);
  for (const std::int16_t sample : samples) {
    const auto bits = static_cast<std::uint16_t>(sample);
    bytes.push_back(static_cast<std::uint8_t>(bits));
    bytes.push_back(static_cast<std::uint8_t>(bits >> 8));
  }
  data_bytes_ += bytes.size();
  return file_.write(bytes);
}

Result<void> WavSink::finish() {
  if (file_.seekable()) {
    if (auto moved = file_.seek(0); !moved) return moved;
    if (auto written = write_header(data_bytes_); !written) return written;
  }
  return file_.commit();
}

}  // namespace fbs
