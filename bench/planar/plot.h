// Plots as SVG text: one panel, axes, dots or stacked bars, a legend. Just enough for the figures in docs/results.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dymsum::bench {

struct Series {
  std::string name;
  std::string colour;
  std::vector<double> values;  ///< one per position on the x axis; not positive or not finite: left out
};

struct PlotText {
  std::string title, x_axis, y_axis;
  std::vector<std::string> positions;  ///< a label per position, shown when hovering and, where there is room, below
  std::string note;                    ///< below the title
};

/// A y value worth a line and a word.
struct Mark {
  double value;
  std::string label;
};

/// Dots over positions, y logarithmic.
std::string draw_dots(const PlotText& text, const std::vector<Series>& series, const std::vector<Mark>& marks = {});

/// Bars over positions, each stacked to 1 of the series' shares.
std::string draw_fractions(const PlotText& text, const std::vector<Series>& series);

/// Colours that stay apart for the colour-blind (Okabe and Ito).
std::string colour(std::size_t index);

}  // namespace dymsum::bench
