#include "bitstream/motion/motion_encoder.h"

#include <algorithm>
#include <utility>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

bool fits(const Knot& knot, std::size_t part, const CodedLimits& limits) {
  for (std::size_t k = 0; k < kMaxPartSize; ++k) {
    const bool in_part = k < kPartSizes[part];
    if (in_part ? !limits.hold(kPartFirst[part] + k, knot.value[k]) : knot.value[k] != 0) return false;
  }
  return true;
}

bool fits(const Track& track, std::size_t part, std::int32_t pictures, const CodedLimits& limits) {
  if (!has_part(limits.parts, part)) return track.empty();
  std::int32_t last = -1;
  for (const Knot& knot : track) {
    if (knot.picture <= last || !fits(knot, part, limits)) return false;
    last = knot.picture;
  }
  return last == pictures - 1;
}

Result<void> check_group(const MotionGroup& group, const CodedLimits& limits) {
  if (group.pictures < 1 || group.pictures > kMaxGroupPictures)
    return fail(ErrorCode::kInvalidArgument, "a motion group has 1 to 256 pictures");
  if (!group.durations.empty() && std::cmp_not_equal(group.durations.size(), group.pictures))
    return fail(ErrorCode::kInvalidArgument, "a motion group has a duration for each picture or none");
  const auto in_range = [](std::uint32_t d) { return d >= 1 && d <= kMaxDuration; };
  if (!std::all_of(group.durations.begin(), group.durations.end(), in_range))
    return fail(ErrorCode::kInvalidArgument, "a picture's duration is out of range");
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (!fits(group.tracks[part], part, group.pictures, limits))
      return fail(ErrorCode::kInvalidArgument, "a track has knots or numbers out of range");
  return {};
}

}  // namespace

Result<std::vector<std::uint8_t>> MotionEncoder::encode(const MotionGroup& group) {
  if (auto checked = check_group(group, reference_.limits); !checked) return fail(checked.error());
  if (groups_ == 0 && !group.key)
    return fail(ErrorCode::kInvalidArgument, "the first motion group must be a key group");
  if (group.anchor != anchor() || group.first != next() || group.missing != 0)
    return fail(ErrorCode::kInvalidArgument, "a motion group does not begin where the one before it ends");

  if (group.key) reference_.reset();
  RangeEncoder encoder;
  encoder.raw_bit(kNotKey, group.key);
  code_first(encoder, group.first, next());
  code_body(encoder, reference_, group, [](std::size_t) {});
  reference_.end(group);
  ++groups_;
  return encoder.finish();
}

}  // namespace fbs
