// All pairs of features of two operands that touch at an exact position of one of them.
#pragma once

#include <vector>

#include "depth/boundary_distance.h"
#include "depth/exact_frame.h"

namespace dymsum::depth {

class TouchingPairs;

/// The moves, sorted, with their directions and with what touches where Q, moved by `from`, has made them; without
/// contacts where there are no pairs to ask.
std::vector<SolidWay> ways_of(std::vector<RationalVector> moves, const RationalVector& from,
                              const TouchingPairs* touching);

/// Operands ready to be asked; the Q of one orientation. Thread-safe.
class TouchingPairs {
 public:
  TouchingPairs(TouchSide p, TouchSide q);

  /// What touches where Q is moved by `x`: pairs of features whose relative interiors have positions in common, one for
  /// each connected piece of these; the greatest dimension first, then by p, q and position. Requires interiors that do
  /// not overlap there. Exact: doubles only leave out what provably is apart. O(log n + k log k) for k pairs of
  /// simplices that come near each other.
  std::vector<SolidTouch> at(const RationalVector& x) const;

 private:
  TouchSide p_, q_;
  int scale_ = 0;     // doubles are times 2^-scale_
  int exponent_ = 0;  // 2^exponent_ divides all coordinates
  std::vector<spatial::Vec3> p_at_, q_at_;
  spatial::BoxTree p_tree_, q_tree_;  // the second one of Q reflected
  friend class TouchSearch;
};

}  // namespace dymsum::depth
