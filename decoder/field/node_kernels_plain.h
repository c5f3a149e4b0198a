// The definition of node_kernels.h, one source after another.
#pragma once

#include "decoder/field/node_kernels.h"

namespace fbs::plain {

void weigh_nodes(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
                 std::size_t row, int step_log2, std::uint16_t* out);
/// Takes displacements of any size.
void displace_nodes(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits,
                    std::size_t row, std::int32_t* out);
void find_motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out);

}  // namespace fbs::plain
