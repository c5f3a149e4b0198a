// A head in one state as a Wavefront OBJ file, and its material.
#pragma once

#include <string>
#include <string_view>

#include "decoder/export/head_look.h"
#include "decoder/export/head_recording.h"

namespace fbs {

/// Vertices of the head in metres, placed as write_gltf() does, with texture coordinates and normals; the
/// inside of the mouth has its own material.
/// @param scale_of_first  pixels per eye distance in the recording's first state: fixes the size of a pixel
/// @param format          of the recording
/// @param library         file name of the materials
/// @param material        start of their names
[[nodiscard]] std::string obj_of(const RecordedHead& head, const State& state, double scale_of_first,
                                 const VideoFormat& format, std::string_view library,
                                 std::string_view material);

/// The two materials of obj_of().
/// @param texture  file name of the picture
[[nodiscard]] std::string mtl_of(const HeadLook& look, std::string_view texture, std::string_view material);

/// For a picture without a head: no vertices, one comment.
[[nodiscard]] std::string obj_of_nobody();

}  // namespace fbs
