#include "spatial/sum/exact_set.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "spatial/sum/face_triangles.h"
#include "spatial/sum/sum_of_solids.h"

namespace dymsum::spatial {

namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;

/// The grid that holds all coordinates: multiples of 2^exponent / scale.
struct CommonGrid {
  BigInteger scale = 1;
  std::optional<int> exponent;  // nothing before a coordinate that is not 0

  void add(const BigRational& c) {
    if (c.is_zero()) return;
    const BigInteger above = abs(numerator(c)), below = denominator(c);
    const int power = static_cast<int>(lsb(above)) - static_cast<int>(lsb(below));
    exponent = std::min(exponent.value_or(power), power);
    scale = lcm(scale, BigInteger(below >> lsb(below)));
  }
  bool too_wide() const { return msb(scale) >= kMostGridBits; }
  /// Doubles see units of 2^shift / scale, in which sizes are what they are, up to a factor of two.
  int shift() const { return static_cast<int>(msb(scale)); }
  BigInteger multiple(const BigRational& c) const {
    const BigRational scaled = c * BigRational(scale);
    const BigInteger above = numerator(scaled), below = denominator(scaled);
    const int power = -static_cast<int>(lsb(below)) - exponent.value_or(0);
    return power >= 0 ? BigInteger(above << power) : BigInteger(above >> -power);
  }
};

Error too_wide(std::size_t bits, const Point3& at) {
  Error error{ErrorCode::out_of_range,
              "in units of their common denominator the operands' vertices need " + std::to_string(bits) +
                  " bits, more than " + std::to_string(kMostGridBits),
              {}};
  error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
  return error;
}

Result<SolidOperand> operand_on(const ExactSet& set, const CommonGrid& grid) {
  std::vector<ExactVertex> vertices;
  for (std::size_t v = 0; v < set.at.size(); ++v) {
    std::array<BigInteger, 3> m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m[axis] = grid.multiple(set.at[v][axis]);
      if (!m[axis].is_zero() && msb(abs(m[axis])) >= kMostGridBits)
        return too_wide(msb(abs(m[axis])) + 1, set.set.vertices[v]);
    }
    vertices.push_back({Big(m[0]), Big(m[1]), Big(m[2])});
  }
  return solid_operand(set.set, set.thin, std::move(vertices), grid.exponent.value_or(0) - grid.shift());
}

}  // namespace

ExactSet exact_set(MeshData set, std::vector<bool> thin) {
  ExactSet result{std::move(set), std::move(thin), {}};
  for (const Point3& v : result.set.vertices)
    result.at.push_back({exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)});
  return result;
}

ExactSet exact_set(const SpatialSum& sum) {
  ExactSet result;
  if (sum.vertices.empty()) return result;
  std::vector<bool> used(sum.vertices.size());
  std::vector<std::uint32_t> name(sum.vertices.size());
  const Triangles all = triangulated(sum);
  for (const Triangle& t : all.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    name[v] = static_cast<std::uint32_t>(result.at.size());
    result.at.push_back(positions.at(v));
    result.set.vertices.push_back(positions.rounded(v));
  }
  for (const Triangle& t : all.triangles) result.set.faces.push_back({name[t[0]], name[t[1]], name[t[2]]});
  return result;
}

Result<SpatialSum> sum_of_exact_sets(const ExactSet& p, const ExactSet& q, const SpatialOptions& options) {
  CommonGrid grid;
  for (const ExactSet* set : {&p, &q})
    for (std::size_t v = 0; v < set->at.size(); ++v) {
      for (const BigRational& c : set->at[v]) grid.add(c);
      if (grid.too_wide()) return too_wide(msb(grid.scale) + 1, set->set.vertices[v]);
    }
  const Result<SolidOperand> a = operand_on(p, grid), b = operand_on(q, grid);
  if (!a || !b) return a ? b.error() : a.error();
  Result<SpatialSum> sum = sum_of_operands(*a, *b, options);
  if (!sum) return sum;
  SpatialSum made = *std::move(sum);
  unscale(made, grid.scale, grid.shift());
  return made;
}

}  // namespace dymsum::spatial
