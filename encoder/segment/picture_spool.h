// Keeps pictures to be read again: a video is read more than once, and memory is bounded.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// A picture that several stages of the encoder have at once. Never empty.
class SharedPicture {
 public:
  /// Takes or copies a picture.
  SharedPicture(Picture picture)  // NOLINT(google-explicit-constructor): whoever has a picture may share it
      : picture_(std::make_shared<const Picture>(std::move(picture))) {}

  operator const Picture&() const { return *picture_; }  // NOLINT(google-explicit-constructor)
  const Picture* operator->() const { return picture_.get(); }

 private:
  std::shared_ptr<const Picture> picture_;
};

/// Pictures of one size. The first few are in memory, the others in an unnamed temporary file that vanishes
/// with the object. Several threads may read at once.
class PictureSpool {
 public:
  /// Appends a picture; all have the size of the first.
  /// @return kIo when there is no room
  Result<void> add(SharedPicture picture);

  /// @param number  0..count()-1
  [[nodiscard]] Result<SharedPicture> read(std::size_t number) const;

  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  Result<void> write(const Picture& picture);

  std::vector<SharedPicture> first_;  ///< the rest is in the file
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t count_ = 0;
  int width_ = 0, height_ = 0;
};

/// Pictures of one size, first in, first out; most of them on disk. One thread may push while another pops.
class PictureQueue {
 public:
  Result<void> push(SharedPicture picture);
  /// Not to be called when none waits.
  Result<SharedPicture> pop();

 private:
  std::mutex mutex_;
  PictureSpool old_, new_;
  std::size_t read_ = 0;  ///< pictures of old_
};

}  // namespace fbs
