#include "decoder/export/wire_frame_gltf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "decoder/export/tinygltf.h"
#include "tests/unit/split_head.h"

namespace fbs {
namespace {

using tinygltf::Value;

template <class T, class Convert>
Value list(const T& items, Convert convert) {
  Value::Array out;
  for (const auto& item : items) out.push_back(convert(item));
  return Value(std::move(out));
}

Value number(int value) {
  return Value(value);
}
Value pair(int a, int b) {
  return Value(Value::Array{number(a), number(b)});
}

Value extras_of(const WireFrameTables& tables) {
  Value::Array vertices;
  for (const std::vector<SkinningWeight>& weights : tables.skinning)
    vertices.emplace_back(Value::Object{{"landmark", number(-1)}, {"skinning", list(weights, [](auto& s) {
                                                                     return pair(s.control, s.weight);
                                                                   })}});
  for (std::size_t k = 0; k < kLandmarkCount; ++k)
    vertices[tables.landmark_vertex[k]].Get<Value::Object>()["landmark"] = number(static_cast<int>(k));
  Value::Array features;
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    features.emplace_back(Value::Object{{"name", Value(std::string(generic_head().features[f].name))},
                                        {"vertices", list(tables.features[f], number)}});
  return Value(Value::Object{{"vertices", Value(vertices)},
                             {"features", Value(features)},
                             {"outline", list(tables.outline, number)},
                             {"atlas", list(tables.atlas, [](auto& p) { return pair(p.x, p.y); })}});
}

/// What a test may spoil before it is written.
struct File {
  tinygltf::Model model;

  explicit File(const WireFrameTables& tables) {
    std::vector<std::array<float, 3>> points;
    for (const glm::ivec3& p : tables.positions)
      points.push_back(
          {static_cast<float>(p.x) / 4096, static_cast<float>(-p.y) / 4096, static_cast<float>(-p.z) / 4096});
    std::vector<std::uint16_t> corners;
    for (const HeadTriangle& t : tables.triangles) corners.insert(corners.end(), {t[0], t[2], t[1]});
    const std::size_t size = points.size() * sizeof points[0], all = size + corners.size() * 2;
    model.buffers.resize(1);
    model.buffers[0].data.resize(all);
    std::memcpy(model.buffers[0].data.data(), points.data(), size);
    std::memcpy(model.buffers[0].data.data() + size, corners.data(), all - size);
    add(0, size, points.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    add(size, all - size, corners.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = 0;
    primitive.indices = 1;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    model.meshes.resize(1);
    model.meshes[0].primitives.push_back(primitive);
    model.meshes[0].extras = extras_of(tables);
    model.asset.version = "2.0";
  }

  Value::Object& extras() { return model.meshes[0].extras.Get<Value::Object>(); }

  /// Writes and reads it.
  Result<std::shared_ptr<const WireFrame>> read(const char* ending = ".gltf") {
    const std::string name =
        (std::filesystem::temp_directory_path() / ("wire_frame_test_" + std::to_string(::getpid())))
            .string() +
        ending;
    EXPECT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&model, name, true, true, false,
                                                          std::string(ending) == ".glb"));
    auto frame = read_wire_frame_gltf(name);
    std::filesystem::remove(name);
    return frame;
  }

 private:
  void add(std::size_t offset, std::size_t size, std::size_t count, int component, int type) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = offset;
    view.byteLength = size;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size());
    accessor.count = count;
    accessor.componentType = component;
    accessor.type = type;
    model.bufferViews.push_back(view);
    model.accessors.push_back(accessor);
  }
};

TEST(WireFrameGltf, GivesTheTablesBack) {
  for (const char* ending : {".gltf", ".glb"}) {
    const auto frame = File(split_head_tables()).read(ending);
    ASSERT_TRUE(frame) << frame.error().text;
    EXPECT_EQ(tables_of(**frame), split_head_tables()) << ending;
  }
}

TEST(WireFrameGltf, NamesWhatIsMissing) {
  for (const char* part : {"vertices", "features", "outline", "atlas"}) {
    File file(split_head_tables());
    file.extras().erase(part);
    const auto frame = file.read();
    ASSERT_FALSE(frame) << part;
    EXPECT_NE(frame.error().text.find(part), std::string::npos) << frame.error().text;
  }
}

TEST(WireFrameGltf, RefusesWhatIsNoHead) {
  const auto refused = [](const char* says, auto spoil) {
    File file(split_head_tables());
    spoil(file);
    const auto frame = file.read();
    ASSERT_FALSE(frame) << says;
    EXPECT_NE(frame.error().text.find(says), std::string::npos) << frame.error().text;
  };
  refused("no mesh", [](File& f) { f.model.meshes.clear(); });
  refused("no vertices", [](File& f) { f.model.meshes[0].primitives[0].attributes = {{"NORMAL", 0}}; });
  refused("no indexed triangles", [](File& f) { f.model.meshes[0].primitives[0].mode = TINYGLTF_MODE_LINE; });
  refused("no indexed triangles", [](File& f) { f.model.accessors[1].count = 100000; });
  refused("no indexed triangles", [](File& f) { f.model.bufferViews[1].byteOffset = 1U << 30U; });
  refused("not floats", [](File& f) { f.model.accessors[0].bufferView = 7; });
  refused("another number", [](File& f) { f.extras()["vertices"].Get<Value::Array>().pop_back(); });
  refused("68 vertices with a landmark", [](File& f) {
    f.extras()["vertices"].Get<Value::Array>()[3].Get<Value::Object>()["landmark"] = number(-1);
  });
  refused("unknown name", [](File& f) {
    f.extras()["features"].Get<Value::Array>()[0].Get<Value::Object>()["name"] = Value(std::string("nose"));
  });
  refused("outline", [](File& f) { f.extras()["outline"].Get<Value::Array>()[0] = Value(0.5); });
  refused("outline", [](File& f) { f.extras()["outline"].Get<Value::Array>()[0] = number(60000); });
  refused("atlas", [](File& f) { f.extras()["atlas"].Get<Value::Array>()[0] = number(3); });
}

TEST(WireFrameGltf, RefusesOtherFiles) {
  EXPECT_EQ(read_wire_frame_gltf("/nowhere.gltf").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace fbs
