#include "decoder/export/face_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line.substr(0, line.find('\n')));
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

FaceRow toy_row(int picture) {
  FaceMeasure measure;
  FaceRow row;
  row.frame = static_cast<std::uint64_t>(picture);
  row.seconds = picture / 30.0;
  row.confidence = 0.5;
  row.success = true;
  row.face = measure(toy_geometry(), talking(picture));
  return row;
}

TEST(FaceTable, BeginsWithTheColumnsThatProgramsKnow) {
  const auto head = cells(FaceTable(TableFormat::kCsv).begin({}));
  const std::vector<std::string> first{"frame", "rx_deg", "ry_deg", "rz_deg", "tx_px",
                                       "ty_px", "scale",  "x0",     "y0"};
  EXPECT_EQ(std::vector(head.begin(), head.begin() + 9), first);
  EXPECT_EQ(head[142], "y67");
  EXPECT_EQ(head[143], "timestamp");
  EXPECT_EQ(head.size(), 148 + blendshape_names().size());
}

TEST(FaceTable, RowsHaveAsManyCellsAsTheHead) {
  FaceTable table(TableFormat::kCsv);
  const auto head = cells(table.begin({}));
  const auto row = cells(table.row(toy_row(4)));
  ASSERT_EQ(row.size(), head.size());
  EXPECT_EQ(row[0], "4");
  EXPECT_EQ(row[2], "2.197");   // yaw of 400 / 65536 turns
  EXPECT_EQ(row[4], "82.000");  // pixels
  EXPECT_EQ(row[143], "0.133333");
  EXPECT_EQ(row[144], "0.5000");
  EXPECT_EQ(row[145], "1");
}

TEST(FaceTable, HasNanWhereThereIsNoFace) {
  FaceTable table(TableFormat::kCsv);
  const auto row = cells(table.row({7, 0.25, 0, false, {}}));
  ASSERT_EQ(row.size(), 148 + blendshape_names().size());
  for (std::size_t i = 1; i < row.size(); ++i)
    if (i < 143 || i > 145) {
      EXPECT_EQ(row[i], "nan") << i;
    }
  EXPECT_EQ(row[143], "0.250000");
  EXPECT_EQ(row[145], "0");
}

TEST(FaceTable, IsTheSameInJson) {
  FaceTable csv(TableFormat::kCsv), json(TableFormat::kJson);
  VideoFormat video;
  video.width = 160;
  video.height = 128;
  const auto head = cells(csv.begin(video));
  std::string text = json.begin(video);
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < 3; ++i) {
    rows.push_back(cells(csv.row(toy_row(i))));
    text += json.row(toy_row(i));
  }
  text += json.row({3, 0.1, 0, false, {}});
  text += json.end();
  const auto read = nlohmann::json::parse(text);
  EXPECT_EQ(read["width"], 160);
  ASSERT_EQ(read["frames"].size(), 4U);
  EXPECT_TRUE(read["frames"][3]["face"].is_null());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& face = read["frames"][i]["face"];
    for (std::size_t c = 0; c < head.size(); ++c) {
      double value = 0;
      if (c == 0 || (c >= 143 && c < 145))
        value = read["frames"][i][head[c]];
      else if (c < 7)
        value = face["pose"][head[c]];
      else if (c < 143)
        value = face["landmarks"][(c - 7) / 2][(c - 7) % 2];
      else if (c == 145)
        value = read["frames"][i]["success"] ? 1 : 0;
      else if (c < 148)
        value = face["gaze"][head[c]];
      else
        value = face["blendshapes"][head[c]];
      EXPECT_EQ(value, std::stod(rows[i][c])) << head[c];
    }
  }
}

TEST(FaceTable, MeasuresGazeInTheHead) {
  State state = toy_state();
  state.pose[kYaw] = 3000;
  for (const FeatureId pupil : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
    state.control[feature(pupil).first_control] = {390, -195};  // half and a quarter of an eyeball's radius
  FaceMeasure measure;
  const FaceNumbers face = measure(toy_geometry(), state);
  EXPECT_NEAR(face.gaze_deg.x, 30, 0.1);
  EXPECT_NEAR(face.gaze_deg.y, -14.5, 0.1);
}

}  // namespace
}  // namespace fbs
