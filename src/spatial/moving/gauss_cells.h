// The sphere of directions in cells, with what of a Gauss map comes near each: a cube whose faces are split in quarters
// where much does.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "spatial/moving/gauss_side.h"

namespace dymsum::spatial {

class GaussCells {
 public:
  explicit GaussCells(const GaussSide& side);

  struct Cell {
    std::span<const std::uint32_t> cones, arcs;
  };
  /// Arcs nearer to n than reach(), a distance, as the cells were made, and cones nearer than a quarter of that.
  Cell at(Vec3 n) const;
  double reach() const { return reach_; }

 private:
  struct Square {
    std::uint32_t face;
    double u, v, size;  // its lowest corner, in [-1, 1]
  };
  struct Node {
    std::uint32_t children = 0;  // the first of four, or 0 for a leaf
    std::uint32_t cones = 0, arcs = 0, end = 0;
  };
  void split(const GaussSide& side, std::uint32_t node, const Square& square, std::span<const std::uint32_t> cones,
             std::span<const std::uint32_t> arcs, int depth);

  double reach_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> lists_;
};

}  // namespace dymsum::spatial
