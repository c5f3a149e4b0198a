#include "cli/video/av/av_support.h"

#include <atomic>
#include <cstdarg>
#include <filesystem>
#include <system_error>

namespace fbs {
namespace {

std::atomic<std::int64_t> complaints = 0;

/// Prints nothing.
void count_complaints(void* object, int level, const char* /*format*/, std::va_list /*arguments*/) {
  if (object == nullptr || level > AV_LOG_ERROR) return;
  const AVClass* const kind = *static_cast<AVClass**>(object);
  const AVClassCategory category =
      kind->get_category != nullptr ? kind->get_category(object) : kind->category;
  if (category == AV_CLASS_CATEGORY_DEMUXER) ++complaints;
}

int is_stopped(void* stop) {
  return static_cast<const StopSignal*>(stop)->raised() ? 1 : 0;
}

}  // namespace

std::int64_t demuxer_complaints() {
  return complaints;
}

AvInput open_av_input(const std::string& name, const StopSignal* stop, int& error) {
  av_log_set_callback(count_complaints);
  std::error_code ignored;
  const std::string url = std::filesystem::exists(name, ignored) ? "file:" + name : name;
  AVFormatContext* context = avformat_alloc_context();
  if (context == nullptr) {
    error = AVERROR(ENOMEM);
    return nullptr;
  }
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): is_stopped only reads it
  if (stop != nullptr) context->interrupt_callback = {is_stopped, const_cast<StopSignal*>(stop)};
  error = avformat_open_input(&context, url.c_str(), nullptr, nullptr);
  if (error < 0) return nullptr;
  AvInput input(context);
  error = avformat_find_stream_info(context, nullptr);
  if (error < 0) return nullptr;
  return input;
}

void discard_others(AVFormatContext& container, int index) {
  for (unsigned i = 0; i < container.nb_streams; ++i) {
    if (static_cast<int>(i) != index) container.streams[i]->discard = AVDISCARD_ALL;
  }
}

}  // namespace fbs
