// The pairs of tables 4.1 and 4.2: a robot that turns, an obstacle that stands still, what the thesis prints of them.
#pragma once

#include <string>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/region.h"

namespace dymsum::bench {

/// What the thesis prints in tables 4.1 and 4.2, its machine running at 2.13 GHz; zeros where it prints nothing.
struct PrintedObstacle {
  double seconds = 0;
  int surfaces = 0, patches = 0, shells = 0;
  int complete = 0, complete_crossings = 0, reduced = 0, reduced_crossings = 0;
};

struct TurningPair {
  std::string name;    ///< as the thesis writes it
  std::string shapes;  ///< where the operands come from
  Region robot, obstacle;
  PrintedObstacle thesis;
};

/// The eight pairs of the thesis and one of our own that encloses many cavities. The thesis's own polygons where `data`
/// has them, generated ones of as many vertices elsewhere; `data` is the folder with planar/, or empty.
std::vector<TurningPair> turning_pairs(const std::string& data);

/// Robots and obstacles whose contacts coincide at many angles at once.
std::vector<TurningPair> symmetric_pairs();

/// The same pairs in coordinates of a kind; what rounding spoils is left out, with a note.
std::vector<TurningPair> with_coordinates(std::vector<TurningPair> pairs, Kind kind, std::vector<std::string>& notes);

}  // namespace dymsum::bench
