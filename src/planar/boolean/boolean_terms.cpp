#include "planar/boolean/boolean_terms.h"

#include <algorithm>

#include "planar/result/result_region.h"

namespace dymsum::planar {
namespace {

BooleanTerms terms_of_rings(RingSet rings) { return {{std::make_shared<const RingSet>(std::move(rings))}, {0}}; }

RingSet rings_of(const Region& region) {
  std::vector<Ring> rings;
  for (const Part& part : region.parts()) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  return {std::move(rings), Fill::positive, {}, {}, {}};
}

RingSet set_of(const Region& region) {
  RingSet set = rings_of(region);
  set.lines = region.polylines();
  set.points = region.points();
  return set;
}

/// The rings of a result at their exact positions, and its segments and points if they count.
RingSet set_of(const PlanarSum& sum, bool with_pieces) {
  RingSet set;
  bool doubles = true;
  if (!sum.parts.empty() || with_pieces) set.fractions = positions_of(sum);
  auto at = set.fractions.begin();
  const auto next = [&] {
    const Point nearest{exact::round_to_double(at->x, at->w), exact::round_to_double(at->y, at->w)};
    doubles &= is_double(*at, nearest);
    ++at;
    return nearest;
  };
  const auto add = [&](const SumRing& ring) {
    Ring& points = set.rings.emplace_back();
    for (std::size_t k = 0; k < ring.vertices.size(); ++k) points.push_back(next());
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  for (std::size_t k = 0; k < sum.segments.size() && with_pieces; ++k) {
    const Point from = next();
    set.lines.push_back({from, next()});
  }
  for (std::size_t k = 0; k < sum.points.size() && with_pieces; ++k) set.points.push_back(next());
  if (doubles) set.fractions.clear();
  else set.fractions.erase(at, set.fractions.end());  // of what does not count
  return set;
}

}  // namespace

void BooleanTerms::append(const BooleanTerms& other) {
  std::vector<std::int32_t> index;
  for (const auto& input : other.inputs) {
    const auto known = std::find(inputs.begin(), inputs.end(), input);
    index.push_back(static_cast<std::int32_t>(known - inputs.begin()));
    if (known == inputs.end()) inputs.push_back(input);
  }
  for (const std::int32_t step : other.steps) steps.push_back(step < 0 ? step : index[static_cast<std::size_t>(step)]);
}

void append_difference(const BooleanTerms& a, const BooleanTerms& b, BooleanTerms& to) {
  to.append(a);
  to.append(b);
  to.steps.insert(to.steps.end(), {BooleanTerms::kNot, BooleanTerms::kAnd});
}

Membership BooleanTerms::evaluate(std::span<const Membership> in, std::vector<Membership>& stack) const {
  stack.clear();
  for (const std::int32_t step : steps) {
    if (step >= 0) {
      stack.push_back(in[static_cast<std::size_t>(step)]);
      continue;
    }
    Membership& top = stack.back();
    if (step == kNot) {
      top = {!top.open, !top.closed};
      continue;
    }
    const Membership last = top;
    stack.pop_back();
    Membership& to = stack.back();
    if (step == kAnd) to = {to.closed && last.closed, to.open && last.open};
    else to = {to.closed || last.closed, to.open || last.open};
  }
  return stack.empty() ? Membership{} : stack.back();
}

BooleanTerms terms_of_parts(const PlanarOperand& operand) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_rings(rings_of(**region));
  return terms_of_rings(set_of(*std::get<const PlanarSum*>(operand.set()), false));
}

BooleanTerms terms_of(const PlanarOperand& operand, Semantics semantics) {
  const bool with_pieces = semantics != Semantics::regular;
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_rings(with_pieces ? set_of(**region) : rings_of(**region));
  const PlanarSum& sum = *std::get<const PlanarSum*>(operand.set());
  if (const auto* made = dynamic_cast<const BooleanSource*>(exact_source(sum).get())) return made->terms();
  return terms_of_rings(set_of(sum, with_pieces));
}

}  // namespace dymsum::planar
