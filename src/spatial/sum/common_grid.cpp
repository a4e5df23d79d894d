#include "spatial/sum/common_grid.h"

#include <algorithm>
#include <string>

namespace dymsum::spatial {

namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;

void add(CommonGrid& grid, const BigRational& c) {
  if (c.is_zero()) return;
  const BigInteger above = abs(numerator(c)), below = denominator(c);
  const int power = static_cast<int>(lsb(above)) - static_cast<int>(lsb(below));
  grid.exponent = std::min(grid.exponent.value_or(power), power);
  grid.scale = lcm(grid.scale, BigInteger(below >> lsb(below)));
}

BigInteger multiple(const CommonGrid& grid, const BigRational& c) {
  const BigRational scaled = c * BigRational(grid.scale);
  const BigInteger above = numerator(scaled), below = denominator(scaled);
  const int power = -static_cast<int>(lsb(below)) - grid.exponent.value_or(0);
  return power >= 0 ? BigInteger(above << power) : BigInteger(above >> -power);
}

Error too_wide(std::size_t bits, const Point3& at) {
  Error error{ErrorCode::out_of_range,
              "in units of their common denominator the operands' vertices need " + std::to_string(bits) +
                  " bits, more than " + std::to_string(kMostGridBits),
              {}};
  error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
  return error;
}

}  // namespace

Result<CommonGrid> common_grid(std::span<const ExactSet* const> sets) {
  CommonGrid grid;
  for (const ExactSet* set : sets) {
    for (std::size_t v = 0; v < set->at.size(); ++v) {
      for (const BigRational& c : set->at[v]) add(grid, c);
      if (msb(grid.scale) >= kMostGridBits) return too_wide(msb(grid.scale) + 1, set->set.vertices[v]);
    }
  }
  return grid;
}

Result<std::vector<ExactVertex>> vertices_on(const CommonGrid& grid, const ExactSet& set) {
  std::vector<ExactVertex> vertices;
  for (std::size_t v = 0; v < set.at.size(); ++v) {
    std::array<BigInteger, 3> m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m[axis] = multiple(grid, set.at[v][axis]);
      if (!m[axis].is_zero() && msb(abs(m[axis])) >= kMostGridBits)
        return too_wide(msb(abs(m[axis])) + 1, set.set.vertices[v]);
    }
    vertices.push_back({Big(m[0]), Big(m[1]), Big(m[2])});
  }
  return vertices;
}

}  // namespace dymsum::spatial
