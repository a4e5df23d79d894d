// Operations of solids that are not known exactly: each set of the result comes from one set of each operand.
#include <array>
#include <utility>

#include "dymsum/solid_erosion.h"
#include "dymsum/solid_union.h"
#include "uncertain/uncertain_solid_internals.h"

namespace dymsum {
namespace {

using uncertain::inner_solid;
using uncertain::outer_solid;

/// Of the inner set of both or the outer one: `shrinks` crosses over to the other one of the second operand.
template <class Operation>
Result<UncertainSolid> each_way(const UncertainSolid& p, const UncertainSolid& q, bool shrinks,
                                const Operation& operation) {
  Result<SpatialSum> outer = operation(outer_solid(p), shrinks ? inner_solid(q) : outer_solid(q));
  if (!outer) return outer.error();
  const double error = p.error() + q.error();
  if (UncertainSolidInternals::is_one(p) && UncertainSolidInternals::is_one(q))
    return UncertainSolidInternals::one(*std::move(outer), {}, error);
  Result<SpatialSum> inner = operation(inner_solid(p), shrinks ? outer_solid(q) : inner_solid(q));
  if (!inner) return inner.error();
  return UncertainSolidInternals::pair(*std::move(inner), *std::move(outer), error);
}

}  // namespace

Result<UncertainSolid> minkowski_sum(const UncertainSolid& p, const UncertainSolid& q, const SpatialOptions& options) {
  return each_way(p, q, false,
                  [&](const SpatialOperand& a, const SpatialOperand& b) { return minkowski_sum(a, b, options); });
}

Result<UncertainSolid> erode(const UncertainSolid& p, const UncertainSolid& q, const SpatialOptions& options) {
  if (uncertain::is_empty(q.inner()) && !uncertain::is_empty(q.outer()))
    return Error{ErrorCode::unsupported_operand,
                 "nothing lies in every variant of the part, so every position may be one where it fits: take a "
                 "smaller tolerance",
                 {}};
  return each_way(p, q, true, [&](const SpatialOperand& a, const SpatialOperand& b) { return erode(a, b, options); });
}

Result<UncertainSolid> united(const UncertainSolid& a, const UncertainSolid& b, const SpatialOptions& options) {
  return each_way(a, b, false, [&](const SpatialOperand& p, const SpatialOperand& q) {
    return united(std::array{p, q}, options);
  });
}
Result<UncertainSolid> intersection(const UncertainSolid& a, const UncertainSolid& b, const SpatialOptions& options) {
  return each_way(a, b, false,
                  [&](const SpatialOperand& p, const SpatialOperand& q) { return intersection(p, q, options); });
}
Result<UncertainSolid> difference(const UncertainSolid& a, const UncertainSolid& b, const SpatialOptions& options) {
  return each_way(a, b, true,
                  [&](const SpatialOperand& p, const SpatialOperand& q) { return difference(p, q, options); });
}

}  // namespace dymsum
