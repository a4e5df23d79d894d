// Where the vertices of a scaling family stand at any scale: linear functions of it, exact ones rounded once.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "planar/motion/exact_frame.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/sum_bounds.h"

namespace dymsum::planar {

/// A vertex of a sum that scales: the sum of two vertices, or the crossing of two lines of fixed directions whose
/// heights are linear in the scale. So its coordinates are a + b (s - at), with a and b the doubles nearest to the
/// exact numbers, and `at` a scale at which the vertex is on the boundary: |a| and what is added to it are then no
/// larger than the sum is wide.
class ScaledPositions {
 public:
  explicit ScaledPositions(std::shared_ptr<const OperandPair> base);

  /// Adds the next vertices; they are on the boundary at the scale `at`.
  void add(std::span<const SumVertex> vertices, double at);

  /// Moves vertex k to where it stands at a scale, of which s is the nearest double. Returns a bound on the error of
  /// both coordinates, which is infinite where doubles know too little.
  double put(std::uint32_t k, double s, SumVertex& to) const {
    const Path& path = paths_[k];
    const double gap = s - path.at;
    to.at = {path.x + path.dx * gap, path.y + path.dy * gap};
    const double error = kPath * (path.size + path.speed * (s + std::abs(gap))) + exact::kSubnormal;
    return error <= kPoorPosition * (still_ + moved_ * s) ? error : INFINITY;
  }

 private:
  struct Path {
    double x = 0, y = 0, dx = 0, dy = 0, at = 0;
    double size = 0, speed = 0;  ///< the larger one of |x|, |y|; of |dx|, |dy|
  };
  Path corner(const SumVertex& v) const;
  Path crossing(const SumVertex& v, double at) const;

  // In roundings: of a 1 and of the sum, which is at most |a| + |b| |gap|, 1; of b 3 where a stretched coordinate is
  // rounded, of the gap and its product 1 each; the scale 1.
  static constexpr double kPath = exact::rounding_bound(6, 8);

  std::shared_ptr<const OperandPair> base_;
  std::array<FrameSource, 2> ends_;  ///< at the scales 1 and 2
  double still_ = 0, moved_ = 0;     ///< how wide the operands are, or how far from the origin
  std::vector<Path> paths_;
};

}  // namespace dymsum::planar
