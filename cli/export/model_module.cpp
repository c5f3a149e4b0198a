#include "cli/export/model_module.h"

#include "cli/program/module.h"

FBS_MODULE_EXPORT void fbs_write_gltf(const fbs::HeadRecording& recording,
                                      const std::vector<fbs::HeadLook>& looks,
                                      const fbs::GltfOptions& options,
                                      fbs::Result<std::vector<std::uint8_t>>& model) {
  model = fbs::write_gltf(recording, looks, options);
}

FBS_MODULE_EXPORT void fbs_read_wire_frame(const std::string& name,
                                           fbs::Result<std::shared_ptr<const fbs::WireFrame>>& frame) {
  frame = fbs::read_wire_frame_gltf(name);
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  return "";  // tinygltf, which is part of the module and has no version
}
