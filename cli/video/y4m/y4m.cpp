#include "cli/video/y4m/y4m.h"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/files/atomic_file.h"
#include "cli/video/dither.h"
#include "cli/video/picture_size.h"
#include "cli/video/timestamps.h"

namespace fbs {
namespace {

constexpr std::size_t kMaxLine = 4096;  // bytes of a header line; real ones have about 80
constexpr std::string_view kFrame = "FRAME";

struct FileCloser {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

int shifted_up(int size, int shift) {
  return (size + (1 << shift) - 1) >> shift;
}

/// A plane as stored: any subsampling, one or two bytes a sample.
struct StoredPlane {
  int width, height;  ///< samples
  int shift_x, shift_y;
  int bits;
  std::vector<std::uint8_t> bytes;

  StoredPlane(const VideoFormat& format, const Y4mLayout& layout, bool chroma)
      : width(shifted_up(format.width, chroma ? layout.chroma_shift_x : 0)),
        height(shifted_up(format.height, chroma ? layout.chroma_shift_y : 0)),
        shift_x(chroma ? layout.chroma_shift_x : 0),
        shift_y(chroma ? layout.chroma_shift_y : 0),
        bits(layout.bits),
        bytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * (bits > 8 ? 2 : 1)) {}

  [[nodiscard]] int sample(int x, int y) const {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return bits > 8 ? bytes[2 * i] | bytes[2 * i + 1] << 8 : bytes[i];
  }
};

/// Averages the samples under each sample of `plane`, which has one sample per 2^shift pixels in each
/// direction. More than 8 bits are dithered.
void reduce(const StoredPlane& stored, int shift, Plane& plane) {
  const auto first = [shift](int position, int stored_shift) { return (position << shift) >> stored_shift; };
  const auto last = [shift](int position, int stored_shift, int size) {
    return std::min((((position + 1) << shift) - 1) >> stored_shift, size - 1);
  };
  for (int y = 0; y < plane.height; ++y) {
    const int top = first(y, stored.shift_y);
    const int bottom = last(y, stored.shift_y, stored.height);
    for (int x = 0; x < plane.width; ++x) {
      const int left = first(x, stored.shift_x);
      const int right = last(x, stored.shift_x, stored.width);
      int sum = 0;
      for (int j = top; j <= bottom; ++j) {
        for (int i = left; i <= right; ++i) sum += stored.sample(i, j);
      }
      const int unit = (bottom - top + 1) * (right - left + 1) << (stored.bits - 8);
      const int rounding = stored.bits > 8 ? dither(x, y, unit) : unit / 2;
      plane.row(y)[x] = static_cast<std::uint8_t>(std::min((sum + rounding) / unit, 255));
    }
  }
}

class Y4mSource final : public VideoSource {
 public:
  Y4mSource(std::string name, File file) : name_(std::move(name)), file_(std::move(file)) {}

  Result<void> read_header();

  [[nodiscard]] const VideoFormat& format() const override { return header_.format; }
  Result<std::optional<TimedPicture>> next() override;
  [[nodiscard]] bool is_ready(std::chrono::milliseconds patience) const override;
  [[nodiscard]] bool has_constant_rate() const override { return true; }
  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override;

 private:
  /// A line without its newline; nullopt at the end of the file.
  Result<std::optional<std::string>> read_line();
  Result<void> read_bytes(std::vector<std::uint8_t>& bytes);
  Result<void> read_plane(Plane& plane, bool chroma);
  Result<void> skip_plane();
  [[nodiscard]] tl::unexpected<Error> ended_early() const;
  [[nodiscard]] tl::unexpected<Error> error(ErrorCode code, const std::string& text) const {
    return fail(code, name_ + ": " + text);
  }

  std::string name_;
  File file_;
  Y4mHeader header_;
  std::size_t header_bytes_ = 0;
  std::int64_t index_ = 0;
};

Result<void> Y4mSource::read_header() {
  auto line = read_line();
  if (!line) return fail(line.error());
  if (!*line) return error(ErrorCode::kTruncated, "empty, not a Y4M stream");
  auto header = parse_y4m_header(**line);
  if (!header) return error(header.error().code, header.error().text);
  header_ = *header;
  header_bytes_ = (*line)->size() + 1;
  return check_picture_size(name_, header_.format.width, header_.format.height);
}

Result<std::optional<TimedPicture>> Y4mSource::next() {
  auto line = read_line();
  if (!line) return fail(line.error());
  if (!*line) return std::nullopt;
  const std::string& text = **line;
  if (!text.starts_with(kFrame) || (text.size() > kFrame.size() && text[kFrame.size()] != ' ')) {
    return error(ErrorCode::kInvalidStream, "no FRAME before picture " + std::to_string(index_));
  }
  TimedPicture timed{Picture(header_.format.width, header_.format.height),
                     regular_pts(index_, header_.format.frame_rate)};
  auto read = read_plane(timed.picture.y, false);
  if (header_.layout.has_chroma) {
    if (read) read = read_plane(timed.picture.u, true);
    if (read) read = read_plane(timed.picture.v, true);
  }
  if (read && header_.layout.has_alpha) read = skip_plane();
  if (!read) return fail(read.error());
  ++index_;
  return timed;
}

bool Y4mSource::is_ready(std::chrono::milliseconds patience) const {
  pollfd input{fileno(file_.get()), POLLIN, 0};
  return poll(&input, 1, static_cast<int>(patience.count())) != 0;  // reading will report errors
}

std::optional<std::int64_t> Y4mSource::frame_count_estimate() const {
  struct stat status {};
  if (fstat(fileno(file_.get()), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const std::size_t luma = StoredPlane(header_.format, header_.layout, false).bytes.size();
  const std::size_t chroma = StoredPlane(header_.format, header_.layout, true).bytes.size();
  const std::size_t picture = luma + (header_.layout.has_chroma ? 2 * chroma : 0) +
                              (header_.layout.has_alpha ? luma : 0) + kFrame.size() + 1;
  const auto bytes = static_cast<std::size_t>(status.st_size);
  return static_cast<std::int64_t>((bytes - std::min(bytes, header_bytes_)) / picture);
}

Result<std::optional<std::string>> Y4mSource::read_line() {
  std::string line;
  for (int c = std::getc(file_.get()); c != '\n'; c = std::getc(file_.get())) {
    if (c == EOF) {
      if (std::ferror(file_.get()) != 0) return error(ErrorCode::kIo, std::generic_category().message(errno));
      if (line.empty()) return std::nullopt;
      return ended_early();
    }
    if (line.size() >= kMaxLine) return error(ErrorCode::kInvalidStream, "not a Y4M stream");
    line += static_cast<char>(c);
  }
  return line;
}

Result<void> Y4mSource::read_bytes(std::vector<std::uint8_t>& bytes) {
  if (std::fread(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size()) return {};
  if (std::ferror(file_.get()) != 0) return error(ErrorCode::kIo, std::generic_category().message(errno));
  return ended_early();
}

Result<void> Y4mSource::read_plane(Plane& plane, bool chroma) {
  const int shift = chroma ? 1 : 0;
  const Y4mLayout& layout = header_.layout;
  const bool same = !chroma || (layout.chroma_shift_x == 1 && layout.chroma_shift_y == 1);
  if (same && layout.bits == 8) return read_bytes(plane.samples);
  StoredPlane stored(header_.format, layout, chroma);
  if (auto read = read_bytes(stored.bytes); !read) return read;
  reduce(stored, shift, plane);
  return {};
}

Result<void> Y4mSource::skip_plane() {
  StoredPlane alpha(header_.format, header_.layout, false);
  return read_bytes(alpha.bytes);
}

tl::unexpected<Error> Y4mSource::ended_early() const {
  return error(ErrorCode::kTruncated, "ends inside picture " + std::to_string(index_));
}

class Y4mSink final : public VideoSink {
 public:
  explicit Y4mSink(AtomicFile file) : file_(std::move(file)) {}

  Result<void> write_line(std::string_view text) {
    const std::string line = std::string(text) + "\n";
    return file_.write({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
  }

  Result<void> write(const Picture& picture, std::int64_t /*pts*/) override {
    auto written = write_line(kFrame);
    if (written) written = file_.write(picture.y.samples);
    if (written) written = file_.write(picture.u.samples);
    if (written) written = file_.write(picture.v.samples);
    return written;
  }

  [[nodiscard]] bool replaced_leftover() const override { return file_.replaced_leftover(); }

  Result<void> finish() override { return file_.commit(); }

 private:
  AtomicFile file_;
};

}  // namespace

Result<std::unique_ptr<VideoSource>> open_y4m_source(const std::string& input) {
  const bool piped = input == "-";
  const std::string name = piped ? "standard input" : input;
  File file(piped ? stdin : std::fopen(input.c_str(), "rbe"));
  if (!file)
    return fail(ErrorCode::kIo, "cannot read " + name + ": " + std::generic_category().message(errno));
  auto source = std::make_unique<Y4mSource>(name, std::move(file));
  if (auto read = source->read_header(); !read) return fail(read.error());
  return source;
}

Result<std::unique_ptr<VideoSink>> open_y4m_sink(const std::string& output, const VideoFormat& format) {
  auto file = AtomicFile::create(output);
  if (!file) return fail(file.error());
  auto sink = std::make_unique<Y4mSink>(std::move(*file));
  if (auto written = sink->write_line(y4m_header(format)); !written) return fail(written.error());
  return sink;
}

}  // namespace fbs
