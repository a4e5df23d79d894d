// Cells that lie in the sum of two edges at every angle of a window: where long thin bars cross, neither operand has a
// cell inside, but their sum does.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/turning/turn_grid.h"

namespace dymsum::planar {

/// Edges of an operand whose parallelograms may hold cells of this size, the longest ones; of those that run along each
/// other within a fraction of a cell one; at most `most`.
std::vector<std::uint32_t> long_edges(const TurningForms& forms, std::uint32_t op, double cell, std::size_t most);

/// Cells of the sum that lie inside e + f for long edges e and f, at every angle within `half` of the one at which the
/// turning operand's vertices are `turned`. The edges cross there properly, so that such a cell is one of int P + int
/// Q.
Bitmap edge_parallelograms(const TurnGrid& grid, const std::vector<Point>& turned, double half);

}  // namespace dymsum::planar
