#include "spatial/mesh/half_edges.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace dymsum::spatial {

HalfEdges half_edges_without_twins(const std::vector<Face>& faces) {
  std::size_t count = 0;
  for (const Face& face : faces) count += face.size();
  if (count >= HalfEdges::kNone) throw std::length_error("a mesh of 2^32 half-edges");
  HalfEdges edges;
  edges.face_begin.reserve(faces.size() + 1);
  for (std::vector<std::uint32_t>* list : {&edges.origin, &edges.face, &edges.next}) list->reserve(count);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto begin = static_cast<std::uint32_t>(edges.size());
    edges.face_begin.push_back(begin);
    for (const std::uint32_t v : faces[f]) {
      edges.origin.push_back(v);
      edges.face.push_back(f);
      edges.next.push_back(static_cast<std::uint32_t>(edges.size()));
    }
    if (edges.size() > begin) edges.next.back() = begin;
  }
  edges.face_begin.push_back(static_cast<std::uint32_t>(count));
  edges.twin.assign(count, HalfEdges::kNone);
  return edges;
}

std::vector<EdgeSide> edge_sides(const HalfEdges& edges) {
  std::vector<EdgeSide> sides(edges.size());
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    const std::uint32_t a = edges.origin[h], b = edges.target(h);
    const auto [low, high] = std::minmax(a, b);
    sides[h] = {std::uint64_t{low} << 32 | high, h};
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

void join_twins(HalfEdges& edges, const std::vector<EdgeSide>& sides) {
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first != 2 || edges.origin[first[0].half_edge] == edges.origin[first[1].half_edge]) return;
    edges.twin[first[0].half_edge] = first[1].half_edge;
    edges.twin[first[1].half_edge] = first[0].half_edge;
  });
}

HalfEdges half_edges(const std::vector<Face>& faces) {
  HalfEdges edges = half_edges_without_twins(faces);
  join_twins(edges, edge_sides(edges));
  return edges;
}

Shells find_shells(const HalfEdges& edges) {
  Shells shells;
  shells.of_face.assign(edges.face_begin.size() - 1, HalfEdges::kNone);
  std::vector<std::uint32_t> open;
  for (std::uint32_t start = 0; start < shells.of_face.size(); ++start) {
    if (shells.of_face[start] != HalfEdges::kNone) continue;
    shells.of_face[start] = shells.count;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      for (std::uint32_t h = edges.face_begin[f]; h < edges.face_begin[f + 1]; ++h) {
        if (edges.twin[h] == HalfEdges::kNone) continue;
        const std::uint32_t g = edges.face[edges.twin[h]];
        if (shells.of_face[g] != HalfEdges::kNone) continue;
        shells.of_face[g] = shells.count;
        open.push_back(g);
      }
    }
    ++shells.count;
  }
  return shells;
}

namespace {

using exact::Axis;

bool lex_less(const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The plane through three points, or axis_sign 0 when they are on one line.
FacePlane plane_through(const std::vector<Point3>& vertices, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (const Axis axis : {Axis::z, Axis::x, Axis::y}) {
    const int sign = exact::normal_sign(vertices[a], vertices[b], vertices[c], axis);
    if (sign != 0) return {a, b, c, axis, sign};
  }
  return {a, b, c, Axis::z, 0};
}

Error at_vertex(ErrorCode code, std::string message, const std::vector<Point3>& vertices, std::uint32_t v) {
  Error error{code, std::move(message), {}};
  error.evidence.vertex = v;
  error.evidence.x = vertices[v].x;
  error.evidence.y = vertices[v].y;
  error.evidence.z = vertices[v].z;
  return error;
}

// The region of the projected face says whether it crosses itself; its evidence counts the face's vertices.
std::optional<Error> crossing_error(const std::vector<Point3>& vertices, const Face& face, const FacePlane& plane) {
  Ring ring = projected(vertices, face, plane);
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  const Result<Region> region = Region::create(std::move(data));
  if (region.ok() && region->touching_points().empty()) return std::nullopt;
  std::size_t corner = 0;
  if (!region) corner = static_cast<std::size_t>(region.error().evidence.vertex.value_or(0));
  return at_vertex(ErrorCode::self_crossing, "a face crosses or touches itself", vertices, face[corner]);
}

}  // namespace

FacePlane face_plane(const std::vector<Point3>& vertices, const Face& face) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < face.size(); ++i) {
    if (lex_less(vertices[face[i]], vertices[face[least]])) least = i;
  }
  const std::size_t n = face.size();
  return plane_through(vertices, face[(least + n - 1) % n], face[least], face[(least + 1) % n]);
}

Ring projected(const std::vector<Point3>& vertices, const Face& face, const FacePlane& plane) {
  Ring ring;
  ring.reserve(face.size());
  for (const std::uint32_t v : face) {
    Point p = exact::dropped(vertices[v], plane.axis);
    if (plane.axis_sign < 0) std::swap(p.x, p.y);
    ring.push_back(p);
  }
  return ring;
}

std::optional<Error> face_error(const std::vector<Point3>& vertices, const Face& face) {
  const std::size_t n = face.size();
  FacePlane plane;
  for (std::size_t i = 2; i < n && plane.axis_sign == 0; ++i) {
    plane = plane_through(vertices, face[0], face[1], face[i]);
  }
  if (plane.axis_sign == 0) {
    return at_vertex(ErrorCode::no_area, "all vertices of a face lie on one line", vertices, face[0]);
  }
  for (const std::uint32_t v : face) {
    if (height_sign(vertices, plane, vertices[v]) == 0) continue;
    return at_vertex(ErrorCode::not_planar, "the vertices of a face do not lie in one plane", vertices, v);
  }
  if (n == 3) return std::nullopt;
  // the corner at the smallest vertex is flat only where the face runs along itself
  plane = face_plane(vertices, face);
  if (plane.axis_sign == 0) {
    return at_vertex(ErrorCode::self_crossing, "a face crosses or touches itself", vertices, plane.b);
  }
  return crossing_error(vertices, face, plane);
}

std::vector<FacePlane> face_planes(const MeshData& data) {
  std::vector<FacePlane> planes;
  planes.reserve(data.faces.size());
  for (const Face& face : data.faces) planes.push_back(face_plane(data.vertices, face));
  return planes;
}

// The other face lies on one side of the edge's line, as far as the edge is concerned. A vertex w of it off that line,
// on that side, is above the first face's plane where the edge is reflex, and below it where it is convex; a w on the
// line's far side says the opposite.
Bend edge_bend(const MeshData& data, const HalfEdges& edges, const std::vector<FacePlane>& planes, std::uint32_t h) {
  const std::uint32_t twin = edges.twin[h];
  const FacePlane &plane = planes[edges.face[h]], &other = planes[edges.face[twin]];
  const Point3 &from = data.vertices[edges.origin[twin]], &to = data.vertices[edges.target(twin)];
  std::uint32_t w = edges.next[edges.next[twin]];
  int side = 0;
  for (; side == 0; w = edges.next[w]) side = turn_sign(other, from, to, data.vertices[edges.origin[w]]);
  w = edges.previous(w);
  const int height = side * height_sign(data.vertices, plane, data.vertices[edges.origin[w]]);
  if (height != 0) return height < 0 ? Bend::convex : Bend::reflex;
  const int other_sign =
      exact::normal_sign(data.vertices[other.a], data.vertices[other.b], data.vertices[other.c], plane.axis);
  return other_sign == plane.axis_sign ? Bend::flat : Bend::folded;
}

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
