#include "decoder/field/surround_field.h"

#include <algorithm>
#include <cstdlib>

#include "decoder/field/node_kernels.h"
#include "decoder/field/node_kernels_plain.h"
#include "decoder/field/padded_plane.h"
#include "decoder/head/head_projection.h"

namespace fbs {

void SurroundField::set(const NodeCover& cover, std::span<const std::vector<glm::ivec2>* const> seen,
                        std::span<const glm::ivec2> now, glm::ivec2 size) {
  row_ = row_size(seen.size());
  moved_.assign(2 * row_ * now.size(), 0);
  std::int32_t any = 0;
  bool fits = true;
  for (std::size_t s = 0; s < seen.size(); ++s) {
    if (seen[s] == nullptr) continue;
    std::int32_t* out = moved_.data() + s;
    for (std::size_t k = 0; k < now.size(); ++k, out += 2 * row_) {
      const glm::ivec2 d = (*seen[s])[k] - now[k];
      out[0] = d.x;
      out[row_] = d.y;
      any |= d.x | d.y;
      fits &= std::max(std::abs(d.x), std::abs(d.y)) < kMaxShortDisplacement;
    }
  }
  if (any == 0) return set_still();
  constexpr int kOutside = kMaxOutside << kScreenOneLog2;
  const NodeLimits limits{glm::ivec2(-kOutside), size * (1 << kScreenOneLog2) + kOutside};
  displacement_.resize(2 * row_ * cover.places().size());
  (fits ? displace_nodes : plain::displace_nodes)(cover, moved_.data(), limits, row_, displacement_.data());
}

}  // namespace fbs
