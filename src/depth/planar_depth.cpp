#include "depth/planar_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "depth/touching_pairs.h"
#include "dymsum/penetration_depth.h"
#include "exact/big.h"

namespace dymsum::depth {
namespace {

using exact::BigRational;

/// A segment of the boundary, or a point of it.
struct BoundaryPiece {
  const SumVertex* from;
  const SumVertex* to;
  bool tight = false;  ///< no edge of a ring
};

std::vector<BoundaryPiece> boundary_pieces(const PlanarSum& sum) {
  std::vector<BoundaryPiece> pieces;
  const auto add_ring = [&](const SumRing& ring) {
    for (std::size_t k = 0; k < ring.vertices.size(); ++k) {
      const SumVertex &a = ring.vertices[k], &b = ring.vertices[(k + 1) % ring.vertices.size()];
      pieces.push_back({&a, &b});
    }
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  for (const SumSegment& s : sum.tight_segments) pieces.push_back({&s.from, &s.to, true});
  for (const SumVertex& v : sum.tight_points) pieces.push_back({&v, &v, true});
  return pieces;
}

// The distance from the edge, along it in units of its length: squares of short ones underflow, those of long ones
// overflow.
double rough_distance(Point a, Point b, Point z) {
  const double dx = b.x - a.x, dy = b.y - a.y, size = std::max(std::abs(dx), std::abs(dy));
  if (!(size > 0)) return std::hypot(a.x - z.x, a.y - z.y);
  const double u = dx / size, w = dy / size;
  const double t = std::clamp(((z.x - a.x) * u + (z.y - a.y) * w) / (u * u + w * w) / size, 0.0, 1.0);
  return std::hypot(a.x + t * dx - z.x, a.y + t * dy - z.y);
}

/// A vertex as seen from z.
PlaneVector seen_from(const PlaneVector& z, const PlanarSum& sum, const SumVertex& v) {
  const RationalPoint x = sum.exact(v);
  return {exact::exact_value(x.x) - z[0], exact::exact_value(x.y) - z[1]};
}

PlaneVector nearest_of_piece(const PlanarSum& sum, const BoundaryPiece& piece, const PlaneVector& z) {
  const PlaneVector a = seen_from(z, sum, *piece.from);
  if (piece.from == piece.to) return a;
  const PlaneVector b = seen_from(z, sum, *piece.to), d{b[0] - a[0], b[1] - a[1]};
  const BigRational t = -(a[0] * d[0] + a[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]);
  if (t <= 0) return a;
  if (t >= 1) return b;
  return {a[0] + t * d[0], a[1] + t * d[1]};
}

/// Whether the ray from z towards +x crosses the edges of rings an odd number of times. Requires: z is on none of them.
/// Positions in doubles are off by less than `off`.
bool in_rings(const PlanarSum& sum, const std::vector<BoundaryPiece>& pieces, const PlaneVector& z, Point near,
              double off) {
  bool odd = false;
  for (const BoundaryPiece& piece : pieces) {
    const Point a = piece.from->at, b = piece.to->at;
    if (piece.tight || std::max(a.x, b.x) < near.x - off || std::min(a.y, b.y) > near.y + off ||
        std::max(a.y, b.y) < near.y - off)
      continue;
    const PlaneVector u = seen_from(z, sum, *piece.from), v = seen_from(z, sum, *piece.to);
    const bool rises = v[1] > 0;
    if ((u[1] > 0) == rises) continue;
    if ((u[0] * v[1] - u[1] * v[0] > 0) == rises) odd = !odd;
  }
  return odd;
}

}  // namespace

PlaneNearest nearest_on_boundary(const PlanarSum& sum, const RationalPoint& position) {
  const Point z{position.x.to_double(), position.y.to_double()};
  const std::vector<BoundaryPiece> pieces = boundary_pieces(sum);
  // Doubles leave few pieces: positions are off by at_error, and what is computed of them by some units more.
  double reach = std::abs(z.x) + std::abs(z.y), bound = std::numeric_limits<double>::infinity();
  std::vector<double> rough;
  for (const BoundaryPiece& piece : pieces) {
    reach = std::max({reach, std::abs(piece.from->at.x), std::abs(piece.from->at.y)});
    rough.push_back(rough_distance(piece.from->at, piece.to->at, z));
    bound = std::min(bound, rough.back());
  }
  constexpr double kSubnormal = 0x1p-1070;  // what is that small has few digits
  const double off = 4 * sum.at_error + reach * 0x1p-24 + kSubnormal;
  const PlaneVector from{exact::exact_value(position.x), exact::exact_value(position.y)};
  PlaneNearest result;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (rough[k] > bound + 2 * off) continue;  // not so for what is no number
    const PlaneVector x = nearest_of_piece(sum, pieces[k], from);
    const BigRational square = x[0] * x[0] + x[1] * x[1];
    if (!result.moves.empty() && square > result.squared) continue;
    if (result.moves.empty() || square < result.squared) result.moves.clear(), result.squared = square;
    result.moves.push_back(x);
  }
  std::sort(result.moves.begin(), result.moves.end());
  result.moves.erase(std::unique(result.moves.begin(), result.moves.end()), result.moves.end());
  // Of an operand with area and one of any kind the closed sum is the closure of the open one, which its rings and
  // tight features bound: what is on none of these lies inside the open sum, or off the closed one.
  result.meeting = !result.moves.empty() && result.squared == 0 ? Meeting::touching
                   : in_rings(sum, pieces, from, z, 2 * off)    ? Meeting::overlapping
                                                                : Meeting::apart;
  return result;
}

}  // namespace dymsum::depth

namespace dymsum {

// Depth and distance of planar regions: how far a position is from the boundary and the tight features of their sum.

namespace {

using depth::PlaneVector;
using exact::BigRational;

Point unit_of(const PlaneVector& v) {
  const BigRational x = abs(v[0]), y = abs(v[1]), larger = x > y ? x : y;
  if (larger == 0) return {};
  const double u = exact::round_to_double(v[0] / larger), w = exact::round_to_double(v[1] / larger);
  const double size = std::hypot(u, w);
  return {u / size, w / size};
}

PlanarFeature planar_feature(const SolidFeature& f) {
  return {f.kind == SolidFeature::Kind::vertex ? PlanarFeature::Kind::vertex : PlanarFeature::Kind::edge, f.a};
}

std::vector<PlanarTouch> planar_touches(const depth::TouchingPairs& pairs, const PlaneVector& x) {
  std::vector<PlanarTouch> all;
  for (const SolidTouch& t : pairs.at({x[0], x[1], BigRational(0)}))
    all.push_back({planar_feature(t.p), planar_feature(t.q), t.dimension, {t.at.x, t.at.y}, t.patch});
  return all;
}

std::optional<Error> operand_error(const Region& p, const Region& q) {
  if (p.empty() || q.empty()) return Error{ErrorCode::no_area, "an operand is empty: it has no depth", {}};
  const auto has_thin_parts = [](const Region& r) { return !r.polylines().empty() || !r.points().empty(); };
  if (has_thin_parts(p) && has_thin_parts(q))
    return Error{
        ErrorCode::unsupported_operand, "both operands have parts without area: depth wants one with area", {}};
  return std::nullopt;
}

}  // namespace

Result<PlanarDepth> PlanarDepth::create(const Region& p, const Region& q) {
  if (std::optional<Error> error = operand_error(p, q)) return *std::move(error);
  Result<PlanarSum> sum = nfp(p, q);
  if (!sum) return sum.error();
  PlanarDepth made;
  made.sum_ = std::make_shared<const PlanarSum>(*std::move(sum));
  made.touching_ = std::make_shared<const depth::TouchingPairs>(depth::touch_side(p), depth::touch_side(q));
  return made;
}

PlanarDistance PlanarDepth::at(Point q_moved_by) const {
  if (!std::isfinite(q_moved_by.x) || !std::isfinite(q_moved_by.y))
    throw std::invalid_argument("PlanarDepth::at: the translation is not finite");
  return at(RationalPoint{*Rational::of(q_moved_by.x), *Rational::of(q_moved_by.y)});
}

template <std::same_as<RationalPoint> Move>
PlanarDistance PlanarDepth::at(const Move& q_moved_by) const {
  const depth::PlaneNearest nearest = depth::nearest_on_boundary(*sum_, q_moved_by);
  const PlaneVector from{exact::exact_value(q_moved_by.x), exact::exact_value(q_moved_by.y)};
  PlanarDistance result;
  result.meeting = nearest.meeting;
  result.squared = exact::to_rational(nearest.squared);
  result.distance = exact::root_to_double(nearest.squared);
  for (const PlaneVector& move : nearest.moves)
    result.ways.push_back({{exact::to_rational(move[0]), exact::to_rational(move[1])},
                           unit_of(move),
                           planar_touches(*touching_, {from[0] + move[0], from[1] + move[1]})});
  return result;
}
template PlanarDistance PlanarDepth::at(const RationalPoint&) const;

}  // namespace dymsum
