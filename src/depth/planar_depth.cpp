// Depth and distance of planar regions: how far a position is from the boundary and the tight features of their sum.
#include <cmath>
#include <stdexcept>

#include "depth/planar_nearest.h"
#include "depth/touching_pairs.h"
#include "dymsum/penetration_depth.h"
#include "exact/big.h"

namespace dymsum {
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
