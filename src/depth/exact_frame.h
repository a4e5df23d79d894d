// Exact positions as seen from the position that is queried: where planes of facets and facet edges meet, and the feet
// of that position on planes and lines.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "dymsum/rotation.h"
#include "exact/big.h"
#include "exact/grid.h"
#include "exact/int.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/mesh/box_tree.h"

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

// The boundary of one operand as points, segments and triangles, for the search of what touches.

using BigVector = exact::Vector3<exact::Big>;

/// Vertices in ascending order, kNoVertex behind them: a point, a segment or a triangle.
using Simplex = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kNoVertex = 0xffffffff;
inline int dimension_of(const Simplex& s) { return s[1] == kNoVertex ? 0 : s[2] == kNoVertex ? 1 : 2; }

struct TouchSide {
  std::vector<Point3> at;            ///< of vertices
  std::vector<Simplex> simplices;    ///< none is a side of another one
  std::vector<SolidFeature> inside;  ///< per simplex: the feature that its relative interior belongs to
  /// The same of segments that are sides of triangles inside a face, or edges with a name of their own.
  std::map<std::array<std::uint32_t, 2>, SolidFeature> sides;
  /// Vertices are to be turned by this integer matrix over an integer.
  std::array<std::int64_t, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::int64_t den = 1;

  void turn(const Rotation& rotation);
  /// The feature that the relative interior of a side of simplex `of`, or of itself, belongs to.
  SolidFeature feature(const Simplex& side, std::uint32_t of) const;
  /// A vertex, turned: times den, in units of 2^exponent, which divides its coordinates.
  BigVector exact(std::uint32_t vertex, int exponent) const;
  /// The same times 2^-scale, in doubles: each coordinate within 2^-49 of the largest one of all vertices.
  spatial::Vec3 approx(std::uint32_t vertex, int scale) const;
};

/// The side of a mesh: faces cut into triangles, points and segments as they are. Features by its indices.
TouchSide touch_side(const Mesh& mesh);
/// The side of a region: its edges at height 0; an edge is named by the vertex that it starts from, as `a`.
TouchSide touch_side(const Region& region);

}  // namespace dymsum::depth
