#include "tests/talker/talker_render.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/talker/talker_noise.h"
#include "tests/talker/talker_set.h"

namespace fbs::talker {
namespace {

constexpr std::array<glm::vec2, 4> kSamples{glm::vec2{-0.25f, -0.25f}, glm::vec2{0.25f, -0.25f},
                                            glm::vec2{-0.25f, 0.25f}, glm::vec2{0.25f, 0.25f}};

// Lights, screen directions, towards the light.
const glm::vec3 kKey = glm::normalize(glm::vec3(-0.50f, -0.55f, -0.80f));
const glm::vec3 kFill = glm::normalize(glm::vec3(0.85f, -0.10f, -0.60f));
const glm::vec3 kHalfway = glm::normalize(kKey + glm::vec3(0, 0, -1));

/// Linear light to display, gamma 2, with a soft shoulder.
glm::vec3 display(glm::vec3 c) {
  c = glm::max(c, glm::vec3(0));
  return glm::sqrt(c / (1.0f + 0.18f * c));
}

/// Light that leaves the material towards the viewer; n in screen directions.
glm::vec3 shade(const Material& m, glm::vec3 n) {
  const auto wrapped = [&](glm::vec3 light, float wrap) {
    return std::max(0.0f, (glm::dot(n, light) + wrap) / (1.0f + wrap));
  };
  const glm::vec3 key = glm::vec3(0.86f, 0.82f, 0.76f) * wrapped(kKey, 0.25f);
  const glm::vec3 fill = glm::vec3(0.22f, 0.24f, 0.28f) * wrapped(kFill, 0.3f);
  const glm::vec3 sky = glm::vec3(0.26f, 0.26f, 0.27f) * (0.65f - 0.35f * n.y);
  const float spark = m.gloss * std::pow(std::max(0.0f, glm::dot(n, kHalfway)), m.shininess);
  return m.occlusion * (m.albedo * (key + fill + sky) + 0.8f * spark);
}

/// One frame being drawn.
class FrameRenderer {
 public:
  FrameRenderer(const Settings& settings, const Look& look, const Moment& moment)
      : look_(look),
        moment_(moment),
        to_screen_(rotation(moment.pose)),
        to_head_(glm::transpose(to_screen_)) {
    const auto height = static_cast<float>(settings.height);
    const Pose& pose = moment.pose;
    arrival_ = {to_head_ * glm::vec3(0, 0, 1), to_head_ * kHalfway, pose.scale_px};
    pixel_ = 1.0f / pose.scale_px;
    unit_px_ = settings.eye_distance * height;
    const glm::vec2 rest{0.5f * static_cast<float>(settings.width - 1), 0.44f * height};
    body_origin_ = rest + 0.4f * (pose.shift_px - rest);
    const auto in_body = [&](glm::vec3 p) { return (project(pose, p) - body_origin_) / unit_px_; };
    body_ = {in_body({0, 1.1f, 0.25f}), in_body(moved({0, 1.82f, -0.6f}, moment.expression)), unit_px_};
  }

  /// Display colour of the pixel at `centre`, given the background. The first sample speeds up the others:
  /// they start near its depth, share its normal on the same piece of surface, or need no ray when it passed
  /// far from the head.
  [[nodiscard]] glm::vec3 colour(glm::vec2 centre, glm::vec3 behind) const {
    glm::vec3 sum{0};
    std::optional<SurfacePoint> first;
    std::optional<float> near;
    glm::vec3 n{0};
    bool far = false;
    for (const glm::vec2 sample : kSamples) {
      const glm::vec2 screen = centre + sample;
      const Trace found = far ? Trace{} : to_head(screen, near);
      if (!found.point) {
        far = far || (!first && found.clearance > pixel_);
        sum += around(screen, behind);
        continue;
      }
      if (!first || glm::distance(first->position, found.point->position) > 2.0f * pixel_) {
        first = found.point;
        n = normal(first->position, moment_.expression);
      }
      near = found.depth;
      const Material m = paint(*found.point, moment_.expression, look_, arrival_);
      sum += display(shade(m, to_screen_ * (m.normal == glm::vec3(0) ? n : m.normal)));
    }
    return 0.25f * sum;
  }

 private:
  [[nodiscard]] Trace to_head(glm::vec2 screen, std::optional<float> near) const {
    const Pose& pose = moment_.pose;
    const glm::vec2 place = (screen - pose.shift_px) / pose.scale_px;
    constexpr float kOutside = 3.0f;
    return trace(to_head_ * glm::vec3(place, -kOutside), arrival_.direction, moment_.expression, near);
  }

  /// Body or background.
  [[nodiscard]] glm::vec3 around(glm::vec2 screen, glm::vec3 behind) const {
    const auto material = body((screen - body_origin_) / unit_px_, body_, look_);
    return material ? display(shade(*material, material->normal)) : behind;
  }

  const Look& look_;
  const Moment& moment_;
  glm::mat3 to_screen_, to_head_;
  Arrival arrival_{};
  BodyState body_{};
  glm::vec2 body_origin_{0};
  float unit_px_ = 1;
  float pixel_ = 0;  ///< size of a pixel on the head, eye distances
};

std::uint8_t to_byte(float v, float low, float high) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(v + 0.5f), low, high));
}

/// Display RGB, 0..1, to 4:2:0 of BT.601, limited range, with camera noise.
Picture to_picture(const std::vector<glm::vec3>& rgb, const Settings& s, int frame) {
  Picture picture(s.width, s.height);
  const auto id = static_cast<std::uint32_t>(frame);
  const auto noise = [&](int x, int y, std::uint32_t plane, float share) {
    if (s.noise <= 0) return 0.0f;
    return share * s.noise *
           normal_noise(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), id * 3 + plane, s.seed);
  };
  const auto at = [&](int x, int y) {
    return rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const float luma = 16.0f + 219.0f * glm::dot(at(x, y), glm::vec3(0.299f, 0.587f, 0.114f));
      picture.y.row(y)[x] = to_byte(luma + noise(x, y, 0, 1), 16, 235);
    }
  }
  for (int y = 0; y < picture.u.height; ++y) {
    for (int x = 0; x < picture.u.width; ++x) {
      const int x0 = 2 * x, y0 = 2 * y, x1 = std::min(x0 + 1, s.width - 1),
                y1 = std::min(y0 + 1, s.height - 1);
      const glm::vec3 c = 0.25f * (at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1));
      const float u = 128.0f + 224.0f * glm::dot(c, glm::vec3(-0.168736f, -0.331264f, 0.5f));
      const float v = 128.0f + 224.0f * glm::dot(c, glm::vec3(0.5f, -0.418688f, -0.081312f));
      picture.u.row(y)[x] = to_byte(u + noise(x, y, 1, 0.5f), 16, 240);
      picture.v.row(y)[x] = to_byte(v + noise(x, y, 2, 0.5f), 16, 240);
    }
  }
  return picture;
}

}  // namespace

Talker::Talker(const Settings& settings)
    : settings_(settings), look_(look_of(settings.seed)), choreography_(settings) {
  const auto height = static_cast<float>(settings.height);
  const float middle = 0.5f * static_cast<float>(settings.width - 1);
  background_.reserve(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      glm::vec3 sum{0};
      for (const glm::vec2 sample : kSamples) {
        const glm::vec2 place = (glm::vec2(x, y) + sample - glm::vec2(middle, 0)) / height;
        sum += display(background(place, look_, height));
      }
      background_.push_back(0.25f * sum);
    }
  }
}

std::array<glm::vec2, kLandmarkTotal> Talker::points(int frame) const {
  const Moment moment = truth(frame);
  const auto on_head = landmarks(moment.expression);
  std::array<glm::vec2, kLandmarkTotal> points;
  std::ranges::transform(on_head, points.begin(), [&](glm::vec3 p) { return project(moment.pose, p); });
  return points;
}

std::array<bool, kLandmarkTotal> Talker::visible(int frame) const {
  const Moment moment = truth(frame);
  const auto on_head = landmarks(moment.expression);
  const glm::vec3 direction = glm::transpose(rotation(moment.pose)) * glm::vec3(0, 0, 1);
  std::array<bool, kLandmarkTotal> visible{};
  std::ranges::transform(on_head, visible.begin(), [&](glm::vec3 p) {
    constexpr float kAway = 3.0f, kTolerance = 0.12f;
    const auto first = trace(p - kAway * direction, direction, moment.expression).point;
    return !first || glm::dot(p - first->position, direction) < kTolerance;
  });
  return visible;
}

Picture Talker::picture(int frame) const {
  const Moment moment = truth(frame);
  const FrameRenderer renderer(settings_, look_, moment);
  const float gain = std::sqrt(std::max(0.0f, moment.light));
  std::vector<glm::vec3> rgb(background_.size());
  std::size_t i = 0;
  for (int y = 0; y < settings_.height; ++y) {
    for (int x = 0; x < settings_.width; ++x, ++i) {
      rgb[i] = glm::min(gain * renderer.colour(glm::vec2(x, y), background_[i]), glm::vec3(1));
    }
  }
  return to_picture(rgb, settings_, frame);
}

}  // namespace fbs::talker
