#include "encoder/find/landmarks.h"

namespace fbs {

double generic_eye_depth() {
  static const double depth = [] {
    double sum = 0;
    for (int k = ibug::kEyesFirst; k < ibug::kEyesEnd; ++k)
      sum += generic_head().vertices[vertex_of_landmark(k)].position.z;
    return sum / (ibug::kEyesEnd - ibug::kEyesFirst) / kUnitsPerEyeDistance;
  }();
  return depth;
}

glm::dvec3 generic_vertex(std::size_t vertex) {
  return glm::dvec3(generic_head().vertices[vertex].position) / static_cast<double>(kUnitsPerEyeDistance) -
         glm::dvec3(0, 0, generic_eye_depth());
}

}  // namespace fbs
