// The fields of a setup payload as numbers that may be out of range, which encode_setup() refuses to write.
#pragma once

#include <span>

#include "tests/fuzz/byte_mutator.h"

namespace fbs::fuzz {

/// Reads the fields of SPEC 4.1 that are there, up to a malformed one, and the bytes after them.
struct SetupFields {
  std::vector<std::uint64_t> values;
  Bytes rest;
};
[[nodiscard]] SetupFields read_setup_fields(std::span<const std::uint8_t> payload);
[[nodiscard]] Bytes write_setup_fields(const SetupFields& fields);

/// Sets one field to a number at a limit or near its own; sometimes the optional fields appear or vanish.
void change_setup(SetupFields& fields, Random& random);

}  // namespace fbs::fuzz
