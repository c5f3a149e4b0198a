#include "decoder/draw/surround_painter.h"

#include <algorithm>

namespace fbs {
namespace {

using Whole = BlockMotion::Whole;

/// A block or patch in a plane.
struct Square {
  glm::ivec2 first;  ///< its upper left sample
  int size;
};

/// @param block  its column and row
Square block_in(std::size_t plane, glm::ivec2 block) {
  const int size = plane == 0 ? kBlockSize : kChromaBlockSize;
  return {block * size, size};
}

/// @param k  0..3, row by row
Square patch_of(const Square& block, int k) {
  const int size = block.size / 2;
  return {block.first + glm::ivec2(k % 2 * size, k / 2 * size), size};
}

bool is_inside(const Square& s, const ConstPlaneView& plane) {
  return s.first.x + s.size <= plane.width && s.first.y + s.size <= plane.height;
}

/// What of a square lies in a plane.
glm::ivec2 size_inside(const Square& s, const ConstPlaneView& plane) {
  return {std::clamp(plane.width - s.first.x, 0, s.size), std::clamp(plane.height - s.first.y, 0, s.size)};
}

SampleBlock own_samples(const ConstPlaneView& plane, const Square& s) {
  return {plane.data + s.first.y * plane.stride + s.first.x, plane.stride};
}

void copy_own(const ConstPlaneView& plane, const Square& s, std::uint8_t* out) {
  const glm::ivec2 size = size_inside(s, plane);
  if (size.x > 0) copy_samples(own_samples(plane, s), size, out, WarpedBlock::kStride);
}

}  // namespace

void SurroundPainter::draw(const SurroundDrawing& surround) {
  const SampleArea& luma = surround.drawing.luma_area;
  shown_.resize(surround.drawing.sources.size());
  for (int row = luma.y0 / kBlockSize; row * kBlockSize < luma.y1; ++row)
    for (int column = luma.x0 / kBlockSize; column * kBlockSize < luma.x1; ++column)
      draw_block(surround, {column, row});
}

void SurroundPainter::draw_block(const SurroundDrawing& surround, glm::ivec2 block) {
  const std::size_t planes = surround.drawing.chroma_area.empty() ? 1 : 3;
  collect(surround, block);
  for (std::size_t p = 0; p < planes; ++p) blended_[p].clear();
  for (Shown& shown : std::span(shown_).first(count_)) {
    if (shown.motion.whole == Whole::kNo) {
      show_patches(shown, block, planes > 1);
      continue;
    }
    for (std::size_t p = 0; p < planes; ++p) {
      const Square square = block_in(p, block);
      const ConstPlaneView& own = shown.source->planes[p];
      std::uint8_t* const memory = shown.memory[p].samples.data();
      if (shown.motion.whole == Whole::kEven) {
        const glm::ivec2 by = shown.motion.patch[0].nodes[0];
        show(p, shown,
             displaced((*shown.source->padded)[p], square.first, p == 0 ? by : chroma_displacement(by),
                       square.size, memory));
      } else if (is_inside(square, own)) {
        show(p, shown, own_samples(own, square));
      } else {
        copy_own(own, square, memory);
        show(p, shown, {memory, WarpedBlock::kStride});
      }
    }
  }
  for (std::size_t p = 0; p < planes; ++p) blend(p, block, surround.drawing.target[p]);
}

void SurroundPainter::collect(const SurroundDrawing& surround, glm::ivec2 block) {
  const int columns = surround.grid.columns();
  const std::ptrdiff_t first = std::ptrdiff_t{2} * block.y * columns + 2 * block.x;
  count_ = 0;
  for (std::size_t s = 0; s < surround.drawing.sources.size(); ++s) {
    const BlockWeights weights = surround.weights.of_block(s, surround.grid, block);
    if (!weights.any) continue;
    Shown& shown = shown_[count_++];
    shown.source = &surround.drawing.sources[s];
    shown.weight = weights.at;
    const SourceField& field = surround.fields[s];
    shown.motion = field.moves ? BlockMotion::of(field.displacement.data() + first, columns) : BlockMotion{};
  }
}

void SurroundPainter::show(std::size_t plane, const Shown& shown, const SampleBlock& block) {
  blended_[plane].push_back({block, shown.weight});
}

void SurroundPainter::show_patches(Shown& shown, glm::ivec2 block, bool has_chroma) {
  const PaddedPicture& texture = *shown.source->padded;
  const auto place = [&](std::size_t plane, int k) {
    const int size = block_in(plane, block).size / 2;
    return shown.memory[plane].samples.data() + k / 2 * size * WarpedBlock::kStride + k % 2 * size;
  };
  for (int k = 0; k < 4; ++k) {  // from left to right: WarpedBlock
    const PatchMotion& motion = shown.motion.patch[k];
    const Square luma = patch_of(block_in(0, block), k), chroma = patch_of(block_in(1, block), k);
    if (motion.kind == PatchMotion::Kind::kStill) {
      copy_own(shown.source->planes[0], luma, place(0, k));
      for (std::size_t p = 1; p < 3 && has_chroma; ++p)
        copy_own(shown.source->planes[p], chroma, place(p, k));
      continue;
    }
    warp_luma(texture[0], motion, luma.first, place(0, k));
    if (has_chroma) warp_chroma(texture[1], texture[2], motion, chroma.first, {place(1, k), place(2, k)});
  }
  for (std::size_t p = 0; p < (has_chroma ? 3 : 1); ++p)
    show(p, shown, {shown.memory[p].samples.data(), WarpedBlock::kStride});
}

void SurroundPainter::blend(std::size_t plane, glm::ivec2 block, const PlaneView& target) {
  const Square square = block_in(plane, block);
  std::uint8_t* const out = target.data + square.first.y * target.stride + square.first.x;
  draw_blend(plane, blended_[plane], size_inside(square, target), out, target.stride);
}

}  // namespace fbs
