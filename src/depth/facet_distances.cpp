#include "depth/facet_distances.h"

#include <algorithm>
#include <cmath>

#include "exact/rounding_bound.h"
#include "spatial/convex/assemble.h"

namespace dymsum::spatial {
namespace {

// Matrices err by 16 u of their entries and unit vectors by 8: normals, sums of three products, by 27 of entries that
// make up sqrt(3) of the spread; those across two edges by twice as much and the product of norms: 128. Positions err
// by 16 + 16 of the reach.
constexpr int kNormal = 128, kPosition = 32;
// The error of normal times position over the normal's length, times spread and reach over that length: the normal's
// error counts again in the length; three products and their sum, the quotient and the root.
constexpr double kDistanceError = exact::rounding_bound(2 * kNormal + kPosition + 3 + 2, 512);
// Squares above this have lost nothing to underflow.
constexpr double kNotSmall = 0x1p-900;

}  // namespace

// Norms are at least 1, as each matrix has an entry in [1, 2), so spreads are; of the three lengths that make reach_
// one is at least 1/2. All numbers are at most 2^20, and what underflows loses at most 2^-1000.
FacetDistances::FacetDistances(const Overlay& overlay, const PosedDoubles& p, const PosedDoubles& q,
                               const ScaledVector& base)
    : o_(overlay), map_{p.map, q.map}, cofactors_{p.cofactors, q.cofactors} {
  const std::array<int, 2> exponent{o_.poly(0).size + p.exponent, o_.poly(1).size + q.exponent};
  int top = std::max(exponent[0], exponent[1]);
  const double far = length(base.v);
  if (far > 0) top = std::max(top, base.exponent + std::ilogb(far));
  const Vec3 from{std::ldexp(base.v.x, base.exponent - top), std::ldexp(base.v.y, base.exponent - top),
                  std::ldexp(base.v.z, base.exponent - top)};
  reach_ = 1.01 * length(from);
  for (int op = 0; op < 2; ++op) {
    spread_[op] = spectral_bound(cofactors_[op]);
    const double norm = spectral_bound(map_[op]);
    spread_[2] *= norm;
    reach_ += 1.74 * std::ldexp(norm, exponent[op] - top);  // a vertex is at most sqrt(3) units from vertex 0
    const Mat3 to_position = scaled_by_power(map_[op], exponent[op] - top);
    position_[op].reserve(o_.poly(op).vertex_count());
    for (const Vec3& v : o_.poly(op).from_first)
      position_[op].push_back(op == 0 ? to_position * v + from : to_position * v);
  }
}

std::vector<GenericFacet> FacetDistances::candidates() {
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f)
      consider({op, f}, cofactors_[op] * o_.poly(op).normal[f], corner({op, f}));
  const Polytope &p = o_.poly(0), &q = o_.poly(1);
  for (std::uint32_t e = 0; e < p.edge_count(); ++e) {
    if (o_.first_crossing(0, e) == kNoCrossing) continue;
    const Vec3 along = map_[0] * p.direction[e], from = position_[0][p.origin[2 * e]];
    for (std::uint32_t id = o_.first_crossing(0, e); id != kNoCrossing; id = o_.crossing(id).next[0]) {
      const HalfEdge h = o_.crossing(id).q;
      consider({2, id}, cross(map_[1] * q.along(h), along), from + position_[1][q.origin[h]]);
    }
  }
  std::vector<GenericFacet> near;
  for (const auto& [lower, facet] : lower_)
    if (lower <= least_upper_) near.push_back(facet);
  return near;
}

// The facet with outward normal n through a corner, seen from the point.
void FacetDistances::consider(const GenericFacet& facet, Vec3 n, Vec3 corner) {
  const double product = dot(n, corner), error = kDistanceError * spread_[facet.op] * reach_, square = dot(n, n);
  // Nearly all are further away, which no root is needed for. Where squares are too small to tell, roots do.
  const double least = product - error, least_square = least * least;
  if (least > 0 && least_square > far_ * square && least_square > kNotSmall) return;
  const double size = std::sqrt(square);
  double lower = -std::numeric_limits<double>::infinity();  // doubles may give no direction
  if (error < reach_ * size) {
    lower = least / size;
    least_upper_ = std::min(least_upper_, (product + error) / size);
    far_ = least_upper_ * least_upper_ * exact::kOutwards;
  }
  if (lower <= least_upper_) lower_.push_back({lower, facet});
}

Vec3 FacetDistances::corner(const GenericFacet& facet) const {
  const auto [p, q] = corner_of(o_, facet.op, facet.id);
  return position_[0][p] + position_[1][q];
}

}  // namespace dymsum::spatial
