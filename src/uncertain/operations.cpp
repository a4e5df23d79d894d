// Operations of uncertain regions: each set of the result comes from one set of each operand.
#include <utility>
#include <vector>

#include "dymsum/planar_boolean.h"
#include "dymsum/uncertain.h"
#include "uncertain/common_sum.h"
#include "uncertain/uncertain_internals.h"

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

/// The sums of the variants of one operand with the other one, which is known.
Result<Uncertain> sum_of_list(Operation operation, const Uncertain& list, const PlanarOperand& known, bool list_first,
                              double error, const SumOptions& options) {
  const auto sum = [&](const PlanarOperand& a) {
    return list_first ? operation(a, known, options) : operation(known, a, options);
  };
  Result<PlanarSum> outer = sum(list.outer());
  if (!outer) return outer.error();
  Result<PlanarSum> inner = uncertain::common_sum(list, sum, options);
  if (!inner) return inner.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

bool is_list(const Uncertain& u) {
  if (u.variants().size() < 2) return false;
  for (const Region& variant : u.variants())
    if (uncertain::has_thin_parts(variant)) return false;
  return true;
}

/// A sum or a no-fit polygon.
Result<Uncertain> monotone(Operation operation, const Uncertain& p, const Uncertain& q, const SumOptions& options) {
  if (options.semantics == Semantics::closed) {
    if (is_list(p) && UncertainInternals::is_one(q))
      return sum_of_list(operation, p, outer_operand(q), true, q.error(), options);
    if (is_list(q) && UncertainInternals::is_one(p))
      return sum_of_list(operation, q, outer_operand(p), false, p.error(), options);
  }
  return pairwise(operation, p, q, options);
}

}  // namespace

Result<Uncertain> minkowski_sum(const Uncertain& p, const Uncertain& q, const SumOptions& options) {
  return monotone(minkowski_sum, p, q, options);
}
Result<Uncertain> nfp(const Uncertain& a, const Uncertain& b, const SumOptions& options) {
  return monotone(nfp, a, b, options);
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
