// Exact positions as seen from the position that is queried: where planes of facets and facet edges meet, and the feet
// of that position on planes and lines.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "exact/big.h"
#include "exact/grid.h"
#include "exact/vector3.h"
#include "spatial/convolution/reduced_facets.h"

namespace dymsum::depth {

using exact::Big;
using exact::BigRational;
using BigVector = exact::Vector3<Big>;

/// n . x = d.
struct ExactPlane {
  BigVector n;
  Big d;
};

/// x / w, w > 0, in the units of a frame.
struct ExactPosition {
  BigVector x;
  Big w;
};

/// Positions are relative to `origin`, in units of a power of two that divides all coordinates, over the least number
/// that makes the origin's whole.
class ExactFrame {
 public:
  ExactFrame(const std::vector<Point3>& p, const std::vector<Point3>& q, int exponent,
             std::array<BigRational, 3> origin);

  BigVector corner(spatial::SumPoint s) const;
  ExactPlane plane(const spatial::SumFacet& facet) const;
  /// The plane through the facet edge from corner k on, and across the facet's plane; its normal points into the facet.
  ExactPlane facet_edge(const spatial::SumFacet& facet, int k) const { return facet_edge(facet, k, plane(facet)); }

  static ExactPosition foot(const ExactPlane& a);
  /// Nothing for parallel planes.
  static std::optional<ExactPosition> foot(const ExactPlane& a, const ExactPlane& b);
  /// Nothing where they do not meet in one point.
  static std::optional<ExactPosition> meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c);
  static int side(const ExactPlane& plane, const ExactPosition& x);

  /// The position of a facet that is nearest to the origin.
  ExactPosition nearest(const spatial::SumFacet& facet) const;
  bool holds(const spatial::SumFacet& facet, const ExactPosition& x) const;

  /// The position as a vector from the origin, in the operands' own units.
  std::array<BigRational, 3> relative(const ExactPosition& x) const;
  std::array<BigRational, 3> absolute(const ExactPosition& x) const;
  const std::array<BigRational, 3>& origin() const { return at_; }
  /// The position that is seen there.
  ExactPosition position(const std::array<BigRational, 3>& relative) const;
  /// A length.
  BigRational in_operand_units(const BigRational& v) const;

 private:
  BigVector vertex(const Point3& v) const;
  ExactPlane facet_edge(const spatial::SumFacet& facet, int k, const ExactPlane& plane) const;
  bool within_facet_edges(const spatial::SumFacet& facet, const ExactPlane& plane, const ExactPosition& x) const;

  const std::vector<Point3>&p_, &q_;
  std::array<BigRational, 3> at_;
  exact::BigInteger parts_ = 1;  ///< of the power of two that make it the unit; odd
  int exponent_;
  BigVector origin_;
};

/// The order of the squares of two distances from the origin: -1, 0, 1.
int compare_lengths(const ExactPosition& a, const ExactPosition& b);
bool same_position(const ExactPosition& a, const ExactPosition& b);

/// A double as a multiple of 2^exponent, which divides it.
Big in_units(double v, int exponent);
BigVector times(const Big& s, const BigVector& v);

/// The largest power of two that divides all coordinates of the solids; 0 where all are zero.
int common_exponent(const std::vector<Point3>& p, const std::vector<Point3>& q);

}  // namespace dymsum::depth
