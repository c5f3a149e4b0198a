#include "tests/vectors/blend_vectors.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/blend/blend_syntax.h"
#include "bitstream/entropy/range_coder.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "decoder/pattern/obu.h"
#include "encoder/patterns/pattern_sequence.h"

namespace fbs {
namespace {

constexpr int kPictures = 40;
constexpr std::int32_t kSlots = 3;

/// Patterns of consecutive slots, coded together, hidden frames among them.
std::vector<SequencePattern> sequence(const std::vector<Picture>& pictures, const VideoFormat& format,
                                      const std::vector<std::size_t>& numbers, bool reduced) {
  std::vector<Picture> chosen;
  for (const std::size_t n : numbers) chosen.push_back(pictures[n]);
  SequenceSettings settings;
  settings.quantiser = 58;
  settings.reduced = reduced;
  auto coded = must(code_pattern_sequence(format, chosen, settings));
  for (SequencePattern& p : coded) p.picture = numbers[p.picture];
  return coded;
}

/// Writes a scene of several patterns by hand, on the motion of a scene of one.
class HandMade {
 public:
  /// @param one    a scene of one pattern, whose motion is taken
  /// @param slots  of the store
  HandMade(const Bytes& one, std::int32_t slots)
      : motion_(pieces_of(one)), seen_(patterns_of(motion_).front().patterns.front().state) {
    setup_ = must(decode_setup(motion_[place_of(motion_, PacketType::kSetup)].payload));
    setup_.patterns = slots;
    setup_.contrast = 170;
    setup_.chroma_contrast = 400;
    motion_decoder_.emplace(setup_, seen_);
    add(PacketType::kSetup, must(encode_setup(setup_)));
    for (const Piece& piece : motion_)
      if (piece.type == PacketType::kGeometry || piece.type == PacketType::kSurround)
        add(piece.type, piece.payload);
  }

  void pattern(std::int32_t slot, const SequencePattern& coded) { patterns(slot, {&coded, 1}); }

  /// In one packet, for consecutive slots.
  void patterns(std::int32_t slot, std::span<const SequencePattern> coded) {
    std::vector<PatternSyntax> together;
    for (const SequencePattern& p : coded) {
      const auto picture = static_cast<std::int32_t>(p.picture);
      together.push_back({slot++, picture, picture == 0 ? seen_ : CodedState{}, p.av1});
    }
    add(PacketType::kPattern, must(writer_.encode(together, setup_, pictures_)));
  }

  void motion(int groups) {
    for (; groups > 0; --groups, ++groups_) {
      add(PacketType::kMotion, motion_[place_of(motion_, PacketType::kMotion, groups_)].payload);
      pictures_ += must(motion_decoder_->decode(pieces_.back().payload))->pictures;
    }
  }

  /// Picture i of them has mode first_mode + i + 3 * r in region r, so that each meets each.
  void blend(int pictures, int first_mode, bool key = false) {
    BlendGroup group;
    group.key = key;
    group.first = blend_.next();
    for (int i = 0; i < pictures; ++i) {
      RegionModes modes;
      for (std::size_t r = 0; r < kRegionCount; ++r)
        modes[r] = static_cast<BlendMode>((first_mode + i / 2 + 3 * static_cast<int>(r)) % kBlendModeCount);
      group.modes.push_back(modes);
    }
    add(PacketType::kBlend, must(blend_.encode(group)));
  }

  [[nodiscard]] const Setup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  void add(PacketType type, Bytes payload) { pieces_.push_back({type, std::move(payload)}); }

  std::vector<Piece> motion_;  // the scene of one pattern
  Setup setup_;
  CodedState seen_;  // of the first pattern
  std::optional<MotionDecoder> motion_decoder_;
  std::int32_t pictures_ = 0;  // that have a state
  PatternPacketWriter writer_;
  BlendEncoder blend_;
  std::vector<Piece> pieces_;
  int groups_ = 0;
};

std::vector<Picture> turning_pictures() {
  auto settings = talker_settings(67, 65, kPictures);
  settings.motion = talker::Motion::kTurns;
  settings.frame_rate = {10, 1};
  return pictures_of(settings);
}

/// Every mode in every region; hidden frames; reduced ones; slots replaced, the first too; pictures before
/// and after all patterns; blend packets of other sizes than the motion's.
std::vector<Piece> blends() {
  const auto pictures = turning_pictures();
  HandMade made(encoded(pictures, one_pattern(8)), kSlots);
  const auto full = sequence(pictures, made.setup().format, {0, 5, 9, 14, 20}, false);
  const auto reduced = sequence(pictures, made.setup().format, {26, 30, 18}, true);
  made.pattern(0, full[0]);
  made.motion(2);  // pictures 0..8
  made.blend(2, 0, true);
  made.motion(2);  // 9..24
  made.patterns(1, std::span(full).subspan(1, 2));
  made.blend(6, 2);
  made.pattern(1, full[3]);
  made.pattern(2, full[4]);
  made.blend(7, 5);
  made.motion(1);  // 25..32
  made.patterns(0, reduced);
  made.blend(8, 8);
  made.motion(1);
  made.blend(2, 12, true);
  made.blend(15, 0);
  return made.pieces();
}

/// A store of one slot, whose pattern is replaced.
std::vector<Piece> replaced() {
  const auto pictures = turning_pictures();
  HandMade made(encoded(pictures, one_pattern(8)), 1);
  const auto coded = sequence(pictures, made.setup().format, {0, 20}, false);
  made.pattern(0, coded[0]);
  made.motion(4);
  made.pattern(0, coded[1]);
  made.motion(2);
  return made.pieces();
}

/// Pictures without a face: a bright bar that wanders over a dark ground.
std::vector<Picture> bars(std::size_t count) {
  std::vector<Picture> out(count, Picture(64, 64));
  for (std::size_t i = 0; i < count; ++i)
    for (int y = 0; y < 64; ++y) std::fill_n(out[i].y.row(y) + i * 48 / count, 16, std::uint8_t{200});
  return out;
}

constexpr int kBars = 320, kBarGroup = 100;

/// A scene without geometry; a pattern of the oldest picture whose state is kept.
/// @param last  picture of the last pattern
std::vector<Piece> cross_fade(std::size_t last) {
  EncoderSettings anything = one_pattern(kBarGroup);
  anything.allow_no_face = true;
  const auto pictures = bars(kBars);
  HandMade made(encoded(std::vector<Picture>(kBars, pictures[0]), anything), kSlots);
  const auto coded = sequence(pictures, made.setup().format, {0, 150}, false);
  made.pattern(0, coded[0]);
  made.motion(4);  // 1 + 3 * kBarGroup
  made.pattern(1, coded[1]);
  made.blend(200, 0, true);
  made.blend(100, 5);
  made.pattern(2, sequence(pictures, made.setup().format, {last}, true)[0]);
  made.motion(1);
  made.blend(20, 0);
  return made.pieces();
}

/// Nine pictures have motion, ten a blend.
Bytes blend_ahead() {
  const auto pictures = turning_pictures();
  HandMade made(encoded(pictures, one_pattern(8)), kSlots);
  made.pattern(0, sequence(pictures, made.setup().format, {0}, false)[0]);
  made.motion(2);
  made.blend(2, 0, true);
  made.blend(8, 1);
  made.motion(1);
  made.blend(8, 2);
  return joined(made.pieces());
}

void require_hidden_frames(const std::vector<Piece>& pieces) {
  const auto is_hidden = [](const PatternSyntax& pattern) {
    for (ObuReader reader(pattern.av1); !reader.done();) {
      const Obu obu = must(reader.next());
      // AV1 specification 5.9.2: show_existing_frame (1 bit), frame_type (2), show_frame.
      if (obu.type == ObuType::kFrame && (obu.payload[0] & 0x10) == 0) return true;
    }
    return false;
  };
  for (const PatternPiece& piece : patterns_of(pieces))
    if (std::any_of(piece.patterns.begin(), piece.patterns.end(), is_hidden)) return;
  give_up("no pattern is a hidden frame");
}

std::vector<Piece> patterns() {
  auto settings = talker_settings(96, 80, 40);
  settings.frame_rate = {15, 1};
  EncoderSettings s;
  s.patterns = 6;
  s.pattern_quantiser = 58;
  s.group_pictures = 10;
  return pieces_of(encoded(pictures_of(settings), s));
}

/// The stream with the first pattern of a packet changed.
Bytes with_pattern(std::vector<Piece> pieces, std::size_t nth, const auto& change) {
  Setup wide = must(decode_setup(pieces[0].payload));
  wide.patterns = kMaxPatterns;
  auto packets = patterns_of(pieces);
  change(packets[nth].patterns.front());
  PatternPacketWriter writer;
  for (const PatternPiece& p : packets)
    pieces[p.piece].payload = must(writer.encode(p.patterns, wide, p.pictures));
  return joined(pieces);
}

/// A later pattern of a picture before the first.
Bytes pattern_of_no_picture() {
  PatternMemory memory;
  RangeEncoder coder;
  coder.raw_bit(kNotKey, false);
  coder.bit(memory.other_slot, false);
  code_wide_integer(coder, memory.number.gap, 0);
  code_exponential(coder, memory.number.from_end, 1000);
  return coder.finish();
}

/// A key group of one picture whose mouth has the first mode that there is not.
Bytes blend_of_unknown_mode() {
  BlendGroup group;
  group.key = true;
  group.modes.resize(1);
  group.modes[0][0] = static_cast<BlendMode>(kBlendModeCount);
  BlendMemory memory;
  RangeEncoder coder;
  coder.raw_bit(kNotKey, true);
  code_count(coder, memory, static_cast<std::int32_t>(group.modes.size()));
  code_modes(coder, memory, std::as_const(group));
  return coder.finish();
}

/// The stream with other surrounds before two of its blend packets, the first with as many columns and rows
/// as pictures are wide.
std::vector<Piece> with_later_surrounds(std::vector<Piece> pieces) {
  for (const auto& [blend, columns] : {std::pair{4, 2}, std::pair{2, 67}}) {
    SurroundMap map{columns, columns, {}, {}};
    const int points = (columns + 1) * (columns + 1);
    for (int k = 0; k < points; ++k) {
      map.head.push_back(static_cast<std::uint8_t>((k * k + blend) % 4));
      map.body.push_back(static_cast<std::uint8_t>(k % 5));
    }
    pieces.insert(pieces.begin() + place_of(pieces, PacketType::kBlend, blend),
                  Piece{PacketType::kSurround, must(encode_surround(map))});
  }
  return pieces;
}

}  // namespace

std::vector<Piece> hand_made_blends() {
  return blends();
}

void add_blends(Folder& folder) {
  const auto own = patterns(), made = blends();
  require_hidden_frames(own);
  require_hidden_frames(made);
  folder.add("patterns.fbs", joined(own), 40);
  folder.add("blends.fbs", joined(made), kPictures);
  folder.add("later_surround.fbs", joined(with_later_surrounds(made)), kPictures);
  folder.add("replaced.fbs", joined(replaced()), kPictures);
  folder.add("cross_fade.fbs", joined(cross_fade(300 - kKeptPictures)), kBars);
}

void add_broken_blends(Folder& folder, const Bytes& talk) {
  const auto made = blends();
  const auto invalid = [&](const std::string& file, const Bytes& bytes, std::uint64_t pictures) {
    folder.add(file, bytes, pictures, "kInvalidStream");
  };
  folder.add("blend_ahead.fbs", blend_ahead(), 17);
  auto of_one = pieces_of(talk);
  of_one.insert(of_one.begin() + place_of(of_one, PacketType::kMotion, 1),
                made[place_of(made, PacketType::kBlend)]);
  invalid("blend_of_one.fbs", joined(of_one), 20);
  auto unknown_mode = made;
  unknown_mode[place_of(made, PacketType::kBlend)].payload = blend_of_unknown_mode();
  invalid("blend_mode.fbs", joined(unknown_mode), kPictures);

  invalid("old_picture.fbs", joined(cross_fade(300 - kKeptPictures - 1)), kBars);
  auto far_picture = made;
  far_picture[place_of(made, PacketType::kPattern, 1)].payload = pattern_of_no_picture();
  invalid("far_picture.fbs", joined(far_picture), kPictures);
  folder.add("far_slot.fbs", with_pattern(made, 1, [](PatternSyntax& p) { p.slot = kSlots; }), kPictures,
             "kTooLarge");
  folder.add("slot_gap.fbs", with_pattern(made, 1, [](PatternSyntax& p) { p.slot = 2; }), kPictures);
  const auto twice = [](PatternSyntax& p) {
    const Bytes frame(p.av1.begin() + 1, p.av1.end());  // without its OBU header, which has no size field
    if (frame.size() > 0x7F) give_up("a frame is longer than its size field here");
    const auto header = static_cast<std::uint8_t>(p.av1[0] | 0x02);
    p.av1 = {header, static_cast<std::uint8_t>(frame.size())};
    p.av1.insert(p.av1.end(), frame.begin(), frame.end());
    const Bytes one = p.av1;
    p.av1.insert(p.av1.end(), one.begin(), one.end());
  };
  invalid("two_frames.fbs", with_pattern(made, 1, twice), kPictures);
  // A frame header OBU of one byte: show_existing_frame of the first of AV1's slots.
  invalid("show_existing.fbs",
          with_pattern(made, 1,
                       [](PatternSyntax& p) {
                         p.av1 = {0x1A, 0x01, 0x80};
                       }),
          kPictures);
  auto lost = made;
  lost.erase(lost.begin() + place_of(lost, PacketType::kPattern, 1));
  invalid("lost_pattern.fbs", joined(lost), kPictures);
  Bytes flipped = joined(made);
  flipped[offset_of(made, place_of(made, PacketType::kBlend, 1)) + 4] ^= 0x30;
  invalid("flipped_blend.fbs", flipped, kPictures);
  invalid("removed_blend.fbs", joined_without(made, place_of(made, PacketType::kBlend, 1)), kPictures);
}

}  // namespace fbs
