// The exact lexicographic order of a sum's vertices, decided by doubles wherever they are far enough apart.
#pragma once

#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// True when two vertices have the same provenance, and therefore the same position.
inline bool same_position(const SumVertex& a, const SumVertex& b) {
  if (a.corner_p != SumVertex::kNone && a.corner_q != SumVertex::kNone)
    return a.corner_p == b.corner_p && a.corner_q == b.corner_q;
  return b.corner_p == SumVertex::kNone && a.in == b.in && a.out == b.out;
}

class VertexOrder {
 public:
  /// Requires |at - exact| <= at_error in each coordinate of every vertex that is compared.
  VertexOrder(const ExactSource& source, double at_error) : source_(source), slack_(2 * at_error) {}

  /// Lexicographic order of the exact positions: -1, 0, 1.
  int compare(const SumVertex& a, const SumVertex& b) const {
    if (const double d = a.at.x - b.at.x; d > slack_ || d < -slack_) return d > 0 ? 1 : -1;
    if (same_position(a, b)) return 0;
    if (slack_ == 0) return a.at.y != b.at.y ? (a.at.y > b.at.y ? 1 : -1) : 0;  // the doubles are the exact positions
    if (const int sign = source_.compare_x(a, b); sign != 0) return sign;
    if (const double d = a.at.y - b.at.y; d > slack_ || d < -slack_) return d > 0 ? 1 : -1;
    return source_.compare_y(a, b);
  }

  /// True when doubles prove that a lies to the right of b.
  bool provably_right(const SumVertex& a, const SumVertex& b) const { return a.at.x - b.at.x > slack_; }

 private:
  const ExactSource& source_;
  double slack_;  // subtraction rounds monotonically, so a computed difference above 2 at_error is above it exactly
};

}  // namespace dymsum::planar
