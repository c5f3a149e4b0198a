#include "status_error.h"

#include <nanobind/nanobind.h>

#include <utility>

namespace nb = nanobind;

namespace fbs_python {
namespace {

const char* class_of(fbs_status status) {
  switch (status) {
    case FBS_ERROR_ARGUMENT:
      return "ArgumentError";
    case FBS_ERROR_NOT_FBS:
      return "NotFbsError";
    case FBS_ERROR_DAMAGED:
      return "DamagedError";
    case FBS_ERROR_TRUNCATED:
      return "TruncatedError";
    case FBS_ERROR_UNSUPPORTED:
      return "UnsupportedError";
    case FBS_ERROR_TOO_LARGE:
      return "TooLargeError";
    case FBS_ERROR_NO_MEMORY:
      return "NoMemoryError";
    case FBS_ERROR_NO_FACE:
      return "NoFaceError";
    case FBS_ERROR_IO:
      return "FileError";
    default:
      return "InternalError";
  }
}

}  // namespace

StatusError::StatusError(fbs_status status, std::string text, std::uint64_t offset)
    : status_(status), text_(text.empty() ? fbs_status_text(status) : std::move(text)), offset_(offset) {}

void translate_status_errors() {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const StatusError& error) {
      const nb::object type = nb::module_::import_("fbs.errors").attr(class_of(error.status()));
      PyErr_SetObject(type.ptr(), type(error.what(), error.offset()).ptr());
    }
  });
}

}  // namespace fbs_python
