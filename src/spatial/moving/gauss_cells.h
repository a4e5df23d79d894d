// The sphere of directions in cells, with what of a Gauss map comes near each: the faces of a cube in equal squares.
#pragma once

#include <span>
#include <vector>

#include "spatial/moving/gauss_side.h"

namespace dymsum::spatial {

class GaussCells {
 public:
  explicit GaussCells(const GaussSide& side);

  /// Arcs of four convex edges as the cells were made, in floats: directions of the edges, and the balls around arcs.
  /// Where there are fewer, the radius of what is left over is below zero and far from everything.
  struct FourArcs {
    float x[4], y[4], z[4], centre_x[4], centre_y[4], centre_z[4], radius[4];
    std::uint32_t index[4];
  };
  struct Cell {
    std::span<const FourArcs> arcs;
    std::span<const std::uint32_t> cones;
  };
  /// Arcs nearer to n than reach(), a distance, as the cells were made, and cones nearer than a quarter of that.
  Cell at(Vec3 n) const;
  double reach() const { return reach_; }
  /// Distances from floats are within this of the exact ones.
  static constexpr double kFloatError = 0x1p-20;

 private:
  struct Square {
    std::uint32_t face, u, v, size;  // its lowest cell, and cells along a side
  };
  struct Lists {
    std::vector<std::vector<std::uint32_t>> arcs, cones;  // per cell
  };
  void split(const GaussSide& side, const Square& square, std::span<const std::uint32_t> cones,
             std::span<const std::uint32_t> arcs, Lists& lists) const;
  std::size_t cell(std::uint32_t face, std::uint32_t u, std::uint32_t v) const {
    return (static_cast<std::size_t>(face) * across_ + v) * across_ + u;
  }

  double reach_ = 0;
  std::uint32_t across_ = 1;                           // cells along a side of the cube, a power of two
  std::vector<std::uint32_t> first_arc_, first_cone_;  // per cell; one more at the end
  std::vector<FourArcs> arcs_;
  std::vector<std::uint32_t> cones_;
};

}  // namespace dymsum::spatial
