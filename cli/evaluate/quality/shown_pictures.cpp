#include "cli/evaluate/quality/shown_pictures.h"

#include <utility>

#include "cli/evaluate/peers/child_process.h"
#include "cli/stream/stream_file.h"

namespace fbs::cli {
namespace {

class FbsPictures final : public ShownPictures {
 public:
  explicit FbsPictures(StreamFile file) : file_(std::move(file)) {}

  Result<const Picture*> next() override {
    const auto status = file_.next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) return nullptr;
    if (auto drawn = file_.decoder().render(picture_); !drawn) return fail(drawn.error());
    return &picture_;
  }

 private:
  StreamFile file_;
  Picture picture_;
};

class PeerPictures final : public ShownPictures {
 public:
  PeerPictures(PeerStream stream, ChildProcess decoder)
      : stream_(std::move(stream)), decoder_(std::move(decoder)), picture_(stream_.width, stream_.height) {}

  Result<const Picture*> next() override {
    if (shown_ == stream_.pictures) return nullptr;
    if (shown_++ % static_cast<std::uint64_t>(stream_.step) != 0) return &picture_;
    for (Plane* plane : {&picture_.y, &picture_.u, &picture_.v})
      if (decoder_.read(plane->samples) != plane->samples.size()) return fail(why_it_ended());
    return &picture_;
  }

 private:
  Error why_it_ended() {
    const auto finished = decoder_.finish();
    return {ErrorCode::kIo,
            stream_.file + ": " + (finished ? "has too few pictures" : finished.error().text)};
  }

  PeerStream stream_;
  ChildProcess decoder_;
  Picture picture_;
  std::uint64_t shown_ = 0;
};

}  // namespace

Result<std::unique_ptr<ShownPictures>> open_fbs_pictures(const std::string& stream, const StopSignal* stop) {
  auto file = StreamFile::open(stream, stop);
  if (!file) return fail(file.error());
  return std::make_unique<FbsPictures>(std::move(*file));
}

Result<std::unique_ptr<ShownPictures>> open_peer_pictures(const PeerStream& stream) {
  const std::string size = std::to_string(stream.width) + ":" + std::to_string(stream.height);
  auto decoder = ChildProcess::start(
      {"ffmpeg", "-v", "error", "-nostdin", "-i", stream.file, "-fps_mode", "passthrough", "-vf",
       "scale=" + size + ":flags=bicubic", "-pix_fmt", "yuv420p", "-f", "rawvideo", "-"},
      ChildProcess::Pipe::kFromStandardOutput, stream.file + ".log");
  if (!decoder) return fail(decoder.error());
  return std::make_unique<PeerPictures>(stream, std::move(*decoder));
}

}  // namespace fbs::cli
