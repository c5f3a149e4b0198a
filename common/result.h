// How functions of fbs fail: Result<T> is a value or an Error; nothing throws across a public header.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace fbs {

enum class ErrorCode : std::uint8_t {
  kInvalidArgument,  ///< a caller's setting is out of its documented range
  kNotFbs,           ///< the bytes are not an fbs stream at all
  kTruncated,        ///< the stream ends inside a packet
  kInvalidStream,    ///< a packet is damaged or breaks a rule of SPEC.md
  kUnsupported,      ///< a newer version or a feature this build lacks
  kTooLarge,         ///< a count or dimension beyond its limit in SPEC.md
  kDegenerateInput,  ///< points collinear, empty range and the like
  kNoFace,           ///< no face was found where one is needed
  kIo,               ///< a file could not be read or written
  kInternal,         ///< our own invariant is broken: always a bug
};

struct [[nodiscard]] Error {
  ErrorCode code;
  std::string text;               ///< one line, no final stop, no file name
  std::uint64_t byte_offset = 0;  ///< where in the stream, when the error is about a stream
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for `return fail(ErrorCode::kIo, "cannot open")` in a function that returns Result<T>.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string text,
                                                std::uint64_t byte_offset = 0) {
  return tl::unexpected<Error>(Error{code, std::move(text), byte_offset});
}

/// Passes the error of one result on as that of another: `if (!parsed) return fail(parsed.error())`.
[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace fbs
