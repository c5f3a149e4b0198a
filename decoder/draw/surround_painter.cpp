#include "decoder/draw/surround_painter.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "decoder/raster/triangle_kernels.h"

namespace fbs {
namespace {

/// A source in a block.
struct ShownSource {
  const DrawnSource& source;
  glm::ivec2 block;  ///< column and row
  bool has_chroma;
  BlockMemory& memory;

  [[nodiscard]] std::size_t planes() const { return has_chroma ? 3 : 1; }
};

SampleBlock own_samples(const ConstPlaneView& plane, glm::ivec2 first) {
  return {plane.data + first.y * plane.stride + first.x, plane.stride};
}

/// Copies the part of a square that lies in a plane.
void copy_own(const ConstPlaneView& plane, glm::ivec2 first, int size, std::uint8_t* out) {
  const glm::ivec2 inside = size_inside(first, size, plane);
  if (inside.x > 0) copy_samples(own_samples(plane, first), inside, out, WarpedBlock::kStride);
}

BlockSamples3 still_block(const ShownSource& shown) {
  BlockSamples3 out{};
  for (std::size_t p = 0; p < shown.planes(); ++p) {
    const ConstPlaneView& own = shown.source.planes[p];
    const int size = block_size(p);
    const glm::ivec2 first = shown.block * size;
    if (first.x + size <= own.width && first.y + size <= own.height) {
      out[p] = own_samples(own, first);
      if (begins_cache_line(shown.block.x, p)) prefetch_next_blocks(out[p], size);
    } else {
      std::uint8_t* const to = shown.memory[p].samples.data();
      copy_own(own, first, size, to);
      out[p] = {to, WarpedBlock::kStride};
    }
  }
  return out;
}

/// @param k  patch, 0..3, row by row
/// @param s  place of the source in the rows
PatchNodes patch_nodes(const BlockNodes& nodes, int k, std::size_t s) {
  const auto at = [&](int column, int line) {
    const std::int32_t* const d = nodes.displacement_at(k % 2 + column, k / 2 + line) + s;
    return glm::ivec2(d[0], d[nodes.row]);
  };
  return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
}

/// Draws patch by patch.
/// @param first  source of the motions' first place
BlockSamples3 patched_block(const ShownSource& shown, const BlockNodes& nodes, const BlockMotions& motions,
                            std::size_t first, std::size_t place) {
  BlockSamples3 out{};
  for (std::size_t p = 0; p < shown.planes(); ++p)
    out[p] = {shown.memory[p].samples.data(), WarpedBlock::kStride};
  for (int k = 0; k < 4; ++k) {  // from left to right: WarpedBlock
    const glm::ivec2 within(k % 2, k / 2), patch = 2 * shown.block + within;
    std::array<std::uint8_t*, 3> to{};
    for (std::size_t p = 0; p < shown.planes(); ++p) {
      const int size = block_size(p) / 2;
      to[p] = shown.memory[p].samples.data() + within.y * size * WarpedBlock::kStride + within.x * size;
    }
    switch (motions.kind[k][place]) {
      case kStill:
        for (std::size_t p = 0; p < shown.planes(); ++p)
          copy_own(shown.source.planes[p], patch * (block_size(p) / 2), block_size(p) / 2, to[p]);
        break;
      case kEven:
        draw_even_patch(*shown.source.padded, patch, {motions.by[k][0][place], motions.by[k][1][place]},
                        shown.has_chroma, to);
        break;
      default:
        draw_bent_patch(*shown.source.padded, patch, patch_nodes(nodes, k, first + place), shown.has_chroma,
                        to);
    }
  }
  return out;
}

/// The samples of a block that the head covers.
class CoveredSamples {
 public:
  CoveredSamples(const SurroundDrawing& surround, glm::ivec2 block) : surround_(surround) {
    for (std::size_t scale = 0; scale < parts_.size(); ++scale) {
      const DepthPlane* const depth = surround.head[scale];
      if (depth == nullptr) continue;
      const int size = block_size(scale);
      const glm::ivec2 first = block * size;
      const SampleArea& limit = scale == 0 ? surround.drawing.luma_area : surround.drawing.chroma_area;
      const SampleArea part = intersection({first.x, first.y, first.x + size, first.y + size}, limit);
      parts_[scale] = intersection(part, depth->area);
      if (!parts_[scale].empty()) covered_ += count_covered(*depth, parts_[scale]);
      samples_ += part.count();
    }
  }
  [[nodiscard]] bool none() const { return covered_ == 0; }
  [[nodiscard]] bool all() const { return covered_ == samples_; }

  /// Calls draw(), which may draw over them, and puts them back.
  template <class Draw>
  void keep(Draw&& draw) const {
    std::array<WarpedBlock, 3> kept;
    for (std::size_t p = 0; p < kept.size(); ++p) {
      const SampleArea& part = part_of(p);
      if (!part.empty())
        copy_samples(own_samples(surround_.drawing.target[p], {part.x0, part.y0}),
                     {part.x1 - part.x0, part.y1 - part.y0}, kept[p].samples.data(), WarpedBlock::kStride);
    }
    draw();
    for (std::size_t p = 0; p < kept.size(); ++p) put_back(p, kept[p].samples.data());
  }

 private:
  static std::size_t scale_of(std::size_t plane) { return std::min<std::size_t>(plane, 1); }
  [[nodiscard]] const SampleArea& part_of(std::size_t plane) const { return parts_[scale_of(plane)]; }

  void put_back(std::size_t plane, const std::uint8_t* kept) const {
    const SampleArea& part = part_of(plane);
    for (int y = part.y0; y < part.y1; ++y, kept += WarpedBlock::kStride) {
      const std::int32_t* const depth = surround_.head[scale_of(plane)]->row(y);
      std::uint8_t* const out = surround_.drawing.target[plane].row(y);
      for (int x = part.x0; x < part.x1; ++x)
        if (is_covered(depth[x])) out[x] = kept[x - part.x0];
    }
  }

  const SurroundDrawing& surround_;
  std::array<SampleArea, 2> parts_{};  ///< in luma and chroma, those that the head may cover
  int covered_ = 0, samples_ = 0;
};

}  // namespace

void SurroundPainter::draw(const SurroundDrawing& surround) {
  const SampleArea& luma = surround.drawing.luma_area;
  memory_.resize(std::max(memory_.size(), surround.drawing.sources.size()));
  for (int row = luma.y0 / kBlockSize; row * kBlockSize < luma.y1; ++row)
    for (int column = luma.x0 / kBlockSize; column * kBlockSize < luma.x1; ++column)
      draw_block(surround, {column, row});
}

void SurroundPainter::draw_block(const SurroundDrawing& surround, glm::ivec2 block) {
  const CoveredSamples covered(surround, block);
  if (covered.none())
    draw_sources(surround, block);
  else if (!covered.all())
    covered.keep([&] { draw_sources(surround, block); });
}

void SurroundPainter::draw_sources(const SurroundDrawing& surround, glm::ivec2 block) {
  const Drawing& d = surround.drawing;
  const int columns = surround.grid.columns();
  const std::size_t node = surround.grid.first_of_block(block.x, block.y);
  const std::size_t row = surround.weights.row();
  const BlockNodes nodes{surround.weights.at(node),
                         surround.field.moves() ? surround.field.at(node) : nullptr, row, columns};
  blended_.clear();
  for_each_shown(nodes, [&](std::size_t first, std::size_t place, const BlockMotions& motions) {
    const DrawnSource& source = d.sources[first + place];
    const ShownSource shown{source, block, !d.chroma_area.empty(), memory_[blended_.size()]};
    BlendedSource& added = blended_.emplace_back();
    added.weight = nodes.weight + first + place;
    if (motions.whole[place] == kStill)
      added.planes = still_block(shown);
    else if (motions.whole[place] == kEven)
      added.planes =
          displaced_block(*source.padded, block, {motions.whole_by[0][place], motions.whole_by[1][place]},
                          shown.has_chroma, shown.memory);
    else
      added.planes = patched_block(shown, nodes, motions, first, place);
  });
  const auto step = static_cast<std::ptrdiff_t>(row);
  draw_blend(blended_, {step, columns * step}, block, d.target);
}

}  // namespace fbs
