// A convex sum as an operand of the next one, from its exact positions.
#include <memory>
#include <utility>

#include "dymsum/convex_memory.h"
#include "spatial/convex/convex_state.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
namespace {

using exact::Big;
using exact::BigInteger;

/// The sum's exact vertices and faces. Errors: unsupported_operand where positions are not multiples of a power of two.
Result<spatial::ExactSolid> exact_solid(const SpatialSum& sum) {
  const spatial::ConvexPositions* positions = spatial::SpatialSumInternals::convex(sum);
  if (!positions) return Error{ErrorCode::unsupported_operand, "this sum was not made of convex solids", {}};
  const exact::BigRational unit = positions->unit() / spatial::SpatialSumInternals::positions(sum).scale;
  const BigInteger num = numerator(unit), den = denominator(unit);
  if (den != BigInteger(1) << msb(den))
    return Error{ErrorCode::unsupported_operand,
                 "a turned or scaled sum, whose positions are no binary fractions, cannot be an operand",
                 {}};
  spatial::ExactSolid solid;
  solid.exponent = -static_cast<int>(msb(den));
  for (const spatial::BigVector& at : positions->numerators())
    solid.vertices.push_back(
        {Big(BigInteger(at[0] * num)), Big(BigInteger(at[1] * num)), Big(BigInteger(at[2] * num))});
  for (const SpatialFace& f : sum.faces) solid.faces.push_back(f.loops[0]);
  return solid;
}

}  // namespace

Result<ConvexSum> ConvexSum::create(const SpatialSum& p, const Mesh& q) { return convex_sum_within(p, q, 0); }

Result<ConvexSum> convex_sum_within(const SpatialSum& p, const Mesh& q, std::uint64_t memory) {
  Result<spatial::ExactSolid> solid = exact_solid(p);
  if (!solid) return solid.error();
  Result<spatial::Polytope> b = spatial::make_polytope(q);
  if (!b) return b.error();
  auto source = std::make_shared<spatial::ConvexOperands>();
  source->operand[0].exact = solid->vertices;
  source->operand[0].exponent = solid->exponent;
  source->operand[1].vertices = q.vertices();
  return spatial::ConvexSumInternals::of(std::make_shared<const spatial::Polytope>(spatial::make_polytope(*solid)),
                                         std::make_shared<const spatial::Polytope>(std::move(b).value()),
                                         std::move(source), memory);
}

}  // namespace dymsum
