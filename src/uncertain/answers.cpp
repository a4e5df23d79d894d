// Questions about regions that are not known exactly.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "depth/planar_depth.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/sum_locator.h"
#include "dymsum/uncertain_answers.h"
#include "exact/big.h"
#include "uncertain/deciding.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum {
namespace {

using uncertain::inner_operand;
using uncertain::outer_operand;

using uncertain::Question;

/// All variants where there are finitely many, else the inner or outer set.
auto candidates(const Uncertain& u, bool outer) { return uncertain::candidates<PlanarOperand>(u, outer); }

Result<UncertainAnswer> decide(const Uncertain& p, const Uncertain& q, bool shrinks, bool hardest,
                               const Question<PlanarOperand>& question) {
  return uncertain::decide(p, q, shrinks, hardest, question);
}

/// The same of sums, which grow with both.
Result<UncertainAnswer> decide_growing(const Uncertain& p, const Uncertain& q,
                                       const Question<PlanarOperand>& question) {
  const Result<bool> hardest = question(inner_operand(p), inner_operand(q));
  if (!hardest) return hardest.error();
  return decide(p, q, false, *hardest, question);
}

/// The double that a number is, if it is one.
std::optional<Point> as_doubles(const RationalPoint& z) {
  const Point at{z.x.to_double(), z.y.to_double()};
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return std::nullopt;
  if (!(*Rational::of(at.x) == z.x) || !(*Rational::of(at.y) == z.y)) return std::nullopt;
  return at;
}

/// Coordinates are such that single positions can be looked at: else sums have the error.
bool are_small(const PlanarOperand& a, const PlanarOperand& b) {
  for (const PlanarOperand* operand : {&a, &b})
    if (const auto* region = std::get_if<const Region*>(&operand->set()))
      for (const double c : bounds(**region))
        if (std::abs(c) > 0x1p996) return false;
  return true;
}

Result<bool> lies_in(const Result<PlanarSum>& sum, const RationalPoint& z, Semantics semantics) {
  if (!sum) return sum.error();
  return SumLocator(*sum, semantics).contains_rational(z);
}

}  // namespace

Result<UncertainAnswer> contains(const Uncertain& p, const Uncertain& q, const RationalPoint& z, Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  const std::optional<Point> doubles = as_doubles(z);
  return decide_growing(p, q, [&](const PlanarOperand& a, const PlanarOperand& b) -> Result<bool> {
    if (doubles && are_small(a, b)) return dymsum::contains(a, b, *doubles, semantics);
    return lies_in(minkowski_sum(a, b, options), z, semantics);
  });
}

Result<UncertainAnswer> collides(const Uncertain& p, const Uncertain& q, const RationalPoint& at) {
  SumOptions open;
  open.semantics = Semantics::open;
  return decide_growing(p, q, [&](const PlanarOperand& a, const PlanarOperand& b) -> Result<bool> {
    return lies_in(nfp(a, b, open), at, Semantics::open);
  });
}

Result<UncertainAnswer> fits_at(const Uncertain& p, const Uncertain& q, const RationalPoint& at) {
  const Result<Uncertain> positions = erode(p, q);
  if (!positions) return positions.error();
  const bool everywhere = SumLocator(positions->inner()).contains_rational(at);
  return decide(p, q, true, everywhere, [&](const PlanarOperand& a, const PlanarOperand& b) -> Result<bool> {
    return lies_in(erode(a, b), at, Semantics::closed);
  });
}

Result<UncertainFit> fits_anywhere(const Uncertain& container, const Uncertain& part, const SumOptions& options) {
  Result<Uncertain> positions = erode(container, part, options);
  if (!positions) return positions.error();
  UncertainFit fit{{}, *std::move(positions), std::nullopt};
  const PlanarSum& everywhere = fit.positions.inner();
  if (!uncertain::is_empty(everywhere)) {
    const SumVertex& vertex = !everywhere.parts.empty()      ? everywhere.parts[0].outer.vertices[0]
                              : !everywhere.segments.empty() ? everywhere.segments[0].from
                                                             : everywhere.points[0];
    fit.common = everywhere.exact(vertex);
  }
  Result<UncertainAnswer> answer = decide(container, part, true, fit.common.has_value(),
                                          [&](const PlanarOperand& a, const PlanarOperand& b) -> Result<bool> {
                                            const Result<PlanarSum> sum = erode(a, b, options);
                                            if (!sum) return sum.error();
                                            return !uncertain::is_empty(*sum);
                                          });
  if (!answer) return answer.error();
  fit.answer = *std::move(answer);
  return fit;
}

namespace {

Result<PlanarDistance> distance_of(const PlanarOperand& p, const PlanarOperand& q, const RationalPoint& at) {
  if (const auto* a = std::get_if<const Region*>(&p.set()), *b = std::get_if<const Region*>(&q.set());
      a && b && !(*a)->empty() && !(*b)->empty()) {
    const Result<PlanarDepth> depth = PlanarDepth::create(**a, **b);
    if (!depth) return depth.error();
    return depth->at(at);
  }
  const Result<PlanarSum> sum = nfp(p, q);
  if (!sum) return sum.error();
  PlanarDistance distance;
  if (uncertain::is_empty(*sum)) {
    distance.distance = std::numeric_limits<double>::infinity();
    return distance;
  }
  const depth::PlaneNearest nearest = depth::nearest_on_boundary(*sum, at);
  distance.meeting = nearest.meeting;
  distance.squared = exact::to_rational(nearest.squared);
  distance.distance = exact::root_to_double(nearest.squared);
  for (const depth::PlaneVector& move : nearest.moves) {
    PlanarWay way;
    way.move = {exact::to_rational(move[0]), exact::to_rational(move[1])};
    distance.ways.push_back(std::move(way));
  }
  return distance;
}

Result<ClearanceBound> extreme(const Uncertain& p, const Uncertain& q, const RationalPoint& at, bool least) {
  return uncertain::extreme<ClearanceBound>(
      candidates(p, least), candidates(q, least), least,
      [&](const PlanarOperand& a, const PlanarOperand& b) { return distance_of(a, b, at); });
}

bool has_thin_pieces(const Uncertain& u) { return !u.outer().segments.empty() || !u.outer().points.empty(); }

double signed_distance(const PlanarDistance& d) { return d.meeting == Meeting::overlapping ? -d.distance : d.distance; }

}  // namespace

double UncertainClearance::least_signed() const { return signed_distance(least.distance); }
double UncertainClearance::most_signed() const { return signed_distance(most.distance); }

Result<UncertainClearance> clearance(const Uncertain& p, const Uncertain& q, const RationalPoint& at) {
  if (has_thin_pieces(p) && has_thin_pieces(q))
    return Error{
        ErrorCode::unsupported_operand, "both operands have parts without area: clearance wants one with area", {}};
  Result<ClearanceBound> least = extreme(p, q, at, true);
  if (!least) return least.error();
  Result<ClearanceBound> most = extreme(p, q, at, false);
  if (!most) return most.error();
  return UncertainClearance{*std::move(least), *std::move(most)};
}

}  // namespace dymsum
