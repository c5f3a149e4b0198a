#include "cli/evaluate/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "cli/evaluate/report/chart_ticks.h"

namespace fbs::cli {
namespace {

// In units of the view box: about pixels on a wide screen.
constexpr double kWidth = 560, kHeight = 360;
constexpr double kLeft = 46, kRight = 74, kTop = 26, kBottom = 44;
constexpr double kLabelHeight = 14, kLabelWidth = 20;
constexpr double kTextHalf = 4;  // from the base line to the middle of a line of text

std::string n(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

std::string text_at(double x, double y, const char* anchor, const std::string& text,
                    const std::string& style) {
  return "<text x=\"" + n(x) + "\" y=\"" + n(y) + "\" text-anchor=\"" + anchor + "\" class=\"" + style +
         "\">" + escaped(text) + "</text>";
}

std::string line_between(double x0, double y0, double x1, double y1, const char* style) {
  return "<line x1=\"" + n(x0) + "\" y1=\"" + n(y0) + "\" x2=\"" + n(x1) + "\" y2=\"" + n(y1) +
         "\" class=\"" + style + "\"/>";
}

std::string svg(const std::string& title, const std::string& content) {
  return "<svg viewBox=\"0 0 " + n(kWidth) + " " + n(kHeight) + "\" role=\"img\" aria-label=\"" +
         escaped(title) + "\">" + content + "</svg>";
}

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void take(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

/// Maps values to positions in the view box.
class Scale {
 public:
  Scale(Span span, double from, double to, bool log) : span_(span), from_(from), to_(to), log_(log) {}

  [[nodiscard]] double operator()(double v) const {
    return from_ + (to_ - from_) * (map(v) - map(span_.low)) / (map(span_.high) - map(span_.low));
  }
  [[nodiscard]] std::vector<double> ticks(int wanted) const {
    return log_ ? log_ticks(span_.low, span_.high) : linear_ticks(span_.low, span_.high, wanted);
  }

 private:
  [[nodiscard]] double map(double v) const { return log_ ? std::log(v) : v; }

  Span span_;
  double from_, to_;
  bool log_;
};

/// A little more than the range of values, so that no point lies on the frame.
Span widened(Span s, bool log) {
  if (log) {
    const double factor = std::max(std::pow(s.high / s.low, 0.04), 1.02);
    return {s.low / factor, s.high * factor};
  }
  const double more = std::max(0.05 * (s.high - s.low), 1e-3 * std::abs(s.high) + 1e-6);
  return {s.low - more, s.high + more};
}

std::string axes(const ChartSetting& setting, const Scale& x, const Scale& y) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string out;
  for (const double v : y.ticks(6))
    out += line_between(kLeft, y(v), right, y(v), "grid") +
           text_at(kLeft - 6, y(v) + kTextHalf, "end", tick_text(v), "tick");
  for (const double v : x.ticks(6))
    out += line_between(x(v), bottom, x(v), bottom + 4, "axis") +
           text_at(x(v), bottom + 18, "middle", tick_text(v), "tick");
  return out + line_between(kLeft, bottom, right, bottom, "axis") +
         text_at(right, kHeight - 8, "end", setting.x_name, "axis-name") +
         text_at(0, 14, "start", setting.y_name, "axis-name");
}

std::string marks(const ChartSeries& s, const Scale& x, const Scale& y) {
  std::string out;
  if (s.line && s.points.size() > 1) {
    out += "<polyline points=\"";
    for (const ChartPoint& p : s.points) out += n(x(p.x)) + "," + n(y(p.y)) + " ";
    out += "\"/>";
  }
  if (s.markers)
    for (const ChartPoint& p : s.points)
      out += "<circle cx=\"" + n(x(p.x)) + "\" cy=\"" + n(y(p.y)) + "\" r=\"3.5\"/>";
  for (const ChartPoint& p : s.points)
    if (!p.label.empty()) out += text_at(x(p.x) - 6, y(p.y) - 6, "end", p.label, "point-name");
  return "<g class=\"series " + s.style + "\">" + out + "</g>";
}

struct EndLabel {
  const ChartSeries* series;
  double x, y;
};

/// Moves labels that would overlap apart, within the chart.
void spread(std::vector<EndLabel>& labels) {
  std::sort(labels.begin(), labels.end(), [](const EndLabel& a, const EndLabel& b) { return a.y < b.y; });
  for (std::size_t i = 1; i < labels.size(); ++i)
    labels[i].y = std::max(labels[i].y, labels[i - 1].y + kLabelHeight);
  double lowest = kHeight - kBottom;
  for (std::size_t i = labels.size(); i-- > 0; lowest -= kLabelHeight)
    labels[i].y = std::min(labels[i].y, lowest);
}

/// Names at the ends of the lines: to the right where nothing follows, else above.
std::string names(const std::vector<ChartSeries>& series, const Scale& x, const Scale& y) {
  double last = 0;
  for (const ChartSeries& s : series)
    if (!s.points.empty()) last = std::max(last, x(s.points.back().x));
  std::vector<EndLabel> right;
  std::string out;
  for (const ChartSeries& s : series) {
    if (s.name.empty() || s.points.empty()) continue;
    const ChartPoint& end = s.points.back();
    if (x(end.x) < last - kLabelWidth || !end.label.empty())
      out += text_at(x(end.x) + 6, y(end.y) - 8, end.label.empty() ? "middle" : "start", s.name,
                     "name " + s.style);
    else
      right.push_back({&s, x(end.x) + 8, y(end.y) + kTextHalf});
  }
  spread(right);
  for (const EndLabel& l : right)
    out += text_at(l.x, l.y, "start", l.series->name, "name " + l.series->style);
  return out;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string line_chart(const ChartSetting& setting, const std::vector<ChartSeries>& series) {
  Span xs, ys;
  for (const ChartSeries& s : series) {
    for (const ChartPoint& p : s.points) {
      xs.take(p.x);
      ys.take(p.y);
    }
  }
  if (xs.low > xs.high) return "";
  if (setting.log_x || xs.low == xs.high) xs = widened(xs, setting.log_x);
  const Scale x(xs, kLeft, kWidth - kRight, setting.log_x);
  const Scale y(widened(ys, false), kHeight - kBottom, kTop, false);
  std::string content = axes(setting, x, y);
  for (const ChartSeries& s : series) content += marks(s, x, y);
  return svg(setting.title, content + names(series, x, y));
}

}  // namespace fbs::cli
