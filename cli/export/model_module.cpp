#include "cli/export/model_module.h"

#include "cli/module.h"

FBS_MODULE_EXPORT void fbs_write_gltf(const fbs::HeadRecording& recording,
                                      const std::vector<fbs::HeadLook>& looks,
                                      const fbs::GltfOptions& options,
                                      fbs::Result<std::vector<std::uint8_t>>& model) {
  model = fbs::write_gltf(recording, looks, options);
}
