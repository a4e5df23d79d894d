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

/// Leaves out sides around an edge that lie inside, where only one of neighbours in one direction can bound: the first
/// one where the inside begins, the last one where it ends. `left_out` of the half-edges; false where no two bound.
bool leave_out_inner(const std::vector<Side>& sorted, std::vector<bool>& left_out) {
  const std::size_t n = sorted.size();
  const auto forward = [&](const Side& side) { return side.forward; };
  if (std::all_of(sorted.begin(), sorted.end(), forward) || std::none_of(sorted.begin(), sorted.end(), forward))
    return false;
  for (std::size_t k = 0; k < n; ++k) {
    const Side &side = sorted[k], &back = sorted[(k + n - 1) % n], &ahead = sorted[(k + 1) % n];
    left_out[side.half_edge] = (side.forward ? ahead : back).forward == side.forward;
  }
  return true;
}

/// The faces that edges of two sides join, as a whole.
std::vector<std::uint32_t> patches_of(const HalfEdges& edges, const std::vector<EdgeSide>& sides) {
  HalfEdges joined = edges;
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first != 2) return;
    joined.twin[first[0].half_edge] = first[1].half_edge;
    joined.twin[first[1].half_edge] = first[0].half_edge;
  });
  return find_shells(joined).of_face;
}

}  // namespace

std::vector<bool> membranes(const MeshData& data) {
  const HalfEdges edges = half_edges_without_twins(data.faces);
  const std::vector<EdgeSide> sides = edge_sides(edges);
  std::vector<bool> left_out(edges.size()), at_crowd(edges.size());
  bool odd = false, sound = true;
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    sound &= last - first > 1;
    if (last - first <= 2) return;
    odd |= (last - first) % 2 == 1;
    AroundEdge around(data, edges, static_cast<std::uint32_t>(first->ends >> 32),
                      static_cast<std::uint32_t>(first->ends));
    const std::vector<Side> sorted = around.sorted(first, last);
    for (const Side& side : sorted) at_crowd[side.half_edge] = true;
    for (std::size_t k = 0; k < sorted.size(); ++k)
      sound &= !around.on_each_other(sorted[k], sorted[(k + 1) % sorted.size()]);
    sound &= leave_out_inner(sorted, left_out);
  });
  if (!odd || !sound) return {};
  const std::vector<std::uint32_t> patch = patches_of(edges, sides);
  std::vector<bool> inner(data.faces.size()), outer(data.faces.size());  // of patches
  for (std::uint32_t h = 0; h < edges.size(); ++h)
    if (at_crowd[h]) (left_out[h] ? inner : outer)[patch[edges.face[h]]] = true;
  std::vector<bool> found(data.faces.size());
  for (std::size_t f = 0; f < found.size(); ++f) {
    found[f] = inner[patch[f]];
    if (inner[patch[f]] && outer[patch[f]]) return {};
  }
  return found;
}

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
