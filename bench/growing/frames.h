// Frames: a sum at a given radius from what is kept, against making it from nothing.
#pragma once

#include <string>
#include <vector>

#include "dymsum/region.h"
#include "page.h"

namespace dymsum::bench {

struct FrameRow {
  std::string name;
  std::size_t vertices = 0, events = 0, frames = 0, pieces = 0;  ///< pieces of all frames together
  double complex_ms = 0;                                         ///< what is kept, made once
  double frame_ms = 0;                                           ///< median of a frame
  double anew_ms = 0;                                            ///< median of the complex and one level of it
  double polygon_ms = 0;                                         ///< median of our sum with a disc of 32 vertices
};

/// `frames` radii from 0 to `fraction` of the extent, evenly; static ones are timed at `samples` of them.
FrameRow measure_frames(const std::string& name, const Region& region, double fraction, std::size_t frames,
                        std::size_t samples);
void report_frames(Report& report, const std::vector<FrameRow>& rows);

}  // namespace dymsum::bench
