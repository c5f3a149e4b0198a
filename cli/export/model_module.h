// The interface of the module fbs_model, which writes and reads glTF models with tinygltf.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "decoder/export/gltf_model.h"
#include "decoder/export/wire_frame_gltf.h"

namespace fbs::cli {

inline constexpr const char* kModelModule = "fbs_model";
inline constexpr const char* kWriteGltfSymbol = "fbs_write_gltf";
inline constexpr const char* kReadWireFrameSymbol = "fbs_read_wire_frame";

/// write_gltf(); sets `model`, since a function with C linkage cannot return it.
using WriteGltfFunction = void(const HeadRecording& recording, const std::vector<HeadLook>& looks,
                               const GltfOptions& options, Result<std::vector<std::uint8_t>>& model);

/// read_wire_frame_gltf(); sets `frame`.
using ReadWireFrameFunction = void(const std::string& name, Result<std::shared_ptr<const WireFrame>>& frame);

}  // namespace fbs::cli
