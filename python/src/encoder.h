// fbs_encoder for Python.
#pragma once

#include <nanobind/nanobind.h>

namespace fbs_python {

/// Class `Encoder`.
void bind_encoder(nanobind::module_& module);

}  // namespace fbs_python
