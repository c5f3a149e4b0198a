#include "cli/evaluate/measurement.h"

#include <optional>
#include <utility>

#include "cli/evaluate/quality/vmaf.h"
#include "cli/program/progress.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {
namespace {

Result<void> check_pair(const std::string& stream, const Picture* shown, const std::string& source,
                        const std::optional<TimedPicture>& picture) {
  if ((shown == nullptr) != !picture)
    return fail(ErrorCode::kInvalidArgument,
                stream + ": has " + (picture ? "fewer" : "more") + " pictures than " + source);
  if (picture && (shown->width() != picture->picture.width() || shown->height() != picture->picture.height()))
    return fail(ErrorCode::kInvalidArgument, stream + ": picture size differs from " + source);
  return {};
}

}  // namespace

Result<SourcePart> measure_pictures(const MeasurementSetting& setting, ShownPictures& shown,
                                    const std::string& log, RdPoint& point) {
  SourceOptions options;
  options.stop = setting.stop;
  auto opened = open_video_source(setting.source, options);
  if (!opened) return fail(opened.error());
  SourcePart source(std::move(*opened), setting.limits, setting.stop);
  std::optional<VmafMeter> vmaf;
  if (setting.vmaf) {
    auto started = VmafMeter::start(source.format().width, source.format().height, log);
    if (!started) return fail(started.error());
    vmaf.emplace(std::move(*started));
  }
  Progress progress("evaluating " + point.label, source.frame_count_estimate(), setting.quiet);
  for (;;) {
    auto picture = source.next();
    if (!picture) return fail(picture.error());
    auto seen = shown.next();
    if (!seen) return fail(seen.error());
    if (setting.stop != nullptr && setting.stop->raised()) return fail(ErrorCode::kIo, "stopped");
    if (auto checked = check_pair(point.file, *seen, setting.source, *picture); !checked)
      return fail(checked.error());
    if (!*picture) break;
    const std::size_t n = point.pictures.size();
    point.pictures.push_back(compare_pictures((*picture)->picture, **seen, setting.regions->of(n)));
    if (vmaf)
      if (auto added = vmaf->add((*picture)->picture, **seen); !added) return fail(added.error());
    progress.update(static_cast<std::int64_t>(n) + 1);
  }
  if (vmaf && !point.pictures.empty()) {
    const auto mean = vmaf->finish();
    if (!mean) return fail(mean.error());
    point.vmaf = *mean;
  }
  progress.finish();
  return source;
}

}  // namespace fbs::cli
