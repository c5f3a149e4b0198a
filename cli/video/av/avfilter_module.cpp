// The module fbs_avfilter.

#include <cstdint>  // libavutil wants it before its own headers

extern "C" {
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
}

#include <array>
#include <cstdio>

#include "cli/program/module.h"
#include "cli/video/av/av_filter.h"

namespace fbs {
namespace {

struct GraphDeleter {
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
};

struct InOutDeleter {
  void operator()(AVFilterInOut* end) const { avfilter_inout_free(&end); }
};
using InOut = std::unique_ptr<AVFilterInOut, InOutDeleter>;

InOut graph_end(const char* name, AVFilterContext* filter) {
  InOut end(avfilter_inout_alloc());
  end->name = av_strdup(name);
  end->filter_ctx = filter;
  return end;
}

class GraphFilter final : public FrameFilter {
 public:
  Result<void> open(const AVFrame& first, const std::string& filters) {
    const AVRational aspect = first.sample_aspect_ratio;
    std::array<char, 160> in{};
    std::snprintf(in.data(), in.size(), "video_size=%dx%d:pix_fmt=%d:time_base=1/1:pixel_aspect=%d/%d",
                  first.width, first.height, first.format, aspect.num, aspect.den > 0 ? aspect.den : 1);
    graph_.reset(avfilter_graph_alloc());
    int code = avfilter_graph_create_filter(&source_, avfilter_get_by_name("buffer"), "in", in.data(),
                                            nullptr, graph_.get());
    if (code >= 0)
      code = avfilter_graph_create_filter(&sink_, avfilter_get_by_name("buffersink"), "out", nullptr, nullptr,
                                          graph_.get());
    if (code < 0) return failed(code);
    InOut outputs = graph_end("in", source_), inputs = graph_end("out", sink_);
    AVFilterInOut* in_ends = inputs.release();
    AVFilterInOut* out_ends = outputs.release();
    code = avfilter_graph_parse_ptr(graph_.get(), filters.c_str(), &in_ends, &out_ends, nullptr);
    inputs.reset(in_ends);
    outputs.reset(out_ends);
    if (code >= 0) code = avfilter_graph_config(graph_.get(), nullptr);
    return code < 0 ? failed(code) : Result<void>{};
  }

  Result<const AVFrame*> filter(const AVFrame& frame) override {
    av_frame_unref(filtered_.get());
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the flag keeps the frame as it is
    auto* const kept = const_cast<AVFrame*>(&frame);
    int code = av_buffersrc_add_frame_flags(source_, kept, AV_BUFFERSRC_FLAG_KEEP_REF);
    if (code >= 0) code = av_buffersink_get_frame(sink_, filtered_.get());
    if (code < 0) return failed(code);
    return filtered_.get();
  }

 private:
  static tl::unexpected<Error> failed(int code) {
    return fail(ErrorCode::kUnsupported, code == AVERROR_FILTER_NOT_FOUND
                                             ? "this FFmpeg lacks the filters zscale or tonemap"
                                             : "colours cannot be converted: " + av_reason(code));
  }

  std::unique_ptr<AVFilterGraph, GraphDeleter> graph_;
  AVFilterContext* source_ = nullptr;  ///< of graph_, as sink_
  AVFilterContext* sink_ = nullptr;
  AvFrame filtered_{av_frame_alloc()};
};

}  // namespace
}  // namespace fbs

FBS_MODULE_EXPORT void fbs_open_filter(const AVFrame& first, const std::string& graph,
                                       fbs::Result<std::unique_ptr<fbs::FrameFilter>>& filter) {
  auto opened = std::make_unique<fbs::GraphFilter>();
  if (auto done = opened->open(first, graph); !done)
    filter = fbs::fail(done.error());
  else
    filter = std::move(opened);
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const std::string text = std::string("FFmpeg ") + av_version_info() + "\nzscale " +
                                  (avfilter_get_by_name("zscale") != nullptr ? "yes" : "no");
  return text.c_str();
}
