#include "planar/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace dymsum::bench {
namespace {

constexpr double kWidth = 1000, kLeft = 78, kRight = 24, kTop = 84, kPanel = 400;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", std::round(x * 100) / 100);
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else result += c;
  }
  return result;
}

/// The page that is being written and the position of the panel on it.
class Sheet {
 public:
  Sheet(const PlotText& text, double low, double high, bool logarithmic)
      : text_(text), low_(low), high_(high), logarithmic_(logarithmic), below_(label_room(text)) {
    const double height = kTop + kPanel + below_;
    svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(kWidth) + " " + number(height) +
           "\" width=\"" + number(kWidth) + "\" height=\"" + number(height) +
           "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\">\n"
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    write(kLeft, 28, text.title, "font-size=\"18\" font-weight=\"bold\"");
    write(kLeft, 48, text.note, "fill=\"#555555\"");
    write(22, kTop + kPanel / 2, text.y_axis,
          "text-anchor=\"middle\" transform=\"rotate(-90 22 " + number(kTop + kPanel / 2) + ")\"");
    write(kLeft + panel_width() / 2, kTop + kPanel + below_ - 10, text.x_axis, "text-anchor=\"middle\"");
    for (std::size_t i = 0; below_ > 60 && i < text.positions.size(); ++i) {
      const std::string at = number(x(i) + 3) + " " + number(kTop + kPanel + 8);
      write(x(i) + 3, kTop + kPanel + 8, text.positions[i],
            "font-size=\"9.5\" text-anchor=\"end\" transform=\"rotate(-90 " + at + ")\"");
    }
  }

  double panel_width() const { return kWidth - kLeft - kRight; }
  double step() const { return panel_width() / std::max<double>(1, static_cast<double>(text_.positions.size())); }
  double x(std::size_t i) const { return kLeft + (static_cast<double>(i) + 0.5) * step(); }
  double y(double value) const {
    const double fraction =
        logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
    return kTop + kPanel * (1 - fraction);
  }

  void write(double x, double y, const std::string& words, const std::string& style = "") {
    svg_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + style + ">" + escaped(words) + "</text>\n";
  }
  void line(double value, const std::string& style) {
    svg_ += "<line x1=\"" + number(kLeft) + "\" x2=\"" + number(kWidth - kRight) + "\" y1=\"" + number(y(value)) +
            "\" y2=\"" + number(y(value)) + "\" " + style + "/>\n";
  }
  void tick(double value) {
    line(value, "stroke=\"#dddddd\"");
    write(kLeft - 8, y(value) + 4, number(value), "text-anchor=\"end\"");
  }
  void dot(std::size_t i, double value, const Series& series) {
    svg_ += "<circle cx=\"" + number(x(i)) + "\" cy=\"" + number(y(value)) + "\" r=\"3.4\" fill=\"" + series.colour +
            "\" fill-opacity=\"0.85\"><title>" + escaped(text_.positions[i]) + ": " + number(value) +
            "</title></circle>\n";
  }
  void bar(std::size_t i, double from, double to, const Series& series) {
    svg_ += "<rect x=\"" + number(x(i) - 0.42 * step()) + "\" width=\"" + number(0.84 * step()) + "\" y=\"" +
            number(y(to)) + "\" height=\"" + number(y(from) - y(to)) + "\" fill=\"" + series.colour + "\"><title>" +
            escaped(text_.positions[i]) + ", " + escaped(series.name) + ": " + number(100 * (to - from)) +
            " %</title></rect>\n";
  }
  void legend(const std::vector<Series>& series) {
    double at = kLeft;
    for (const Series& one : series) {
      svg_ += "<rect x=\"" + number(at) + "\" y=\"60\" width=\"12\" height=\"12\" fill=\"" + one.colour + "\"/>\n";
      write(at + 17, 71, one.name);
      at += 40 + 7.6 * static_cast<double>(one.name.size());
    }
  }
  std::string finish() {
    svg_ += "<rect x=\"" + number(kLeft) + "\" y=\"" + number(kTop) + "\" width=\"" + number(panel_width()) +
            "\" height=\"" + number(kPanel) + "\" fill=\"none\" stroke=\"#333333\"/>\n</svg>\n";
    return std::move(svg_);
  }

 private:
  /// Labels below the positions only where each has 9 units of width.
  static double label_room(const PlotText& text) {
    std::size_t longest = 0;
    for (const std::string& label : text.positions) longest = std::max(longest, label.size());
    return text.positions.size() * 9 > kWidth - kLeft - kRight ? 40 : 40 + 6.2 * static_cast<double>(longest);
  }

  const PlotText& text_;
  double low_, high_;
  bool logarithmic_;
  double below_;
  std::string svg_;
};

}  // namespace

std::string colour(std::size_t index) {
  static const std::array<const char*, 10> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                   "#56b4e9", "#f0e442", "#777777", "#000000", "#8c510a"};
  return colours[index % colours.size()];
}

std::string draw_dots(const PlotText& text, const std::vector<Series>& series, const std::vector<Mark>& marks) {
  double least = 1e300, most = 0;
  const auto seen = [](double value) { return value > 0 && std::isfinite(value); };
  const auto extend = [&](double value) {
    if (!seen(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  };
  for (const Series& one : series) {
    for (const double value : one.values) extend(value);
  }
  for (const Mark& mark : marks) extend(mark.value);
  if (most <= 0) least = 1, most = 10;
  double low = 1, high = 1;
  while (low > least) low /= 10;
  while (low * 10 <= least) low *= 10;
  while (high < most * 1.05) high *= 10;
  if (high <= low) high = low * 10;
  Sheet sheet(text, low, high, true);
  for (double value = low; value <= high * 1.01; value *= 10) sheet.tick(value);
  for (const Mark& mark : marks) {
    sheet.line(mark.value, "stroke=\"#444444\" stroke-dasharray=\"6 4\"");
    sheet.write(kWidth - kRight - 6, sheet.y(mark.value) - 5, mark.label, "text-anchor=\"end\" fill=\"#444444\"");
  }
  for (const Series& one : series) {
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      if (seen(one.values[i])) sheet.dot(i, one.values[i], one);
    }
  }
  if (series.size() > 1) sheet.legend(series);
  return sheet.finish();
}

std::string draw_fractions(const PlotText& text, const std::vector<Series>& series) {
  Sheet sheet(text, 0, 1, false);
  for (const double value : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) sheet.tick(value);
  for (std::size_t i = 0; i < text.positions.size(); ++i) {
    double total = 0, done = 0;
    for (const Series& one : series) total += one.values[i];
    if (total <= 0) continue;
    for (const Series& one : series) {
      const double next = done + one.values[i] / total;
      if (next > done) sheet.bar(i, done, next, one);
      done = next;
    }
  }
  sheet.legend(series);
  return sheet.finish();
}

}  // namespace dymsum::bench
