#include "tests/vectors/loss_vectors.h"

#include <utility>

namespace fbs {
namespace {

constexpr int kLivePictures = 48;

Bytes live(const std::vector<std::uint32_t>& durations = {}, double join = 0) {
  auto turning = talker_settings(96, 80, kLivePictures);
  turning.motion = talker::Motion::kTurns;
  turning.yaw_deg = 20;
  EncoderSettings settings;
  settings.quality = 70;
  settings.live = LiveSettings{.resilience = Resilience::kStrong, .join = join};
  return encoded(pictures_of(turning), settings, durations);
}

/// Only the loss of a pattern that nothing needs goes unnoticed.
std::string_view error_of(const Piece& lost) {
  return lost.type == PacketType::kPattern ? "-" : "kInvalidStream";
}

Bytes joined_with_swapped(const std::vector<Piece>& pieces, std::size_t nth) {
  const Bytes whole = joined(pieces);
  const auto at = [&](std::size_t n) {
    return whole.begin() + static_cast<std::ptrdiff_t>(offset_of(pieces, n));
  };
  Bytes stream(whole.begin(), at(nth));
  stream.insert(stream.end(), at(nth + 1), at(nth + 2));
  stream.insert(stream.end(), at(nth), at(nth + 1));
  stream.insert(stream.end(), at(nth + 2), whole.end());
  return stream;
}

}  // namespace

void add_losses(Folder& folder) {
  const Bytes stream = live();
  const auto pieces = pieces_of(stream);
  folder.add("live.fbs", stream, kLivePictures);
  const std::size_t head = place_of(pieces, PacketType::kPattern) + 1, end = pieces.size() - 1;
  for (std::size_t n = head; n < end; ++n)
    folder.add("live_without_" + std::to_string(n) + ".fbs", joined_without(pieces, n), kLivePictures,
               error_of(pieces[n]));
  const std::size_t unit = place_of(pieces, PacketType::kUnit, 2);
  folder.add("live_doubled.fbs", joined_with_two(pieces, unit), kLivePictures);
  folder.add("live_swapped.fbs", joined_with_swapped(pieces, unit), kLivePictures, "kInvalidStream");
  folder.add("live_late_pattern.fbs", joined_with_swapped(pieces, place_of(pieces, PacketType::kPattern, 1)),
             kLivePictures);
  Bytes flipped = stream;
  flipped[offset_of(pieces, unit)] ^= 0x10;  // the type: what follows has to be searched
  folder.add("live_flipped.fbs", flipped, kLivePictures, "kInvalidStream");

  const auto parts = pieces_of(live({}, 1));
  folder.add("live_parts.fbs", joined(parts), kLivePictures);
  folder.add("live_joined.fbs", joined_from(parts, place_of(parts, PacketType::kUnit, 1)), 17, "kNotFbs");

  std::vector<std::uint32_t> durations;
  for (std::uint32_t i = 0; i < kLivePictures; ++i) durations.push_back(i % 3 == 2 ? 6000 : 3000);
  const auto timed = pieces_of(live(durations));
  folder.add("live_timed.fbs", joined_without(timed, place_of(timed, PacketType::kUnit, 2)), kLivePictures,
             "kInvalidStream");
  const auto timed_parts = pieces_of(live(durations, 1));
  folder.add("live_timed_joined.fbs", joined_from(timed_parts, place_of(timed_parts, PacketType::kUnit, 1)),
             23, "kNotFbs");
}

}  // namespace fbs
