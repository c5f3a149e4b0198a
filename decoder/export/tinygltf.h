// tinygltf for models in memory: include this and not its own header, since the options must be the same
// everywhere.
#pragma once

#define TINYGLTF_NO_STB_IMAGE  // images come and go as PNG files in memory
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
