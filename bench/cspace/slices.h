// What one obstacle of all orientations replaces: slices at equally spaced orientations, by our static engine and by
// CGAL's reduced convolution.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cspace/turning_pairs.h"

namespace dymsum::bench {

struct SlicesRow {
  std::string name;
  double ours_ms = 0;             ///< of 360 slices by our static engine
  double fine_ms = 0;             ///< of 3600
  bool fine_measured = false;     ///< and not ten times the 360
  double cgal_ms = 0;             ///< of 360 slices by CGAL
  std::size_t cgal_measured = 0;  ///< of the 360; the time is scaled
  std::size_t compared = 0;       ///< answers of both, of which differ in:
  std::size_t vertices_differ = 0, holes_differ = 0, area_differs = 0, any_differs = 0;
  std::size_t exact_areas = 0;             ///< compared as fractions; the others to twelve digits
  std::size_t unfinished = 0;              ///< orientations at which CGAL gave no answer
  std::size_t confirmed = 0, queried = 0;  ///< of CGAL's vertical decomposition, where both differ
  std::vector<std::string> remarks;
};

/// 360 orientations, one a degree, each the simplest within 1e-6 radians. Processor times. CGAL computes 36 equally
/// spaced ones, and all where these suggest less than 30 s. Everyone sums the same exact vertices.
SlicesRow measure_slices(const TurningPair& pair);

}  // namespace dymsum::bench
