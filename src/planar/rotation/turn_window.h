// A range of angles with one set of segments: those that are not inside the obstacle at every angle of it, and the
// pairs of them that may meet.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "planar/dead_cells.h"
#include "planar/rotation/turn_catalog.h"

namespace dymsum::planar {

/// t in (t_low, t_high] of a chart.
struct TurnRange {
  int chart = 0;
  double t_low = 0, t_high = 0;
  double theta(double t) const { return 2 * std::atan(t) + (chart == 1 ? std::numbers::pi : 0.0); }
};

/// What does not depend on the window.
class TurnGrid {
 public:
  TurnGrid(const TurningForms& forms, int cells);
  const TurningForms& forms;
  SumGrid grid;
  Raster fixed;
  int cells;
};

/// Cells of the sum that are inside it at every angle within `half` of the one at which the turning operand's vertices are `turned`.
DeadCells dead_cells(const TurnGrid& base, const std::vector<Point>& turned, double half);

/// How far a point at p from the centre moves within `half` radians; the chord is shorter than the arc.
inline double moved(Point p, double half) { return (std::hypot(p.x, p.y) * half) * (1 + 0x1p-40); }

class TurnWindow {
 public:
  TurnWindow(const TurnGrid& base, const TurnCatalog& catalog, const TurnRange& range, bool mask);

  /// A pair of segments that may meet, a < b, by their numbers here.
  struct Meeting {
    std::uint32_t a = 0, b = 0;
  };
  TurnRange range;
  double low = 0, high = 0, middle = 0, half = 0;  ///< angles, rounded outwards
  Heading heading;                                 ///< of the middle
  std::vector<WalkSegment> segments;
  std::vector<Meeting> meetings;                   ///< sorted
  std::vector<Point> turned;                       ///< vertices of the turning operand at the middle, about its centre
  std::size_t all_segments = 0;                    ///< before the mask

 private:
  struct Box {
    double x0, y0, x1, y1;  ///< of both ends at all angles
    double ax, ay, bx, by;  ///< at the middle
    double reach;           ///< how far an end moves from there
  };
  Box box(const WalkSegment& s) const;
  void find_meetings(const DeadCells& dead);
  bool may_meet(std::uint32_t i, std::uint32_t j) const;

  const TurningForms& forms_;
  std::vector<Box> boxes_;
};

}  // namespace dymsum::planar
