#include "tests/fuzz/byte_mutator.h"

#include <algorithm>

namespace fbs::fuzz {

void mutate_bytes(Bytes& bytes, Random& random) {
  for (unsigned n = 1 + random() % 4; n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random() % bytes.size();
    const auto there = bytes.begin() + at;
    switch (random() % 6) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 1U << random() % 8);
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes[at] = random() % 2 == 0 ? 0x00 : 0xFF;
        break;
      case 3:
        bytes.insert(there, static_cast<std::uint8_t>(random()));
        break;
      case 4:
        bytes.erase(there, there + std::min<std::size_t>(1 + random() % 4, bytes.size() - at));
        break;
      default: {
        const std::size_t from = random() % bytes.size();
        const std::size_t count = std::min<std::size_t>(random() % 16, bytes.size() - std::max(from, at));
        const Bytes copied(bytes.begin() + from, bytes.begin() + from + count);  // the two may overlap
        std::copy(copied.begin(), copied.end(), there);
        break;
      }
    }
  }
  if (random() % 12 == 0) bytes.resize(random() % (bytes.size() + 1));
}

}  // namespace fbs::fuzz
