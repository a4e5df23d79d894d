// The signs of a space of sums in intervals of many digits: the rungs between doubles and exact numbers. Where a third
// of all coordinates lie within 1e-16 of each other, as in turned solids, doubles leave thousands of signs open, and
// some thirty digits leave next to none but the zeros. At algebraic angles these are 1e-34 apart, and seventy digits
// do.
#pragma once

#include <optional>
#include <vector>

#include "exact/int.h"
#include "exact/interval.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// Every sign is the exact one, or nothing where it was not found; the cost is that of some hundred operations on
/// numbers. Coordinates are the space's own doubles over a power of two, with all digits that a number has: |x| <= 1.
/// N is FineInterval or WideInterval.
template <class N>
class IntervalSpace {
 public:
  using Number = N;
  using Vector = exact::Vector3<Number>;

  /// Keeps the references: planes and edges may be added.
  IntervalSpace(std::vector<Vector> p, std::vector<Vector> q, const std::vector<PlaneSource>& planes,
                const std::vector<SumEdge>& edges)
      : p_(std::move(p)), q_(std::move(q)), planes_(planes), edges_(edges) {}

  std::optional<int> side(const PlaneSource& plane, SumPoint point) const;
  std::optional<int> side(const PlaneSource& plane, const PointSource& point) const;
  std::optional<int> twist(const SumEdge& a, const SumEdge& b) const;
  std::optional<int> det(PlaneId a, PlaneId b, PlaneId c) const;
  std::optional<int> order(const PointSource& a, const PointSource& b, int axis) const;

 private:
  /// (x, y, z) / w.
  struct Position {
    Vector x;
    Number w;
  };
  /// Differences are taken before sums: of neighbours they are short.
  Vector between(SumPoint from, SumPoint to) const { return (p_[to.p] - p_[from.p]) + (q_[to.q] - q_[from.q]); }
  Vector direction(DirectionSource w) const;
  Vector along(const SumEdge& e) const;
  Vector normal(const PlaneSource& source) const;
  /// The position of a point of kind sum, edge or planes, as a vector from a sum.
  Position position(const PointSource& point, SumPoint origin) const;
  SumPoint beside(const PointSource& point) const;

  std::vector<Vector> p_, q_;
  const std::vector<PlaneSource>& planes_;
  const std::vector<SumEdge>& edges_;
};

using FineSpace = IntervalSpace<exact::FineInterval>;
using WideSpace = IntervalSpace<exact::WideInterval>;

}  // namespace dymsum::spatial
