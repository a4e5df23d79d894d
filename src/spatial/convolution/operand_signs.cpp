#include "spatial/convolution/operand_signs.h"

namespace dymsum::spatial {

namespace {

/// The component on an axis of a vector of doubles or of integers.
template <class V>
const auto& component(const V& v, exact::Axis axis) {
  return axis == exact::Axis::x ? v.x : axis == exact::Axis::y ? v.y : v.z;
}

}  // namespace

int SignsOfDoubles::order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
  const double from = component(at_[a], axis), to = component(at_[b], axis);
  return (to > from) - (to < from);
}

int SignsOfIntegers::orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  return sign(exact::determinant(at_[b] - at_[a], at_[c] - at_[a], at_[d] - at_[a]));
}

int SignsOfIntegers::normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const {
  return sign(component(cross(at_[b] - at_[a], at_[c] - at_[a]), axis));
}

int SignsOfIntegers::order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const {
  return sign(component(at_[b], axis) - component(at_[a], axis));
}

}  // namespace dymsum::spatial
