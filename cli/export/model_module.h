// The interface of the module fbs_model, which writes glTF models: it needs tinygltf.
#pragma once

#include <vector>

#include "decoder/export/gltf_model.h"

namespace fbs::cli {

inline constexpr const char* kModelModule = "fbs_model";
inline constexpr const char* kWriteGltfSymbol = "fbs_write_gltf";

/// write_gltf(); sets `model`, since a function with C linkage cannot return it.
using WriteGltfFunction = void(const HeadRecording& recording, const std::vector<HeadLook>& looks,
                               const GltfOptions& options, Result<std::vector<std::uint8_t>>& model);

}  // namespace fbs::cli
