#include "cli/play/pipe_peek.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Pipe {
  std::array<int, 2> ends{};
  Pipe() { EXPECT_EQ(::pipe(ends.data()), 0); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends) ::close(end);
  }
  [[nodiscard]] std::string name() const { return "/dev/fd/" + std::to_string(ends[0]); }
  void write(const Bytes& bytes) const {
    EXPECT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] Bytes read(std::size_t count) const {
    Bytes out(count);
    EXPECT_EQ(::read(ends[0], out.data(), count), static_cast<ssize_t>(count));
    return out;
  }
};

TEST(PipePeek, LeavesTheBytesForWhoReadsThem) {
  const Pipe pipe;
  const PipePeek peek(pipe.name());
  EXPECT_EQ(peek.bytes(), Bytes());
  pipe.write({1, 2, 3});
  EXPECT_EQ(peek.bytes(), Bytes({1, 2, 3}));
  EXPECT_EQ(peek.bytes(), Bytes({1, 2, 3}));
  EXPECT_EQ(pipe.read(2), Bytes({1, 2}));
  pipe.write({4});
  EXPECT_EQ(peek.bytes(), Bytes({3, 4}));
  EXPECT_EQ(pipe.read(2), Bytes({3, 4}));
  EXPECT_EQ(peek.bytes(), Bytes());
}

TEST(PipePeek, SeesNothingWhereThereIsNoPipe) {
  EXPECT_EQ(PipePeek("/dev/null").bytes(), Bytes());
  EXPECT_EQ(PipePeek("/absent/pipe").bytes(), Bytes());
}

}  // namespace
}  // namespace fbs::cli
