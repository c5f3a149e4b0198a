#include "encoder/find/find_marks.h"

#include "encoder/find/brow_marks.h"
#include "encoder/find/evidence.h"
#include "encoder/find/landmarks.h"
#include "encoder/find/mouth_marks.h"
#include "encoder/find/outline_marks.h"

namespace fbs {

using namespace find_tuning;

namespace {

FaceFrame frame_of(const Picture& picture, const FoundFace& face) {
  const glm::dvec2 across = face.left_eye - face.right_eye;
  const glm::dvec2 down(-across.y, across.x);
  const glm::dvec2 bias = face.eyes_seen ? kEyeBiasX * across + kEyeBiasY * down : glm::dvec2(0);
  return {picture, face.right_eye + bias, face.left_eye + bias};
}

/// y of the nose's base, which goes with the upper lip; nostrils and the shadow under the tip are dark.
double find_nose_base(const FaceFrame& f, const FaceYaw& yaw, const MouthMarks& mouth) {
  const glm::dvec3 base = generic_landmark(ibug::kNoseBase);
  const double middle = yaw.seen(base).x;
  const double closed_line = mouth.lips.inner_top + kLineBelowUpperLip;
  return search(base.y - kNoseBaseReach, base.y + kNoseBaseReach, kNoseBasePerMouthLine * closed_line,
                kNoseBaseSigma, [&](double y) {
                  const double nostrils = y * kNostrilsPerMouthLine / kNoseBasePerMouthLine;
                  return mean_over(middle, kNostrilHalf,
                                   [&](double x) { return f.valley(x, nostrils, kNostrilReach); }) /
                         kValleyPerEvidence;
                });
}

}  // namespace

Marks find_marks(const Picture& picture, const FoundFace& face) {
  const FaceFrame f = frame_of(picture, face);
  const FaceYaw yaw = estimate_yaw(f);
  const auto usual = [&](int landmark) { return yaw.seen(generic_landmark(landmark)); };
  Marks marks;
  const auto set = [&](int landmark, glm::dvec2 p) { marks.set_landmark(landmark, f.to_picture(p)); };

  for (int k = ibug::kEyesFirst; k < ibug::kEyesEnd; ++k)
    set(k, {usual(k).x, kLidHeight[k - ibug::kEyesFirst]});

  const MouthMarks mouth = find_mouth(f, yaw);
  for (int k = ibug::kMouthFirst; k < ibug::kMouthEnd; ++k) set(k, mouth.place_of(k));

  for (const int first : {ibug::kBrowRight, ibug::kBrowLeft}) {
    const auto brow = find_brow(f, yaw, first);
    for (int i = 0; i < ibug::kBrowPoints; ++i) set(first + i, brow[i]);
  }

  const double base = find_nose_base(f, yaw, mouth), generic_base = generic_landmark(ibug::kNoseBase).y;
  set(ibug::kNoseBridge, usual(ibug::kNoseBridge));
  for (int k = ibug::kNoseBridge + 1; k < ibug::kNoseEnd; ++k)
    set(k, {usual(k).x, usual(k).y * base / generic_base});

  const JawMarks jaw = find_jaw(f, yaw, mouth);
  for (int k = ibug::kJawFirst; k < ibug::kJawEnd; ++k) set(k, jaw.place_of(k, yaw));
  return marks;
}

}  // namespace fbs
