#include "encoder/landmarks/landmark_table.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "bitstream/byte_io.h"
#include "encoder/landmarks/built_in_table.h"
#include "encoder/landmarks/face_patch.h"

namespace fbs {
namespace {

constexpr std::uint16_t kVersion = 2;
constexpr int kMaxStages = 16;

/// Reads or writes the parts of a table: defines the layout once.
class TableReader {
 public:
  explicit TableReader(std::span<const std::uint8_t> bytes) : reader_(bytes) {}
  void number(std::uint16_t& value) { value = reader_.u16(); }
  void real(float& value) {
    const std::uint32_t high = reader_.u16();
    value = std::bit_cast<float>(high << 16 | reader_.u16());
  }
  void reals(std::vector<float>& values, std::size_t count) {
    values.resize(count);
    for (float& v : values) real(v);
  }
  void small(std::vector<std::int8_t>& values, std::size_t count) {
    const auto bytes = reader_.bytes(count);
    values.assign(count, 0);
    for (std::size_t i = 0; i < bytes.size(); ++i) values[i] = static_cast<std::int8_t>(bytes[i]);
  }
  [[nodiscard]] bool complete() const { return reader_.ok() && reader_.remaining() == 0; }

 private:
  ByteReader reader_;
};

class TableWriter {
 public:
  void number(std::uint16_t& value) { writer_.u16(value); }
  void real(float& value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    writer_.u16(static_cast<std::uint16_t>(bits >> 16));
    writer_.u16(static_cast<std::uint16_t>(bits));
  }
  void reals(std::vector<float>& values, std::size_t /*count*/) {
    for (float& v : values) real(v);
  }
  void small(std::vector<std::int8_t>& values, std::size_t /*count*/) {
    for (const std::int8_t v : values) writer_.u8(static_cast<std::uint8_t>(v));
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  ByteWriter writer_{bytes_};
};

template <class Coder>
void code(Coder& coder, Look& look) {
  auto side = static_cast<std::uint16_t>(look.side);
  coder.number(side);
  look.side = side;
  coder.real(look.sigma);
  coder.real(look.radius);
}

template <class Coder>
void code(Coder& coder, DescriptorMap& map, int outputs) {
  map.outputs = outputs;
  const auto count = static_cast<std::size_t>(outputs);
  coder.reals(map.scale, count);
  coder.small(map.weights, kDescriptorSize * count);
}

template <class Coder>
void code(Coder& coder, LandmarkTable& table) {
  for (glm::vec2& p : table.mean) {
    coder.real(p.x);
    coder.real(p.y);
  }
  code(coder, table.places.score, 1);
  coder.real(table.places.offset);
  constexpr std::size_t kNumbers = 2 * kLandmarkCount;
  for (LandmarkStage& stage : table.stages) {
    code(coder, stage.look);
    code(coder, stage.regression, kShapeModes);
    coder.reals(stage.modes, kShapeModes * kNumbers);
    coder.reals(stage.offset, kNumbers);
  }
  for (BeliefView& view : table.belief.views) {
    code(coder, view.look);
    code(coder, view.score, 1);
  }
  coder.real(table.belief.spread);
  coder.real(table.belief.place);
  coder.real(table.belief.offset);
}

bool is_usable(const Look& look) {
  return look.side >= 16 && look.side <= kPatchSide && look.sigma > 0.1F && look.sigma < 16;
}

}  // namespace

std::vector<float> DescriptorMap::operator()(std::span<const float> descriptor) const {
  std::vector<float> out(static_cast<std::size_t>(outputs));
  const std::int8_t* row = weights.data();
  for (const float value : descriptor)
    for (float& o : out) o += value * static_cast<float>(*row++);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] *= scale[i];
  return out;
}

Result<LandmarkTable> read_landmark_table(std::span<const std::uint8_t> bytes) {
  TableReader reader(bytes);
  std::uint16_t version = 0, stages = 0;
  reader.number(version);
  if (version != kVersion) return fail(ErrorCode::kUnsupported, "table of landmarks of another version");
  reader.number(stages);
  if (stages > kMaxStages) return fail(ErrorCode::kInvalidStream, "table of landmarks has too many stages");
  LandmarkTable table;
  table.stages.resize(stages);
  code(reader, table);
  const auto is_seen_well = [](const auto& part) { return is_usable(part.look); };
  const bool usable = reader.complete() && std::ranges::all_of(table.stages, is_seen_well) &&
                      std::ranges::all_of(table.belief.views, is_seen_well);
  if (!usable) return fail(ErrorCode::kInvalidStream, "table of landmarks is damaged");
  return table;
}

std::vector<std::uint8_t> write_landmark_table(const LandmarkTable& table) {
  TableWriter writer;
  LandmarkTable copy = table;
  std::uint16_t version = kVersion;
  auto stages = static_cast<std::uint16_t>(table.stages.size());
  writer.number(version);
  writer.number(stages);
  code(writer, copy);
  return writer.take();
}

Result<LandmarkTable> load_landmarks() {
  // Read once, before any of our threads could change the environment.
  const char* path = std::getenv("FBS_LANDMARKS");  // NOLINT(concurrency-mt-unsafe)
  if (path == nullptr) return read_landmark_table(built_in_landmark_table());
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file),
                                        std::istreambuf_iterator<char>()};
  if (!file) return fail(ErrorCode::kIo, std::string("cannot read ") + path);
  return read_landmark_table(bytes);
}

}  // namespace fbs
