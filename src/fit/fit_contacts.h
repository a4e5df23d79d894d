// What holds a scaled part at a scale at which it has no freedom left.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/scale_range.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// Numbers of obstacle vertices and edges as they are told, by those of the operand.
struct ObstacleIndices {
  std::vector<std::uint32_t> vertices, edges;
};

/// Everything in which part and obstacles touch when the part stands at a tight point of a sum at scale s: a vertex
/// inside an edge, or two vertices; and the vertices inside edges that keep touching along an interval of a tight
/// segment. Sorted by position. Requires: the sum is that of obstacles (operand 0) and a reflected part (operand 1)
/// that scales. O(n m T) doubles for T tight features, exact arithmetic for what they do not distinguish.
std::vector<ScaleContact> tight_contacts(const OperandPair& base, const PlanarSum& sum, const exact::BigRational& s,
                                         const ObstacleIndices& indices);

}  // namespace dymsum::planar
