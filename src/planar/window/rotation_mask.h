// Cells of the sum that stay inside it while an operand rotates a little: what windows of angles are made with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "planar/mask/interior_mask.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// What does not depend on the window.
class RotationGrid {
 public:
  /// All pairs of the longest edges of either operand, some at most, are looked at for every window.
  RotationGrid(const TurningForms& forms, int cells, std::size_t most_long_edges = 24);
  const TurningForms& forms;
  SumGrid grid;
  Raster fixed;
  int cells;
  std::array<std::vector<std::uint32_t>, 2> long_edges;  ///< for edge_parallelograms
};

/// How far a vertex of the rotating operand moves within `half` radians, at most; the chord is shorter than the arc.
inline double moved(const TurningForms& forms, std::uint32_t v, double half) {
  return forms.radius(v) * half * exact::kOutwards;
}

/// How far a vertex at p, about the centre of the turn, moves in either axis within `half` radians, at most: by
/// p (cos - 1) and across it by p sin.
inline Point moved_by(Point p, double half) {
  const double x = std::abs(p.x), y = std::abs(p.y), second = 0.5 * half * half;
  return {(y * half + x * second) * exact::kOutwards, (x * half + y * second) * exact::kOutwards};
}
/// What is at least as far in both axes.
inline Point farther(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }
inline Point farther_by(Point a, double by) { return {a.x + by, a.y + by}; }

/// Cells of the sum that are inside it at every angle within `half` of the one at which the rotating operand's vertices
/// are `turned`.
CoveredCells covered_cells(const RotationGrid& base, const std::vector<Point>& turned, double half);

/// Where long thin bars cross, neither operand has a cell inside, but the sum of two edges does. Edges of an operand
/// whose parallelograms may hold cells of this size, the longest ones; of those that run along each other within a
/// fraction of a cell one; at most `most`.
std::vector<std::uint32_t> long_edges(const TurningForms& forms, std::uint32_t op, double cell, std::size_t most);

/// Cells of the sum that lie inside e + f for long edges e and f, at every angle within `half` of the one at which the
/// rotating operand's vertices are `turned`. The edges cross there properly, so that such a cell is one of int P + int
/// Q.
Bitmap edge_parallelograms(const RotationGrid& grid, const std::vector<Point>& turned, double half);

/// The segments of a window of angles that stay in covered cells: the cells that an edge reaches there, wherever a
/// vertex of the other operand moves it.
class EdgeCells {
 public:
  /// `turned`: the rotating operand's vertices at the midpoint of the window, about its centre; `reach`: how far a
  /// point with each of them moves from there.
  EdgeCells(const TurningForms& forms, const CoveredCells& cells, const std::vector<Point>& turned,
            std::span<const Point> reach);

  /// Whether the segment of an edge of operand `side` and a vertex of the other one lies in covered cells at every
  /// angle.
  bool covered(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const {
    const Bounds sum = edges_[side][edge] + vertices_[side][vertex];
    Whole cell = __builtin_convertvector(sum, Whole);
    cell = cell < 0 ? Whole{} : cell;
    cell = cell > last_ ? last_ : cell;
    return !cells_.any_live(cell[0], cell[1], cell[2], cell[3]);
  }

 private:
  // Low row, low column, high row, high column, in cells.
  using Bounds = float __attribute__((vector_size(16)));
  using Whole = std::int32_t __attribute__((vector_size(16)));

  const CoveredCells& cells_;
  Whole last_{};
  std::array<std::vector<Bounds>, 2> edges_, vertices_;  // by side of the segment
};

}  // namespace dymsum::planar
