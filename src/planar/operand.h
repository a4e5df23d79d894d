// An operand of a planar sum as the convolution sees it: closed walks with the interior on their left, collinear vertices
// dropped, grouped into connected components.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dymsum/region.h"
#include "planar/lattice.h"
#include "planar/separate_touching.h"

namespace dymsum::planar {

enum class LoopKind : std::uint8_t {
  outer,  ///< counter-clockwise boundary of a two-dimensional component
  hole,   ///< clockwise
  curve,  ///< there and back along a polyline
  point,  ///< a single vertex without edges
};

/// A closed walk: walk vertices [first, last); walk edge i starts at walk vertex i.
struct Loop {
  LoopKind kind = LoopKind::outer;
  std::uint32_t component = 0, first = 0, last = 0;
};

/// Loops [first_loop, last_loop), the outer one first; walk vertices [first, last).
struct Component {
  int dimension = 2;
  std::uint32_t first_loop = 0, last_loop = 0, first = 0, last = 0;
};

struct Operand {
  std::uint32_t op = 0;
  std::vector<std::uint32_t> source;       ///< walk vertex -> source vertex
  std::vector<std::uint32_t> next, prev;   ///< walk vertex -> walk vertex
  std::vector<std::uint32_t> vertex_number;  ///< walk vertex -> vertex number in the region
  std::vector<std::uint32_t> edge_number;    ///< walk edge -> edge number in the region
  std::vector<std::uint8_t> convex;        ///< strictly convex, tip of a spike, or a point: it can touch with its vertex
  std::vector<double> ex, ey;              ///< walk edge vectors
  std::vector<Loop> loops;
  std::vector<Component> components;

  std::size_t size() const { return source.size(); }
  Edge edge(std::uint32_t i) const { return {op, source[i], source[next[i]]}; }
};

/// The source vertices of a region in the numbering of region.h.
std::vector<Point> source_vertices(const RegionData& region);

/// Walks and components of operand `op` whose source vertices `lattice` holds.
Operand make_operand(const EngineRegion& region, std::uint32_t op, const Lattice& lattice);

}  // namespace dymsum::planar
