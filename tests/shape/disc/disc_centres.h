// Which points discs of a region reach, by definition: all positions where a centre can be nearest to a point.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/growing_disc.h"

namespace dymsum::oracles {

/// Centres at a distance of at least `radius` from the region, or from its complement, with slack 1e-9. Doubles, for
/// regions whose coordinates are small and whose events are further apart than that.
class DiscCentres {
 public:
  DiscCentres(const Region& region, DiscSide side, double radius);

  double clearance(Point c) const;
  /// How far the nearest centre is; nothing where there is none.
  std::optional<double> nearest(Point z) const;
  /// Where two of the curves at this distance from edges and vertices meet.
  const std::vector<Point>& corners() const { return corners_; }

 private:
  struct Line {
    Point a, direction;  ///< unit
  };
  bool is_centre(Point c) const { return clearance(c) >= radius_ - 1e-9; }
  void see(Point c) {
    if (is_centre(c)) corners_.push_back(c);
  }
  void meet(const Line& line, Point v);
  void meet(Point v, Point w);

  const Region& region_;
  DiscSide side_;
  double radius_;
  std::vector<Line> lines_;
  std::vector<Point> vertices_, corners_;
};

}  // namespace dymsum::oracles
