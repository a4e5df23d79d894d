// An operand of a planar sum as the convolution sees it: closed walks with the interior on their left, collinear vertices
// dropped, grouped into connected components; and everything about them that does not depend on the other operand.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/region.h"
#include "planar/directions.h"
#include "planar/edge_tree.h"
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
  std::uint32_t min_x = 0, max_x = 0, min_y = 0, max_y = 0;  ///< source vertices that span its bounding box
};

/// Loops [first_loop, last_loop), the outer one first; walk vertices [first, last).
struct Component {
  int dimension = 2;
  bool convex = false;  ///< two-dimensional, and all vertices of the outer loop are convex
  std::uint32_t first_loop = 0, last_loop = 0, first = 0, last = 0;
  std::uint32_t widest_hole = 0, tallest_hole = 0;  ///< loops, by rounded coordinates; where it has holes
};

/// An edge by its rounded end points and vector, for filters: side by side, because whoever tests it needs all of them.
struct EdgeBox {
  double ax, ay, bx, by;
  double dx, dy;  ///< each component rounded once, not the difference of the ends
};

struct Operand {
  std::uint32_t op = 0;
  bool reflected = false;                  ///< of the region's reflection: evidence shows coordinates as the region has them
  std::vector<std::uint32_t> source;       ///< walk vertex -> source vertex
  std::vector<std::uint32_t> next, prev;   ///< walk vertex -> walk vertex
  std::vector<std::uint32_t> vertex_number;  ///< walk vertex -> vertex number in the region
  std::vector<std::uint32_t> edge_number;    ///< walk edge -> edge number in the region
  struct Numbers {
    std::uint32_t vertex = 0, edge = 0, next_vertex = 0;
  };
  std::vector<Numbers> numbers;            ///< the same side by side, with the number of the edge's end
  std::vector<std::uint32_t> numbered_vertex;  ///< vertex number -> source vertex
  std::vector<std::array<std::uint32_t, 2>> numbered_edge;  ///< edge number -> the source vertices of its walk edge
  std::vector<std::uint8_t> convex;        ///< strictly convex, tip of a spike, or a point: it can touch with its vertex
  std::vector<double> x, y;                ///< walk vertices, in the units of `points`
  std::vector<double> ex, ey;              ///< walk edge vectors, each component rounded once
  std::vector<EdgeBox> boxes;              ///< walk edges: the same side by side
  std::vector<Loop> loops;
  std::vector<Component> components;
  std::vector<std::uint32_t> component_of; ///< walk vertex -> component
  std::vector<DirectionList> directions;
  std::vector<std::array<std::uint32_t, 2>> component_directions;  ///< per component: all its edges, its outer loop's
  std::vector<EdgeTree> trees;             ///< per component
  std::shared_ptr<const PlacedPoints> points;  ///< the source vertices

  std::size_t size() const { return source.size(); }
  Edge edge(std::uint32_t i) const { return {op, source[i], source[next[i]]}; }
};

/// Operand `op` (0 = P, 1 = Q) of a region. O(n log n); independent of the other operand, so that it can be kept.
std::shared_ptr<Operand> make_operand(const EngineRegion& region, std::uint32_t op);

/// The operand in the units and relative to the offset of a lattice that places its points differently: because the other operand
/// is huge or minute, because it is scaled, or because there are further points.
std::shared_ptr<const Operand> placed_on(const Lattice& lattice, std::shared_ptr<const Operand> operand);

/// The error for a coordinate that no sum can take: larger than 2^1000, so that differences overflow.
std::optional<Error> too_large(const PlacedPoints& points);
std::optional<Error> too_large(const Operand& operand);

}  // namespace dymsum::planar
