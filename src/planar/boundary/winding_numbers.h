// Winding numbers of closed walks, left and right of every edge of the graph they form.
#pragma once

#include <vector>

#include "base/memory_budget.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/arrangement/soup.h"

namespace dymsum::planar {

/// Segments of which segment s counts signs[s] times. Together they must start as often as they end at every position.
struct Tracing {
  Tracing(const Lattice& lattice, const Operand& p, const Operand& q, Scratch* scratch = nullptr)
      : soup(lattice, p, q, scratch) {}

  void add(const WalkSegment& w, int sign) {
    soup.add(w, soup.box(w));
    signs.push_back(sign);
  }

  Soup soup;
  base::CountedArray<int> signs;
};

/// Winding numbers left and right of an edge, seen from its low end.
struct Sides {
  int left = 0, right = 0;
  friend bool operator==(const Sides&, const Sides&) = default;
};

/// The winding numbers beside all edges of the tracing's graph: one ray for every connected piece, then around the
/// nodes. Throws std::logic_error when the tracing is not closed.
std::vector<Sides> find_windings(const Tracing& tracing, const SegmentGraph& graph);

}  // namespace dymsum::planar
