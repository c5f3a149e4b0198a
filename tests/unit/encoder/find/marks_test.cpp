#include "encoder/find/marks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/talker/talker_files.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

class MarksFile : public ::testing::Test {
 protected:
  ~MarksFile() override { std::filesystem::remove(path_); }

  Result<Marks> read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_marks(path_);
  }
  /// The code of a text that is refused.
  std::optional<ErrorCode> refusal(const std::string& text) {
    const auto marks = read(text);
    return marks ? std::nullopt : std::optional(marks.error().code);
  }

 private:
  std::string path_ =
      (std::filesystem::temp_directory_path() / ("fbs_marks_test_" + std::to_string(getpid()) + ".json"))
          .string();
};

std::string sixty_eight(int count, const std::string& last = "[1, 2]") {
  std::ostringstream text;
  text << "{\"landmarks\": [";
  for (int k = 0; k + 1 < count; ++k) text << '[' << 3 * k << ", 50],";
  text << last << "]}";
  return text.str();
}

/// Names that mark both eyes.
std::string with_eyes(const std::string& more) {
  const auto name = [](std::size_t ibug) { return generic_head().vertices[vertex_of_landmark(ibug)].name; };
  std::ostringstream text;
  text << "{\"" << name(36) << "\": [80, 60], \"" << name(45) << "\": [120.5, 61]" << more << '}';
  return text.str();
}

TEST_F(MarksFile, ReadsVertexNames) {
  const auto marks = read(with_eyes(", \"nose_tip\": [100.25, 75]"));
  ASSERT_TRUE(marks) << marks.error().text;
  EXPECT_EQ(marks->landmark(36), glm::dvec2(80, 60));
  EXPECT_EQ(marks->landmark(45), glm::dvec2(120.5, 61));
  int count = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (!marks->vertex[v]) continue;
    ++count;
    if (generic_head().vertices[v].name == "nose_tip") {
      EXPECT_EQ(*marks->vertex[v], glm::dvec2(100.25, 75));
    }
  }
  EXPECT_EQ(count, 3);
}

TEST_F(MarksFile, ReadsSixtyEightLandmarks) {
  const auto marks = read(sixty_eight(68));
  ASSERT_TRUE(marks) << marks.error().text;
  for (int k = 0; k < 67; ++k) EXPECT_EQ(marks->landmark(k), glm::dvec2(3 * k, 50)) << k;
}

TEST_F(MarksFile, ReadsWhatTheTalkerWrites) {
  const TalkerClip clip(talker_settings(176, 144, 1));
  std::ostringstream json;
  talker::write_marks(json, clip.talker(), 0);
  const auto marks = read(json.str());
  ASSERT_TRUE(marks) << marks.error().text;
  const auto truth = clip.talker().points(0);
  for (int k = 0; k < kLandmarkCount; ++k) {
    EXPECT_NEAR(marks->landmark(k)->x, static_cast<double>(truth[k].x), 0.51);
    EXPECT_NEAR(marks->landmark(k)->y, static_cast<double>(truth[k].y), 0.51);
  }
}

TEST_F(MarksFile, EveryFaultIsRefused) {
  EXPECT_EQ(refusal(""), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal("{\"nose_tip\": [1, 2"), ErrorCode::kInvalidArgument) << "truncated";
  EXPECT_EQ(refusal("[1, 2]"), ErrorCode::kInvalidArgument) << "no object";
  EXPECT_EQ(refusal("{}"), ErrorCode::kInvalidArgument) << "no eyes";
  EXPECT_EQ(refusal("{\"nose_tip\": [1, 2]}"), ErrorCode::kInvalidArgument) << "no eyes";
  EXPECT_EQ(refusal(with_eyes(", \"third_eye\": [1, 2]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": [1]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": [1, 2, 3]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": \"here\"")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": [1, \"2\"]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": [1, null]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(with_eyes(", \"nose_tip\": [1, 1e300]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(sixty_eight(67)), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(sixty_eight(69)), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(sixty_eight(68, "[1]")), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal("{\"landmarks\": 68}"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(std::string(100000, '[')), ErrorCode::kInvalidArgument);
}

TEST_F(MarksFile, EyesExchangedOrTooNearAreRefused) {
  auto exchanged = with_eyes("");
  const auto at = exchanged.find("80");
  exchanged.replace(at, 2, "180");
  EXPECT_EQ(refusal(exchanged), ErrorCode::kInvalidArgument);
  exchanged.replace(at, 3, "119");
  EXPECT_EQ(refusal(exchanged), ErrorCode::kInvalidArgument);
}

TEST_F(MarksFile, MissingFileIsAnIoError) {
  EXPECT_EQ(read_marks("/nowhere/marks.json").error().code, ErrorCode::kIo);
}

TEST(Marks, EyesAreTheMeansOfWhatIsMarked) {
  Marks marks;
  EXPECT_FALSE(marks.eyes());
  marks.set_landmark(36, {10, 20});
  marks.set_landmark(39, {14, 22});
  EXPECT_FALSE(marks.eyes()) << "one eye";
  marks.set_landmark(43, {30, 21});
  const auto eyes = marks.eyes();
  ASSERT_TRUE(eyes);
  EXPECT_EQ((*eyes)[0], glm::dvec2(12, 21));
  EXPECT_EQ((*eyes)[1], glm::dvec2(30, 21));
}

}  // namespace
}  // namespace fbs
