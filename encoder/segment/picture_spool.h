// Keeps pictures to be read again: a video is read more than once, and memory is bounded.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Pictures of one size. The first few are in memory, the others in an unnamed temporary file that vanishes
/// with the object. Several threads may read at once.
class PictureSpool {
 public:
  /// Appends a picture; all have the size of the first.
  /// @return kIo when there is no room
  Result<void> add(const Picture& picture);

  /// @param number  0..count()-1
  [[nodiscard]] Result<Picture> read(std::size_t number) const;

  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  Result<void> write(const Picture& picture);

  std::vector<Picture> first_;  ///< the rest is in the file
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t count_ = 0;
  int width_ = 0, height_ = 0;
};

/// Pictures of one size, first in, first out; most of them on disk. One thread may push while another pops.
class PictureQueue {
 public:
  Result<void> push(const Picture& picture);
  /// Not to be called when none waits.
  Result<Picture> pop();

 private:
  std::mutex mutex_;
  PictureSpool old_, new_;
  std::size_t read_ = 0;  ///< pictures of old_
};

}  // namespace fbs
