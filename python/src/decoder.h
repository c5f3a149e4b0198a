// fbs_decoder for Python.
#pragma once

#include <fbs/fbs.h>
#include <nanobind/nanobind.h>

namespace fbs_python {

/// Class `Decoder`, and function `find_scene`.
void bind_decoder(nanobind::module_& module);

}  // namespace fbs_python
