// A scatter plot as SVG text, both axes logarithmic.
#pragma once

#include <string>
#include <vector>

namespace dymsum::bench {

struct Dot {
  double x, y;
};
std::string draw_scatter(const std::string& title, const std::string& x_axis, const std::string& y_axis,
                         const std::vector<Dot>& left, const std::string& second_x_axis, const std::vector<Dot>& right);

}  // namespace dymsum::bench
