// A decoder of fbs/fbs.h for tests, and its output for a stream.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/md5.h"
#include "fbs/fbs.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {

struct CloseDecoder {
  void operator()(fbs_decoder* decoder) const { fbs_decoder_close(&decoder); }
};
using ApiDecoder = std::unique_ptr<fbs_decoder, CloseDecoder>;

inline ApiDecoder api_decoder(std::uint64_t max_pixels = 0) {
  fbs_decoder_settings settings;
  fbs_decoder_default_settings(&settings, sizeof settings);
  settings.max_pixels = max_pixels;
  fbs_decoder* decoder = nullptr;
  EXPECT_EQ(fbs_decoder_open(&decoder, &settings), FBS_OK);
  return ApiDecoder(decoder);
}

inline std::vector<std::uint8_t> vector_bytes(const std::string& name) {
  auto bytes = read_bytes(FBS_VECTORS "/" + name);
  EXPECT_FALSE(bytes.empty()) << name;
  return bytes;
}

inline std::size_t plane_width(std::uint32_t width, int plane) {
  return plane == 0 ? width : (width + 1) / 2;
}

inline std::vector<std::uint8_t> samples_of(const fbs_const_picture& p) {
  std::vector<std::uint8_t> out;
  for (int k = 0; k < 3; ++k)
    for (std::size_t y = 0; y < plane_width(p.height, k); ++y) {
      const std::uint8_t* const row = p.data[k] + static_cast<std::ptrdiff_t>(y) * p.stride[k];
      out.insert(out.end(), row, row + plane_width(p.width, k));
    }
  return out;
}

/// The samples of the picture announced last.
inline std::vector<std::uint8_t> shown_by(fbs_decoder* decoder) {
  fbs_const_picture picture;
  EXPECT_EQ(fbs_decoder_get_picture(decoder, &picture), FBS_OK);
  return samples_of(picture);
}

struct Heard {
  std::vector<fbs_picture_info> infos;
  std::vector<fbs_status> errors;
  std::vector<std::uint64_t> error_offsets;
  std::string md5;           ///< of all pictures, as in vectors.txt
  fbs_status last = FBS_OK;  ///< FBS_END, or FBS_NEED_DATA where the decoder was not finished
};

/// Takes all pictures that have arrived.
inline void hear(fbs_decoder* decoder, Heard& out, Md5& md5) {
  for (int guard = 0; guard < 100000; ++guard) {
    fbs_picture_info info{};
    out.last = fbs_decoder_next(decoder, &info);
    if (out.last == FBS_NEED_DATA || out.last == FBS_END) return;
    if (out.last == FBS_OK) {
      out.infos.push_back(info);
      md5.add(shown_by(decoder));
    } else {
      EXPECT_NE(out.last, FBS_ERROR_INTERNAL) << fbs_decoder_error(decoder);
      EXPECT_STRNE(fbs_decoder_error(decoder), "");
      out.errors.push_back(out.last);
      out.error_offsets.push_back(fbs_decoder_error_offset(decoder));
    }
  }
  ADD_FAILURE() << "a decoder that never ends";
}

/// Feeds all bytes in pieces, then finishes.
inline Heard heard(fbs_decoder* decoder, std::span<const std::uint8_t> bytes, std::size_t piece) {
  Heard out;
  Md5 md5;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const auto part = bytes.subspan(at, std::min(piece, bytes.size() - at));
    EXPECT_EQ(fbs_decoder_feed(decoder, part.data(), part.size()), FBS_OK);
    hear(decoder, out, md5);
  }
  EXPECT_EQ(fbs_decoder_finish(decoder), FBS_OK);
  hear(decoder, out, md5);
  out.md5 = md5.hex();
  return out;
}
inline Heard heard(std::span<const std::uint8_t> bytes, std::size_t piece = 4096) {
  return heard(api_decoder().get(), bytes, piece);
}

/// A decoder that has the whole stream and has announced its first picture.
inline ApiDecoder at_first_picture(const std::string& vector) {
  ApiDecoder decoder = api_decoder();
  const auto bytes = vector_bytes(vector);
  EXPECT_EQ(fbs_decoder_feed(decoder.get(), bytes.data(), bytes.size()), FBS_OK);
  EXPECT_EQ(fbs_decoder_finish(decoder.get()), FBS_OK);
  EXPECT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_OK);
  return decoder;
}

}  // namespace fbs
