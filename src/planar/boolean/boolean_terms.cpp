#include "planar/boolean/boolean_terms.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

BooleanTerms terms_of_rings(std::vector<Ring> rings, Fill fill) {
  return {{std::make_shared<const RingSet>(RingSet{std::move(rings), fill})}, {0}};
}

Error error_at(ErrorCode code, const char* message, Point at) {
  Error error{code, message, {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

Result<BooleanTerms> terms_of_region(const Region& region, Semantics semantics) {
  if (semantics != Semantics::regular && !(region.polylines().empty() && region.points().empty()))
    return error_at(
        ErrorCode::unsupported_operand,
        "Boolean operations take regions without polylines and points, which only regular semantics leaves out",
        region.points().empty() ? region.polylines()[0][0] : region.points()[0]);
  std::vector<Ring> rings;
  for (const Part& part : region.parts()) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  return terms_of_rings(std::move(rings), Fill::positive);
}

/// A vertex that is the pair of doubles nearest to it, or nothing.
std::optional<Point> as_point(const ExactSource& source, const SumVertex& vertex) {
  const ExactSource::Position at = source.position(vertex);
  const Point nearest{exact::round_to_double(at.x), exact::round_to_double(at.y)};
  if (!(std::abs(nearest.x) <= 0x1p1000) || !(std::abs(nearest.y) <= 0x1p1000)) return std::nullopt;
  if (exact::exact_value(nearest.x) != at.x || exact::exact_value(nearest.y) != at.y) return std::nullopt;
  return nearest;
}

// The terms of a result that no Boolean operation has made.
Result<BooleanTerms> terms_of_sum(const PlanarSum& sum) {
  std::vector<Ring> rings;
  std::optional<Error> failed;
  const auto add = [&](const SumRing& ring) {
    Ring& points = rings.emplace_back();
    for (const SumVertex& v : ring.vertices) {
      const std::optional<Point> at = exact_source(sum) ? as_point(*exact_source(sum), v) : v.at;
      if (!at && !failed)
        failed = error_at(ErrorCode::unsupported_operand,
                          "a vertex of this result is no double, so it is no operand; round it first (rounded)", v.at);
      points.push_back(at.value_or(v.at));
    }
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  if (failed) return *std::move(failed);
  return terms_of_rings(std::move(rings), Fill::positive);
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

Result<BooleanTerms> terms_of(const PlanarOperand& operand, Semantics semantics) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return terms_of_region(**region, semantics);
  const PlanarSum& sum = *std::get<const PlanarSum*>(operand.set());
  if (const auto* made = dynamic_cast<const BooleanSource*>(exact_source(sum).get())) return made->terms();
  return terms_of_sum(sum);
}

}  // namespace dymsum::planar
