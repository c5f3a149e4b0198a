// out_of_memory STREAM: makes each allocation in turn fail while a stream is decoded through fbs/fbs.h. Each
// time the decoder reports it, or manages without; it neither crashes nor fails to continue after a reset. A
// separate program, since it replaces operator new.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <new>
#include <vector>

#include "fbs/fbs.h"

namespace {

long allocations_left = -1;  // until one fails; negative: none does
bool has_failed = false;

constexpr long kTried = 400;  ///< each of these; later ones in steps of kStep
constexpr long kStep = 61;

}  // namespace

void* operator new(std::size_t size) {
  if (allocations_left == 0) has_failed = true;
  if (allocations_left-- == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

void require(bool holds, const char* what, long number) {
  if (holds) return;
  std::fprintf(stderr, "allocation %ld: %s\n", number, what);
  std::exit(1);
}

/// Decodes all that comes. @return number of pictures; an error of the stream or of memory adds none
int decode(fbs_decoder* decoder, const std::vector<std::uint8_t>& stream, long number) {
  int pictures = 0;
  bool told = fbs_decoder_feed(decoder, stream.data(), stream.size()) == FBS_ERROR_NO_MEMORY;
  while (fbs_decoder_finish(decoder) != FBS_OK) told = true;
  for (;;) {
    const fbs_status status = fbs_decoder_next(decoder, nullptr);
    require(status != FBS_NEED_DATA && status != FBS_ERROR_ARGUMENT, "an answer that makes no sense", number);
    if (status == FBS_END) break;
    told = told || status < 0;  // Draco's failures count as damage: absurd sizes of bad streams look the same
    if (status != FBS_OK) continue;
    fbs_const_picture picture;
    fbs_landmark landmarks[FBS_LANDMARKS];
    while (fbs_decoder_get_picture(decoder, &picture) != FBS_OK) told = true;
    while (fbs_decoder_get_landmarks(decoder, landmarks) == FBS_ERROR_NO_MEMORY) told = true;
    ++pictures;
  }
  require(told || !has_failed || pictures > 0, "a failure that nobody tells of", number);
  return pictures;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<std::uint8_t> stream{std::istreambuf_iterator<char>(file), {}};
  long number = 0;
  int expected = 0;
  for (;; number += number < kTried ? 1 : kStep) {
    has_failed = false;
    allocations_left = number;
    fbs_decoder* decoder = nullptr;
    while (fbs_decoder_open(&decoder, nullptr) != FBS_OK) require(has_failed, "no decoder", number);
    const int pictures = decode(decoder, stream, number);
    allocations_left = -1;
    require(fbs_decoder_reset(decoder) == FBS_OK, "no reset", number);
    expected = decode(decoder, stream, number);
    fbs_decoder_close(&decoder);
    require(expected > 0 && pictures <= expected, "another number of pictures", number);
    if (!has_failed) break;
  }
  std::printf("%d pictures, %ld allocations\n", expected, number);
  return 0;
}
