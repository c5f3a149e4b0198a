#include "bitstream/payload/wire_frame_payload.h"

#include <array>

#include "bitstream/entropy/adaptive_integer.h"
#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

/// Codes tables in the order of SPEC 4.8. A reader replaces the first number out of range, and all after it,
/// by the smallest in range.
template <class Coder>
class FrameCoder {
 public:
  explicit FrameCoder(Coder& coder) : coder_(coder) {}

  void code(WireFrameTables& t) {
    sized(t.positions, kMinWireFrameVertices, kMaxWireFrameVertices, [&] { positions(t.positions); });
    vertices_ = t.positions.size();
    indices(t.landmark_vertex);
    for (std::vector<std::uint16_t>& feature : t.features)
      sized(feature, 1, kMaxFeatureVertices, [&] { indices(feature); });
    sized(t.triangles, 1, kMaxWireFrameTriangles, [&] { triangles(t.triangles); });
    sized(t.outline, 3, kMaxOutline, [&] { indices(t.outline); });
    if constexpr (Coder::kReads) t.skinning.resize(vertices_);
    for (std::vector<SkinningWeight>& weights : t.skinning)
      sized(weights, 0, kControlCount, [&] { skinning(weights); });
    if constexpr (Coder::kReads) t.atlas.resize(vertices_ + t.outline.size());
    atlas(t.atlas);
  }
  [[nodiscard]] bool in_range() const { return ok_; }
  /// Whether all bytes were there, up to the first number out of range if there is one.
  [[nodiscard]] bool complete() const { return ok_ ? coder_.ok() : complete_; }

 private:
  template <class Table, class Code>
  void sized(Table& table, std::size_t low, std::size_t high, Code&& code) {
    const auto over = static_cast<std::uint32_t>(table.size() - low);
    const std::uint32_t coded = code_exponential(coder_, size_, Coder::kReads ? 0 : over);
    require(coded <= high - low);
    if constexpr (Coder::kReads) table.resize(ok_ ? low + coded : low);
    code();
  }

  void require(bool holds) {
    if (!ok_ || holds) return;
    ok_ = false;
    if constexpr (Coder::kReads) complete_ = coder_.ok();
  }

  /// A number as its difference from `from`.
  template <class T>
  void number(WideIntegerContexts& contexts, std::int32_t from, T& value, std::int32_t low,
              std::int32_t high) {
    const std::int32_t read = from + code_wide_integer(coder_, contexts, std::int32_t{value} - from);
    require(read >= low && read <= high);
    value = static_cast<T>(ok_ ? read : low);
  }

  void index(WideIntegerContexts& contexts, std::int32_t from, std::uint16_t& value) {
    number(contexts, from, value, 0, static_cast<std::int32_t>(vertices_) - 1);
  }

  template <class Table>
  void indices(Table& table) {
    std::int32_t before = 0;
    for (std::uint16_t& v : table) {
      index(index_, before, v);
      before = v;
    }
  }

  void positions(std::vector<glm::ivec3>& table) {
    glm::ivec3 before(0);
    for (glm::ivec3& p : table) {
      for (int axis = 0; axis < 3; ++axis)
        number(position_[axis], before[axis], p[axis], -kMaxCoordinate, kMaxCoordinate);
      before = p;
    }
  }

  void triangles(std::vector<HeadTriangle>& table) {
    std::int32_t before = 0;
    for (HeadTriangle& t : table) {
      for (std::size_t i = 0; i < t.size(); ++i) index(corner_[i], i == 0 ? before : t[i - 1], t[i]);
      before = t.front();
    }
  }

  void skinning(std::vector<SkinningWeight>& weights) {
    std::int32_t before = -1;
    for (SkinningWeight& s : weights) {
      const auto over = static_cast<std::uint32_t>(s.control - before - 1);
      const std::uint32_t coded = code_exponential(coder_, control_, Coder::kReads ? 0 : over);
      require(coded < static_cast<std::uint32_t>(kControlCount - before - 1));
      s.control = static_cast<std::uint16_t>(ok_ ? before + 1 + static_cast<std::int32_t>(coded) : 0);
      before = s.control;
      number(weight_, 0, s.weight, -kMaxSkinningSum, kMaxSkinningSum);
    }
  }

  void atlas(std::vector<glm::ivec2>& table) {
    glm::ivec2 before(0);
    for (glm::ivec2& p : table) {
      for (int axis = 0; axis < 2; ++axis)
        number(atlas_[axis], before[axis], p[axis], 0, kMaxAtlasCoordinate);
      before = p;
    }
  }

  Coder& coder_;
  bool ok_ = true, complete_ = true;
  std::size_t vertices_ = 0;
  ExponentialContexts size_, control_;
  WideIntegerContexts index_, weight_;
  std::array<WideIntegerContexts, 3> position_, corner_;
  std::array<WideIntegerContexts, 2> atlas_;
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_wire_frame(const WireFrame& frame) {
  WireFrameTables tables = tables_of(frame);
  RangeEncoder encoder;
  FrameCoder(encoder).code(tables);
  std::vector<std::uint8_t> payload = encoder.finish();
  if (payload.size() > kMaxWireFramePayload) return fail(ErrorCode::kTooLarge, "the wire-frame is too large");
  return payload;
}

Result<std::shared_ptr<const WireFrame>> decode_wire_frame(std::span<const std::uint8_t> payload) {
  if (payload.size() > kMaxWireFramePayload)
    return fail(ErrorCode::kTooLarge, "wire-frame packet is too large");
  RangeDecoder decoder(payload);
  WireFrameTables tables;
  FrameCoder coder(decoder);
  coder.code(tables);
  if (!coder.complete()) return fail(ErrorCode::kTruncated, "wire-frame packet ends early", payload.size());
  if (!coder.in_range()) return fail(ErrorCode::kInvalidStream, "a number of the wire-frame is out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "wire-frame packet has excess bytes");
  auto frame = make_wire_frame(tables);
  if (!frame) return fail(ErrorCode::kInvalidStream, frame.error().text);
  return frame;
}

}  // namespace fbs
