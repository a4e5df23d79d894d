// A page that plays the frames of a sum of solids of any shape.
#pragma once

#include <string>
#include <vector>

#include "dymsum/moving_solid_sum.h"
#include "pictures/page.h"

namespace dymsum::cli {

struct MovingSolidPicture {
  std::string label;
  SpatialSum sum;
  SolidFrameChanges changes;  ///< from the frame before
};

/// One HTML page: drag to look around, wheel or pinch to come nearer, slider and play button; faces coloured by kind or
/// by whether they are new, what is tight in magenta, ticks at events, or where there are none given at frames whose
/// shells or tight features are others. WebGL, with a depth buffer; no network, no library. Stops where a vertex is
/// past the range of doubles.
std::string moving_solid_page(const std::vector<MovingSolidPicture>& frames, const std::vector<SliderTick>& events,
                              const std::string& title);

}  // namespace dymsum::cli
