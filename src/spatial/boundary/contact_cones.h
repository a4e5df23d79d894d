// Two solids touch at a point: do their interiors overlap near it?
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

/// The part of a solid's boundary on which a point lies.
struct Feature {
  enum class Kind : std::uint8_t { vertex, wedge, triangle } kind = Kind::vertex;
  std::uint32_t index = 0;
  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// An operand with the boxes of its triangles, and of the segments that it lists.
struct IndexedSolid {
  const SolidOperand& solid;
  const std::vector<Vec3>& at;  ///< its vertices, within the space's sum_radius()
  const BoxTree &triangles, &segments;
};

/// Whether the interiors of P's cone at feature p and of the cone of -Q at feature -q overlap, both with one apex; of
/// thin parts there, whether they meet the other one's interior. Exact. O(k l) for k and l triangles there, and those
/// over a vertex.
bool cones_overlap(const SumSpace& space, const IndexedSolid& p, Feature at_p, const IndexedSolid& q, Feature at_q);

}  // namespace dymsum::spatial
