#include "encoder/segment/picture_spool.h"

#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <span>
#include <utility>

namespace fbs {
namespace {

/// Memory that pictures may take, bytes: a live group at 1280x720.
constexpr std::size_t kInMemory = std::size_t{1} << 23;

std::size_t bytes_of(const Picture& p) {
  return p.y.samples.size() + p.u.samples.size() + p.v.samples.size();
}

bool read_all(int file, std::span<std::uint8_t> out, off_t at) {
  while (!out.empty()) {
    const ssize_t count = pread(file, out.data(), out.size(), at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    out = out.subspan(static_cast<std::size_t>(count));
    at += count;
  }
  return true;
}

}  // namespace

Result<void> PictureSpool::add(SharedPicture picture) {
  if (count_ == 0) {
    width_ = picture->width();
    height_ = picture->height();
  }
  assert(picture->width() == width_ && picture->height() == height_);
  if (!file_ && (count_ + 1) * bytes_of(picture) <= kInMemory)
    first_.push_back(std::move(picture));
  else if (auto written = write(picture); !written)
    return written;
  ++count_;
  return {};
}

Result<void> PictureSpool::write(const Picture& picture) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_) return fail(ErrorCode::kIo, "cannot create a temporary file");
  bool written = true;
  for (const Plane* p : {&picture.y, &picture.u, &picture.v})
    written =
        written && std::fwrite(p->samples.data(), 1, p->samples.size(), file_.get()) == p->samples.size();
  if (!written || std::fflush(file_.get()) != 0)
    return fail(ErrorCode::kIo, "no room for pictures in the temporary directory");
  return {};
}

Result<SharedPicture> PictureSpool::read(std::size_t number) const {
  assert(number < count_);
  if (number < first_.size()) return first_[number];
  Picture picture(width_, height_);
  auto at = static_cast<off_t>((number - first_.size()) * bytes_of(picture));
  bool read = true;
  for (Plane* p : {&picture.y, &picture.u, &picture.v}) {
    read = read && read_all(fileno(file_.get()), p->samples, at);
    at += static_cast<off_t>(p->samples.size());
  }
  if (!read) return fail(ErrorCode::kIo, "a temporary file cannot be read");
  return picture;
}

Result<void> PictureQueue::push(SharedPicture picture) {
  const std::lock_guard lock(mutex_);
  return new_.add(std::move(picture));
}

Result<SharedPicture> PictureQueue::pop() {
  const std::lock_guard lock(mutex_);
  // A file read to its end makes room for later pictures.
  if (read_ == old_.count()) {
    old_ = std::exchange(new_, {});
    read_ = 0;
  }
  return old_.read(read_++);
}

}  // namespace fbs
