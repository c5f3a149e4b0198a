#include "cli/files/number_pattern.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>

namespace fbs {
namespace {

constexpr int kMaxDigits = 18;  // enough for any std::int64_t

}  // namespace

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string NumberPattern::name(std::int64_t number) const {
  assert(number >= 0);
  const std::string text = std::to_string(number);
  const auto zeros = static_cast<std::size_t>(std::max(digits - static_cast<int>(text.size()), 0));
  return before + std::string(zeros, '0') + text + after;
}

std::optional<std::int64_t> NumberPattern::number(std::string_view name) const {
  if (name.size() <= before.size() + after.size()) return std::nullopt;
  if (!name.starts_with(before) || !name.ends_with(after)) return std::nullopt;
  const std::string_view text = name.substr(before.size(), name.size() - before.size() - after.size());
  if (text.size() > kMaxDigits || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  if (this->name(value) != name) return std::nullopt;  // %d does not make 007
  return value;
}

std::optional<NumberPattern> parse_number_pattern(std::string_view text) {
  const std::size_t percent = text.find('%');
  if (percent == std::string_view::npos || text.find('%', percent + 1) != std::string_view::npos) {
    return std::nullopt;
  }
  std::size_t end = percent + 1;
  while (end < text.size() && is_digit(text[end])) ++end;
  if (end >= text.size() || text[end] != 'd') return std::nullopt;

  NumberPattern pattern{std::string(text.substr(0, percent)), 0, std::string(text.substr(end + 1))};
  const std::string_view width = text.substr(percent + 1, end - percent - 1);
  if (width.empty()) return pattern;
  if (width[0] != '0' || width.size() > 3) return std::nullopt;
  std::from_chars(width.data(), width.data() + width.size(), pattern.digits);
  if (pattern.digits > kMaxDigits) return std::nullopt;
  return pattern;
}

}  // namespace fbs
