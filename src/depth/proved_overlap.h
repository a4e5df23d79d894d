// Overlap that doubles prove.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "depth/depth_operands.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

/// A vertex that is inside, or an edge of one solid that crosses a triangle of the other, determined by doubles with a
/// margin: a "no" says nothing.
class ProvedOverlap {
 public:
  explicit ProvedOverlap(const DepthOperands& o);

  /// Whether P and Q provably overlap at all positions within `radius` of one, in each coordinate. Pairs that crossed
  /// at the last positions are tried first, then those whose boxes overlap, some of them; then places inside one solid,
  /// whether they are inside the other: they determine where faces are flush and nothing crosses.
  bool holds(spatial::Vec3 at, double radius);

 private:
  struct Solid {
    const spatial::SolidOperand& solid;
    const std::vector<spatial::Vec3>& at;
    spatial::BoxTree tree;
    std::vector<spatial::Vec3> inner;  // places inside
    std::size_t last = 0;              // of these, inside the other solid last time

    Solid(const spatial::SolidOperand& operand, const std::vector<spatial::Vec3>& positions);
    bool contains(spatial::Vec3 position, double margin) const;
  };
  bool crosses(std::uint32_t i, std::uint32_t j, spatial::Vec3 at, double radius) const;
  bool some_inside(Solid& of, const Solid& other, spatial::Vec3 at, double margin);

  const DepthOperands& o_;
  Solid p_, q_;
  std::vector<std::array<std::uint32_t, 2>> witnesses_;  // the last one first
};

}  // namespace dymsum::depth
