#include "tests/vectors/sound_vectors.h"

#include <utility>

#include "bitstream/payload/sound_payload.h"
#include "encoder/sound/sound_encoder.h"
#include "tests/unit/encoder/sound/voice.h"
#include "tests/vectors/sound_digest.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr std::int64_t kFirstPictures = 6, kPicture = 1600;  // of late.fbs; 1/kSoundClock s

struct Voice {
  SoundSetup setup;
  SoundEncoder::Frames frames;
};

Voice voice_in(const SoundSettings& settings, double seconds) {
  const auto encoder = must(SoundEncoder::create(settings));
  Voice out{encoder->setup(), {}};
  const auto coded = encoder->add(test::voice(encoder->sample_rate(), seconds), out.frames);
  if (!coded || !encoder->finish(out.frames)) give_up("a voice cannot be coded");
  return out;
}

/// Sound packets of a scene, the setup first.
using SceneSound = std::vector<Piece>;

Piece sound_packet(const Voice& voice, std::int64_t first, SoundEncoder::Frames frames) {
  return {PacketType::kSound, must(encode_sound({first, std::move(frames)}, voice.setup))};
}

/// The frames that begin between two times, in one packet.
SceneSound between(const Voice& voice, std::int64_t begin, std::int64_t end) {
  SoundEncoder::Frames frames;
  std::int64_t first = -1, number = 0;
  for (const auto& frame : voice.frames) {
    const std::int64_t time = number++ * voice.setup.duration - voice.setup.skip;
    if (time >= end || (begin > 0 && time < begin)) continue;
    if (first < 0) first = number - 1;
    frames.push_back(frame);
  }
  return {{PacketType::kSoundSetup, must(encode_sound_setup(voice.setup))},
          sound_packet(voice, first, std::move(frames))};
}

Bytes with_sound(const Bytes& stream, const std::vector<SceneSound>& sound) {
  std::vector<Piece> out;
  std::size_t scene = 0;
  for (const Piece& piece : pieces_of(stream)) {
    out.push_back(piece);
    if (piece.type != PacketType::kSetup) continue;
    out.insert(out.end(), sound[scene].begin(), sound[scene].end());
    ++scene;
  }
  return joined(out);
}

/// Two frames that are said to be missing, three that are not there.
SceneSound gaps(const Voice& voice) {
  SceneSound out = {{PacketType::kSoundSetup, must(encode_sound_setup(voice.setup))}};
  const auto part = [&](std::size_t begin, std::size_t end) {
    const auto frame = [&](std::size_t k) { return voice.frames.begin() + static_cast<std::ptrdiff_t>(k); };
    return SoundEncoder::Frames(frame(begin), frame(end));
  };
  SoundEncoder::Frames frames = part(0, 10);
  frames[4].clear();
  frames[5].clear();
  out.push_back(sound_packet(voice, 0, std::move(frames)));
  out.push_back(sound_packet(voice, 13, part(13, 20)));
  return out;
}

class SoundFolder {
 public:
  SoundFolder(Folder& pictures, const std::string& path) : pictures_(pictures), table_(path + "/sound.txt") {
    table_ << "# Written by make_vectors. File, frames of sound, samples heard, MD5 over the bytes of the "
              "frames.\n";
  }

  void add(const std::string& file, const Bytes& bytes, std::uint64_t pictures) {
    pictures_.add(file, bytes, pictures);
    const SoundDigest d = sound_digest_of(bytes);
    table_ << file << ' ' << d.frames << ' ' << d.samples << ' ' << d.md5 << '\n';
    if (!table_) give_up("cannot write the table of sound");
  }

 private:
  Folder& pictures_;
  std::ofstream table_;
};

}  // namespace

void add_sound(Folder& folder, const std::string& path, const Bytes& talk, const Bytes& late) {
  SoundFolder sound(folder, path);
  constexpr std::int64_t kCut = kFirstPictures * kPicture, kLate = 16 * kPicture, kTalk = 20 * kPicture;
  const Voice opus = voice_in({SoundCodec::kOpus, 1, 8000, 20}, 1);
  sound.add("sound_opus.fbs", with_sound(late, {between(opus, 0, kCut), between(opus, kCut, kLate)}), 16);
  const Voice codec2 = voice_in({SoundCodec::kCodec2, 1, 1200, 20}, 1);
  sound.add("sound_codec2.fbs", with_sound(talk, {between(codec2, 0, kTalk)}), 20);
  sound.add("sound_gaps.fbs", with_sound(talk, {gaps(opus)}), 20);

  const Voice faster = voice_in({SoundCodec::kCodec2, 1, 3200, 20}, 1);
  SceneSound unknown = between(opus, 0, kCut);
  unknown.front().payload = {3, 'l', 'a', 't', 'e', 'r'};
  sound.add("sound_unknown.fbs", with_sound(late, {unknown, between(faster, kCut, kLate)}), 16);
}

}  // namespace fbs
