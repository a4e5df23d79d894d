// An operand of a planar sum as the convolution sees it: closed walks with the interior on their left, collinear
// vertices dropped, grouped into connected components; and everything about them that does not depend on the other
// operand.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "planar/operand/edges.h"
#include "planar/operand/lattice.h"
#include "planar/region/region.h"

namespace dymsum::planar {

// Both operands of a sum where they stand.

class Lattice;
struct Operand;

/// P and Q on their common lattice.
struct PlacedPair {
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
};

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
  Operand() = default;
  /// An operand with room for `bytes` of arrays in one block.
  explicit Operand(std::size_t bytes) : memory(bytes) {}

  template <class T>
  using List = OwnArray<T>;
  OwnMemory memory;
  std::uint32_t op = 0;
  bool reflected = false;  ///< of the region's reflection: evidence shows coordinates as the region has them
  List<std::uint32_t> source{memory};              ///< walk vertex -> source vertex
  List<std::uint32_t> next{memory}, prev{memory};  ///< walk vertex -> walk vertex
  List<std::uint32_t> vertex_index{memory};        ///< walk vertex -> vertex index in the region
  List<std::uint32_t> edge_index{memory};          ///< walk edge -> edge index in the region
  struct Indices {
    std::uint32_t vertex = 0, edge = 0, next_vertex = 0;
  };
  List<Indices> indices{memory};                ///< the same side by side, with the number of the edge's end
  List<std::uint32_t> vertex_of_index{memory};  ///< vertex index -> source vertex
  List<std::array<std::uint32_t, 2>> edge_of_index{memory};  ///< edge index -> the source vertices of its walk edge
  List<std::uint8_t> convex{memory};    ///< strictly convex, tip of a spike, or a point: it can touch with its vertex
  List<double> x{memory}, y{memory};    ///< walk vertices, in the units of `points`
  List<double> ex{memory}, ey{memory};  ///< walk edge vectors, each component rounded once
  List<EdgeBox> boxes{memory};          ///< walk edges: the same side by side
  List<Loop> loops{memory};
  List<Component> components{memory};
  List<std::uint32_t> component_of{memory};  ///< walk vertex -> component
  List<DirectionList> directions{memory};
  List<std::array<std::uint32_t, 2>> component_directions{memory};  ///< per component: all its edges, its outer loop's
  std::shared_ptr<const PlacedPoints> points;                       ///< the source vertices

  std::size_t size() const { return source.size(); }
  const std::vector<EdgeTree>& trees() const { return trees_.of(*this); }  ///< per component
  Edge edge(std::uint32_t i) const { return {op, source[i], source[next[i]]}; }
  /// Edges moved.
  void forget_trees() { trees_ = EdgeTrees(); }

 private:
  EdgeTrees trees_;
};

/// No segment, piece, edge or vertex.
inline constexpr std::uint32_t kNone = 0xffffffff;

/// A segment by walk edge of one side and walk vertex of the other: side 0 is edge of P + vertex of Q.
struct WalkSegment {
  std::uint32_t side = 0, edge = 0, vertex = 0;
};

/// A pair of walk vertices (P, Q).
using WalkPair = Pair;

/// Operand `op` (0 = P, 1 = Q) of a region, or of its reflection. O(n log n); independent of the other operand, so that
/// it can be kept.
std::shared_ptr<Operand> make_operand(const EngineRegion& region, std::uint32_t op, bool reflected = false);

/// The operand in the units and relative to the offset of a lattice that places its points differently: because the
/// other operand is huge or minute, because it is scaled, or because there are further points.
std::shared_ptr<const Operand> placed_on(const Lattice& lattice, std::shared_ptr<const Operand> operand);

/// The error for a coordinate that no sum can take: larger than 2^1000, so that differences overflow.
std::optional<Error> too_large(const PlacedPoints& points);
std::optional<Error> too_large(const Operand& operand);

/// Whether some component is a polyline or a point.
bool has_component_without_area(const Operand& operand);

// What a segment of the convolution is called in the regions.

/// Requires: operands P and Q.
inline Contact contact_of(const WalkSegment& s, const Operand& p, const Operand& q) {
  if (s.side == 0) return {Contact::Kind::edge_of_p, p.edge_index[s.edge], q.vertex_index[s.vertex]};
  return {Contact::Kind::edge_of_q, p.vertex_index[s.vertex], q.edge_index[s.edge]};
}

// What the engine keeps of a region from one sum to the next: the region as an operand, in each role it has played so
// far.

/// Shared by all copies of a region; each operand is made when it is first requested. Thread-safe.
class PreparedRegion {
 public:
  /// The region, or its reflection, as operand `op`. Requires: always the same region.
  std::shared_ptr<const Operand> operand(const Region& region, std::uint32_t op, bool reflected);

 private:
  struct Slot {
    std::atomic<bool> made = false;
    std::shared_ptr<const Operand> operand;
  };
  std::array<Slot, 4> slots_;
  std::mutex making_;  // a once_flag asks the system to wake whoever waits, which takes as long as a small operand
};

/// The region, or its reflection, as operand `op`, kept with the region.
std::shared_ptr<const Operand> prepared_operand(const Region& region, std::uint32_t op, bool reflected = false);

}  // namespace dymsum::planar
