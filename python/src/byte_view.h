// The bytes of any Python object that has some: bytes, bytearray, memoryview, mmap, an array.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>
#include <span>

namespace fbs_python {

/// Created and destroyed with the interpreter's lock; read without it.
class ByteView {
 public:
  explicit ByteView(nanobind::handle object) {
    if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_SIMPLE) != 0) throw nanobind::python_error();
  }
  ByteView(const ByteView&) = delete;
  ByteView& operator=(const ByteView&) = delete;
  ~ByteView() { PyBuffer_Release(&buffer_); }

  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {static_cast<const std::uint8_t*>(buffer_.buf), static_cast<std::size_t>(buffer_.len)};
  }

 private:
  Py_buffer buffer_{};
};

}  // namespace fbs_python
