// Pictures of a sum that scales: a film strip, an animation, and a page that scrubs through the frames.
#pragma once

#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "svg_paths.h"

namespace dymsum::cli {

/// What a picture needs of a frame.
struct PicturedFrame {
  double s = 1;
  std::string label;  ///< the exact scale, or its digits where that is long
  Drawn set;
};

PicturedFrame pictured(const ScalingSum& sum);

/// The frames side by side in one scale of drawing, at most `columns` in a row; SVG text.
std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns);

/// The frames one after the other, for ever; SVG text with declarative animation and no script. What does not animate shows the first frame.
std::string animation(const std::vector<PicturedFrame>& frames);

/// One HTML page with a slider over the frames and ticks at the events; no network, no library.
std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<ScaleEvent>& events, const std::string& title);

}  // namespace dymsum::cli
