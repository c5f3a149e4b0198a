// The loudspeaker, through SDL.
#pragma once

#include <memory>

#include "cli/play/sound/sound_queue.h"
#include "common/result.h"

namespace fbs::cli {

/// At most one exists at a time.
class SoundDevice {
 public:
  /// @param queue  must outlive the object; sets rate and channels, which SDL converts if the device needs
  ///               others
  /// @return kIo, with a text that begins "cannot open an audio device"
  static Result<SoundDevice> open(SoundQueue& queue);

  /// Starts or stops fetching from the queue. Stopped when opened.
  void run(bool runs);

 private:
  struct Handle;
  struct Close {
    void operator()(Handle* handle) const;
  };
  explicit SoundDevice(std::unique_ptr<Handle, Close> handle) : handle_(std::move(handle)) {}

  std::unique_ptr<Handle, Close> handle_;
};

}  // namespace fbs::cli
