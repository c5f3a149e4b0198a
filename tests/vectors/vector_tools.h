// What test vectors are made from: pictures of the talker, streams as packets, and the folder they go to.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/settings.h"
#include "tests/talker/talker_motion.h"

namespace fbs {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void give_up(const std::string& why);

template <class T>
T must(Result<T> result) {
  if (!result) give_up(result.error().text);
  return std::move(*result);
}

talker::Settings talker_settings(int width, int height, int frames);
std::vector<Picture> pictures_of(const talker::Settings& settings);

/// Settings of a scene of one pattern.
/// @param group_pictures  as EncoderSettings
EncoderSettings one_pattern(int group_pictures = 0);

/// The stream of the codec's own encoder, at 30 pictures a second.
Bytes encoded(const std::vector<Picture>& pictures, const EncoderSettings& settings,
              const std::vector<std::uint32_t>& durations = {});

/// One packet of a stream.
struct Piece {
  PacketType type;
  Bytes payload;
};
std::vector<Piece> pieces_of(const Bytes& stream);
Bytes joined(const std::vector<Piece>& pieces);
std::size_t place_of(const std::vector<Piece>& pieces, PacketType type, int nth = 0);
/// Offset of packet `nth` in the stream.
std::size_t offset_of(std::vector<Piece> pieces, std::size_t nth);
/// The stream as a network delivers it that has lost packet `nth`: the checks are those of the whole stream.
Bytes joined_without(const std::vector<Piece>& pieces, std::size_t nth);
/// The same for a network that delivers packet `nth` twice.
Bytes joined_with_two(const std::vector<Piece>& pieces, std::size_t nth);

/// The stream from packet `nth` on, as one who comes in its middle gets it.
Bytes joined_from(const std::vector<Piece>& pieces, std::size_t nth);

/// A pattern packet of a stream.
struct PatternPiece {
  std::size_t piece;  ///< index
  std::vector<PatternSyntax> patterns;
  std::int32_t pictures;  ///< that have a state before it
};
/// All of a stream of one scene.
std::vector<PatternPiece> patterns_of(const std::vector<Piece>& pieces);

/// Where vectors and their table are written.
class Folder {
 public:
  explicit Folder(std::string path);

  /// Writes a vector after checking that it decodes to the given number of pictures and error.
  void add(const std::string& file, const Bytes& bytes, std::uint64_t pictures, std::string_view error = "-");

 private:
  std::string path_;
  std::ofstream table_;
};

}  // namespace fbs
