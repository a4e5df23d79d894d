// Pictures of a sum that scales: a film strip, and a page that scrubs through the frames.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"

namespace dymsum::cli {

/// What a picture needs of a frame.
struct PicturedFrame {
  double s = 1;
  std::string label;   ///< the exact scale
  std::string path;    ///< SVG path data of the rings, y downwards
  std::vector<Point> tight;
  std::array<double, 4> box{};  ///< min x, min y, max x, max y, y downwards
};

PicturedFrame pictured(const ScalingSum& sum);

/// The frames side by side in one scale of drawing, at most `columns` in a row; SVG text.
std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns);

/// One HTML page with a slider over the frames and ticks at the events; no network, no library.
std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<ScaleEvent>& events, const std::string& title);

}  // namespace dymsum::cli
