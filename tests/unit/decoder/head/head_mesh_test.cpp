#include "decoder/head/head_mesh.h"

#include <gtest/gtest.h>

#include "decoder/animate/scene_geometry.h"
#include "decoder/raster/triangle_setup.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(HeadMesh, FacesTheViewerFromTheFront) {
  const HeadMesh& mesh = generic_head_mesh();
  EXPECT_EQ(mesh.vertex_count, kVertexCount + generic_head().outline.size());
  const SceneGeometry geometry(toy_setup(), toy_geometry(), even_surround(2, 2, 0), toy_state());
  const ScreenMesh screen = geometry.screen_mesh(toy_state());
  ASSERT_EQ(screen.head.size(), mesh.vertex_count);
  const std::size_t ring_begins = generic_head().triangles.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ScreenTriangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(mesh.triangles[t][i] < mesh.vertex_count);
      const glm::ivec3 p = screen.head[mesh.triangles[t][i]];
      corners[i] = {{p.x, p.y}, p.z};
    }
    EXPECT_TRUE(faces_viewer(corners)) << (t < ring_begins ? "head " : "ring ") << t;
  }
}

}  // namespace
}  // namespace fbs
