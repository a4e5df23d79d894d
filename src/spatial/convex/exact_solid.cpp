#include "spatial/convex/exact_solid.h"

#include "spatial/convex/convex_state.h"
#include "spatial/convex/exact_places.h"

namespace dymsum::spatial {

using exact::Big;
using exact::BigInteger;

Result<ExactSolid> exact_solid(const SolidSum& sum) {
  const ExactPlaces places(spatial::ConvexSumInternals::operands(sum), sum.p_pose, sum.q_pose);
  const BigInteger num = numerator(places.unit()), den = denominator(places.unit());
  if (den != BigInteger(1) << msb(den))
    return Error{ErrorCode::unsupported_operand,
                 "a turned or scaled sum, whose positions are no binary fractions, cannot be an operand",
                 {}};
  ExactSolid solid;
  solid.exponent = -static_cast<int>(msb(den));
  for (const SolidSum::Vertex& v : sum.vertices) {
    const BigVector a = places.of(0, v.p), b = places.of(1, v.q);
    const auto at = [&](int k) { return Big(BigInteger((a[k] + b[k]) * num)); };
    solid.vertices.push_back({at(0), at(1), at(2)});
  }
  for (const SolidFacet& f : sum.facets) solid.faces.push_back(f.vertices);
  return solid;
}

}  // namespace dymsum::spatial
