#include "planar/boolean/boolean_terms.h"

#include <algorithm>

#include "planar/result/result_region.h"

namespace dymsum::planar {
namespace {

BooleanTerms terms_of_rings(RingSet rings) { return {{std::make_shared<const RingSet>(std::move(rings))}, {0}}; }

Error error_at(ErrorCode code, const char* message, Point at) {
  Error error{code, message, {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

RingSet rings_of(const Region& region) {
  std::vector<Ring> rings;
  for (const Part& part : region.parts()) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  return {std::move(rings), Fill::positive, {}};
}

Result<BooleanTerms> terms_of_region(const Region& region, Semantics semantics) {
  if (semantics != Semantics::regular && !(region.polylines().empty() && region.points().empty()))
    return error_at(
        ErrorCode::unsupported_operand,
        "Boolean operations take regions without polylines and points, which only regular semantics leaves out",
        region.points().empty() ? region.polylines()[0][0] : region.points()[0]);
  return terms_of_rings(rings_of(region));
}

RingSet rings_of(const PlanarSum& sum) {
  RingSet set;
  bool doubles = true;
  if (!sum.parts.empty()) set.fractions = positions_of(sum);
  auto at = set.fractions.begin();
  const auto add = [&](const SumRing& ring) {
    Ring& points = set.rings.emplace_back();
    for (std::size_t k = 0; k < ring.vertices.size(); ++k, ++at) {
      points.push_back({exact::round_to_double(at->x, at->w), exact::round_to_double(at->y, at->w)});
      doubles &= is_double(*at, points.back());
    }
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  if (doubles) set.fractions.clear();
  else set.fractions.erase(at, set.fractions.end());  // of segments and points
  return set;
}

// The terms of a result that no Boolean operation has made.
Result<BooleanTerms> terms_of_sum(const PlanarSum& sum, Semantics semantics) {
  if (semantics != Semantics::regular && !(sum.segments.empty() && sum.points.empty()))
    return error_at(ErrorCode::unsupported_operand,
                    "Boolean operations take results without segments and points, which only regular semantics leaves "
                    "out",
                    sum.points.empty() ? sum.segments[0].from.at : sum.points[0].at);
  return terms_of_rings(rings_of(sum));
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
  return terms_of_rings(std::visit([](const auto* set) { return rings_of(*set); }, operand.set()));
}

Result<BooleanTerms> terms_of(const PlanarOperand& operand, Semantics semantics) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_region(**region, semantics);
  const PlanarSum& sum = *std::get<const PlanarSum*>(operand.set());
  if (const auto* made = dynamic_cast<const BooleanSource*>(exact_source(sum).get())) return made->terms();
  return terms_of_sum(sum, semantics);
}

}  // namespace dymsum::planar
