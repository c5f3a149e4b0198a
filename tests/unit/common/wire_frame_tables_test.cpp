#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/generic_head.h"
#include "common/wire_frame.h"
#include "tests/unit/split_head.h"

namespace fbs {
namespace {

constexpr std::size_t index_of(FeatureId id) {
  return static_cast<std::size_t>(id);
}

TEST(WireFrameTables, IsMadeFromTheTablesOfAnother) {
  const WireFrameTables tables = tables_of(generic_head());
  const auto frame = make_wire_frame(tables);
  ASSERT_TRUE(frame);
  EXPECT_EQ(tables_of(**frame), tables);
  const WireFrame& made = **frame;
  const GenericHead& head = generic_head();
  ASSERT_EQ(made.vertices.size(), head.vertices.size());
  for (std::size_t v = 0; v < made.vertices.size(); ++v) {
    EXPECT_EQ(made.vertices[v].position, head.vertices[v].position);
    EXPECT_EQ(made.vertices[v].landmark, head.vertices[v].landmark);
    EXPECT_EQ(made.vertices[v].feature, head.vertices[v].feature);
    EXPECT_EQ(made.vertices[v].mirror, static_cast<int>(v)) << "each is its own";
  }
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    EXPECT_EQ(made.features[f].closed, head.features[f].closed);
    EXPECT_EQ(made.features[f].first_control, head.features[f].first_control);
    EXPECT_EQ(made.features[f].control_count, head.features[f].control_count);
  }
}

TEST(WireFrameTables, PlacesVerticesOnTheirCurvesInOrder) {
  const auto frame = split_head();
  for (const Feature& feature : frame->features) {
    float last = -1;
    for (const FeatureVertex& v : feature.vertices) {
      EXPECT_GT(v.s, last) << feature.name;
      last = v.s;
    }
    EXPECT_LT(last, feature.closed ? static_cast<float>(feature.control_count) : 1.0F) << feature.name;
  }
}

TEST(WireFrameTables, KeepsWhatItShows) {
  auto tables = std::make_unique<WireFrameTables>(split_head_tables());
  const WireFrameTables copy = *tables;
  const auto frame = make_wire_frame(*tables).value();
  tables.reset();
  EXPECT_EQ(tables_of(*frame), copy);
}

/// A change of the split head, and whether there still is a wire-frame.
struct Change {
  std::string what;
  std::function<void(WireFrameTables&)> make;
};

void expect_all(bool accepted, const std::vector<Change>& changes) {
  const WireFrameTables right = split_head_tables();
  ASSERT_TRUE(make_wire_frame(right));
  for (const Change& change : changes) {
    WireFrameTables tables = right;
    change.make(tables);
    const auto frame = make_wire_frame(tables);
    EXPECT_EQ(frame.has_value(), accepted) << change.what;
    if (!frame) {
      EXPECT_EQ(frame.error().code, ErrorCode::kInvalidArgument) << change.what;
    }
  }
}

/// The tables with another number of vertices, of which those that are new have nothing.
void resize(WireFrameTables& t, std::size_t vertices) {
  const std::vector<glm::ivec2> ring(t.atlas.end() - static_cast<std::ptrdiff_t>(t.outline.size()),
                                     t.atlas.end());
  t.positions.resize(vertices);
  t.skinning.resize(vertices);
  t.atlas.resize(vertices);
  t.atlas.insert(t.atlas.end(), ring.begin(), ring.end());
}

TEST(WireFrameTables, HaveAtLeastLandmarksAndPupils) {
  EXPECT_TRUE(make_wire_frame(smallest_tables()));
  EXPECT_FALSE(make_wire_frame(smallest_tables(kMinWireFrameVertices - 1)));
}

TEST(WireFrameTables, RefusesTooManyOrTooFew) {
  expect_all(false,
             {{"vertices", [](auto& t) { resize(t, kMaxWireFrameVertices + 1); }},
              {"triangles", [](auto& t) { t.triangles.resize(kMaxWireFrameTriangles + 1, t.triangles[0]); }},
              {"no triangles", [](auto& t) { t.triangles.clear(); }},
              {"no ring",
               [](auto& t) {
                 t.outline.resize(2);
                 t.atlas.resize(t.positions.size() + 2);
               }},
              {"no vertex of a feature", [](auto& t) { t.features[index_of(FeatureId::kBrowLeft)].clear(); }},
              {"two pupils on one side",
               [](auto& t) { t.features[index_of(FeatureId::kPupilLeft)].push_back(kVertexCount); }},
              {"skinning of a vertex that there is not", [](auto& t) { t.skinning.emplace_back(); }},
              {"a vertex without skinning", [](auto& t) { t.skinning.pop_back(); }},
              {"a place in the atlas", [](auto& t) { t.atlas.emplace_back(1, 1); }},
              {"a vertex without a place in the atlas", [](auto& t) { t.atlas.pop_back(); }}});
  expect_all(true, {{"most vertices", [](auto& t) { resize(t, kMaxWireFrameVertices); }},
                    {"most triangles",
                     [](auto& t) { t.triangles.resize(kMaxWireFrameTriangles, t.triangles[0]); }}});
}

/// Some vertex in the middle of a triangle, as often as there is one.
std::vector<std::uint16_t> middles(std::size_t count) {
  std::vector<std::uint16_t> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(static_cast<std::uint16_t>(kVertexCount + k));
  return out;
}

TEST(WireFrameTables, BoundsFeaturesAndOutline) {
  const auto brow = [](std::size_t count) {
    return [count](WireFrameTables& t) { t.features[index_of(FeatureId::kBrowLeft)] = middles(count); };
  };
  expect_all(true, {{"most vertices of a feature", brow(kMaxFeatureVertices)}});
  expect_all(false, {{"vertices of a feature", brow(kMaxFeatureVertices + 1)}});
  const auto outline = [](std::size_t count) {
    return [count](WireFrameTables& t) {
      resize(t, kMaxWireFrameVertices);
      t.outline = middles(count);
      t.atlas.resize(t.positions.size() + count);
    };
  };
  expect_all(true, {{"most of an outline", outline(kMaxOutline)}, {"least", outline(3)}});
  expect_all(false, {{"vertices of the outline", outline(kMaxOutline + 1)}});
}

TEST(WireFrameTables, RefusesVerticesThatAreWrong) {
  const auto past = [](const WireFrameTables& t) { return static_cast<std::uint16_t>(t.positions.size()); };
  expect_all(
      false,
      {{"a landmark twice", [](auto& t) { t.landmark_vertex[5] = t.landmark_vertex[6]; }},
       {"a landmark nowhere", [&](auto& t) { t.landmark_vertex[5] = past(t); }},
       {"a corner twice", [](auto& t) { t.triangles[3][0] = t.triangles[3][2]; }},
       {"a corner nowhere", [&](auto& t) { t.triangles[3][0] = past(t); }},
       {"an outline that meets itself", [](auto& t) { t.outline[0] = t.outline[9]; }},
       {"an outline of nothing", [&](auto& t) { t.outline[0] = past(t); }},
       {"a vertex twice in a feature", [](auto& t) { t.features[1].push_back(t.features[1].back()); }},
       {"a vertex in two features", [](auto& t) { t.features[0].push_back(t.features[1].back()); }},
       {"a feature nowhere", [&](auto& t) { t.features[0][2] = past(t); }},
       {"inner lips that begin elsewhere", [](auto& t) { std::swap(t.features[1][0], t.features[1][1]); }},
       {"inner lips without a left corner",
        [](auto& t) { std::erase(t.features[1], t.landmark_vertex[64]); }}});
}

TEST(WireFrameTables, RefusesNumbersOutOfRange) {
  expect_all(false, {{"x", [](auto& t) { t.positions[7].x = kMaxCoordinate + 1; }},
                     {"z", [](auto& t) { t.positions[7].z = -kMaxCoordinate - 1; }},
                     {"u", [](auto& t) { t.atlas[7].x = -1; }},
                     {"v", [](auto& t) { t.atlas.back().y = kMaxAtlasCoordinate + 1; }},
                     {"a weight of nothing",
                      [](auto& t) {
                        t.skinning[7] = {{3, 0}};
                      }},
                     {"a control point",
                      [](auto& t) {
                        t.skinning[7] = {{kControlCount, 1}};
                      }},
                     {"a control point twice",
                      [](auto& t) {
                        t.skinning[7] = {{3, 1}, {3, 1}};
                      }},
                     {"descending",
                      [](auto& t) {
                        t.skinning[7] = {{3, 1}, {2, 1}};
                      }},
                     {"weights", [](auto& t) {
                        t.skinning[7] = {{1, -4097}, {2, 4096}};
                      }}});
  expect_all(true, {{"z", [](auto& t) { t.positions[7].z = -kMaxCoordinate; }},
                    {"v", [](auto& t) { t.atlas.back().y = kMaxAtlasCoordinate; }},
                    {"weights", [](auto& t) {
                       t.skinning[7] = {{1, -4096}, {35, 4096}};
                     }}});
}

}  // namespace
}  // namespace fbs
