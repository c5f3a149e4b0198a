// Compiled into every module: lets the loader refuse a module of another version of the program.
#include "cli/module.h"

FBS_MODULE_EXPORT const char* fbs_module_version() {
  return FBS_VERSION;
}
