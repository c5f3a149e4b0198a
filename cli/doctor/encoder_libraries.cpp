// Versions of the module fbs_encoder's libraries.
#include <aom/aom_codec.h>

#include <opencv2/core/utility.hpp>
#include <string>

#include "cli/program/module.h"

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const std::string text =
      std::string("libaom ") + aom_codec_version_str() + "\nOpenCV " + cv::getVersionString();
  return text.c_str();
}
