// Operations of uncertain regions: each set of the result comes from one set of each operand.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/planar_boolean.h"
#include "dymsum/uncertain.h"
#include "uncertain/uncertain_internals.h"
#include "uncertain/variant_sets.h"

namespace dymsum {
namespace {

using uncertain::inner_operand;
using uncertain::outer_operand;

using Operation = Result<PlanarSum> (*)(const PlanarOperand&, const PlanarOperand&, const SumOptions&);

/// The operation of both inner sets and of both outer ones.
Result<Uncertain> pairwise(Operation operation, const Uncertain& p, const Uncertain& q, const SumOptions& options) {
  Result<PlanarSum> outer = operation(outer_operand(p), outer_operand(q), options);
  if (!outer) return outer.error();
  const double error = p.error() + q.error();
  if (UncertainInternals::is_one(p) && UncertainInternals::is_one(q))
    return UncertainInternals::one(*std::move(outer), {}, error);
  Result<PlanarSum> inner = operation(inner_operand(p), inner_operand(q), options);
  if (!inner) return inner.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

/// All variants, where there are finitely many: those by name, or a result that both sets are.
std::vector<PlanarOperand> all_of(const Uncertain& u) {
  if (u.variants().empty() && UncertainInternals::is_one(u)) return {u.outer()};
  return {u.variants().begin(), u.variants().end()};
}

/// A box around the sums of what lies in two boxes.
PlanarBox sum_of(const PlanarBox& a, const PlanarBox& b) {
  return {{a.low.x + b.low.x, a.low.y + b.low.y}, {a.high.x + b.high.x, a.high.y + b.high.y}};
}
PlanarBox hull_of_boxes(const PlanarBox& a, const PlanarBox& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
PlanarBox box_around(const std::vector<Region>& variants) {
  std::optional<PlanarBox> box;
  for (const Region& variant : variants) {
    if (variant.empty()) continue;
    const std::array<double, 4> b = bounds(variant);
    const PlanarBox one{{b[0], b[1]}, {b[2], b[3]}};
    box = box ? hull_of_boxes(*box, one) : one;
  }
  return box.value_or(PlanarBox{});
}

/// Where sums of variants differ: in sums of a position where one operand's differ, and one of the other operand.
/// Nothing where that is not known.
std::optional<PlanarBox> window_of_sums(const Uncertain& p, const Uncertain& q, bool reflect) {
  if (p.variants().empty() || q.variants().empty()) return std::nullopt;
  const auto reflected = [&](const PlanarBox& b) {
    return reflect ? PlanarBox{{-b.high.x, -b.high.y}, {-b.low.x, -b.low.y}} : b;
  };
  std::optional<PlanarBox> window;
  if (const auto of_p = uncertain::differing_box(p.variants()))
    window = sum_of(*of_p, reflected(box_around(q.variants())));
  if (const auto of_q = uncertain::differing_box(q.variants())) {
    const PlanarBox other = sum_of(box_around(p.variants()), reflected(*of_q));
    window = window ? hull_of_boxes(*window, other) : other;
  }
  return window;
}

/// The sums of all variants with all, or their no-fit polygons; what they have in common, and their union.
Result<Uncertain> sums_of_lists(Operation operation, const Uncertain& p, const Uncertain& q, bool reflect,
                                const SumOptions& options) {
  std::vector<PlanarSum> sums;
  for (const PlanarOperand& a : all_of(p))
    for (const PlanarOperand& b : all_of(q)) {
      Result<PlanarSum> sum = operation(a, b, options);
      if (!sum) return sum.error();
      sums.push_back(*std::move(sum));
    }
  Result<uncertain::CommonAndAny> made = uncertain::common_and_any(std::vector<PlanarOperand>(sums.begin(), sums.end()),
                                                                   window_of_sums(p, q, reflect), options);
  if (!made) return made.error();
  uncertain::CommonAndAny both = *std::move(made);
  return UncertainInternals::pair(std::move(both.common), std::move(both.any), p.error() + q.error());
}

/// A sum or a no-fit polygon.
Result<Uncertain> monotone(Operation operation, const Uncertain& p, const Uncertain& q, bool reflect,
                           const SumOptions& options) {
  const bool one = UncertainInternals::is_one(p) && UncertainInternals::is_one(q);
  if (options.semantics == Semantics::closed && !one && !all_of(p).empty() && !all_of(q).empty())
    return sums_of_lists(operation, p, q, reflect, options);
  return pairwise(operation, p, q, options);
}

}  // namespace

Result<Uncertain> minkowski_sum(const Uncertain& p, const Uncertain& q, const SumOptions& options) {
  return monotone(minkowski_sum, p, q, false, options);
}
Result<Uncertain> nfp(const Uncertain& a, const Uncertain& b, const SumOptions& options) {
  return monotone(nfp, a, b, true, options);
}

// Pieces without area of what all variants of P have in common hold no part with area: they are left out.
Result<Uncertain> erode(const Uncertain& p, const Uncertain& q, const SumOptions& options) {
  if (uncertain::is_empty(q.inner()) && !uncertain::is_empty(q.outer()))
    return Error{ErrorCode::unsupported_operand,
                 "nothing lies in every variant of the part, so every position may be one where it fits: take a "
                 "smaller tolerance",
                 {}};
  Result<PlanarSum> outer = erode(outer_operand(p), inner_operand(q), options);
  if (!outer) return outer.error();
  const double error = p.error() + q.error();
  if (UncertainInternals::is_one(p) && UncertainInternals::is_one(q))
    return UncertainInternals::one(*std::move(outer), {}, error);
  Result<PlanarSum> inner = uncertain::regular_set(p.inner());
  if (inner) inner = erode(*inner, outer_operand(q), options);
  if (!inner) return inner.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

Result<Uncertain> united(const Uncertain& a, const Uncertain& b, const SumOptions& options) {
  return pairwise(united, a, b, options);
}
Result<Uncertain> intersection(const Uncertain& a, const Uncertain& b, const SumOptions& options) {
  return pairwise(intersection, a, b, options);
}
Result<Uncertain> difference(const Uncertain& a, const Uncertain& b, const SumOptions& options) {
  const double error = a.error() + b.error();
  Result<PlanarSum> outer = difference(outer_operand(a), inner_operand(b), options);
  if (!outer) return outer.error();
  if (UncertainInternals::is_one(a) && UncertainInternals::is_one(b))
    return UncertainInternals::one(*std::move(outer), {}, error);
  // The interior of the outer set, with what lies between the sets that it may have been united from.
  Result<PlanarSum> inner = uncertain::closed_set(b.outer());
  if (inner) inner = difference(inner_operand(a), *inner, options);
  if (!inner) return inner.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

}  // namespace dymsum
