#include "cli/play/sound/sound_device.h"

#include <SDL.h>

#include <algorithm>
#include <bit>
#include <string>

namespace fbs::cli {
namespace {

constexpr unsigned kBlocksPerSecond = 50;  // approximate; blocks have a power of two of samples

Error no_device() {
  std::string reason = SDL_GetError();
  std::ranges::replace(reason, '\n', ' ');
  return {ErrorCode::kIo, "cannot open an audio device: " + reason};
}

// NOLINTNEXTLINE(cert-dcl50-cpp): the type of the handler is that of ALSA
void say_nothing(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
                 const char* /*format*/, ...) {}

/// Without a sound card, ALSA prints a page of its own before SDL gives the reason.
void silence_alsa() {
  void* const library = SDL_LoadObject("libasound.so.2");
  if (library == nullptr) return;
  using Handler = void (*)(const char*, int, const char*, int, const char*, ...);
  using SetHandler = int (*)(Handler);
  if (auto* const set = reinterpret_cast<SetHandler>(SDL_LoadFunction(library, "snd_lib_error_set_handler")))
    set(say_nothing);
}

void fetch(void* queue, Uint8* bytes, int size) {
  // SDL aligns its buffers for every format.
  auto* const samples = reinterpret_cast<std::int16_t*>(bytes);
  static_cast<SoundQueue*>(queue)->fetch(std::span(samples, static_cast<std::size_t>(size) / sizeof *samples),
                                         SoundQueue::Clock::now());
}

}  // namespace

struct SoundDevice::Handle {
  SDL_AudioDeviceID device = 0;
};

void SoundDevice::Close::operator()(Handle* handle) const {
  if (handle->device != 0) SDL_CloseAudioDevice(handle->device);
  delete handle;
  SDL_QuitSubSystem(SDL_INIT_AUDIO);
}

Result<SoundDevice> SoundDevice::open(SoundQueue& queue) {
  SDL_SetHint(SDL_HINT_AUDIO_DEVICE_APP_NAME, "fbs");
  silence_alsa();
  if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0) return fail(no_device());
  std::unique_ptr<Handle, Close> handle(new Handle);
  SDL_AudioSpec wanted{};
  wanted.freq = queue.sample_rate();
  wanted.format = AUDIO_S16SYS;
  wanted.channels = static_cast<Uint8>(queue.channels());
  wanted.samples =
      static_cast<Uint16>(std::bit_ceil(static_cast<unsigned>(queue.sample_rate()) / kBlocksPerSecond));
  wanted.callback = fetch;
  wanted.userdata = &queue;
  handle->device = SDL_OpenAudioDevice(nullptr, 0, &wanted, nullptr, 0);
  if (handle->device == 0) return fail(no_device());
  return SoundDevice(std::move(handle));
}

void SoundDevice::run(bool runs) {
  SDL_PauseAudioDevice(handle_->device, runs ? 0 : 1);
}

}  // namespace fbs::cli
