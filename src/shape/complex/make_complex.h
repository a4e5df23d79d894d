// Nodes and edges from matched cells.
#pragma once

#include <optional>

#include "base/poll.h"
#include "shape/complex/candidates.h"
#include "shape/complex/envelope.h"
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
Complex ranked(Graph graph, std::shared_ptr<ExactComplex> exact, Work work);

// The complex of given walks, from a guess which may be wrong.

/// The same complex whatever the guess: it is completed, certified, and where that fails replaced by all pairs, as
/// where there is none. Throws Cancelled.
Complex complex_from(Walks walks, std::optional<Candidates> guess, int threads, const Poll& poll);
/// The same from rough candidates, if these are good, or else from better ones.
Complex complex_from_rough(Walks walks, int threads, const Poll& poll);

}  // namespace dymsum::shape
