// stream_md5 FOLDER: decodes every vector of a folder and compares with its vectors.txt.
// stream_md5 FILE...: prints the digest of each stream as a line of vectors.txt.
// Links only the decoder; tests/layering/ builds it several times.
#include <filesystem>
#include <iostream>

#include "decoder/vectors/scalar.h"
#include "tests/vectors/stream_digest.h"

namespace {

std::ostream& operator<<(std::ostream& out, const fbs::StreamDigest& d) {
  return out << d.error << ' ' << d.pictures << ' ' << d.md5;
}

int check(const std::string& folder) {
  const auto vectors = fbs::read_vectors(folder);
  int wrong = 0;
  for (const fbs::Vector& v : vectors) {
    const fbs::StreamDigest got = fbs::digest_of(fbs::read_bytes(folder + "/" + v.file));
    if (got == v.expected) continue;
    ++wrong;
    std::cout << v.file << ": expected " << v.expected << ", got " << got << '\n';
  }
  std::cout << vectors.size() << " vectors, " << wrong << " wrong, kernels " << fbs::kernel_name() << '\n';
  return vectors.empty() || wrong > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::filesystem::is_directory(argv[1])) return check(argv[1]);
  for (int i = 1; i < argc; ++i)
    std::cout << std::filesystem::path(argv[i]).filename().string() << ' '
              << fbs::digest_of(fbs::read_bytes(argv[i])) << '\n';
  return 0;
}
