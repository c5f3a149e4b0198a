#include "cli/video/av/av_support.h"

#include <filesystem>
#include <system_error>

namespace fbs {

AvInput open_av_input(const std::string& name, int& error) {
  av_log_set_level(AV_LOG_QUIET);
  std::error_code ignored;
  const std::string url = std::filesystem::exists(name, ignored) ? "file:" + name : name;
  AVFormatContext* context = nullptr;
  error = avformat_open_input(&context, url.c_str(), nullptr, nullptr);
  if (error < 0) return nullptr;
  AvInput input(context);
  error = avformat_find_stream_info(context, nullptr);
  if (error < 0) return nullptr;
  return input;
}

}  // namespace fbs
