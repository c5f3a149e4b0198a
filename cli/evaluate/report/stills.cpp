#include "cli/evaluate/report/stills.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "cli/evaluate/quality/shown_pictures.h"
#include "cli/evaluate/run/run_folder.h"
#include "cli/files/atomic_file.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {
namespace {

using Pictures = std::map<std::size_t, Picture>;  // by number

double psnr_of_picture(const PictureQuality& q) {
  return q.face ? q.face->y.psnr() : q.frame.y.psnr();
}

Result<Pictures> pictures_of_source(const std::string& source, const std::set<std::size_t>& wanted) {
  auto opened = open_video_source(source);
  if (!opened) return fail(opened.error());
  Pictures out;
  for (std::size_t n = 0; n <= *wanted.rbegin(); ++n) {
    auto picture = (*opened)->next();
    if (!picture) return fail(picture.error());
    if (!*picture) break;
    if (wanted.contains(n)) out[n] = std::move((*picture)->picture);
  }
  return out;
}

Result<Pictures> pictures_of_stream(const ClipReport& clip, const RdPoint& point,
                                    const std::set<std::size_t>& wanted) {
  auto shown = point.codec == "fbs" ? open_fbs_pictures(point.file, nullptr)
                                    : open_peer_pictures({point.file, clip.format.width, clip.format.height,
                                                          point.step, clip.times.size()});
  if (!shown) return fail(shown.error());
  Pictures out;
  for (std::size_t n = 0; n <= *wanted.rbegin(); ++n) {
    const auto picture = (*shown)->next();
    if (!picture) return fail(picture.error());
    if (*picture == nullptr) break;
    if (wanted.contains(n)) out[n] = **picture;
  }
  return out;
}

/// Encodes with OpenImageIO, like image sequences.
Result<std::string> jpeg_of(const Picture& picture, const VideoFormat& format) {
  const auto folder = RunFolder::temporary();
  if (!folder) return fail(folder.error());
  auto sink = open_video_sink(folder->path("%d.jpg"), format);
  if (!sink) return fail(sink.error());
  if (auto written = (*sink)->write(picture, 0).and_then([&] { return (*sink)->finish(); }); !written)
    return fail(written.error());
  std::ifstream file(folder->path("1.jpg"), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

Result<void> add_images(const ClipReport& clip, const RdPoint* point, const Pictures& pictures,
                        std::vector<Still>& stills) {
  for (Still& still : stills) {
    const auto found = pictures.find(still.picture);
    if (found == pictures.end()) continue;
    auto jpeg = jpeg_of(found->second, clip.format);
    if (!jpeg) return fail(jpeg.error());
    still.images.push_back({std::move(*jpeg), point});
  }
  return {};
}

Picture difference_of(const Picture& a, const Picture& b) {
  constexpr int kGain = 4, kBlack = 16, kWhite = 235;
  Picture out(a.width(), a.height());
  for (std::size_t i = 0; i < a.y.samples.size(); ++i)
    out.y.samples[i] = static_cast<std::uint8_t>(
        std::min(kWhite, kBlack + kGain * std::abs(int{a.y.samples[i]} - int{b.y.samples[i]})));
  return out;
}

Result<void> add_differences(const VideoFormat& format, const Pictures& source, const Pictures& fbs,
                             std::vector<Still>& stills) {
  for (Still& still : stills) {
    const auto a = source.find(still.picture), b = fbs.find(still.picture);
    if (a == source.end() || b == fbs.end()) continue;
    auto jpeg = jpeg_of(difference_of(a->second, b->second), format);
    if (!jpeg) return fail(jpeg.error());
    still.difference = std::move(*jpeg);
  }
  return {};
}

std::vector<Still> choose(const RdPoint& point) {
  std::vector<std::size_t> order(point.pictures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return psnr_of_picture(point.pictures[a]) < psnr_of_picture(point.pictures[b]);
  });
  std::vector<Still> out;
  if (order.empty()) return out;
  out.push_back({order[order.size() / 2], "typical", {}, {}});
  if (order.size() > 1) out.push_back({order.front(), "worst", {}, {}});
  return out;
}

}  // namespace

Result<std::vector<Still>> make_stills(const ClipReport& clip) {
  const RdPoint* point = shown_point(clip);
  if (point == nullptr) return std::vector<Still>{};
  std::vector<Still> stills = choose(*point);
  if (stills.empty()) return stills;
  std::set<std::size_t> wanted;
  for (const Still& still : stills) wanted.insert(still.picture);
  const auto source = pictures_of_source(clip.read_from, wanted);
  if (!source) return fail(source.error());
  if (auto added = add_images(clip, nullptr, *source, stills); !added) return fail(added.error());
  for (const RdPoint* p : {point, rival_of(clip, point->kbps())}) {
    if (p == nullptr) continue;
    const auto pictures = pictures_of_stream(clip, *p, wanted);
    if (!pictures) return fail(pictures.error());
    if (auto added = add_images(clip, p, *pictures, stills); !added) return fail(added.error());
    if (p != point) continue;
    if (auto added = add_differences(clip.format, *source, *pictures, stills); !added)
      return fail(added.error());
  }
  return stills;
}

Result<void> write_stills(const std::string& folder, const std::vector<Still>& stills) {
  const auto opened = RunFolder::open(folder);
  if (!opened) return fail(opened.error());
  const auto write = [&](const std::string& name, const std::string& jpeg) -> Result<void> {
    auto file = AtomicFile::create(opened->path(name + ".jpg"));
    if (!file) return fail(file.error());
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size());
    return file->write(bytes).and_then([&] { return file->commit(); });
  };
  for (const Still& still : stills) {
    for (const Still::Image& image : still.images)
      if (auto written =
              write(still.why + "-" + (image.point == nullptr ? "source" : image.point->codec), image.jpeg);
          !written)
        return written;
    if (auto written = write(still.why + "-difference", still.difference); !written) return written;
  }
  return {};
}

}  // namespace fbs::cli
