// tinygltf, compiled here and hidden from the dynamic linker: Debian's libdraco holds another version under
// the same names, which would replace this one in a shared library.
#define TINYGLTF_IMPLEMENTATION
#include "decoder/export/tinygltf.h"
