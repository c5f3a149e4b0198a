// The pictures of a scene's packets.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "bitstream/packet.h"
#include "common/quality.h"
#include "decoder/scene/scene_face.h"
#include "tests/unit/encode_decode.h"

namespace fbs {

struct Shown {
  std::vector<Picture> pictures;
  std::vector<std::uint32_t> durations;
  std::vector<bool> moves;  ///< whether the picture's scene has a geometry
  std::size_t scenes = 0;
  std::size_t patterns = 0;
  std::size_t bytes = 0;
  /// PSNR of luma against the sources.
  [[nodiscard]] double psnr(const std::vector<Picture>& sources) const {
    EXPECT_EQ(pictures.size(), sources.size());
    SquaredError error;
    for (std::size_t i = 0; i < std::min(pictures.size(), sources.size()); ++i)
      error += squared_error(pictures[i].y, sources[i].y);
    return error.psnr();
  }
};

/// @param packets  of whole scenes, without the signature
inline Shown shown_by(const std::vector<std::uint8_t>& packets) {
  std::vector<std::uint8_t> stream;
  write_signature(stream);
  stream.insert(stream.end(), packets.begin(), packets.end());
  Shown shown;
  shown.bytes = stream.size();
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next())
    if (read->packet.type == PacketType::kSetup) ++shown.scenes;
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  decoder.record_patterns();
  const auto end = decode_pictures(decoder, [&](StreamDecoder&) {
    shown.pictures.emplace_back();
    EXPECT_TRUE(decoder.render(shown.pictures.back()));
    shown.durations.push_back(decoder.duration());
    shown.moves.push_back(decoder.scene().geometry.has_value());
    EXPECT_EQ(face_of(decoder.scene()), nullptr);
  });
  EXPECT_TRUE(end) << end.error().text;
  shown.patterns = decoder.pattern_records().size();
  return shown;
}

}  // namespace fbs
