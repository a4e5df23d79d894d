// One pose of a robot against an obstacle, in doubles with bounds: a proved overlap, a proved gap, or neither.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"

namespace dymsum::planar {

/// A region's rings as vertices and edges by their indices in the region.
struct Outline {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> next;    ///< the other end of the edge that starts at a vertex
  std::vector<std::uint32_t> before;  ///< the start of the edge that ends at a vertex
  std::vector<std::uint32_t> rings;   ///< the first vertex of every ring
  explicit Outline(const Region& region);
  Outline() = default;
};

/// Requires that the largest of all coordinates, those of poses too, is neither so small nor so large that squares
/// leave the range of doubles.
class Pose {
 public:
  /// All coordinates times `scale`, a power of two that leaves them exact.
  Pose(const Region& robot, const Region& obstacle, double scale = 1);

  enum class Overlap : std::uint8_t { no, yes, unsure };
  struct Gap {
    double at_least = 0;  ///< the distance of the boundaries is at least this
    Contact nearest;
  };

  const Outline& robot() const { return robot_; }
  const Outline& obstacle() const { return obstacle_; }
  double reach() const { return reach_; }  ///< of the robot about its origin, at least

  /// The robot rotated by (c, s) and moved to (x, y), where each coordinate of its vertices errs by at most `slack`
  /// more than rounding makes it: whether the interiors meet. `no` says that the closed sets do not meet. O(nm).
  Overlap overlap(double x, double y, double c, double s, double slack);
  Gap gap(double x, double y, double c, double s, double slack);

 private:
  double position(double x, double y, double c, double s, double slack);

  Outline robot_, obstacle_;
  std::vector<Point> placed_;
  double reach_ = 0, span_ = 0;
};

}  // namespace dymsum::planar
