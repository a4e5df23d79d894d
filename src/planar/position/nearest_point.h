// The nearest doubles of a sum's vertices: from one sum of doubles, from some thirty digits, or from the exact
// position, whichever decides first.
#pragma once

#include <optional>

#include "planar/position/exact_source.h"

namespace dymsum::planar {

class NearestPoint {
 public:
  /// Requires that the source outlives this.
  explicit NearestPoint(const ExactSource& source);

  /// Both coordinates correctly rounded, infinite past the double range.
  Point operator()(const SumVertex& vertex) const;

 private:
  struct Frame {
    base::DoublePair unit, x, y;
  };
  const ExactSource& source_;
  std::optional<Frame> frame_;
};

}  // namespace dymsum::planar
