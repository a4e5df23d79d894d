#include "spatial/convolution/operand_signs.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/interval.h"

namespace dymsum::spatial {

namespace {

/// The component on an axis of a vector of doubles or of fractions.
template <class V>
const auto& component(const V& v, exact::Axis axis) {
  return axis == exact::Axis::x ? v.x : axis == exact::Axis::y ? v.y : v.z;
}

}  // namespace

int SignsOfDoubles::order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
  const double from = component(at_[a], axis), to = component(at_[b], axis);
  return (to > from) - (to < from);
}

namespace {

using Near = std::array<exact::Interval, 3>;

/// The coordinates of b - a, by the nearest doubles of both: fractions of thousands of digits have the sign of these,
/// mostly, and what they have in common takes longer to find than all else.
Near near_direction(const ExactVertex& a, const ExactVertex& b) {
  const auto near = [](const exact::Fraction& v) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const double x = exact::round_to_double(v.above(), v.below());
    return exact::Interval(std::nextafter(x, -kFar), std::nextafter(x, kFar));
  };
  return {near(b.x) - near(a.x), near(b.y) - near(a.y), near(b.z) - near(a.z)};
}

/// The component of u x v along an axis.
exact::Interval cross_component(const Near& u, const Near& v, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, k = (axis + 2) % 3;
  return u[i] * v[k] - u[k] * v[i];
}

}  // namespace

int SignsOfFractions::orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  const Near u = near_direction(at_[a], at_[b]), v = near_direction(at_[a], at_[c]), w = near_direction(at_[a], at_[d]);
  const exact::Interval volume =
      cross_component(u, v, 0) * w[0] + cross_component(u, v, 1) * w[1] + cross_component(u, v, 2) * w[2];
  if (!volume.contains_zero()) return volume.low() > 0 ? 1 : -1;
  return sign(exact::determinant(direction(a, b), direction(a, c), direction(a, d)));
}

int SignsOfFractions::normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const {
  const exact::Interval near = cross_component(near_direction(at_[a], at_[b]), near_direction(at_[a], at_[c]),
                                               axis == exact::Axis::x   ? 0
                                               : axis == exact::Axis::y ? 1
                                                                        : 2);
  if (!near.contains_zero()) return near.low() > 0 ? 1 : -1;
  return sign(component(cross(direction(a, b), direction(a, c)), axis));
}

int SignsOfFractions::order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
  return sign(component(at_[b], axis) - component(at_[a], axis));
}

}  // namespace dymsum::spatial
