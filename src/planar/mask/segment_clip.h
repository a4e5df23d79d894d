// The part of a segment that lies in a box, for pieces of segments in cells of a grid.
#pragma once

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

/// A segment from (x, y) with a vector, to be clipped by many boxes.
class SegmentClip {
 public:
  SegmentClip(double x, double y, double dx, double dy) : x_(x), y_(y), per_x_(1 / dx), per_y_(1 / dy) {}

  /// Fractions of the segment; nothing of it where from > to. Each errs by three roundings.
  struct Part {
    double from = 0, to = 1;
    double midpoint() const { return 0.5 * (from + to); }
  };
  /// What lies in [x0, x1] x [y0, y1].
  Part within(double x0, double y0, double x1, double y1) const {
    Part part;
    meet(part, x0 - x_, x1 - x_, per_x_);
    meet(part, y0 - y_, y1 - y_, per_y_);
    return part;
  }

 private:
  static void meet(Part& part, double low, double high, double per) {
    if (std::isinf(per)) {  // upright or level: all of it or nothing
      if (low > 0 || high < 0) part.to = -1;
      return;
    }
    const double u = low * per, v = high * per;
    part.from = std::max(part.from, std::min(u, v));
    part.to = std::min(part.to, std::max(u, v));
  }
  double x_, y_, per_x_, per_y_;
};

}  // namespace dymsum::planar
