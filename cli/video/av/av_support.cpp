#include "cli/video/av/av_support.h"

#include <filesystem>
#include <system_error>

namespace fbs {
namespace {

int is_stopped(void* stop) {
  return static_cast<const StopSignal*>(stop)->raised() ? 1 : 0;
}

}  // namespace

AvInput open_av_input(const std::string& name, const StopSignal* stop, int& error) {
  av_log_set_level(AV_LOG_QUIET);
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

}  // namespace fbs
