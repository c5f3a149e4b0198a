#include "tests/vectors/return_vectors.h"

#include <algorithm>

#include "bitstream/packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "tests/vectors/blend_vectors.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr int kShotWidth = 67, kShotHeight = 65;  // of hand_made_blends()

/// A scene that is sent in several parts.
struct Shot {
  std::vector<Piece> pieces;
  std::size_t sent = 0;
  std::uint32_t check = 0;  ///< of its first pattern packet, once it has been sent
};

/// So many pictures are shown of the first `count` packets.
std::uint64_t shown(std::vector<Piece> pieces, std::size_t count) {
  pieces.resize(count);
  return count == 0 ? 0 : digest_of(joined(pieces)).pictures;
}

std::uint32_t last_check(const std::vector<Piece>& pieces) {
  Bytes stream;
  PacketWriter writer;
  std::uint32_t check = 0;
  for (const Piece& p : pieces) check = writer.write(stream, p.type, p.payload);
  return check;
}

/// Cuts a stream from shot to shot.
class Cutter {
 public:
  void begin(Shot& shot, std::size_t packets, SceneKeeping keeps) {
    Setup setup = must(decode_setup(shot.pieces.front().payload));
    setup.before = position();
    setup.keeps = keeps;
    shot.pieces.front().payload = must(encode_setup(setup));
    send(shot, packets);
  }

  /// @param before  the position; null: the right one
  void go_on(Shot& shot, std::size_t packets, bool aside, const StreamPosition* before = nullptr) {
    const StreamPosition at = before == nullptr ? position() : *before;
    pieces_.push_back(
        {PacketType::kReturn,
         encode_return({shot.check, at, aside, static_cast<std::uint32_t>(shown(shot.pieces, shot.sent))})});
    send(shot, packets);
  }

  /// With an end packet.
  [[nodiscard]] std::vector<Piece> pieces() const {
    auto out = pieces_;
    out.push_back({PacketType::kEnd, encode_end({pictures_})});
    return out;
  }
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }

 private:
  [[nodiscard]] StreamPosition position() const { return {pictures_, pictures_ * 3000}; }

  /// The next packets of a shot, or what is left of it.
  void send(Shot& shot, std::size_t packets) {
    const std::size_t end = std::min(shot.sent + packets, shot.pieces.size());
    pictures_ += shown(shot.pieces, end) - shown(shot.pieces, shot.sent);
    for (; shot.sent < end; ++shot.sent) {
      pieces_.push_back(shot.pieces[shot.sent]);
      if (shot.check == 0 && pieces_.back().type == PacketType::kPattern) shot.check = last_check(pieces_);
    }
  }

  std::vector<Piece> pieces_;
  std::uint64_t pictures_ = 0;
};

constexpr std::size_t kRest = 1000;  // packets: all that are left

Shot shot_of(std::vector<Piece> pieces) {
  if (pieces.back().type == PacketType::kEnd) pieces.pop_back();
  return {std::move(pieces)};
}

/// Patterns, motion and blends. Seven pictures wait behind the first seven packets.
Shot speaker() {
  return shot_of(hand_made_blends());
}

/// Units, as of a live stream: two in the first six packets.
Shot answerer() {
  auto turning = talker_settings(kShotWidth, kShotHeight, 36);
  turning.seed = 7;
  turning.motion = talker::Motion::kTurns;
  EncoderSettings settings;
  settings.quality = 70;
  settings.live = LiveSettings{.resilience = Resilience::kStrong};
  return shot_of(pieces_of(encoded(pictures_of(turning), settings)));
}

/// One picture without a face.
Shot slide(std::uint8_t grey) {
  Picture picture(kShotWidth, kShotHeight);
  for (int y = 0; y < kShotHeight; ++y) std::fill_n(picture.y.row(y), kShotWidth, grey);
  EncoderSettings anything = one_pattern();
  anything.allow_no_face = true;
  return shot_of(pieces_of(encoded({picture}, anything)));
}

/// Two speakers in turn, a slide to which the stream returns not, and one behind a speaker who has ended.
Cutter conversation() {
  Shot a = speaker(), b = answerer(), one = slide(60), other = slide(180);
  Cutter out;
  out.begin(a, 7, SceneKeeping::kNone);
  out.begin(b, 6, SceneKeeping::kAndPresent);
  out.go_on(a, 7, true);
  out.go_on(b, 2, true);
  out.begin(one, kRest, SceneKeeping::kAndPresent);
  out.go_on(a, kRest, false);
  out.begin(other, kRest, SceneKeeping::kAside);
  out.go_on(b, kRest, false);
  return out;
}

/// Five scenes, of which the first four may be set aside: one more than a decoder keeps.
Cutter many() {
  Shot a = speaker(), slides[] = {slide(20), slide(90), slide(160), slide(230)};
  Cutter out;
  out.begin(a, 7, SceneKeeping::kNone);
  for (Shot* s = slides; s < slides + 3; ++s) out.begin(*s, kRest, SceneKeeping::kAndPresent);
  out.go_on(a, 7, true);  // the oldest of three, and the present one makes four
  out.begin(slides[3], kRest, SceneKeeping::kAndPresent);
  out.go_on(slides[0], kRest, true);  // has been discarded
  out.go_on(a, kRest, false);
  return out;
}

/// Two scenes, then the first again where the second may have discarded it, then the second, and a third.
Cutter two(SceneKeeping keeps, const StreamPosition* before = nullptr) {
  Shot a = speaker(), b = answerer(), last = slide(120);
  Cutter out;
  out.begin(a, 7, SceneKeeping::kNone);
  out.begin(b, 6, keeps);
  out.go_on(a, 7, true, before);
  out.go_on(b, 2, true);
  out.go_on(a, kRest, false);
  out.begin(last, kRest, SceneKeeping::kNone);
  return out;
}

}  // namespace

void add_returns(Folder& folder) {
  const auto good = conversation(), kept = two(SceneKeeping::kAndPresent);
  const auto pieces = good.pieces(), of_two = kept.pieces();
  const std::size_t second = place_of(pieces, PacketType::kSetup, 1);
  folder.add("returns.fbs", joined(pieces), good.pictures());
  const auto invalid = [&](const std::string& file, const Bytes& bytes, std::uint64_t pictures) {
    folder.add(file, bytes, pictures, "kInvalidStream");
  };
  const auto written = [&](const std::string& file, const Cutter& cutter) {
    invalid(file, joined(cutter.pieces()), cutter.pictures());
  };
  written("returns_many.fbs", many());
  written("returns_lost.fbs", two(SceneKeeping::kNone));
  written("returns_discarded.fbs", two(SceneKeeping::kAside));
  const StreamPosition early{1, 3000};
  written("returns_backwards.fbs", two(SceneKeeping::kAndPresent, &early));
  folder.add("returns_joined.fbs",
             joined({pieces.begin() + static_cast<std::ptrdiff_t>(second), pieces.end()}),
             good.pictures() - must(decode_setup(pieces[second].payload)).before.pictures);
  invalid("returns_removed_setup.fbs", joined_without(pieces, second), good.pictures());
  invalid("returns_removed.fbs", joined_without(pieces, place_of(pieces, PacketType::kReturn)),
          good.pictures());

  auto cut = of_two, newer = of_two;
  cut[place_of(cut, PacketType::kReturn)].payload = {0x80};
  folder.add("returns_cut.fbs", joined(cut), kept.pictures(), "kTruncated");
  newer[place_of(newer, PacketType::kSetup, 1)].payload[0] = kFormatVersion + 1;
  folder.add("returns_newer.fbs", joined(newer), kept.pictures(), "kUnsupported");
}

}  // namespace fbs
