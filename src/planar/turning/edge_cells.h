// Which segments of a window of angles stay in covered cells: the cells that an edge reaches there, wherever a vertex
// of the other operand moves it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planar/mask/covered_cells.h"
#include "planar/turning/turning_forms.h"

namespace dymsum::planar {

class EdgeCells {
 public:
  /// `turned`: the turning operand's vertices at the middle of the window, about its centre; `reach`: how far a point
  /// with each of them moves from there.
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
