// The faces of a whole stream as arrays.
#pragma once

#include <nanobind/nanobind.h>

namespace fbs_python {

/// Function `read_states`.
void bind_states(nanobind::module_& module);

}  // namespace fbs_python
