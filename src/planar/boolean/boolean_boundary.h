// The boundary of a Boolean expression, from the windings of its inputs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/boolean/planar_boolean.h"
#include "planar/boundary/boundary.h"
#include "planar/result/pieces.h"

namespace dymsum::planar {

// How often the rings of every input go around each side of the edges of a graph.

class InputWindings {
 public:
  /// `input_of`: segment -> input, of `inputs`. The segments of each are closed rings. One ray for every connected
  /// piece of the graph, then around its nodes.
  InputWindings(const Soup& soup, const SegmentGraph& graph, const std::vector<std::uint32_t>& input_of,
                std::size_t inputs, const Poll& poll);

  /// The winding number of every input on the left or the right of an edge as seen from its low end.
  std::span<const std::int32_t> left(std::uint32_t edge) const { return side(edge, 0); }
  std::span<const std::int32_t> right(std::uint32_t edge) const { return side(edge, 1); }
  /// The winding numbers of the face counter-clockwise of a ray.
  std::span<const std::int32_t> beside(const SegmentGraph::Ray& ray) const {
    return ray.forward ? left(ray.edge) : right(ray.edge);
  }

 private:
  std::span<const std::int32_t> side(std::uint32_t edge, std::size_t k) const {
    return {windings_.data() + (2 * std::size_t{edge} + k) * inputs_, inputs_};
  }
  std::span<std::int32_t> side(std::uint32_t edge, std::size_t k) {
    return {windings_.data() + (2 * std::size_t{edge} + k) * inputs_, inputs_};
  }

  std::size_t inputs_;
  base::CountedArray<std::int32_t> windings_;
};

/// Rings where faces inside meet faces outside. Cracks and punctures: edges and nodes whose faces are all inside, or
/// all outside, and that lie in the closed set and not in the open one. `pieces`: those of them that lie outside.
struct BooleanBoundary {
  RawBoundary boundary;
  PieceCandidates pieces;
};
BooleanBoundary boolean_boundary(const Soup& soup, const SegmentGraph& graph, const InputWindings& windings,
                                 const SegmentInputs& segments, const BooleanTerms& terms);

}  // namespace dymsum::planar
