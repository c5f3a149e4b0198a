// Names with a number in them, such as `frame_%05d.png`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fbs {

/// '0' to '9'.
[[nodiscard]] bool is_digit(char c);

/// `before` + the number, padded with zeros to `digits` + `after`. Only %d and %0Nd are supported.
struct NumberPattern {
  std::string before;
  int digits = 0;  ///< minimum number of digits, 0..18
  std::string after;

  [[nodiscard]] std::string name(std::int64_t number) const;

  /// The number in a name made from this pattern; nullopt for any other name.
  [[nodiscard]] std::optional<std::int64_t> number(std::string_view name) const;
};

/// @return nullopt when the text has no %d or %0Nd, or more than one
std::optional<NumberPattern> parse_number_pattern(std::string_view text);

}  // namespace fbs
