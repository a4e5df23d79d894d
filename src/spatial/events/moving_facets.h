// The facets of P (+) Q while one operand scales: their corners are f + s m, and their planes keep their normals, so
// that all that they do is linear in s. The reduced convolution is the same at every s > 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exact/big.h"
#include "spatial/convex/exact_places.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

/// The moving plane n . x = d0 + s d1, in units of the operands' grid; a hyperplane of (x, s).
struct MovingPlane {
  BigVector n;
  exact::BigInteger d0, d1;
};
/// A linear function of the scale, a + s b: each within 2^-52 of its size, so zero only where it is zero.
struct SureForm {
  double a = 0, b = 0;
};
/// The same hyperplane in doubles, each within 2^-53 of its size, over one power of two: n, -d1, d0.
using PlaneRow = std::array<double, 5>;

/// Part of a facet's border: an edge of sums, with the facets that it bounds.
struct MovingBorder {
  SumPoint a, b;
  std::uint32_t first = 0, last = 0;  ///< of MovingFacets::border_facets
  bool inner = false;                 ///< between two triangles of one face
  bool of_p = false;                  ///< along an edge of P
  std::uint32_t direction = 0;        ///< the same for parallel ones
};
struct MovingCorner {
  SumPoint at;
  std::uint32_t first = 0, last = 0;  ///< of MovingFacets::corner_facets
};

class MovingFacets {
 public:
  /// P (`moving` 0) or Q (1) scales. Requires operands without thin parts that are not empty; the pair has to live as
  /// long.
  MovingFacets(const SolidPair& pair, int moving, StageWatch& watch);

  const SolidPair& pair() const { return *pair_; }
  int moving() const { return moving_; }
  const ReducedConvolution& convolution() const { return convolution_; }
  const std::vector<SumFacet>& facets() const { return convolution_.facets; }
  const std::vector<MovingBorder>& borders() const { return borders_; }
  const std::vector<MovingCorner>& corners() const { return corners_; }
  std::span<const std::uint32_t> facets_of(const MovingBorder& b) const {
    return {border_facets_.data() + b.first, border_facets_.data() + b.last};
  }
  std::span<const std::uint32_t> facets_of(const MovingCorner& c) const {
    return {corner_facets_.data() + c.first, corner_facets_.data() + c.last};
  }
  std::uint32_t border_of(std::uint32_t facet, int k) const { return facet_borders_[4 * facet + k]; }
  std::uint32_t corner_of(std::uint32_t facet, int k) const { return facet_corners_[4 * facet + k]; }

  /// A corner is fixed(c) + s moved(c), in doubles each within 2^-53 of its size.
  Vec3 fixed(SumPoint c) const { return moving_ == 0 ? places_[1][c.q] : places_[0][c.p]; }
  Vec3 moved(SumPoint c) const { return moving_ == 0 ? places_[0][c.p] : places_[1][c.q]; }
  Vec3 at(SumPoint c, double s) const { return fixed(c) + s * moved(c); }
  /// Whether corners are sums with the same vertex of the operand that does not scale, or of that which does.
  bool same_fixed(SumPoint a, SumPoint b) const { return moving_ == 0 ? a.q == b.q : a.p == b.p; }
  bool same_moved(SumPoint a, SumPoint b) const { return moving_ == 0 ? a.p == b.p : a.q == b.q; }
  const BigVector& exact_fixed(SumPoint c) const { return moving_ == 0 ? exact_[1][c.q] : exact_[0][c.p]; }
  const BigVector& exact_moved(SumPoint c) const { return moving_ == 0 ? exact_[0][c.p] : exact_[1][c.q]; }
  const std::vector<Vec3>& places(int operand) const { return places_[operand]; }

  const MovingPlane& plane(std::uint32_t facet) const { return planes_[facet]; }
  const PlaneRow& row(std::uint32_t facet) const { return rows_[facet]; }
  /// The same for facets that lie in one plane at every scale.
  std::uint32_t hyperplane(std::uint32_t facet) const { return hyperplanes_[facet]; }
  /// Two planes along a border whose directions differ: its 2-flat of (x, s) is where they cross.
  const std::array<MovingPlane, 2>& planes_of(std::uint32_t border) const { return border_planes_[border]; }
  const std::array<PlaneRow, 2>& rows_of(std::uint32_t border) const { return border_rows_[border]; }
  /// As hyperplane(), of these planes, and by the same names.
  const std::array<std::uint32_t, 2>& hyperplanes_of(std::uint32_t border) const { return border_hyperplanes_[border]; }

  /// The height of a corner over a facet's plane, times the length of its normal; nothing where coordinates are too
  /// large for 128 bits.
  std::optional<SureForm> sure_height(SumPoint corner, std::uint32_t facet) const;
  /// det(e, h, gap) for the borders from e[0] to e[1] and from h[0] to h[1], without the scale in their lengths, and
  /// the gap from e[0] to h[0].
  std::optional<SureForm> sure_twist(const std::array<SumPoint, 2>& e, const std::array<SumPoint, 2>& h) const;

  /// At least the largest coordinate of any sum at scales up to s.
  double span(double s) const { return reach_[1 - moving_] + s * reach_[moving_]; }
  /// The pose of either operand at a scale.
  PosePair poses(const Scale& s) const;

 private:
  void list_borders();
  void name_planes();
  void keep_small();
  std::array<MovingPlane, 2> planes_along(const MovingBorder& border) const;
  void list_corners();
  void mark_inner();

  const SolidPair* pair_;
  int moving_;
  ReducedConvolution convolution_;
  std::array<std::vector<BigVector>, 2> exact_;
  using SmallVector = std::array<std::int64_t, 3>;
  /// n . (to - from).
  SureForm form_of(const SmallVector& n, SumPoint from, SumPoint to) const;

  std::array<std::vector<Vec3>, 2> places_;
  bool small_ = false;                                // all coordinates are
  std::array<std::vector<SmallVector>, 2> integers_;  // where they are small, as are the normals
  std::vector<SmallVector> small_normals_;
  std::array<double, 2> reach_{};
  std::vector<MovingPlane> planes_;
  std::vector<PlaneRow> rows_;
  std::vector<std::uint32_t> hyperplanes_;
  std::vector<std::array<MovingPlane, 2>> border_planes_;
  std::vector<std::array<PlaneRow, 2>> border_rows_;
  std::vector<std::array<std::uint32_t, 2>> border_hyperplanes_;
  std::vector<MovingBorder> borders_;
  std::vector<MovingCorner> corners_;
  std::vector<std::uint32_t> border_facets_, corner_facets_, facet_borders_, facet_corners_;
};

PlaneRow row_of(const MovingPlane& plane);

/// The facets that the operands have in common with their own corner: whether two facets share one.
bool share_corner(const SumFacet& a, const SumFacet& b);
bool has_corner(const SumFacet& facet, SumPoint corner);

}  // namespace dymsum::spatial
