#include "cli/evaluate/report/html_report.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "cli/evaluate/rate_distortion/clip_means.h"
#include "cli/evaluate/report/base64.h"
#include "cli/evaluate/report/chart.h"
#include "cli/evaluate/report/clip_charts.h"
#include "cli/evaluate/report/html_tables.h"
#include "cli/evaluate/report/report_texts.h"
#include "cli/evaluate/report/stills.h"
#include "cli/files/atomic_file.h"

namespace fbs::cli {
namespace {

using Fields = std::map<std::string, std::string>;

/// The text with each {{name}} replaced. Values may contain braces.
std::string filled(std::string_view text, const Fields& fields) {
  std::string out;
  for (;;) {
    const std::size_t begin = text.find("{{");
    if (begin == std::string_view::npos) return out.append(text);
    const std::size_t end = text.find("}}", begin);
    out.append(text.substr(0, begin)).append(fields.at(std::string(text.substr(begin + 2, end - begin - 2))));
    text.remove_prefix(end + 2);
  }
}

std::string facts_of(const ClipReport& clip) {
  const VideoFormat& f = clip.format;
  const std::size_t pictures = clip.times.size();
  std::string out = std::to_string(f.width) + " &times; " + std::to_string(f.height) + ", " +
                    std::to_string(pictures) + " pictures in " + decimal(clip.seconds, 1) +
                    " s. Face: " + escaped(clip.region_origin) + ", believed in " +
                    std::to_string(clip.believed) + " of " + std::to_string(pictures) + " pictures. VMAF: ";
  out += clip.vmaf_available ? "by ffmpeg." : "not available, since ffmpeg has no libvmaf.";
  if (!clip.compared) out += " Other codecs were not asked for (<code>--peers</code>).";
  if (!clip.whole) out += " The source is cut off or damaged: measured as far as it goes.";
  return out;
}

std::string image(const Still::Image& i, const Still& still, const ClipReport& clip) {
  const Rational aspect = clip.format.pixel_aspect;
  const double pixel = aspect.num > 0 ? static_cast<double>(aspect.num) / aspect.den : 1;
  const std::string shape =
      decimal(clip.format.width * pixel, 1) + " / " + std::to_string(clip.format.height);
  const std::string name = i.point == nullptr ? "source" : i.point->codec == "fbs" ? "fbs" : i.point->codec;
  std::string caption = "<b>" + escaped(name) + "</b>";
  if (i.point == nullptr) {
    caption += ", picture " + std::to_string(still.picture) + ", " + still.why + " for fbs";
  } else {
    const std::string& label = i.point->label;
    caption += ", " +
               escaped(label.starts_with(name + " ") ? label.substr(name.size() + 1) : point_name(*i.point)) +
               ", " + decimal(i.point->kbps(), 1) + " kbit/s";
    const PictureQuality& q = i.point->pictures.at(still.picture);
    if (q.face) caption += ": face " + decimal(q.face->y.psnr(), 1) + " dB, ";
    caption += (q.face ? "frame " : ": frame ") + decimal(q.frame.y.psnr(), 1) + " dB";
  }
  return "<figure><img alt=\"" + escaped(name) + "\" style=\"aspect-ratio: " + shape +
         "\" src=\"data:image/jpeg;base64," + base64(i.jpeg) + "\"><figcaption>" + caption +
         "</figcaption></figure>\n";
}

Result<std::string> stills_of(const ClipReport& clip) {
  const auto stills = make_stills(clip);
  if (!stills) return fail(stills.error());
  std::string out;
  for (const Still& still : *stills) {
    out += "<div class=\"stills\" style=\"grid-template-columns: repeat(" +
           std::to_string(still.images.size()) + ", 1fr)\">\n";
    for (const Still::Image& i : still.images) out += image(i, still, clip);
    out += "</div>\n";
  }
  return out;
}

std::string byte_keys(const ClipReport& clip) {
  const bool sound = std::ranges::any_of(clip.points, [](const RdPoint& p) { return p.bytes.sound > 0; });
  std::string out;
  for (const std::string part : {"geometry", "patterns", "motion", "sound", "other"})
    if (part != "sound" || sound)
      out.append("<span><i class=\"key ").append(part).append("\"></i>").append(part).append("</span>");
  return out;
}

Result<std::string> clip_section(const ClipReport& clip, bool with_heading) {
  auto stills = stills_of(clip);
  if (!stills) return fail(stills.error());
  const std::string rival = time_rival_text(clip);
  const bool face = clip.believed > 0;
  const std::string grey = clip.peers.empty() ? "" : "; grey: the best of the others";
  return filled(clip_html(),
                {{"heading", with_heading ? "<h2>" + escaped(figures_of(clip).name) + "</h2>" : ""},
                 {"summary", escaped(summary_of(clip))},
                 {"facts", facts_of(clip)},
                 {"face_caption", face ? "Face: luma PSNR over bitrate" + grey : "Face: in no picture"},
                 {"face_curve", rate_chart(clip, Area::kFace)},
                 {"frame_caption", "Frame: luma PSNR over bitrate" + grey},
                 {"frame_curve", rate_chart(clip, Area::kFrame)},
                 {"streams", point_table(clip)},
                 {"bars", byte_bars(clip)},
                 {"keys", byte_keys(clip)},
                 {"stills", std::move(*stills)},
                 {"face_time_caption", face ? "Face: luma PSNR of each picture" + rival : ""},
                 {"face_time", time_chart(clip, Area::kFace)},
                 {"frame_time_caption", "Frame: luma PSNR of each picture" + rival},
                 {"frame_time", time_chart(clip, Area::kFrame)},
                 {"peers", peer_table(clip)}});
}

/// The part before several clips.
std::string overview(const std::vector<ClipReport>& clips) {
  std::string out;
  if (const std::string means = means_sentence(clips); !means.empty())
    out = "<p class=\"summary\">" + escaped(means) + "</p>";
  return out + clip_table(clips);
}

std::string title_of(const std::string& source) {
  std::filesystem::path path(source);
  if (!path.has_filename()) path = path.parent_path();
  return source == "-" ? "Standard input" : path.filename().string();
}

}  // namespace

Result<void> write_html(const std::string& file, const std::string& source,
                        const std::vector<ClipReport>& clips) {
  const bool several = clips.size() > 1;
  std::string sections;
  for (const ClipReport& clip : clips) {
    auto section = clip_section(clip, several);
    if (!section) return fail(section.error());
    sections += *section;
  }
  const std::string page = filled(report_html(), {{"title", escaped(title_of(source))},
                                                  {"style", std::string(report_css())},
                                                  {"head", several ? overview(clips) : ""},
                                                  {"clips", sections},
                                                  {"legend", std::string(legend_html())}});
  auto out = AtomicFile::create(file);
  if (!out) return fail(out.error());
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(page.data()), page.size());
  return out->write(bytes).and_then([&] { return out->commit(); });
}

}  // namespace fbs::cli
