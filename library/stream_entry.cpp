#include "library/stream_entry.h"

#include <algorithm>
#include <vector>

namespace fbs {

void StreamEntry::feed(StreamDecoder& decoder, std::span<const std::uint8_t> bytes) {
  if (decided_) return decoder.feed(bytes);
  const auto expected = std::span(kSignature).subspan(held_);
  const std::size_t compared = std::min(expected.size(), bytes.size());
  const bool same = std::equal(bytes.begin(), bytes.begin() + compared, expected.begin());
  if (same && compared < expected.size()) {
    held_ += compared;
    return;
  }
  std::vector<std::uint8_t> begin;  // one piece: either all of it is taken or nothing
  if (!same) begin.assign(kSignature.begin(), kSignature.end());
  begin.insert(begin.end(), kSignature.begin(), kSignature.begin() + held_);
  begin.insert(begin.end(), bytes.begin(), bytes.end());
  decoder.feed(begin);
  decided_ = true;
  supplied_ = !same;
}

void StreamEntry::close(StreamDecoder& decoder) {
  if (!decided_) decoder.feed(std::span(kSignature).first(held_));
  decided_ = true;
  decoder.close();
}

}  // namespace fbs
