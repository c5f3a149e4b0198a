// Statuses of the library as Python's exceptions.
#pragma once

#include <fbs/fbs.h>

#include <cstdint>
#include <exception>
#include <string>

namespace fbs_python {

/// A failed call. Holds no Python object, so that it may be thrown without the interpreter's lock; becomes
/// the class of fbs.errors for the status.
class StatusError : public std::exception {
 public:
  /// @param text    empty: the status's own
  /// @param offset  in the stream, bytes
  explicit StatusError(fbs_status status, std::string text = {}, std::uint64_t offset = 0);

  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] fbs_status status() const noexcept { return status_; }
  [[nodiscard]] std::uint64_t offset() const noexcept { return offset_; }

 private:
  fbs_status status_;
  std::string text_;
  std::uint64_t offset_;
};

/// Call once, when the extension is loaded.
void translate_status_errors();

}  // namespace fbs_python
