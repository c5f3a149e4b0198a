// What the player shows: the picture, the source beside it, panels and the time bar.
#include <algorithm>
#include <array>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "cli/display/display_image.h"
#include "cli/display/text_panel.h"
#include "cli/play/player.h"
#include "decoder/scene/scene_face.h"

namespace fbs::cli {
namespace {

/// The source, scaled to the picture's height, on its left.
cv::Mat beside(const cv::Mat& source, const cv::Mat& picture, int height) {
  cv::Mat left;
  const double factor = static_cast<double>(height) / source.rows;
  cv::resize(source, left, {}, factor, factor, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  cv::Mat out(std::max(left.rows, picture.rows), left.cols + picture.cols, CV_8UC3, cv::Scalar());
  left.copyTo(out(cv::Rect({0, 0}, left.size())));
  picture.copyTo(out(cv::Rect({left.cols, 0}, picture.size())));
  return out;
}

cv::Mat help_panel() {
  std::vector<PanelLine> lines;
  for (const KeyLine& line : key_lines()) lines.push_back({line.names(), std::string(line.text)});
  for (const MouseLine& line : mouse_lines())
    lines.push_back({std::string(line.name), std::string(line.text)});
  return text_panel(lines);
}

}  // namespace

Result<void> Player::draw() {
  if (auto drawn = stage_.draw(decoder()); !drawn) return drawn;
  drawn_ = true;
  shown_ = false;
  playback_.drawn(Playback::Clock::now());
  // While the stream plays, changes become visible in the next picture.
  if (!recording_ || (std::exchange(recorded_, true) && playback_.is_running())) return {};
  const auto picture = stage_.file_picture(decoder());
  if (!picture) return fail(picture.error());
  return recording_->write(*picture, decoder().duration(), sound_of_picture());
}

Result<void> Player::show() {
  shown_ = true;
  const auto shown = image();
  if (!shown) return fail(shown.error());
  if (auto seen = window_->show(*shown, content_of(*shown), panels(), shows_info_ ? progress() : -1); !seen)
    return seen;
  log_times();
  return {};
}

Result<cv::Mat> Player::image() {
  auto picture = stage_.screen_image(decoder());
  if (!picture || !shows_source_) return picture;
  const auto source = source_->picture_at(decoder().position().time);
  if (!source) return fail(source.error());
  return beside(*source, *picture, decoder().format().height * display_zoom(decoder().format()));
}

Size Player::content_of(const cv::Mat& image) const {
  return square_pixels({image.cols, image.rows}, decoder().format().pixel_aspect);
}

double Player::progress() const {
  if (!length_ || *length_ == 0) return 0;
  const std::uint64_t end = decoder().position().time + (playback_.ended() ? decoder().duration() : 0);
  return static_cast<double>(end) / static_cast<double>(*length_);
}

std::vector<Panel> Player::panels() const {
  std::vector<Panel> out;
  if (shows_info_) {
    std::vector<PanelLine> lines;
    for (const std::string& line : info()) lines.push_back({"", line});
    out.push_back({text_panel(lines), Panel::Place::kBottomLeft});
  }
  if (shows_help_) out.push_back({help_panel(), Panel::Place::kMiddle});
  return out;
}

std::vector<std::string> Player::info() const {
  const std::uint64_t begin = decoder().position().time, end = begin + decoder().duration();
  // The first second also covers what precedes the first picture.
  const std::uint64_t time = std::max<std::uint64_t>(end, kTicksPerSecond);
  const double rate =
      8e-3 * static_cast<double>(file_->bytes_decoded()) * kTicksPerSecond / static_cast<double>(time);
  const std::string sound = device_ ? sound_->volume_text() : "";
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), "%s%s%s   %.1f kbit/s   picture %llu   patterns %zu%s%s%s%s",
                clock_text(begin).c_str(), length_ ? " / " : "", length_ ? clock_text(*length_).c_str() : "",
                rate, static_cast<unsigned long long>(decoder().position().pictures),
                decoder().scene().patterns.size(), playback_.paused() ? "   paused" : "",
                loops_ ? "   loop" : "", sound.empty() ? "" : "   ", sound.c_str());
  std::vector<std::string> out = {line.data()};
  if (stage_.pattern)
    out.push_back("pattern " + std::to_string(*stage_.pattern + 1) + " alone (o: as in the stream)");
  if (stage_.edit.any())
    out.emplace_back(face_of(decoder().scene()) != nullptr ? "moved by keys (0: as in the stream)"
                                                           : "no face to be moved here");
  return out;
}

}  // namespace fbs::cli
