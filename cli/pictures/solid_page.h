// A page that plays the frames of a solid in motion.
#pragma once

#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "pictures/page.h"

namespace dymsum::cli {

struct SolidPicture {
  std::string label;
  SolidSum sum;
};

/// One HTML page: drag to look around, slider and play button, facets coloured by kind or by whether they changed,
/// ticks at events. A convex solid needs no depth order: facets that look towards the viewer are all seen. No network,
/// no library.
std::string solid_page(const std::vector<SolidPicture>& frames, const std::vector<SliderTick>& events,
                       const std::string& title);

}  // namespace dymsum::cli
