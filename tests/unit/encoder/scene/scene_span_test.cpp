#include "encoder/scene/scene_span.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Scenes that have begun to end and are not waited for yet.
struct Endings {
  int now = 0, most = 0;
};

/// Shows one person, of whom pictures show nothing but a number in their first sample. Its packets are a
/// setup packet and a pattern packet where it begins, a return packet where it goes on, and a motion packet
/// of that number for each picture, all of which come when it ends.
class ToyScene : public SceneEncoder {
 public:
  ToyScene(std::uint8_t person, std::uint64_t begin, bool goes_on, Endings& endings)
      : person_(person), goes_on_(goes_on), endings_(endings) {
    begin_again(begin);
  }

  Result<void> push(const Picture& picture, const PictureTime&) override {
    if (std::exchange(ended_, false)) begin_again(begin_);
    coded_.emplace_back(PacketType::kMotion, std::vector{picture.y.samples.front()});
    ++begin_;
    return {};
  }
  StreamPosition end_picture(std::optional<std::uint64_t>) override { return {begin_, begin_}; }
  void cut() override {}
  [[nodiscard]] bool recognises(const Picture& picture) override {
    return picture.y.samples.front() == person_;
  }
  [[nodiscard]] bool carries_shots() const override { return goes_on_; }
  [[nodiscard]] bool can_go_on() const override { return goes_on_; }
  Result<void> go_on(const StreamPosition& at) override {
    begin_ = at.pictures;
    if (!ended_) coded_.emplace_back(PacketType::kReturn, encode_return({0, at, false}));
    return {};
  }
  Result<void> finish() override {
    ended_ = true;
    if (!std::exchange(coding_, true)) endings_.most = std::max(endings_.most, ++endings_.now);
    return {};
  }
  [[nodiscard]] bool is_coding() const override { return coding_; }
  Result<void> wait() override {
    if (!std::exchange(coding_, false)) return {};
    --endings_.now;
    for (const auto& [type, payload] : coded_) writer_.write(ready_, type, payload);
    coded_.clear();
    return {};
  }
  [[nodiscard]] std::vector<std::uint8_t> take() override { return std::exchange(ready_, {}); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_; }

 private:
  void begin_again(std::uint64_t picture) {
    begin_ = picture;
    Setup setup = toy_setup();
    setup.before = {picture, picture};
    coded_.emplace_back(PacketType::kSetup, *encode_setup(setup));
    coded_.emplace_back(PacketType::kPattern, std::vector{person_});
  }

  std::uint8_t person_;
  bool goes_on_, ended_ = false, coding_ = false;
  Endings& endings_;
  std::uint64_t begin_ = 0;
  std::vector<TypedPayload> coded_;
  PacketWriter writer_;
  std::vector<std::uint8_t> ready_;
  PictureAnalysis analysis_;
};

/// Shows a person in each picture, by a letter; small ones in scenes that cannot go on.
class Shown {
 public:
  explicit Shown(std::uint64_t most = 1000, std::size_t together = 1) : span_(most, together) {}

  Shown& show(const std::string& people) {
    for (const char person : people) push(static_cast<std::uint8_t>(person));
    return *this;
  }

  /// All packets as text: "[A0" a setup packet of A without keeping others, 1 and 2 as SceneKeeping has it;
  /// "<A0" a return, or 1 where the scene before is set aside; a letter for each picture.
  [[nodiscard]] std::string finished() {
    EXPECT_TRUE(span_.finish());
    take();
    std::string out;
    PacketReader reader(stream_);
    std::optional<char> keeps;
    std::map<std::uint32_t, char> people;
    for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next()) {
      const auto& payload = read->packet.payload;
      if (read->packet.type == PacketType::kSetup)
        keeps = static_cast<char>('0' + static_cast<int>(decode_setup(payload)->keeps));
      else if (read->packet.type == PacketType::kPattern)
        out += std::string("[") + (people[read->packet.check] = static_cast<char>(payload[0])) + *keeps;
      else if (read->packet.type == PacketType::kReturn)
        out += std::string("<") + people[decode_return(payload)->scene] +
               (decode_return(payload)->aside ? '1' : '0');
      else
        out += static_cast<char>(payload[0]);
    }
    return out;
  }

  void take() {
    const auto taken = span_.take();
    stream_.insert(stream_.end(), taken.begin(), taken.end());
  }
  [[nodiscard]] const std::vector<std::uint8_t>& stream() const { return stream_; }
  [[nodiscard]] const Endings& endings() const { return endings_; }

 private:
  void push(std::uint8_t person) {
    Picture picture(64, 64);
    picture.y.samples.front() = person;
    EXPECT_TRUE(span_.end_span(pictures_));
    if (span_.present() == nullptr || !span_.present()->recognises(picture)) {
      const bool returned = span_.present() != nullptr && *span_.return_to(picture, {pictures_, pictures_});
      if (!returned) {
        ASSERT_TRUE(
            span_.begin(std::make_unique<ToyScene>(person, pictures_, person < 'a', endings_), pictures_));
      }
    }
    ASSERT_TRUE(span_.present()->push(picture, 0));
    ++pictures_;
    take();
  }

  Endings endings_;
  SceneSpan span_;
  std::uint64_t pictures_ = 0;
  std::vector<std::uint8_t> stream_ = {kSignature.begin(), kSignature.end()};
};

TEST(SceneSpan, ScenesThatDoNotReturnArePlacesToJoin) {
  EXPECT_EQ(Shown().show("AAABBC").finished(), "[A0AAA[B0BB[C0C");
}

TEST(SceneSpan, ASceneThatReturnsIsNotBegunAgain) {
  EXPECT_EQ(Shown().show("AABBABBA").finished(), "[A0AA[B2BB<A1A<B1BB<A0A");
}

TEST(SceneSpan, ScenesThatCannotGoOnAreNotSetAside) {
  EXPECT_EQ(Shown().show("AAsAAtA").finished(), "[A0AA[s2s<A0AA[t2t<A0A");
  EXPECT_EQ(Shown().show("stA").finished(), "[s0s[t0t[A0A");
}

TEST(SceneSpan, OnlyScenesThatReturnAreSetAside) {
  EXPECT_EQ(Shown().show("ABCA").finished(), "[A0A[B2B[C1C<A0A");
}

TEST(SceneSpan, OneThatIsLeftFirstEndsWhereMoreAreOpenThanAViewerKeeps) {
  EXPECT_EQ(Shown().show("ABCDEA").finished(), "[A0A[B0B[C0C[D0D[E0E[A0A");
  EXPECT_EQ(Shown().show("ABCDA").finished(), "[A0A[B2B[C1C[D1D<A0A");
}

TEST(SceneSpan, AllEndTogether) {
  EXPECT_EQ(Shown(4).show("AABBABAABB").finished(), "[A0AA[B2BB<A1A<B0B[A0AA[B0BB");
  EXPECT_EQ(Shown(4).show("ABBBBBB").finished(), "[A0A[B0BBBB[B0BB");
}

TEST(SceneSpan, ScenesThatEndTogetherLeaveTheStreamAsItIs) {
  for (const char* const people : {"ABBABCDEABs", "ABCDABCDst", "stABBA"}) {
    Shown one(4), two(4, 2);
    EXPECT_EQ(one.show(people).finished(), two.show(people).finished()) << people;
    EXPECT_EQ(one.endings().most, 1) << people;
    EXPECT_EQ(two.endings().most, 2) << people;
    EXPECT_EQ(two.endings().now, 0) << people;
  }
}

TEST(SceneSpan, PacketsComeAsSoonAsTheirSceneHasEnded) {
  Shown shown;
  shown.show("sst");
  EXPECT_GT(shown.stream().size(), kSignature.size());
  Shown open;
  open.show("AAB");
  EXPECT_EQ(open.stream().size(), kSignature.size());
}

}  // namespace
}  // namespace fbs
