// Affine maps of drawings, in doubles.
#pragma once

#include "dymsum/region.h"

namespace dymsum::io {

/// (x, y) -> (a x + c y + e, b x + d y + f).
struct PlaneTransform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  bool identity() const { return a == 1 && b == 0 && c == 0 && d == 1 && e == 0 && f == 0; }
  /// This after `inner`.
  PlaneTransform after(const PlaneTransform& inner) const;
  /// Coordinates are rounded as they are computed, except under the identity, and infinite past the double range.
  Point apply(Point p) const;
  /// The image of a vector: without e and f.
  Point apply_vector(Point v) const;
};

}  // namespace dymsum::io
