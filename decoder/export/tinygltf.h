// tinygltf for models in memory. Include this instead of its own header: the options must be the same
// everywhere.
#pragma once

#define TINYGLTF_NO_STB_IMAGE  // images are PNG files in memory
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
