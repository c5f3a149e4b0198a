#include "bitstream/scene/head_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace fbs {
namespace {

/// GF(256) with the polynomial x^8 + x^4 + x^3 + x^2 + 1, by logarithms to the base x.
struct Field {
  std::array<std::uint8_t, 510> power{};
  std::array<int, 256> logarithm{};

  constexpr Field() {
    unsigned value = 1;
    for (std::size_t i = 0; i < 255; ++i) {
      power[i] = power[i + 255] = static_cast<std::uint8_t>(value);
      logarithm[value] = static_cast<int>(i);
      value <<= 1;
      if (value > 255) value ^= 0x11D;
    }
  }
};
constexpr Field kField;

/// to += factor * from
void add_multiple(std::span<std::uint8_t> to, std::span<const std::uint8_t> from, std::uint8_t factor) {
  if (factor == 0) return;
  const std::uint8_t* const powers = &kField.power[static_cast<std::size_t>(kField.logarithm[factor])];
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] != 0) to[i] ^= powers[kField.logarithm[from[i]]];
}

void divide(std::span<std::uint8_t> row, std::uint8_t by) {
  const std::uint8_t* const powers = &kField.power[static_cast<std::size_t>(255 - kField.logarithm[by])];
  for (std::uint8_t& value : row)
    if (value != 0) value = powers[kField.logarithm[value]];
}

/// The factor of piece `k` in the symbol `index`.
std::uint8_t factor_of(int index, int k) {
  return kField.power[static_cast<std::size_t>(index * k % 255)];
}

bool are_of_one_head(const HeadPart& a, const HeadPart& b) {
  return a.scene == b.scene && a.size == b.size && a.symbols == b.symbols;
}

/// Solves for the pieces: Gauss-Jordan. The factors are a Vandermonde matrix of different rows, so there is
/// one solution.
std::vector<std::uint8_t> head_of(const std::vector<HeadPart>& parts) {
  const std::size_t count = parts.size();
  std::vector<std::vector<std::uint8_t>> rows;  // factors, then the symbol
  for (const HeadPart& part : parts) {
    std::vector<std::uint8_t>& row = rows.emplace_back();
    for (int k = 0; k < part.symbols; ++k) row.push_back(factor_of(part.index, k));
    row.insert(row.end(), part.symbol.begin(), part.symbol.end());
  }
  for (std::size_t k = 0; k < count; ++k) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                                    [&](const auto& row) { return row[k] != 0; });
    std::swap(rows[k], *pivot);
    divide(rows[k], rows[k][k]);
    for (std::size_t n = 0; n < count; ++n)
      if (n != k) add_multiple(rows[n], rows[k], std::uint8_t{rows[n][k]});
  }
  std::vector<std::uint8_t> head;
  for (const auto& row : rows)
    head.insert(head.end(), row.begin() + static_cast<std::ptrdiff_t>(count), row.end());
  head.resize(parts.front().size);
  return head;
}

}  // namespace

std::vector<std::uint8_t> head_symbol(std::span<const std::uint8_t> head, int symbols, int index) {
  assert(symbols >= 1 && symbols <= kMaxHeadSymbols && index >= 0 && index < kMaxHeadParts);
  const auto count = static_cast<std::size_t>(symbols);
  const std::size_t size = (head.size() + count - 1) / count;
  std::vector<std::uint8_t> symbol(size);
  for (int k = 0; !head.empty(); ++k) {
    const auto piece = head.first(std::min(size, head.size()));
    add_multiple(symbol, piece, factor_of(index, k));
    head = head.subspan(piece.size());
  }
  return symbol;
}

std::optional<std::vector<std::uint8_t>> HeadParts::add(HeadPart part) {
  if (!parts_.empty() && !are_of_one_head(parts_.front(), part)) parts_.clear();
  if (std::any_of(parts_.begin(), parts_.end(), [&](const HeadPart& p) { return p.index == part.index; }))
    return std::nullopt;
  parts_.push_back(std::move(part));
  if (parts_.size() < static_cast<std::size_t>(parts_.front().symbols)) return std::nullopt;
  return head_of(std::exchange(parts_, {}));
}

}  // namespace fbs
