# Points without triangles, decoded one after another: what a stream has.
set(draco ${SOURCES}/draco/src)
set(draco_config ${CMAKE_CURRENT_BINARY_DIR}/draco_config)
file(WRITE ${draco_config}/draco/draco_features.h "#define DRACO_POINT_CLOUD_COMPRESSION_SUPPORTED\n")
# Points are predicted by the one before, whatever the stream says: Draco's own choice has the schemes of meshes, too.
set(draco_schemes draco/compression/attributes/prediction_schemes)
file(WRITE ${draco_config}/${draco_schemes}/prediction_scheme_decoder_factory.h [[
#pragma once
#include "draco/compression/attributes/prediction_schemes/prediction_scheme_delta_decoder.h"
#include "draco/compression/point_cloud/point_cloud_decoder.h"
#include "draco/core/bit_utils.h"
namespace draco {
template <typename DataTypeT, class TransformT>
std::unique_ptr<PredictionSchemeDecoder<DataTypeT, TransformT>> CreatePredictionSchemeForDecoder(
    PredictionSchemeMethod method, int attribute, const PointCloudDecoder* decoder, const TransformT& transform) {
  if (method == PREDICTION_NONE) return nullptr;
  return std::make_unique<PredictionSchemeDeltaDecoder<DataTypeT, TransformT>>(
      decoder->point_cloud()->attribute(attribute), transform);
}
template <typename DataTypeT, class TransformT>
std::unique_ptr<PredictionSchemeDecoder<DataTypeT, TransformT>> CreatePredictionSchemeForDecoder(
    PredictionSchemeMethod method, int attribute, const PointCloudDecoder* decoder) {
  return CreatePredictionSchemeForDecoder<DataTypeT, TransformT>(method, attribute, decoder, TransformT());
}
}  // namespace draco
]])

prefixed(draco_sources ${draco}/draco
  attributes/attribute_quantization_transform.cc attributes/attribute_octahedron_transform.cc
  attributes/attribute_transform.cc attributes/geometry_attribute.cc attributes/point_attribute.cc
  compression/attributes/attributes_decoder.cc
  compression/attributes/sequential_attribute_decoder.cc
  compression/attributes/sequential_attribute_decoders_controller.cc
  compression/attributes/sequential_integer_attribute_decoder.cc
  compression/attributes/sequential_normal_attribute_decoder.cc
  compression/attributes/sequential_quantization_attribute_decoder.cc
  compression/bit_coders/adaptive_rans_bit_decoder.cc compression/bit_coders/direct_bit_decoder.cc
  compression/bit_coders/rans_bit_decoder.cc compression/bit_coders/symbol_bit_decoder.cc
  compression/entropy/symbol_decoding.cc compression/point_cloud/point_cloud_decoder.cc
  compression/point_cloud/point_cloud_sequential_decoder.cc
  core/bit_utils.cc core/data_buffer.cc core/decoder_buffer.cc core/divide.cc core/draco_types.cc core/hash_utils.cc
  core/options.cc core/quantization_utils.cc core/status.cc
  metadata/geometry_metadata.cc metadata/metadata.cc
  point_cloud/point_cloud.cc)
# A head has no metadata.
file(WRITE ${draco_config}/no_metadata.cc [[
#include "draco/metadata/metadata_decoder.h"
namespace draco {
MetadataDecoder::MetadataDecoder() : buffer_(nullptr) {}
bool MetadataDecoder::DecodeGeometryMetadata(DecoderBuffer*, GeometryMetadata*) { return false; }
}  // namespace draco
]])
add_library(draco STATIC ${draco_sources} ${draco_config}/no_metadata.cc)
target_compile_options(draco PRIVATE -Os)
target_include_directories(draco PRIVATE ${draco_config} ${draco})
install(TARGETS draco EXPORT draco ARCHIVE DESTINATION lib INCLUDES DESTINATION include)
install(EXPORT draco NAMESPACE draco:: FILE draco-config.cmake DESTINATION lib/cmake/draco)
install(DIRECTORY ${draco}/draco ${draco_config}/draco DESTINATION include FILES_MATCHING PATTERN "*.h")
