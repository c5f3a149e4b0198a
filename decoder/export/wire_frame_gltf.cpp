#include "decoder/export/wire_frame_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "common/generic_head.h"
#include "decoder/export/tinygltf.h"

namespace fbs {
namespace {

using tinygltf::Model;
using tinygltf::Value;

auto refused(const std::string& text) {
  return fail(ErrorCode::kInvalidArgument, text);
}

bool take_no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                   int, void*) {
  return true;
}

Result<Model> load(const std::string& name) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(take_no_image, nullptr);
  Model model;
  std::string error, warning;
  const bool done = name.ends_with(".glb") ? reader.LoadBinaryFromFile(&model, &error, &warning, name)
                                           : reader.LoadASCIIFromFile(&model, &error, &warning, name);
  if (done) return model;
  const std::string first = error.substr(0, error.find('\n'));
  return fail(ErrorCode::kIo, first.empty() ? "is not glTF" : "is not glTF: " + first);
}

template <class T>
const T* item(const std::vector<T>& items, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < items.size()
             ? &items[static_cast<std::size_t>(index)]
             : nullptr;
}

/// The elements of an accessor in order.
class Elements {
 public:
  static std::optional<Elements> of(const Model& model, int accessor, int type) {
    const tinygltf::Accessor* const a = item(model.accessors, accessor);
    if (a == nullptr || a->type != type || a->sparse.isSparse) return std::nullopt;
    const tinygltf::BufferView* const view = item(model.bufferViews, a->bufferView);
    const tinygltf::Buffer* const buffer = view != nullptr ? item(model.buffers, view->buffer) : nullptr;
    if (buffer == nullptr) return std::nullopt;
    const int stride = a->ByteStride(*view);
    const auto component = static_cast<std::uint32_t>(a->componentType),
               elements = static_cast<std::uint32_t>(type);
    const auto size = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(component)) *
                      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(elements));
    const std::size_t start = view->byteOffset + a->byteOffset;
    if (stride <= 0 || a->count == 0 || a->count > kMost || start > buffer->data.size() ||
        (a->count - 1) * static_cast<std::size_t>(stride) + size > buffer->data.size() - start)
      return std::nullopt;
    return Elements(buffer->data.data() + start, static_cast<std::size_t>(stride), a->count,
                    a->componentType);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] int component_type() const { return component_type_; }

  template <class T>
  [[nodiscard]] T at(std::size_t index) const {
    T out;
    std::memcpy(&out, bytes_ + index * stride_, sizeof out);
    return out;
  }

 private:
  static constexpr std::size_t kMost = 1U << 20U;

  Elements(const unsigned char* bytes, std::size_t stride, std::size_t count, int component_type)
      : bytes_(bytes), stride_(stride), count_(count), component_type_(component_type) {}

  const unsigned char* bytes_;
  std::size_t stride_, count_;
  int component_type_;
};

/// Converts to the head frame; make_wire_frame() refuses what becomes of a coordinate out of range.
glm::ivec3 head_units(const std::array<float, 3>& p) {
  const auto units = [](float value) {
    const float u = value * static_cast<float>(kUnitsPerEyeDistance);
    return std::abs(u) <= static_cast<float>(kMaxCoordinate) ? static_cast<int>(std::lround(u))
                                                             : kMaxCoordinate + 1;
  };
  return {units(p[0]), units(-p[1]), units(-p[2])};
}

Result<void> read_mesh(const Model& model, const tinygltf::Primitive& primitive, WireFrameTables& out) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return refused("has no vertices");
  const auto points = Elements::of(model, position->second, TINYGLTF_TYPE_VEC3);
  if (!points || points->component_type() != TINYGLTF_COMPONENT_TYPE_FLOAT)
    return refused("has vertices that are not floats");
  for (std::size_t v = 0; v < points->count(); ++v)
    out.positions.push_back(head_units(points->at<std::array<float, 3>>(v)));

  const auto corners = Elements::of(model, primitive.indices, TINYGLTF_TYPE_SCALAR);
  const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1;
  if (!corners || !triangles || corners->count() % 3 != 0) return refused("has no indexed triangles");
  const auto corner = [&](std::size_t i) -> std::uint16_t {
    switch (corners->component_type()) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return corners->at<std::uint8_t>(i);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return corners->at<std::uint16_t>(i);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return static_cast<std::uint16_t>(std::min(corners->at<std::uint32_t>(i), std::uint32_t{0xFFFF}));
      default:
        return 0xFFFF;
    }
  };
  // Fronts are clockwise in the picture; in glTF they are counter-clockwise.
  for (std::size_t i = 0; i < corners->count(); i += 3)
    out.triangles.push_back({corner(i), corner(i + 2), corner(i + 1)});
  return {};
}

/// Null without such a member.
const Value& member(const Value& object, const char* key) {
  static const Value nothing;
  return object.IsObject() ? object.Get(key) : nothing;
}

/// Reads whole numbers out of extras, and records whether all were present and in range.
class Extras {
 public:
  template <class T>
  T number(const Value& value) {
    const double read = value.IsNumber() ? value.GetNumberAsDouble() : -1e9;
    const bool fits = read == std::nearbyint(read) && read >= std::numeric_limits<T>::min() &&
                      read <= std::numeric_limits<T>::max();
    good_ = good_ && fits;
    return fits ? static_cast<T>(read) : T{};
  }

  template <class First, class Second, class Take>
  void pairs(const Value& list, Take&& take) {
    for (const Value& pair : array(list)) {
      const std::vector<Value>& both = array(pair);
      good_ = good_ && both.size() == 2;
      if (both.size() == 2) take(number<First>(both[0]), number<Second>(both[1]));
    }
  }

  template <class T>
  std::vector<T> numbers(const Value& list) {
    std::vector<T> out;
    for (const Value& value : array(list)) out.push_back(number<T>(value));
    return out;
  }

  const std::vector<Value>& array(const Value& value) {
    static const std::vector<Value> nothing;
    good_ = good_ && value.IsArray();
    return value.IsArray() ? value.Get<Value::Array>() : nothing;
  }

  /// Whether everything read since the last call was there.
  bool good() { return std::exchange(good_, true); }

 private:
  bool good_ = true;
};

Result<void> read_vertices(Extras& extras, const Value& mesh, WireFrameTables& out) {
  std::size_t index = 0, landmarks = 0;
  for (const Value& vertex : extras.array(member(mesh, "vertices"))) {
    if (const Value& landmark = member(vertex, "landmark"); landmark.IsNumber()) {
      const auto k = extras.number<std::int16_t>(landmark);
      if (k >= kLandmarkCount) return refused("has a landmark that is not one of 0 to 67");
      if (k >= 0) out.landmark_vertex[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(index);
      landmarks += k >= 0 ? 1 : 0;
    }
    std::vector<SkinningWeight>& weights = out.skinning.emplace_back();
    if (const Value& skinning = member(vertex, "skinning"); skinning.IsArray())
      extras.pairs<std::uint16_t, std::int16_t>(skinning, [&](std::uint16_t control, std::int16_t weight) {
        weights.push_back({control, weight});
      });
    std::ranges::sort(weights, {}, &SkinningWeight::control);
    ++index;
  }
  if (!extras.good()) return refused("needs extras.vertices: a landmark and skinning weights of each");
  if (index != out.positions.size()) return refused("has extras.vertices of another number than vertices");
  if (landmarks != kLandmarkCount) return refused("needs 68 vertices with a landmark in extras.vertices");
  return {};
}

Result<void> read_features(Extras& extras, const Value& mesh, WireFrameTables& out) {
  for (const Value& feature : extras.array(member(mesh, "features"))) {
    const Value& name = member(feature, "name");
    const auto& known = generic_head().features;
    const auto found = std::ranges::find_if(known, [&](const Feature& f) {
      return name.IsString() && f.name == std::string_view(name.Get<std::string>());
    });
    if (found == known.end()) return refused("has a feature with an unknown name");
    out.features[static_cast<std::size_t>(found - known.begin())] =
        extras.numbers<std::uint16_t>(member(feature, "vertices"));
  }
  if (!extras.good()) return refused("needs extras.features: name and vertices of each");
  return {};
}

Result<void> read_extras(const Value& mesh, WireFrameTables& out) {
  Extras extras;
  if (auto read = read_vertices(extras, mesh, out); !read) return read;
  if (auto read = read_features(extras, mesh, out); !read) return read;
  out.outline = extras.numbers<std::uint16_t>(member(mesh, "outline"));
  if (!extras.good()) return refused("needs extras.outline: vertices of the border");
  extras.pairs<std::int32_t, std::int32_t>(member(mesh, "atlas"),
                                           [&](int x, int y) { out.atlas.emplace_back(x, y); });
  if (!extras.good()) return refused("needs extras.atlas: a place for each vertex, and for the ring");
  return {};
}

}  // namespace

Result<std::shared_ptr<const WireFrame>> read_wire_frame_gltf(const std::string& name) {
  const auto model = load(name);
  if (!model) return fail(model.error());
  if (model->meshes.empty() || model->meshes[0].primitives.empty()) return refused("has no mesh");
  WireFrameTables tables;
  if (auto read = read_mesh(*model, model->meshes[0].primitives[0], tables); !read) return fail(read.error());
  if (auto read = read_extras(model->meshes[0].extras, tables); !read) return fail(read.error());
  return make_wire_frame(tables);
}

}  // namespace fbs
