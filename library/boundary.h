// The boundary of C++: results and exceptions become statuses and a line of text.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>

#include "common/result.h"
#include "fbs/fbs.h"

namespace fbs {

inline constexpr const char* kNullPointer = "a null pointer";
inline constexpr const char* kOtherSettings =
    "settings of another version: struct_size, or an unknown member";

[[nodiscard]] fbs_status status_of(ErrorCode code);

/// The text of fbs_decoder_error(). Allocates nothing, since it may have to report a lack of memory. Two
/// threads may set it at once.
class LastError {
 public:
  /// Each sets the text, cut to one short line, and returns the status.
  /// @param offset  in the stream, bytes; 0 if the error has none
  fbs_status set(fbs_status status, const char* text, std::uint64_t offset = 0);
  fbs_status set(const Error& error) { return set(status_of(error.code), error.text.c_str()); }
  fbs_status set_argument(const char* text) { return set(FBS_ERROR_ARGUMENT, text); }
  void clear() { set(FBS_OK, ""); }

  [[nodiscard]] const char* text() const { return text_.data(); }
  /// @param out  FBS_ERROR_SIZE bytes; null: nothing happens
  void copy_to(char* out) const {
    if (out != nullptr) std::copy(text_.begin(), text_.end(), out);
  }
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  std::mutex mutex_;
  std::array<char, FBS_ERROR_SIZE> text_{};
  std::uint64_t offset_ = 0;
};

/// Calls `body`, which returns a status, and turns exceptions into one.
template <class Body>
[[nodiscard]] fbs_status guarded(LastError& error, Body&& body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return error.set(FBS_ERROR_NO_MEMORY, "out of memory");
  } catch (const std::length_error&) {  // more than any memory holds
    return error.set(FBS_ERROR_NO_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    return error.set(FBS_ERROR_INTERNAL, e.what());
  } catch (...) {
    return error.set(FBS_ERROR_INTERNAL, "unknown exception");
  }
}

/// Sets *out to a new object, or to null on failure.
template <class Object, class... Arguments>
[[nodiscard]] fbs_status open_object(Object** out, const Arguments&... arguments) noexcept {
  if (out == nullptr) return FBS_ERROR_ARGUMENT;
  *out = nullptr;
  LastError ignored;
  return guarded(ignored, [&] {
    *out = std::make_unique<Object>(arguments...).release();
    return FBS_OK;
  });
}

/// Frees the object, if there is one, and sets *object to null.
template <class Object>
void close_object(Object** object) noexcept {
  if (object == nullptr) return;
  const std::unique_ptr<Object> closed(*object);
  *object = nullptr;
}

}  // namespace fbs
