#include "encoder/segment/picture_spool.h"

#include <array>
#include <cassert>

namespace fbs {
namespace {

/// Memory that pictures may take, bytes: a live group at 640x480.
constexpr std::size_t kInMemory = std::size_t{1} << 22;

std::size_t bytes_of(const Picture& p) {
  return p.y.samples.size() + p.u.samples.size() + p.v.samples.size();
}

}  // namespace

Result<void> PictureSpool::add(const Picture& picture) {
  if (count_ == 0) {
    width_ = picture.width();
    height_ = picture.height();
  }
  assert(picture.width() == width_ && picture.height() == height_);
  if (!file_ && (count_ + 1) * bytes_of(picture) <= kInMemory)
    first_.push_back(picture);
  else if (auto written = write(picture); !written)
    return written;
  ++count_;
  return {};
}

Result<void> PictureSpool::write(const Picture& picture) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_) return fail(ErrorCode::kIo, "cannot create a temporary file");
  bool written =
      fseeko(file_.get(), static_cast<off_t>((count_ - first_.size()) * bytes_of(picture)), SEEK_SET) == 0;
  for (const Plane* p : {&picture.y, &picture.u, &picture.v})
    written =
        written && std::fwrite(p->samples.data(), 1, p->samples.size(), file_.get()) == p->samples.size();
  if (!written) return fail(ErrorCode::kIo, "no room for pictures in the temporary directory");
  return {};
}

Result<Picture> PictureSpool::read(std::size_t number) {
  assert(number < count_);
  if (number < first_.size()) return first_[number];
  Picture picture(width_, height_);
  bool read =
      fseeko(file_.get(), static_cast<off_t>((number - first_.size()) * bytes_of(picture)), SEEK_SET) == 0;
  for (Plane* p : {&picture.y, &picture.u, &picture.v})
    read = read && std::fread(p->samples.data(), 1, p->samples.size(), file_.get()) == p->samples.size();
  if (!read) return fail(ErrorCode::kIo, "a temporary file cannot be read");
  return picture;
}

}  // namespace fbs
