// The sound of fbs/sound.h.
#include <algorithm>
#include <optional>
#include <vector>

#include "bitstream/sound_time.h"
#include "decoder/sound/sound_cursor.h"
#include "decoder/sound/sound_decoder.h"
#include "decoder/sound/sound_parts.h"
#include "fbs/sound.h"
#include "library/boundary.h"

namespace {

using namespace fbs;

static_assert(FBS_SOUND_TICKS_PER_SECOND == kSoundClock);

std::int64_t sound_ticks(std::uint64_t ticks) {
  return sound_time(static_cast<std::int64_t>(std::min(ticks, kMaxStreamTime)));
}

}  // namespace

struct fbs_sound {  // NOLINT(readability-identifier-naming): the interface is C
  fbs_sound() { parts.follow_pictures(); }

  /// Whether sound has come that can be decoded; `cursor` is there then.
  bool begin();
  /// Up to here sound that has not come will not come, 1/kSoundClock s.
  [[nodiscard]] std::int64_t known() const;

  SoundParts parts;
  std::optional<SoundCursor> cursor;
  std::int64_t from = 0;  ///< of the last seek, 1/kSoundClock s
  std::vector<std::int16_t> samples;
  LastError error;
};

bool fbs_sound::begin() {
  if (cursor) return true;
  for (const SoundPart& part : parts.all()) {
    const auto codec = SoundDecoder::create(part.setup);
    if (!codec) continue;  // SPEC 4.9: left out
    cursor.emplace(parts, (*codec)->sample_rate(), (*codec)->channels());
    cursor->seek(from);
    return true;
  }
  return false;
}

std::int64_t fbs_sound::known() const {
  const std::int64_t shown = sound_ticks(parts.released());
  return parts.all().empty() ? shown : std::max(shown, end_of(parts.all().back()));
}

fbs_status fbs_sound_open(fbs_sound** out) {
  return open_object(out);
}

void fbs_sound_close(fbs_sound** sound) {
  close_object(sound);
}

fbs_status fbs_sound_feed(fbs_sound* sound, const uint8_t* bytes, size_t size) {
  if (sound == nullptr) return FBS_ERROR_ARGUMENT;
  if (bytes == nullptr && size > 0) return sound->error.set_argument(kNullPointer);
  return guarded(sound->error, [&] {
    sound->parts.add({bytes, size});
    return FBS_OK;
  });
}

fbs_status fbs_sound_get_info(fbs_sound* sound, fbs_sound_info* out) {
  if (sound == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return sound->error.set_argument(kNullPointer);
  return guarded(sound->error, [&] {
    *out = {0, 0, sound->parts.bytes(), sound->parts.released()};
    if (sound->begin()) {
      out->sample_rate = static_cast<uint32_t>(sound->cursor->sample_rate());
      out->channels = static_cast<uint32_t>(sound->cursor->channels());
    }
    return FBS_OK;
  });
}

fbs_status fbs_sound_seek(fbs_sound* sound, uint64_t time) {
  if (sound == nullptr) return FBS_ERROR_ARGUMENT;
  return guarded(sound->error, [&] {
    sound->from = sound_ticks(time);
    if (sound->cursor) sound->cursor->seek(sound->from);
    return FBS_OK;
  });
}

fbs_status fbs_sound_take(fbs_sound* sound, uint64_t end, fbs_samples* out) {
  if (sound == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_sound& s = *sound;
  if (out == nullptr) return s.error.set_argument(kNullPointer);
  return guarded(s.error, [&] {
    if (!s.begin()) return FBS_NEED_DATA;
    const std::int64_t time = s.cursor->time();
    s.samples = s.cursor->take(std::min(sound_ticks(end), s.known()));
    const auto channels = static_cast<uint32_t>(s.cursor->channels());
    *out = {static_cast<uint64_t>(time), static_cast<uint32_t>(s.cursor->sample_rate()), channels,
            s.samples.size() / channels, s.samples.data()};
    return FBS_OK;
  });
}

const char* fbs_sound_error(const fbs_sound* sound) {
  return sound != nullptr ? sound->error.text() : "";
}
