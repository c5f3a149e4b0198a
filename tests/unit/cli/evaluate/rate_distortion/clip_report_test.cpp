#include "cli/evaluate/rate_distortion/clip_report.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs::cli {
namespace {

/// One picture of 1000 samples with this PSNR of the face; the frame has 5 dB more.
RdPoint point(const std::string& label, const std::string& codec, double kbps, double face_db) {
  RdPoint p;
  p.label = label;
  p.codec = codec;
  p.seconds = 8;
  p.bytes.total = static_cast<std::uint64_t>(std::lround(kbps * 1000));
  const auto error = [](double db) {
    return SquaredError{static_cast<std::uint64_t>(std::lround(65025 * std::pow(10, -db / 10) * 100000)),
                        100000};
  };
  PictureQuality& q = p.pictures.emplace_back();
  q.frame.y = error(face_db + 5);
  q.face.emplace().y = error(face_db);
  return p;
}

ClipReport compared() {
  ClipReport clip;
  clip.compared = true;
  for (int i = 0; i < 5; ++i)
    clip.points.push_back(point("quality " + std::to_string(20 + 15 * i), "fbs", std::pow(2, i), 24 + i));
  for (int i = 0; i < 5; ++i)
    clip.peers.push_back(point("x265 crf " + std::to_string(51 - i), "x265", std::pow(2, i + 1), 24 + i));
  return clip;
}

TEST(ClipReport, ShowsThePointOfTheMiddleRate) {
  const ClipReport clip = compared();
  EXPECT_EQ(shown_point(clip)->label, "quality 50");
  EXPECT_EQ(shown_point({}), nullptr);
}

TEST(ClipReport, RivalTakesNoMoreUnlessAllDo) {
  const ClipReport clip = compared();
  EXPECT_EQ(rival_of(clip, 4)->label, "x265 crf 50");
  EXPECT_EQ(rival_of(clip, 7.9)->label, "x265 crf 49");
  EXPECT_EQ(rival_of(clip, 7.8)->label, "x265 crf 50");
  EXPECT_EQ(rival_of(clip, 0.5)->label, "x265 crf 51");
  EXPECT_EQ(rival_of({}, 4), nullptr);
}

TEST(ClipReport, HalfTheRateIsMinusFiftyPercent) {
  EXPECT_NEAR(bd_rate_against_peers(compared(), Area::kFace)->percent, -50, 0.01);
}

TEST(ClipReport, SummaryComparesAtTheSameRate) {
  const std::string text = summary_of(compared());
  EXPECT_EQ(text,
            "At 4.0 kbit/s (quality 50), compared with the best of x265, the face is 1.0 dB better (26.0 "
            "against 25.0 dB) "
            "and the frame is 1.0 dB better (31.0 against 30.0 dB). For the same face it needs 50 % less "
            "rate (BD-rate, "
            "24 to 28 dB). For the same frame it needs 50 % less rate (BD-rate, 29 to 33 dB).");
}

TEST(ClipReport, SummarySaysWhereNoPeerGoes) {
  ClipReport clip = compared();
  clip.peers.erase(clip.peers.begin(), clip.peers.begin() + 2);
  EXPECT_NE(summary_of(clip).find(
                "None of x265 goes that low: the least of them takes 8.0 kbit/s for a frame of 31.0"),
            std::string::npos);
}

TEST(ClipReport, SummaryWithoutPeersIsAboutItself) {
  ClipReport clip = compared();
  clip.compared = false;
  clip.peers.clear();
  EXPECT_EQ(summary_of(clip),
            "At 4.0 kbit/s (quality 50) the face has 26.0 dB and the frame 31.0 dB of luma PSNR.");
}

}  // namespace
}  // namespace fbs::cli
