// Nodes and edges from matched cells.
#pragma once

#include "shape/complex/cells.h"
#include "shape/complex/exact_complex.h"

namespace dymsum::shape {

/// A complex whose nodes are in no particular order and have neither ranks nor doubles.
struct Graph {
  std::vector<Node> nodes;
  std::vector<DiscSource> discs;                     ///< per node
  std::vector<std::vector<std::uint32_t>> contacts;  ///< per node
  std::vector<std::vector<Spoke>> spokes;            ///< per node, counter-clockwise
  std::vector<Edge> edges;
};

/// Requires: match_cells succeeded.
Graph assemble(Order& order, const Cells& cells);

/// Sorts by radius, exactly. `exact` gets what it needs but the walks, which it has.
Complex ranked(Graph graph, std::shared_ptr<ExactComplex> exact, exact::FilterCounts& counts);

}  // namespace dymsum::shape
