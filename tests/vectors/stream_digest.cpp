#include "tests/vectors/stream_digest.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "common/md5.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return "kInvalidArgument";
    case ErrorCode::kNotFbs:
      return "kNotFbs";
    case ErrorCode::kTruncated:
      return "kTruncated";
    case ErrorCode::kInvalidStream:
      return "kInvalidStream";
    case ErrorCode::kUnsupported:
      return "kUnsupported";
    case ErrorCode::kTooLarge:
      return "kTooLarge";
    case ErrorCode::kDegenerateInput:
      return "kDegenerateInput";
    case ErrorCode::kNoFace:
      return "kNoFace";
    case ErrorCode::kTooFewFaces:
      return "kTooFewFaces";
    case ErrorCode::kIo:
      return "kIo";
    case ErrorCode::kInternal:
      return "kInternal";
  }
  return "?";
}

StreamDigest digest_of(std::span<const std::uint8_t> stream) {
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  StreamDigest out;
  Md5 md5;
  Picture picture;
  for (;;) {
    const auto status = decoder.next();
    if (!status) {
      if (out.error == "-") out.error = name_of(status.error().code);
      continue;
    }
    if (*status != DecodeStatus::kPicture) break;
    if (const auto drawn = decoder.render(picture); !drawn) {
      out.error = name_of(drawn.error().code);
      break;
    }
    md5.add(picture);
    ++out.pictures;
  }
  out.md5 = md5.hex();
  return out;
}

std::vector<Vector> read_vectors(const std::string& folder) {
  std::ifstream table(folder + "/vectors.txt");
  std::vector<Vector> out;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    Vector v;
    if (fields >> v.file >> v.expected.error >> v.expected.pictures >> v.expected.md5) out.push_back(v);
  }
  return out;
}

std::vector<std::uint8_t> read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace fbs
