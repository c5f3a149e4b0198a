// Part of every module, so that the loader can refuse one of another version.
#include "cli/program/module.h"

FBS_MODULE_EXPORT const char* fbs_module_version() {
  return FBS_VERSION;
}
