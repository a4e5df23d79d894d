// Questions whose answer changes in one direction only when an operand grows: the smallest and the largest variants
// decide, and where there are finitely many all of them are looked at.
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "depth/planar_depth.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/sum_locator.h"
#include "dymsum/uncertain_answers.h"
#include "exact/big.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum {
namespace {

using uncertain::inner_operand;
using uncertain::outer_operand;

/// A variant, or a set that stands for one.
struct Candidate {
  PlanarOperand set;
  std::uint32_t index;
};

/// All variants where there are finitely many, else the inner or outer set.
std::vector<Candidate> candidates(const Uncertain& u, bool outer) {
  std::vector<Candidate> all;
  for (const Region& variant : u.variants()) all.push_back({variant, static_cast<std::uint32_t>(all.size())});
  if (all.empty()) {
    if (outer) all.push_back({u.outer(), VariantPair::kOuter});
    else all.push_back({u.inner(), VariantPair::kInner});
  }
  return all;
}

using Question = std::function<Result<bool>(const PlanarOperand&, const PlanarOperand&)>;

/// The first pairs, in the order of p, for which a question holds and for which it does not, as far as they are wanted.
struct FirstPairs {
  bool want_yes, want_no;
  std::optional<VariantPair> yes, no;

  Result<void> look(const std::vector<Candidate>& p, const std::vector<Candidate>& q, const Question& question) {
    for (const Candidate& a : p)
      for (const Candidate& b : q) {
        if ((yes || !want_yes) && (no || !want_no)) return {};
        const Result<bool> answer = question(a.set, b.set);
        if (!answer) return answer.error();
        std::optional<VariantPair>& first = *answer ? yes : no;
        if (!first && (*answer ? want_yes : want_no)) first = VariantPair{a.index, b.index};
      }
    return {};
  }
};

/// A question that holds for larger P where it holds for smaller ones, and likewise for Q; for smaller Q where the part
/// `shrinks`. `hardest`: it holds for the pair of sets, which need not be variants, for which that is hardest.
Result<UncertainAnswer> decide(const Uncertain& p, const Uncertain& q, bool shrinks, bool hardest,
                               const Question& question) {
  const auto easy_p = candidates(p, true), easy_q = candidates(q, !shrinks);
  if (hardest) return UncertainAnswer{Holds::for_all, VariantPair{easy_p[0].index, easy_q[0].index}, std::nullopt};
  const bool lists = !p.variants().empty() && !q.variants().empty();
  FirstPairs pairs{true, lists, {}, {}};
  if (const Result<void> looked = pairs.look(easy_p, easy_q, question); !looked) return looked.error();
  if (!lists) {
    FirstPairs hard{false, true, {}, {}};
    if (const Result<void> looked = hard.look(candidates(p, false), candidates(q, shrinks), question); !looked)
      return looked.error();
    pairs.no = hard.no;
  }
  return UncertainAnswer{!pairs.no   ? Holds::for_all
                         : pairs.yes ? Holds::for_some
                                     : Holds::for_none,
                         pairs.yes, pairs.no};
}

/// The same of sums, which grow with both.
Result<UncertainAnswer> decide_growing(const Uncertain& p, const Uncertain& q, const Question& question) {
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

/// How two sets lie, and how far from touching they are.
struct Distance {
  Meeting meeting = Meeting::apart;
  exact::BigRational squared;
  bool infinite = false;
};

/// a has less clearance than b: it is deeper, or not so far apart.
bool is_less(const Distance& a, const Distance& b) {
  const auto side = [](const Distance& d) {
    return d.meeting == Meeting::overlapping ? -1 : d.meeting == Meeting::touching ? 0 : 1;
  };
  if (side(a) != side(b)) return side(a) < side(b);
  if (a.infinite || b.infinite) return !a.infinite;
  return side(a) < 0 ? a.squared > b.squared : a.squared < b.squared;
}

using PlanarPair = std::pair<PlanarOperand, PlanarOperand>;

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

Distance compared(const PlanarDistance& d) {
  return {d.meeting, exact::exact_value(d.squared), std::isinf(d.distance)};
}

/// Of all pairs the least clearance, or the most; the first one of equal ones.
Result<ClearanceBound> extreme(const std::vector<Candidate>& p, const std::vector<Candidate>& q,
                               const RationalPoint& at, bool least) {
  std::optional<ClearanceBound> best;
  for (const Candidate& a : p)
    for (const Candidate& b : q) {
      Result<PlanarDistance> distance = distance_of(a.set, b.set, at);
      if (!distance) return distance.error();
      const bool better = !best || (least ? is_less(compared(*distance), compared(best->distance))
                                          : is_less(compared(best->distance), compared(*distance)));
      if (better) best = ClearanceBound{*std::move(distance), {a.index, b.index}};
    }
  return *std::move(best);
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
  Result<ClearanceBound> least = extreme(candidates(p, true), candidates(q, true), at, true);
  if (!least) return least.error();
  Result<ClearanceBound> most = extreme(candidates(p, false), candidates(q, false), at, false);
  if (!most) return most.error();
  return UncertainClearance{*std::move(least), *std::move(most)};
}

}  // namespace dymsum
