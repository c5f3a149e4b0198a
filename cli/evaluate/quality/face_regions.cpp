#include "cli/evaluate/quality/face_regions.h"

#include <algorithm>
#include <utility>

#include "cli/stream/stream_file.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {

std::size_t FaceRegions::believed() const {
  return static_cast<std::size_t>(
      std::count_if(outlines.begin(), outlines.end(), [](const FaceOutline& o) { return !o.empty(); }));
}

const FaceOutline& FaceRegions::of(std::size_t picture) const {
  static const FaceOutline none;
  return picture < outlines.size() ? outlines[picture] : none;
}

std::size_t FaceRegions::hash() const {
  // FNV-1a, 64 bits.
  std::uint64_t h = 0xCBF29CE484222325;
  const auto take = [&](std::int64_t v) { h = (h ^ static_cast<std::uint64_t>(v)) * 0x100000001B3; };
  for (const FaceOutline& outline : outlines) {
    take(static_cast<std::int64_t>(outline.size()));
    for (const OutlinePoint& p : outline) {
      take(p.x);
      take(p.y);
    }
  }
  return h;
}

Result<StreamTrack> read_track(const std::string& stream, const StopSignal* stop) {
  auto file = StreamFile::open(stream, stop);
  if (!file) return fail(file.error());
  const StreamDecoder& decoder = file->decoder();
  StreamTrack track;
  for (;;) {
    const auto status = file->next();
    if (!status) return fail(status.error());
    if (stop != nullptr && stop->raised()) return fail(ErrorCode::kIo, stream + ": stopped");
    if (*status == DecodeStatus::kEnd) break;
    track.format = decoder.format();
    track.times.push_back(static_cast<double>(decoder.position().time) / kTicksPerSecond);
    track.seconds += static_cast<double>(decoder.duration()) / kTicksPerSecond;
    track.outlines.push_back(face_outline(decoder));
  }
  track.bytes = decoder.bytes();
  return track;
}

Result<FaceRegions> read_region(const std::string& file, const StopSignal* stop) {
  if (!is_stream_file(file)) return read_region_csv(file);
  auto track = read_track(file, stop);
  if (!track) return fail(track.error());
  return FaceRegions{"the mesh of " + file, std::move(track->outlines)};
}

}  // namespace fbs::cli
