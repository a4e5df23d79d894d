#include "spatial/sum/convex_measures.h"

#include <vector>

#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;

exact::Vector3<Big> big_vector(const BigVector& v) { return {Big(v[0]), Big(v[1]), Big(v[2])}; }

BigInteger determinant(const BigVector& a, const BigVector& b, const BigVector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Positions are numerators times this.
BigRational unit_of(const SpatialSum& sum) {
  return SpatialSumInternals::convex(sum)->unit() / SpatialSumInternals::positions(sum).scale;
}

}  // namespace

BigRational convex_volume(const SpatialSum& sum) {
  const std::vector<BigVector> at = SpatialSumInternals::convex(sum)->numerators();
  BigInteger six = 0;
  for (const SpatialFace& f : sum.faces) {
    const std::vector<std::uint32_t>& loop = f.loops[0];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) six += determinant(at[loop[0]], at[loop[i]], at[loop[i + 1]]);
  }
  const BigRational unit = unit_of(sum);
  return BigRational(six) * unit * unit * unit / 6;
}

LengthSum convex_surface(const SpatialSum& sum) {
  const std::vector<BigVector> at = SpatialSumInternals::convex(sum)->numerators();
  LengthSum surface;
  for (const SpatialFace& f : sum.faces) {
    const std::vector<std::uint32_t>& loop = f.loops[0];
    exact::Vector3<Big>& twice = surface.vectors.emplace_back();
    const auto from_first = [&](std::size_t i) { return big_vector(at[loop[i]]) - big_vector(at[loop[0]]); };
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) twice = twice + exact::cross(from_first(i), from_first(i + 1));
  }
  const BigRational unit = unit_of(sum);
  surface.unit = unit * unit / 2;
  return surface;
}

std::size_t convex_volume_bits(const SpatialSum& sum) {
  const BigInteger below = denominator(unit_of(sum));
  return 3 * (msb(below) - lsb(below));
}

}  // namespace dymsum::spatial
