// An object of the library shared by Python threads.
#pragma once

#include <nanobind/nanobind.h>

#include <mutex>

#include "status_error.h"

namespace fbs_python {

/// Owns a T of the C interface, which belongs to one thread at a time: calls wait for each other, while other
/// Python threads continue.
template <class T, void (*close_object)(T**), const char* (*error_text)(const T*)>
class Guarded {
 public:
  explicit Guarded(T* object) : object_(object) {}
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
  ~Guarded() { close_object(&object_); }

  void close() {
    const nanobind::gil_scoped_release others;
    const std::lock_guard<std::mutex> lock(mutex_);
    close_object(&object_);
  }

  /// @param body  called with the object; must not touch any Python object
  template <class Body>
  auto call(Body&& body) {
    const nanobind::gil_scoped_release others;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (object_ == nullptr) throw StatusError(FBS_ERROR_ARGUMENT, "it has been closed");
    return body(object_);
  }

  /// @return `status`, unless it is an error, which is thrown with its text
  static fbs_status check(const T* object, fbs_status status, std::uint64_t offset = 0) {
    if (status < 0) throw StatusError(status, error_text(object), offset);
    return status;
  }

 private:
  std::mutex mutex_;
  T* object_;
};

}  // namespace fbs_python
