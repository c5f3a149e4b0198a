// Errors: Result<T> is a value or an Error; no exception crosses a public header.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace fbs {

enum class ErrorCode : std::uint8_t {
  kInvalidArgument,  ///< a setting is outside its documented range
  kNotFbs,           ///< not an fbs stream
  kTruncated,        ///< the stream ends inside a packet
  kInvalidStream,    ///< a packet is damaged or breaks a rule of SPEC.md
  kUnsupported,      ///< a newer version or a feature this build lacks
  kTooLarge,         ///< a count or dimension beyond its limit in SPEC.md
  kDegenerateInput,  ///< collinear points, an empty range and the like
  kNoFace,           ///< no face where one is needed
  kTooFewFaces,      ///< some faces, but not the one that a setting asks for
  kIo,               ///< a file could not be read or written
  kInternal,         ///< a broken invariant of our own: always a bug
};

struct [[nodiscard]] Error {
  ErrorCode code;
  std::string text;               ///< one line, without full stop or file name
  std::uint64_t byte_offset = 0;  ///< position in the stream, for errors about a stream
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for `return fail(ErrorCode::kIo, "cannot open")` in a function that returns Result<T>.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string text,
                                                std::uint64_t byte_offset = 0) {
  return tl::unexpected<Error>(Error{code, std::move(text), byte_offset});
}

/// Passes on the error of another result: `if (!parsed) return fail(parsed.error())`.
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace fbs
