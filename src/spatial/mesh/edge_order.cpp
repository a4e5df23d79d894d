#include "spatial/mesh/edge_order.h"

#include <algorithm>

#include "spatial/mesh/face_plane.h"

namespace dymsum::spatial {
namespace {

/// A side of an edge: its face lies, near the edge, towards `apex`, or away from it where the sign is negative.
struct Side {
  std::uint32_t half_edge = 0;
  bool forward = false;  ///< from the smaller end to the larger one
  std::uint32_t apex = 0;
  int sign = 1;
};

class AroundEdge {
 public:
  AroundEdge(const MeshData& data, const HalfEdges& edges, std::uint32_t low, std::uint32_t high)
      : data_(data), edges_(edges), low_(data.vertices[low]), high_(data.vertices[high]), low_index_(low) {}

  /// Counter-clockwise seen against the way from the smaller end to the larger one.
  std::vector<Side> sorted(const EdgeSide* first, const EdgeSide* last) {
    std::vector<Side> sides;
    for (const EdgeSide* s = first; s != last; ++s) sides.push_back(side_of(s->half_edge));
    reference_ = sides[0];
    std::stable_sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return before(a, b); });
    return sides;
  }
  bool on_each_other(const Side& a, const Side& b) const { return !before(a, b) && !before(b, a); }

 private:
  const Point3& at(std::uint32_t v) const { return data_.vertices[v]; }

  Side side_of(std::uint32_t h) const {
    const FacePlane plane = face_plane(data_.vertices, data_.faces[edges_.face[h]]);
    const Point3 &from = at(edges_.origin[h]), &to = at(edges_.target(h));
    for (std::uint32_t g = edges_.next[edges_.next[h]];; g = edges_.next[g]) {
      const int turn = turn_sign(plane, from, to, at(edges_.origin[g]));
      if (turn != 0) return {h, edges_.origin[h] == low_index_, edges_.origin[g], turn};
    }
  }

  int turn(const Side& a, const Side& b) const {
    return a.sign * b.sign * exact::orient3_sign(low_, high_, at(a.apex), at(b.apex));
  }
  /// 0 along the reference, 1 before half a turn, 2 opposite, 3 beyond.
  int sector(const Side& s) const {
    if (const int t = turn(reference_, s); t != 0) return t > 0 ? 1 : 3;
    for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x}) {
      const int a = exact::normal_sign(low_, high_, at(reference_.apex), axis);
      if (a != 0) return same_half(a, s, axis) ? 0 : 2;
    }
    return same_half(exact::normal_sign(low_, high_, at(reference_.apex), exact::Axis::y), s, exact::Axis::y) ? 0 : 2;
  }
  bool same_half(int of_reference, const Side& s, exact::Axis axis) const {
    return reference_.sign * of_reference == s.sign * exact::normal_sign(low_, high_, at(s.apex), axis);
  }
  bool before(const Side& a, const Side& b) const {
    const int x = sector(a), y = sector(b);
    if (x != y) return x < y;
    return (x == 1 || x == 3) && turn(a, b) > 0;
  }

  const MeshData& data_;
  const HalfEdges& edges_;
  const Point3 &low_, &high_;
  std::uint32_t low_index_;
  Side reference_;
};

}  // namespace

std::optional<SideClash> join_around(HalfEdges& edges, const std::vector<EdgeSide>& sides, const MeshData& data) {
  join_twins(edges, sides);
  std::optional<SideClash> clash;
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first <= 2 || clash) return;
    AroundEdge around(data, edges, static_cast<std::uint32_t>(first->ends >> 32),
                      static_cast<std::uint32_t>(first->ends));
    const std::vector<Side> sorted = around.sorted(first, last);
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const Side &back = sorted[k], &ahead = sorted[(k + 1) % sorted.size()];
      if (back.forward == ahead.forward || around.on_each_other(back, ahead)) {
        clash = {back.half_edge, ahead.half_edge};
        return;
      }
      if (back.forward) continue;  // counter-clockwise of a side that runs forward lies the outside
      edges.twin[back.half_edge] = ahead.half_edge;
      edges.twin[ahead.half_edge] = back.half_edge;
    }
  });
  return clash;
}

HalfEdges half_edges(const MeshData& valid) {
  HalfEdges edges = half_edges_without_twins(valid.faces);
  join_around(edges, edge_sides(edges), valid);
  return edges;
}

}  // namespace dymsum::spatial
