// Digest of a decoded stream: the first error, the number of pictures, the MD5 of all their samples.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.h"

namespace fbs {

struct StreamDigest {
  std::string error = "-";  ///< name of the first error's code; "-" for none
  std::uint64_t pictures = 0;
  std::string md5;  ///< over the planes Y, U, V of each picture in order, rows without padding
  friend bool operator==(const StreamDigest&, const StreamDigest&) = default;
};

/// Decodes to the end, continuing after errors.
[[nodiscard]] StreamDigest digest_of(std::span<const std::uint8_t> stream);

[[nodiscard]] std::string_view name_of(ErrorCode code);

/// One line of vectors.txt.
struct Vector {
  std::string file;
  StreamDigest expected;
};

/// The table vectors.txt of a folder: file, error, pictures, MD5. Empty when it cannot be read.
[[nodiscard]] std::vector<Vector> read_vectors(const std::string& folder);

[[nodiscard]] std::vector<std::uint8_t> read_bytes(const std::string& path);

}  // namespace fbs
