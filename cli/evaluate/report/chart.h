// Charts as SVG: lines over two axes. Colours are classes defined in report.css.
#pragma once

#include <string>
#include <vector>

namespace fbs::cli {

struct ChartPoint {
  double x = 0, y = 0;
  std::string label;  ///< beside the point; may be empty
};

struct ChartSeries {
  std::string name;                ///< at the end of the line; may be empty
  std::string style;               ///< class: "fbs", "x264", "x265", "av1", "envelope"
  std::vector<ChartPoint> points;  ///< x rises
  bool line = true;
  bool markers = true;
};

struct ChartSetting {
  std::string title;  ///< for readers who cannot see the chart
  std::string x_name, y_name;
  bool log_x = false;
};

/// Empty for series without points.
[[nodiscard]] std::string line_chart(const ChartSetting& setting, const std::vector<ChartSeries>& series);

/// Escapes text and attribute values of HTML and SVG.
[[nodiscard]] std::string escaped(const std::string& text);

}  // namespace fbs::cli
