// Two solids touch at a point: do their interiors overlap near it?
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// The part of a solid's boundary on which a point lies.
struct Feature {
  enum class Kind : std::uint8_t { vertex, wedge, triangle } kind = Kind::vertex;
  std::uint32_t index = 0;
  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// Whether the interiors of P's cone at feature p and of the cone of -Q at feature -q overlap, both with one apex; of
/// thin parts there, whether they meet the other one's interior. Exact. O(k l) for k and l triangles there.
bool cones_overlap(const SumSpace& space, const SolidOperand& p, Feature at_p, const SolidOperand& q, Feature at_q);

}  // namespace dymsum::spatial
