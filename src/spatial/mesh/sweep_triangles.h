// Polygons with holes split into triangles, by a sweep into monotone pieces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dymsum::spatial {

/// What a sweep asks about places in a plane, by their indices: different indices are different positions.
class PlaneOrder {
 public:
  virtual ~PlaneOrder() = default;
  /// Whether a comes before b along a direction, the same for all, in which no two positions are equally far.
  virtual bool before(std::uint32_t a, std::uint32_t b) = 0;
  /// 1 where a, b, c turn left, -1 right, 0 on a line.
  virtual int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) = 0;
};

/// Triangles, counter-clockwise, each with area, whose union is what lies to the left of the rings: an outer one
/// counter-clockwise and its holes clockwise, perhaps several of these. Rings cross nowhere but may touch in vertices;
/// a way there and back may be part of a ring, to a hole, or a ring: a slit. Nothing, or triangles that use every edge
/// of the rings once and all others twice, in opposite directions, where the rings are not such. O(n log n) for n
/// vertices.
std::optional<std::vector<std::array<std::uint32_t, 3>>> sweep_triangles(
    std::span<const std::vector<std::uint32_t>> rings, PlaneOrder& order);

}  // namespace dymsum::spatial
