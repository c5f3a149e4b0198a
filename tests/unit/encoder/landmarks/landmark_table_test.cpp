#include "encoder/landmarks/landmark_table.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "encoder/landmarks/built_in_table.h"

namespace fbs {
namespace {

std::vector<std::uint8_t> built_in() {
  const auto bytes = built_in_landmark_table();
  return {bytes.begin(), bytes.end()};
}

TEST(LandmarkTable, TheBuiltInOneIsReadAndWritten) {
  const auto table = read_landmark_table(built_in());
  ASSERT_TRUE(table) << table.error().text;
  EXPECT_GE(table->stages.size(), 3U);
  EXPECT_EQ(write_landmark_table(*table), built_in());
  EXPECT_LT(built_in().size(), 1U << 20);
}

TEST(LandmarkTable, DamagedOnesAreRefused) {
  auto bytes = built_in();
  bytes.pop_back();
  EXPECT_EQ(read_landmark_table(bytes).error().code, ErrorCode::kInvalidStream) << "cut off";
  bytes = built_in();
  bytes.push_back(0);
  EXPECT_EQ(read_landmark_table(bytes).error().code, ErrorCode::kInvalidStream) << "too long";
  bytes = built_in();
  ++bytes[1];
  EXPECT_EQ(read_landmark_table(bytes).error().code, ErrorCode::kUnsupported) << "another version";
  bytes = built_in();
  bytes[2] = 255;
  EXPECT_EQ(read_landmark_table(bytes).error().code, ErrorCode::kInvalidStream) << "stages";
  EXPECT_FALSE(read_landmark_table({}));
}

TEST(LandmarkTable, MapIsAMatrixProduct) {
  DescriptorMap map;
  map.outputs = 2;
  map.scale = {0.5F, 2};
  map.weights.assign(2 * kDescriptorSize, 0);
  map.weights[0] = 4;
  map.weights[2 * 7 + 1] = -3;
  std::vector<float> descriptor(kDescriptorSize);
  descriptor[0] = 1;
  descriptor[7] = 10;
  EXPECT_EQ(map(descriptor), (std::vector<float>{2, -60}));
}

TEST(LandmarkTable, AMissingFileIsAnIoError) {
  setenv("FBS_LANDMARKS", "/nowhere", 1);
  const auto missing = load_landmarks();
  unsetenv("FBS_LANDMARKS");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace fbs
