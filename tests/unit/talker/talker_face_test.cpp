#include "tests/talker/talker_face.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace fbs::talker {
namespace {

TEST(TalkerFace, MovedIsTheInverseOfRestOf) {
  Expression e = neutral();
  e.mouth_open = 0.3f;
  e.mouth_wide = 0.06f;
  e.brow_right = 0.13f;
  for (const glm::vec3 q :
       {glm::vec3(0, 1.6f, -1.2f), glm::vec3(-0.5f, -0.4f, -1.2f), glm::vec3(0.4f, 1.0f, -1.1f)}) {
    EXPECT_LT(glm::length(rest_of(moved(q, e), e) - q), 1e-3f);
  }
}

}  // namespace
}  // namespace fbs::talker
