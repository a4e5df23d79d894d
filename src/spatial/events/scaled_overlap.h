// Whether the solids overlap at a position and a scale, in doubles with a margin: fixed solid F and x - s M, M being
// the one that scales. Says so only where it is sure.
#pragma once

#include "spatial/events/moving_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/moving/inner_balls.h"

namespace dymsum::spatial {

class ScaledOverlap {
 public:
  enum class Answer : std::uint8_t { apart, overlap, unsure };

  explicit ScaledOverlap(const MovingFacets& all);

  /// For all positions within `radius` of x and scales within `s_radius` of s.
  Answer at(Vec3 x, double s, double radius, double s_radius) const;
  /// Whether the facet lies in the open sum at all scales from `low` to `high`. A "no" says nothing.
  bool deep_inside(const SumFacet& facet, double low, double high) const;

 private:
  struct Placed {
    Vec3 x;
    double s, blur;
  };
  struct BallPair {
    std::uint32_t f = 0, m = 0;
  };
  double gap(BallPair pair, Vec3 x, double s) const;
  BallPair nearest_balls(Vec3 x, double s) const;
  Answer triangles(const Placed& at, std::uint32_t i, std::uint32_t j) const;
  bool contained(const Placed& at, bool& sure) const;
  const SolidOperand& fixed() const;
  const SolidOperand& moving() const;

  const MovingFacets& all_;
  int f_, m_;  // operands
  BoxTree trees_[2];
  InnerBalls balls_[2];  // on the grid
};

}  // namespace dymsum::spatial
