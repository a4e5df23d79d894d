// Maps of ranges of headings: where a robot hits something at some heading of the range.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "inputs.h"
#include "report.h"
#include "timing.h"

namespace dymsum::cli {

struct SlabOptions {
  std::size_t slabs = 0;
  double tolerance = 1e-3;  ///< of the sets, times their extent
  double resolution = 0;    ///< the size of a cell; 0: a 256th of the longer side
  Progress progress;
};

/// The set of all positions of the robot at which it hits the obstacle at some heading from `from` to `to`, radians,
/// and a little more: it holds all of them exactly.
struct SlabMap {
  double from = 0, to = 0;
  PlanarSum set;
  std::vector<std::uint8_t> blocked;  ///< cells that the set meets, row by row from below
};
struct SlabMaps {
  std::string folder;
  double x = 0, y = 0, cell = 0;  ///< the lower left corner, the size of a cell
  std::size_t width = 0, height = 0;
  double tolerance = 0;
  std::vector<SlabMap> slabs;
};

/// Inputs: the robot, the obstacle. Stops where the tolerance takes too many orientations.
SlabMaps slab_maps(const std::vector<Input>& inputs, const SlabOptions& options, const std::string& folder);
/// slab_000.pgm, .yaml and .wkt and so on; the folder is made where it is missing.
void write_slab_maps(const SlabMaps& maps);
Json slab_json(const SlabMaps& maps, const std::vector<Input>& inputs, const Timing& timing);
void print_slabs(std::ostream& out, const SlabMaps& maps);

}  // namespace dymsum::cli
