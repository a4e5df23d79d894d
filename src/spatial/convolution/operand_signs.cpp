#include "spatial/convolution/operand_signs.h"

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

int SignsOfFractions::orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  return sign(exact::determinant(direction(a, b), direction(a, c), direction(a, d)));
}

int SignsOfFractions::normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const {
  return sign(component(cross(direction(a, b), direction(a, c)), axis));
}

int SignsOfFractions::order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
  return sign(component(at_[b], axis) - component(at_[a], axis));
}

}  // namespace dymsum::spatial
