#include "bitstream/payload/draco_points.h"

#include <draco/compression/expert_encode.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/encoder_buffer.h>
#include <draco/point_cloud/point_cloud.h>

#include <algorithm>
#include <bit>
#include <exception>
#include <memory>

namespace fbs {
namespace {

/// The start of the Draco stream of a head, bitstream version 2.3. SPEC 4.2 lists the fields.
/// @param points  less than 65536
std::array<std::uint8_t, 22> draco_start(std::size_t points) {
  const auto low = static_cast<std::uint8_t>(points), high = static_cast<std::uint8_t>(points >> 8);
  // clang-format off
  return {
      'D', 'R', 'A', 'C', 'O', 2, 3, 0, 0, 0, 0,  // version, point cloud, sequential, no flags
      low, high, 0, 0,                            // points, 32 bits, low byte first
      1, 1, 4, 5, 3, 0, 0,                        // one decoder, one attribute: generic, int32, 3 components, id 0
  };
  // clang-format on
}

Result<std::vector<std::uint8_t>> encode_with(const HeadPoints& points,
                                              draco::PredictionSchemeMethod prediction) {
  draco::PointCloud cloud;
  const auto count = static_cast<std::uint32_t>(points.size());
  cloud.set_num_points(count);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::GENERIC, nullptr, 3, draco::DT_INT32, false, 3 * sizeof(std::int32_t),
              0);
  const int attribute = cloud.AddAttribute(layout, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<std::int32_t, 3> value = {points[i].x, points[i].y, points[i].z};
    cloud.attribute(attribute)->SetAttributeValue(draco::AttributeValueIndex(i), value.data());
  }

  draco::ExpertEncoder encoder(cloud);
  encoder.SetEncodingMethod(draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  encoder.SetSpeedOptions(0, 0);
  if (!encoder.SetAttributePredictionScheme(attribute, prediction).ok()) {
    return fail(ErrorCode::kInternal, "Draco rejects a prediction scheme");
  }
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok())
    return fail(ErrorCode::kInternal, "Draco cannot encode the geometry");
  return std::vector<std::uint8_t>(buffer.data(), buffer.data() + buffer.size());
}

Result<HeadPoints> read_points(const draco::PointCloud& cloud, std::size_t count) {
  if (cloud.num_points() != count || cloud.num_attributes() != 1) {
    return fail(ErrorCode::kInvalidStream, "geometry has another number of points than its wire-frame");
  }
  const draco::PointAttribute& attribute = *cloud.attribute(0);
  if (attribute.num_components() != 3 || attribute.data_type() != draco::DT_INT32) {
    return fail(ErrorCode::kInvalidStream, "geometry is not made of integer points");
  }
  HeadPoints points(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
    std::array<std::int32_t, 3> value{};
    if (index.value() >= attribute.size() || !attribute.ConvertValue<std::int32_t>(index, 3, value.data())) {
      return fail(ErrorCode::kInvalidStream, "geometry lacks points");
    }
    points[i] = {value[0], value[1], value[2]};
  }
  return points;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_points(const HeadPoints& points) try {
  auto shortest = encode_with(points, draco::PREDICTION_NONE);
  auto difference = encode_with(points, draco::PREDICTION_DIFFERENCE);
  if (!shortest) return shortest;
  if (!difference) return difference;
  if (difference->size() < shortest->size()) shortest.swap(difference);
  const auto start = draco_start(points.size());
  if (shortest->size() < start.size() || !std::equal(start.begin(), start.end(), shortest->begin())) {
    return fail(ErrorCode::kInternal, "Draco writes another bitstream version");
  }
  shortest->erase(shortest->begin(), shortest->begin() + start.size());
  return shortest;
} catch (const std::exception&) {
  return fail(ErrorCode::kInternal, "Draco threw an exception");
}

Result<HeadPoints> decode_points(std::span<const std::uint8_t> bytes, std::size_t count) try {
  // Draco copies numbers as they are in memory; with the high byte first it would ask for gigabytes.
  if constexpr (std::endian::native != std::endian::little)
    return fail(ErrorCode::kUnsupported, "Draco reads no head on a processor with the high byte first");
  const auto start = draco_start(count);
  std::vector<char> stream(start.begin(), start.end());
  stream.insert(stream.end(), bytes.begin(), bytes.end());
  draco::DecoderBuffer buffer;
  buffer.Init(stream.data(), stream.size());
  draco::PointCloud cloud;
  draco::PointCloudSequentialDecoder decoder;  // gets what the start says
  if (!decoder.Decode(draco::DecoderOptions(), &buffer, &cloud).ok())
    return fail(ErrorCode::kInvalidStream, "Draco cannot decode the geometry");
  return read_points(cloud, count);
} catch (const std::exception&) {
  return fail(ErrorCode::kInvalidStream, "Draco threw an exception");
}

}  // namespace fbs
