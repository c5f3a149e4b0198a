#include "web/module/web_sound.h"

#include <algorithm>

#include "bitstream/sound_time.h"
#include "decoder/sound/sound_decoder.h"

namespace fbs::web {

int WebSound::sample_rate() {
  if (cursor_) return sample_rate_;
  for (const SoundPart& part : parts_.all()) {
    const auto codec = SoundDecoder::create(part.setup);
    if (!codec) continue;  // SPEC 4.9: left out
    sample_rate_ = (*codec)->sample_rate();
    channels_ = (*codec)->channels();
    cursor_.emplace(parts_, sample_rate_, channels_);
    cursor_->seek(begin_);
    return sample_rate_;
  }
  return 0;
}

void WebSound::seek(std::int64_t time) {
  begin_ = time;
  if (cursor_) cursor_->seek(time);
}

std::vector<std::int16_t> WebSound::take(std::int64_t end) {
  if (sample_rate() == 0) return {};
  return cursor_->take(std::min(end, known()));
}

std::int64_t WebSound::known() const {
  const std::int64_t pictures = sound_time(static_cast<std::int64_t>(parts_.released()));
  return parts_.all().empty() ? pictures : std::max(pictures, end_of(parts_.all().back()));
}

}  // namespace fbs::web
