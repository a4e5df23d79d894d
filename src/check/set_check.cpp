#include "dymsum/set_check.h"

#include <cmath>
#include <limits>

#include "base/poll.h"
#include "check/farthest.h"
#include "check/gap.h"
#include "check/within.h"
#include "dymsum/planar_boolean.h"
#include "exact/big.h"

namespace dymsum {
namespace {

Rational rational(const exact::BigInteger& num, const exact::BigInteger& den) {
  return exact::to_rational(exact::BigRational(num, den));
}
RationalPoint rational(const exact::HomogeneousPoint& p) { return {rational(p.x, p.w), rational(p.y, p.w)}; }

/// What lies in a and not in b, and how far it is from the edges.
Result<PlanarExcess> excess_of(const PlanarSum& a, const PlanarSum& b, const check::EdgeTree& edges,
                               const SumOptions& options, const Poll& poll) {
  Result<PlanarSum> set = difference(a, b, options);
  if (!set) return set.error();
  PlanarExcess excess;
  excess.set = *std::move(set);
  std::vector<check::ConvexCell> cells = check::convex_cells(excess.set);
  if (cells.empty()) return excess;
  if (edges.empty()) {
    excess.distance = excess.at_most = std::numeric_limits<double>::infinity();
    excess.at = rational(cells[0].vertices[0]->exact);
    return excess;
  }
  const check::Farthest far = check::farthest(std::move(cells), edges, poll);
  excess.at = rational(far.at->exact);
  excess.nearest = rational(far.nearest);
  const exact::BigRational squared(far.squared.num, far.squared.den);
  excess.squared = exact::to_rational(squared);
  excess.distance = exact::root_to_double(squared);
  excess.exact = far.exact;
  excess.at_most = far.exact ? excess.distance : far.at_most;
  return excess;
}

/// The set of an operand. A Boolean result would be taken for the operations that made it, and what lies between two
/// closed sets that it unites would be in none of their interiors: the sum with the origin is the closed set alone.
Result<PlanarSum> set_of(const PlanarOperand& operand, const SumOptions& options) {
  const PlanarOperand one[]{operand};
  if (options.semantics == Semantics::regular) return united(one, options);
  return minkowski_sum(operand, *Region::create({{}, {}, {{0, 0}}}), options);
}

bool is_nothing(const PlanarExcess& excess) { return excess.exact && excess.distance == 0; }

}  // namespace

bool PlanarSetCheck::contains() const { return is_nothing(missing); }
bool PlanarSetCheck::contained() const { return is_nothing(surplus); }

CheckVerdict PlanarSetCheck::within(const Rational& tolerance) const {
  return check::both(check::within(missing, tolerance), check::within(surplus, tolerance));
}

CheckVerdict PlanarOffsetCheck::at_least(const Rational& r) const {
  if (r.sign() <= 0) return is_nothing(beyond) ? CheckVerdict::right : CheckVerdict::wrong;
  return is_nothing(beyond) && (std::isinf(least) || least_squared >= r * r) ? CheckVerdict::right
                                                                             : CheckVerdict::wrong;
}
CheckVerdict PlanarOffsetCheck::at_most(const Rational& r) const { return check::within(between, r); }

Result<PlanarSetCheck> check_set(const PlanarOperand& right, const PlanarOperand& made,
                                 const SetCheckOptions& options) {
  if (options.semantics == Semantics::open)
    return Error{
        ErrorCode::unsupported_operand, "sets are compared as closed or as regular ones, not as open ones", {}};
  SumOptions sums;
  sums.semantics = options.semantics;
  sums.progress = options.progress;
  try {
    Poll poll(options.progress);
    poll.stage("distances");
    const Result<PlanarSum> a = set_of(right, sums), b = set_of(made, sums);
    if (!a || !b) return a ? b.error() : a.error();
    Result<PlanarExcess> missing = excess_of(*a, *b, check::EdgeTree(check::edges_of(*b)), sums, poll);
    if (!missing) return missing.error();
    Result<PlanarExcess> surplus = excess_of(*b, *a, check::EdgeTree(check::edges_of(*a)), sums, poll);
    if (!surplus) return surplus.error();
    return PlanarSetCheck{*std::move(missing), *std::move(surplus)};
  } catch (const Cancelled&) {
    return cancelled();
  }
}

Result<PlanarOffsetCheck> check_offset(const PlanarOperand& a, const PlanarOperand& made, DiscSide side,
                                       const Progress& progress) {
  SumOptions sums;
  sums.semantics = Semantics::regular;
  sums.progress = progress;
  try {
    Poll poll(progress);
    poll.stage("distances");
    const PlanarOperand as[]{a}, mades[]{made};
    const Result<PlanarSum> operand = united(as, sums), set = united(mades, sums);
    if (!operand || !set) return operand ? set.error() : operand.error();
    const check::EdgeTree of_a(check::edges_of(*operand)), of_set(check::edges_of(*set));
    const bool outside = side == DiscSide::outside;
    const PlanarSum &inner = outside ? *operand : *set, &outer = outside ? *set : *operand;
    Result<PlanarExcess> beyond = excess_of(inner, outer, outside ? of_set : of_a, sums, poll);
    if (!beyond) return beyond.error();
    Result<PlanarExcess> between = excess_of(outer, inner, of_a, sums, poll);
    if (!between) return between.error();
    PlanarOffsetCheck check;
    check.beyond = *std::move(beyond);
    check.between = *std::move(between);
    if (!is_nothing(check.beyond)) return check;
    if (const std::optional<check::Gap> gap = check::gap_between(of_set, of_a, {0, 0, 1})) {
      const exact::BigRational squared(gap->squared.num, gap->squared.den);
      check.least_squared = exact::to_rational(squared);
      check.least = exact::root_to_double(squared);
      check.least_at = rational(gap->of_a->exact);
      check.least_from = rational(gap->of_b->exact);
    } else {
      check.least = std::numeric_limits<double>::infinity();
    }
    return check;
  } catch (const Cancelled&) {
    return cancelled();
  }
}

}  // namespace dymsum
