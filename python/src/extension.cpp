// The module fbs._fbs: include/fbs in Python. The rest of the package makes it pleasant.
#include <fbs/fbs.h>
#include <nanobind/nanobind.h>

#include "colour.h"
#include "decoder.h"
#include "encoder.h"
#include "states.h"
#include "status_error.h"

namespace nb = nanobind;

NB_MODULE(_fbs, module) {
  fbs_python::translate_status_errors();
  fbs_python::bind_colour(module);
  fbs_python::bind_decoder(module);
  fbs_python::bind_encoder(module);
  fbs_python::bind_states(module);
  nb::list names;
  for (std::size_t k = 0; k < FBS_BLENDSHAPES; ++k) names.append(nb::str(fbs_blendshape_name(k)));
  module.attr("BLENDSHAPES") = nb::tuple(names);
  module.def("version", fbs_version_string);
  module.def("format_version", fbs_format_version);
}
