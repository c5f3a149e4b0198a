#include "cli/play/player.h"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include "cli/play/stream_length.h"

namespace fbs::cli {
namespace {

constexpr std::chrono::milliseconds kIdle{50};  ///< between looks at the clock where nothing is due
constexpr int kMostThreads = 4;                 ///< more wait for each other

/// A drag over the height of the picture, in 2^-16 turns: a quarter turn.
constexpr double kTurnOfDrag = 65536.0 / 4;

std::int32_t turn(double share) {
  return static_cast<std::int32_t>(share * kTurnOfDrag);
}

}  // namespace

Result<void> Player::open() {
  loops_ = arguments_.loop;
  if (auto opened = open_stream(); !opened) return opened;
  if (!arguments_.source.empty()) {
    auto source = SourceTrack::open(arguments_.source);
    if (!source) return fail(source.error());
    source_.emplace(std::move(*source));
    shows_source_ = true;
  }
  if (auto drawn = stage_.draw(decoder()); !drawn) return drawn;
  const auto first = image();
  if (!first) return fail(first.error());
  auto window = Window::open("fbs: " + arguments_.input, content_of(*first));
  if (!window) return fail(window.error());
  window_.emplace(std::move(*window));
  return begin_recording();
}

Result<void> Player::open_stream() {
  auto file = StreamFile::open(arguments_.input);
  if (!file) return fail(file.error());
  file_.emplace(std::move(*file));
  file_->keep_bytes();
  // A file is read as a whole, which tells its length; a pipe only as far as it is played.
  std::error_code ignored;
  const bool whole = std::filesystem::is_regular_file(arguments_.input, ignored);
  if (whole || first_time() > 0)
    if (auto sought = file_->seek(first_time()); !sought) return sought;
  if (whole) length_ = stream_length(file_->kept());
  prepare_decoder();
  const auto found = losses_.next(*file_);
  if (!found) return fail(found.error());
  if (*found == DecodeStatus::kEnd)
    return fail(ErrorCode::kInvalidStream, file_->name() + ": contains no pictures");
  const auto now = Playback::Clock::now();
  playback_.pause(arguments_.paused, now);
  playback_.take(decoder().position().time, decoder().duration(), now);
  return {};
}

void Player::prepare_decoder() {
  decoder().record_patterns();
  decoder().use_threads(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads));
}

Result<void> Player::begin_recording() {
  if (arguments_.record.empty()) return {};
  auto recording = Recording::open(arguments_.record, decoder().format());
  if (!recording) return fail(recording.error());
  recording_.emplace(std::move(*recording));
  return {};
}

Result<void> Player::run() {
  file_->on_wait([this] {
    interrupted_ = window_->has_events();
    return !interrupted_;
  });
  playback_.jump();  // the time that the window took to open does not count
  playback_.take(decoder().position().time, decoder().duration(), Playback::Clock::now());
  if (auto drawn = draw(); !drawn) return drawn;
  while (!quits_) {
    for (const WindowEvent& event : window_->events(patience())) {
      if (auto taken = take(event); !taken) return taken;
      // What is recorded shows every change, even of keys that come at once.
      if (recording_ && !drawn_)
        if (auto drawn = draw(); !drawn) return drawn;
    }
    if (!quits_ && drawn_ && playback_.is_due(Playback::Clock::now()))
      if (auto gone = advance(); !gone) return gone;
    if (!drawn_)
      if (auto drawn = draw(); !drawn) return drawn;
    if (!shown_)
      if (auto shown = show(); !shown) return shown;
  }
  return recording_ ? recording_->finish() : Result<void>{};
}

std::chrono::milliseconds Player::patience() const {
  if (!playback_.is_running()) return kIdle;
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(playback_.until_due(Playback::Clock::now()));
  return std::min(left, kIdle);
}

Result<bool> Player::decode_next() {
  auto status = losses_.next(*file_);
  if (status && *status == DecodeStatus::kPicture) {
    playback_.take(decoder().position().time, decoder().duration(), Playback::Clock::now());
    return true;
  }
  if (!status && interrupted_) {
    interrupted_ = false;
    return false;
  }
  // A time past the end of a pipe, whose length was not known, shows its last picture.
  const bool ended =
      status || (status.error().code == ErrorCode::kInvalidArgument && decoder().pictures() > 0);
  if (!ended) return fail(status.error());
  playback_.end();
  return false;
}

Result<void> Player::advance() {
  const auto decoded = decode_next();
  if (!decoded) return fail(decoded.error());
  if (playback_.ended()) return end_stream();
  // What is recorded leaves out no picture.
  const bool skipped = !recording_ && playback_.is_late(Playback::Clock::now());
  if (*decoded && !skipped) drawn_ = false;
  return {};
}

Result<void> Player::end_stream() {
  length_ = decoder().position().time + decoder().duration();
  if (!std::exchange(reported_, true)) losses_.finish(*file_);
  shown_ = false;
  return loops_ ? go_to(first_time()) : Result<void>{};
}

Result<void> Player::go_to(std::uint64_t time) {
  if (length_ && *length_ > 0) time = std::min(time, *length_ - 1);
  file_->rejoin(time);
  prepare_decoder();
  playback_.jump();
  const auto decoded = decode_next();
  if (!decoded) return fail(decoded.error());
  drawn_ = false;
  return {};
}

Result<void> Player::step(int pictures) {
  playback_.pause(true, Playback::Clock::now());
  shown_ = false;
  const std::uint64_t now = decoder().position().time;
  if (pictures < 0)
    return now > decoder().start().time || now > 0 ? go_to(now - std::min<std::uint64_t>(now, 1))
                                                   : Result<void>{};
  if (playback_.ended()) return {};
  const auto decoded = decode_next();
  if (!decoded) return fail(decoded.error());
  if (playback_.ended()) {
    // Stepping does not begin again.
    length_ = decoder().position().time + decoder().duration();
    if (!std::exchange(reported_, true)) losses_.finish(*file_);
  }
  if (*decoded) drawn_ = false;
  return {};
}

Result<void> Player::take(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  switch (event.kind) {
    case Kind::kClose:
      quits_ = true;
      break;
    case Kind::kRedraw:
      shown_ = false;
      break;
    case Kind::kTurn:
      stage_.edit.add(EditPart::kYaw, -turn(event.x));
      stage_.edit.add(EditPart::kPitch, turn(event.y));
      drawn_ = false;
      break;
    case Kind::kTilt:
      stage_.edit.add(EditPart::kRoll, turn(event.x));
      drawn_ = false;
      break;
    case Kind::kPlace:
      if (length_) return go_to(static_cast<std::uint64_t>(event.x * static_cast<double>(*length_)));
      break;
    case Kind::kKey:
      if (const auto press = find_key(event.key)) return take_key(*press);
      break;
  }
  return {};
}

Result<void> Player::take_key(const KeyPress& press) {
  if (press.action <= Action::kLoop) return take_playing_key(press);
  take_view_key(press);
  return {};
}

Result<void> Player::take_playing_key(const KeyPress& press) {
  const std::uint64_t now = decoder().position().time;
  shown_ = false;
  switch (press.action) {
    case Action::kPause:
      if (playback_.ended()) return go_to(first_time());
      playback_.pause(!playback_.paused(), Playback::Clock::now());
      break;
    case Action::kStep:
      return step(press.amount);
    case Action::kSeek: {
      const std::uint64_t far = ticks(std::abs(press.amount));
      return go_to(press.amount > 0 ? now + far : now - std::min(now, far));
    }
    case Action::kRestart:
      return go_to(first_time());
    default:
      loops_ = !loops_;
      if (loops_ && playback_.ended()) return go_to(first_time());
      break;
  }
  return {};
}

void Player::take_view_key(const KeyPress& press) {
  const auto edit = [&](EditPart part) { stage_.edit.step(part, press.amount); };
  shown_ = false;
  switch (press.action) {
    case Action::kFullScreen:
      window_->set_full_screen(!window_->full_screen());
      return;
    case Action::kInfo:
      shows_info_ = !shows_info_;
      return;
    case Action::kSource:
      shows_source_ = !shows_source_ && source_;
      return;
    case Action::kHelp:
      shows_help_ = !shows_help_;
      return;
    case Action::kLeave:
      quits_ = !window_->full_screen();
      window_->set_full_screen(false);
      return;
    case Action::kQuit:
      quits_ = true;
      return;
    default:
      break;
  }
  drawn_ = false;  // all others change the picture
  switch (press.action) {
    case Action::kWire:
      stage_.overlays.wire = !stage_.overlays.wire;
      break;
    case Action::kSnakes:
      stage_.overlays.snakes = !stage_.overlays.snakes;
      break;
    case Action::kPatterns:
      stage_.overlays.patterns = !stage_.overlays.patterns;
      break;
    case Action::kYaw:
      edit(EditPart::kYaw);
      break;
    case Action::kPitch:
      edit(EditPart::kPitch);
      break;
    case Action::kRoll:
      edit(EditPart::kRoll);
      break;
    case Action::kBrows:
      edit(EditPart::kBrows);
      break;
    case Action::kMouth:
      edit(EditPart::kMouth);
      break;
    case Action::kSmile:
      edit(EditPart::kSmile);
      break;
    case Action::kLids:
      edit(EditPart::kLids);
      break;
    case Action::kReset:
      stage_.edit.reset();
      break;
    case Action::kPattern:
      stage_.pattern = static_cast<std::size_t>(press.amount - 1);
      break;
    case Action::kNextPattern:
      stage_.choose_next(decoder(), press.amount);
      break;
    case Action::kOwnBlend:
      stage_.pattern.reset();
      break;
    default:
      break;
  }
}

}  // namespace fbs::cli
