// The pieces of segments that bound the sum: they are linked around nodes, and each patch is queried once.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/frame/local_nodes.h"
#include "planar/frame/local_overlap.h"

namespace dymsum::planar {

/// A piece of segments between two nodes, in the direction of its segment.
struct LocalEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t segment = 0;
};

struct LocalEdges {
  std::vector<LocalEdge> boundary;  ///< in the box, the sum on their left
  std::vector<LocalEdge> tight;     ///< in the box, each once
  std::vector<std::uint32_t> tight_points;
};

enum class Linking : std::uint8_t {
  patches,  ///< one question for each patch; places that may be tight
  none,     ///< a question for every piece and every node: the reference
};

/// Pieces with length. Exact.
LocalEdges local_edges(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking);

/// Pieces in a row on one line made one.
std::vector<LocalEdge> joined(const LocalNodes& nodes, std::vector<LocalEdge> edges);

}  // namespace dymsum::planar
