// tinygltf, compiled here and hidden from the dynamic linker: Debian's libdraco holds another version under
// the same names, which would take the place of a shared library's.
#define TINYGLTF_IMPLEMENTATION
#include "decoder/export/tinygltf.h"
