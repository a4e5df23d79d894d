#include "spatial/boundary/tight_features.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace dymsum::spatial {

LoneContacts::Side::Side(const SumSpace& space, DirectionSource::Of name, const SolidOperand& operand,
                         const std::vector<Vec3>& vertices)
    : of(name), solid(operand), at(vertices), radius(space.sum_radius()), tame(operand.vertices.size()) {
  normals.reserve(solid.triangles.size());
  for (const Triangle& t : solid.triangles) normals.push_back(normal_direction(at[t[0]], at[t[1]], at[t[2]], radius));
}

template <class F>
bool LoneContacts::Side::all_triangles(std::uint32_t vertex, F f) const {
  for (std::uint32_t c = solid.corner_begin[vertex]; c < solid.corner_begin[vertex + 1]; ++c)
    if (!f(solid.corners[c] / 3)) return false;
  return true;
}

/// Every edge at a vertex leaves it in one of the triangles there.
template <class F>
bool LoneContacts::Side::all_edges(std::uint32_t vertex, F f) const {
  for (std::uint32_t c = solid.corner_begin[vertex]; c < solid.corner_begin[vertex + 1]; ++c) {
    const std::uint32_t corner = solid.corners[c];
    if (!f(line(vertex, solid.triangles[corner / 3][(corner + 1) % 3]))) return false;
  }
  return true;
}

/// Whether a way leads inward through all faces at a vertex: moved along it, the material there stays in itself.
bool LoneContacts::Side::has_free_direction(std::uint32_t vertex) {
  return tame.get(vertex, [&] {
    Vec3 sum;
    all_triangles(vertex, [&](std::uint32_t t) {
      const Vec3 n = normals[t].v;
      const double size = length(n);
      if (size > 0) sum = sum - (1 / size) * n;
      return true;
    });
    const Direction direction = scaled_direction(sum, 0);
    return all_triangles(vertex, [&](std::uint32_t t) { return filtered_sign(normals[t], direction) < 0; });
  });
}

LoneContacts::LoneContacts(const SumSpace& space, const FacetTable& table, const SolidOperand& p, const SolidOperand& q)
    : space_(space),
      table_(table),
      p_(space, DirectionSource::Of::p, p, space.p()),
      q_(space, DirectionSource::Of::q, q, space.q()),
      edge_(space.edges().size()) {}

bool LoneContacts::parallel(const Side& faces, std::uint32_t triangle, const Line& line) const {
  if (filtered_sign(faces.normals[triangle], line.near) != 0) return false;
  const Triangle& t = faces.solid.triangles[triangle];
  return space_.exact_det({faces.of, t[0], t[1]}, {faces.of, t[0], t[2]}, line.direction) == 0;
}

bool LoneContacts::lone(const Side& edges, std::uint32_t from, std::uint32_t to, const Side& vertices,
                        std::uint32_t v) const {
  int faces = 0;
  Vec3 direction;
  const bool across = edges.all_triangles(from, [&](std::uint32_t t) {
    const Triangle& triangle = edges.solid.triangles[t];
    if (triangle[0] != to && triangle[1] != to && triangle[2] != to) return true;
    ++faces;
    const double size = length(edges.normals[t].v);
    if (size > 0) direction = direction - (1 / size) * edges.normals[t].v;
    return vertices.all_edges(v, [&](const Line& d) { return !parallel(edges, t, d); });
  });
  if (!across || faces != 2) return false;
  // Inward through both faces: a way apart.
  const Direction inward = scaled_direction(direction, 0);
  const bool free = edges.all_triangles(from, [&](std::uint32_t t) {
    const Triangle& triangle = edges.solid.triangles[t];
    const bool there = triangle[0] == to || triangle[1] == to || triangle[2] == to;
    return !there || filtered_sign(edges.normals[t], inward) < 0;
  });
  if (!free) return false;
  const Line along = edges.line(from, to);
  return vertices.all_triangles(v, [&](std::uint32_t t) { return !parallel(vertices, t, along); });
}

/// No face at a vertex of one operand is parallel to an edge at a vertex of the other.
bool LoneContacts::lone(const Side& faces, std::uint32_t vertex, const Side& edges, std::uint32_t v) const {
  return edges.all_edges(v, [&](const Line& d) {
    return faces.all_triangles(vertex, [&](std::uint32_t t) { return !parallel(faces, t, d); });
  });
}

bool LoneContacts::edge(EdgeId id) {
  return edge_.get(id, [&] {
    const SumEdge& e = space_.edges()[id];
    const bool of_p = e.from.q == e.to.q;
    return of_p ? lone(p_, e.from.p, e.to.p, q_, e.from.q) : lone(q_, e.from.q, e.to.q, p_, e.from.p);
  });
}

bool LoneContacts::corner(SumPoint s) {
  return (p_.has_free_direction(s.p) || q_.has_free_direction(s.q)) && lone(p_, s.p, q_, s.q) && lone(q_, s.q, p_, s.p);
}

bool LoneContacts::facet(std::uint32_t id) {
  const SumFacet& f = table_.facets[id].facet;
  const auto face_vertex = [&](const Side& faces, std::uint32_t t, const Side& vertices, std::uint32_t v) {
    return vertices.all_edges(v, [&](const Line& d) { return !parallel(faces, t, d); });
  };
  if (f.kind == SumFacet::Kind::face_vertex) return face_vertex(p_, f.p, q_, f.q);
  if (f.kind == SumFacet::Kind::vertex_face) return face_vertex(q_, f.q, p_, f.p);
  const Wedge &e = p_.solid.wedges[f.p], &g = q_.solid.wedges[f.q];
  const Line along_e = p_.line(e.from, e.to), along_g = q_.line(g.from, g.to);
  return !parallel(p_, e.left, along_g) && !parallel(p_, e.right, along_g) && !parallel(q_, g.left, along_e) &&
         !parallel(q_, g.right, along_e);
}

bool LoneContacts::crosses(EdgeId id, PlaneId plane) const {
  const SumEdge& e = space_.edges()[id];
  const Direction along = edge_direction(space_.approx(e.from), space_.approx(e.to), space_.sum_radius());
  // The plane's normal is relatively within 2^-51, its largest component at least a half.
  return filtered_sign({space_.plane(plane).n, 0x1p-49}, along) != 0 || space_.exact_rise(plane, e) != 0;
}

namespace {

/// An edge of a plane's cells, or a point of them.
struct Trace {
  PointId a, b;  ///< a <= b; equal for a point
  PlaneId plane, cut;
  std::int8_t direction;  ///< 1 where the vector from a to b is n x n_cut
  bool full;              ///< all around it in the plane lie facets of one direction, none of the other
  /// What facets of the plane end there: none; one facet, along the edge of sums `facet_edge`; those with a corner at
  /// the sum that the point is; or something else.
  enum class End : std::uint8_t { none, facet_edge, corner, other } end = End::other;
  EdgeId facet_edge = kNoId;
  std::uint32_t group = 0;
};

class Tight {
 public:
  Tight(const SumSpace& space, const SolidArrangement& arrangement, const std::vector<bool>& boundary,
        const Collision& collision, LoneContacts lone, bool every_position, StageWatch& watch,
        const ArrangementScope* scope)
      : space_(space),
        arrangement_(arrangement),
        collision_(collision),
        lone_(std::move(lone)),
        every_position_(every_position),
        watch_(watch),
        scope_(scope),
        outside_(boundary),
        touched_(arrangement.points.size()),
        lone_groups_(arrangement.groups.size()) {}

  TightFeatures run() {
    in_parts(arrangement_.groups.size(), 16,
             [&](Part& part, std::size_t g) { look_at_cells(arrangement_.groups[g], part); });
    for (const std::uint32_t c : result_.cells) outside_[c] = true;
    leave_out_free_cells();
    fraction_ = 1.0 / 3;
    std::vector<std::uint8_t> closed(arrangement_.edge_ends.size());
    in_parts(closed.size(), 512, [&](Part& part, std::size_t e) {
      closed[e] = touches_outside(static_cast<std::uint32_t>(e));
      if (!closed[e] && (scope_ == nullptr || scope_->edges[e])) look_at_edge(static_cast<std::uint32_t>(e), part);
    });
    for (std::uint32_t e = 0; e < closed.size(); ++e)
      if (closed[e]) touch(e);
    for (const auto& segment : result_.segments)
      for (const PointId p : segment) touched_[p] = true;
    look_at_touches();
    std::sort(dots_.begin(), dots_.end());
    fraction_ = 2.0 / 3;
    look_at_points();
    return std::move(result_);
  }

 private:
  /// What is found in a part of a loop.
  struct Part {
    TightFeatures found;
    std::vector<Trace> traces;  // scratch: of one position
  };

  /// Calls f(part, k) for all k below `count`, and puts together what the parts have found, in their order.
  template <class F>
  void in_parts(std::size_t count, std::size_t size, F f) {
    std::vector<TightFeatures> found((count + size - 1) / size);
    watch_.run_intervals(count, size, [&](std::size_t k, std::size_t first, std::size_t last) {
      Part part;
      for (std::size_t i = first; i < last; ++i) f(part, i);
      found[k] = std::move(part.found);
    });
    for (const TightFeatures& some : found) {
      result_.cells.insert(result_.cells.end(), some.cells.begin(), some.cells.end());
      result_.segments.insert(result_.segments.end(), some.segments.begin(), some.segments.end());
      result_.points.insert(result_.points.end(), some.points.begin(), some.points.end());
      result_.tests += some.tests;
    }
  }

  /// Whether the closure of a boundary or a tight cell holds an edge.
  bool touches_outside(std::uint32_t edge) const {
    for (const EdgeUse use : arrangement_.uses(edge)) {
      const CellEdge& e = arrangement_.edge(use);
      const std::uint32_t first = arrangement_.groups[use.group].first_cell;
      for (const std::uint32_t c : {e.left, e.right})
        if (c != kNoId && outside_[first + c]) return true;
    }
    return false;
  }
  void touch(std::uint32_t edge) {
    for (const PointId p : arrangement_.edge_ends[edge]) touched_[p] = true;
  }

  /// Of two operands with thin parts some cells have nothing on either side.
  void leave_out_free_cells() {
    for (const PlaneGroup& group : arrangement_.groups)
      for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c)
        if (group.cells.cells[c].front == 0 && group.cells.cells[c].back == 0) outside_[group.first_cell + c] = true;
  }

  /// Cells with facets of both directions.
  void look_at_cells(const PlaneGroup& group, Part& part) const {
    for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) {
      const Cell& cell = group.cells.cells[c];
      if (cell.front == 0 || cell.back == 0 || (scope_ != nullptr && !scope_->cells[group.first_cell + c])) continue;
      const std::uint32_t h = group.cells.half_edges[group.cells.loops[cell.first_loop]];
      const CellEdge& e = group.cells.edges[h / 2];
      const PointId at = arrangement_.point(group, h & 1 ? e.b : e.a);
      const auto direction = static_cast<std::int8_t>((e.along ? 1 : -1) * (h & 1 ? -1 : 1));
      if (overlaps({arrangement_.points.source(at), group.plane, e.cut, direction, 1, 0}, part)) continue;
      part.found.cells.push_back(group.first_cell + c);
    }
  }

  bool overlaps(const Flag& flag, Part& part) const {
    if (++part.found.tests % 16 == 0) watch_.query_within_part(fraction_);
    return collision_.overlaps(flag);
  }

  /// 1 or -1 for facets of one direction, else 0.
  static int facing(const PlaneGroup& group, std::uint32_t c) {
    if (c == kNoId) return 0;
    const Cell& cell = group.cells.cells[c];
    return cell.front > 0 ? cell.back > 0 ? 0 : 1 : -1;
  }
  static bool is_full(const PlaneGroup& group, const CellEdge& e) {
    const int left = facing(group, e.left);
    return left != 0 && left == facing(group, e.right);
  }
  static bool single(const PlaneGroup& group, std::uint32_t c) {
    return c == kNoId || group.cells.cells[c].front + group.cells.cells[c].back == 1;
  }
  /// One facet on one side, nothing on the other.
  static bool one_sided(const PlaneGroup& group, const CellEdge& e) {
    return (e.left == kNoId) != (e.right == kNoId) && single(group, e.left) && single(group, e.right);
  }
  static bool one_facet_edge(const CellEdge& e) { return e.facet_edge != kNoId && e.facet_edge != kManyEdges; }

  Trace edge_trace(std::uint32_t edge, EdgeUse use) const {
    const PlaneGroup& group = arrangement_.groups[use.group];
    const CellEdge& e = group.cells.edges[use.edge];
    const auto [a, b] = arrangement_.edge_ends[edge];
    const auto direction =
        static_cast<std::int8_t>((e.along ? 1 : -1) * (arrangement_.point(group, e.a) == a ? 1 : -1));
    Trace trace{a, b, group.plane, e.cut, direction, is_full(group, e), Trace::End::other, e.facet_edge, use.group};
    if (one_facet_edge(e) && one_sided(group, e)) trace.end = Trace::End::facet_edge;
    return trace;
  }
  /// The trace of the edges of one group at a point.
  Trace point_trace(PointId at, std::span<const EdgeUse> ends) const {
    const PlaneGroup& group = arrangement_.groups[ends[0].group];
    const PointSource& source = arrangement_.points.source(at);
    const SumPoint sum{source.a, source.b};
    Trace trace{at, at, group.plane, 0, 0, true, Trace::End::other, kNoId, ends[0].group};
    bool alone = true, through = true, corner = source.kind == PointSource::Kind::sum;
    int facet_edges = 0;
    for (const EdgeUse use : ends) {
      const CellEdge& e = group.cells.edges[use.edge];
      trace.full = trace.full && is_full(group, e);
      alone = alone && single(group, e.left) && single(group, e.right);
      if (e.facet_edge == kNoId) continue;
      if (facet_edges++ == 0) trace.facet_edge = e.facet_edge;
      through = through && e.facet_edge == trace.facet_edge && one_facet_edge(e) && one_sided(group, e);
      corner = corner && one_facet_edge(e) &&
               (space_.edges()[e.facet_edge].from == sum || space_.edges()[e.facet_edge].to == sum);
    }
    if (facet_edges == 0) trace.end = trace.full ? Trace::End::none : Trace::End::other;
    else if (alone && through && facet_edges == 2) trace.end = Trace::End::facet_edge;
    else if (alone && corner) trace.end = Trace::End::corner;
    return trace;
  }

  /// Whether contacts there hold up motion in independent directions only: then what is free is free in a wedge, too.
  bool free_in_a_wedge(std::span<const Trace> traces) const {
    if (traces.size() > 3) return false;
    for (const Trace& t : traces)
      if (!t.full) return false;
    if (traces.size() < 3) return true;
    return space_.det(traces[0].plane, traces[1].plane, traces[2].plane) != 0;
  }

  /// Whether all facets there come from one contact, or one and another that holds up motion across it only: the
  /// solids can be moved apart then, into an open set of positions.
  bool free_by_itself(std::span<const Trace> traces) {
    const Trace* plane = nullptr;
    const Trace* facet_edge = nullptr;
    std::size_t corners = 0;
    for (const Trace& t : traces) {
      if (t.end == Trace::End::other) return false;
      if (t.end == Trace::End::corner) ++corners;
      if (t.end == Trace::End::none) {
        if (plane != nullptr) return false;
        plane = &t;
      }
      if (t.end == Trace::End::facet_edge) {
        if (facet_edge != nullptr && facet_edge->facet_edge != t.facet_edge) return false;
        facet_edge = &t;
      }
    }
    if (corners > 0) {
      const PointSource& at = arrangement_.points.source(traces[0].a);
      return corners == traces.size() && lone_.corner({at.a, at.b});
    }
    if (facet_edge == nullptr || !lone_.edge(facet_edge->facet_edge)) return false;
    return plane == nullptr || (lone_.crosses(facet_edge->facet_edge, plane->plane) && lone_group(plane->group));
  }
  /// Whether the contacts inside all facets of a group are single points.
  bool lone_group(std::uint32_t g) {
    return lone_groups_.get(g, [&] {
      const std::vector<std::uint32_t>& facets = arrangement_.groups[g].facets;
      return std::all_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return lone_.facet(f); });
    });
  }

  void look_at_edge(std::uint32_t edge, Part& part) {
    std::vector<Trace>& traces = part.traces;
    traces.clear();
    for (const EdgeUse use : arrangement_.uses(edge)) traces.push_back(edge_trace(edge, use));
    if (!every_position_ && ((traces.size() < 3 && free_in_a_wedge(traces)) || free_by_itself(traces))) return;
    const Trace& t = traces[0];
    if (overlaps({arrangement_.points.source(t.a), t.plane, t.cut, t.direction, 0, 0}, part)) return;
    part.found.segments.push_back({t.a, t.b});
  }

  /// Where facets touch the inside of a cell at a point, the outside may lie in front of that cell.
  void look_at_touches() {
    struct Touch {
      PointId at;
      PlaneId plane, cut;
    };
    std::vector<Touch> touches;
    for (const PlaneGroup& group : arrangement_.groups) {
      for (const PlaneCells::Touch& t : group.cells.touches) {
        dots_.push_back(arrangement_.point(group, t.at));
        if (!touched_[dots_.back()] && counts(dots_.back())) touches.push_back({dots_.back(), group.plane, t.cut});
      }
    }
    std::stable_sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.at < b.at; });
    std::vector<std::size_t> begin;  // of the touches at each point
    for (std::size_t k = 0; k < touches.size(); ++k)
      if (k == 0 || touches[k].at != touches[k - 1].at) begin.push_back(k);
    begin.push_back(touches.size());
    std::vector<std::uint8_t> free(begin.size() - 1);
    in_parts(free.size(), 16, [&](Part& part, std::size_t i) {
      for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
        for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}})
          if (!free[i] &&
              !overlaps({arrangement_.points.source(touches[k].at), touches[k].plane, touches[k].cut, 1, 1, side},
                        part))
            free[i] = true;
    });
    for (std::size_t i = 0; i < free.size(); ++i)
      if (free[i]) touched_[touches[begin[i]].at] = true;
  }

  /// Looks at the points that nothing outside is known to touch, with all edges at each.
  void look_at_points() {
    std::vector<std::uint32_t> begin(arrangement_.points.size() + 1, 0);
    const auto for_each = [&](auto f) {
      for (std::uint32_t g = 0; g < arrangement_.groups.size(); ++g) {
        const PlaneGroup& group = arrangement_.groups[g];
        for (std::uint32_t e = 0; e < group.cells.edges.size(); ++e)
          for (const PointId p : {group.cells.edges[e].a, group.cells.edges[e].b})
            if (const PointId at = arrangement_.point(group, p); !touched_[at] && counts(at)) f(at, EdgeUse{g, e});
      }
    };
    for_each([&](PointId at, EdgeUse) { ++begin[at + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<EdgeUse> ends(begin.back());
    std::vector<std::uint32_t> position(begin.begin(), begin.end() - 1);
    for_each([&](PointId at, EdgeUse use) { ends[position[at]++] = use; });
    in_parts(arrangement_.points.size(), 256, [&](Part& part, std::size_t at) {
      if (begin[at] < begin[at + 1])
        look_at_point(static_cast<PointId>(at), {ends.data() + begin[at], ends.data() + begin[at + 1]}, part);
    });
  }
  void look_at_point(PointId at, std::span<const EdgeUse> ends, Part& part) {
    std::vector<Trace>& traces = part.traces;
    traces.clear();
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
      while (last < ends.size() && ends[last].group == ends[first].group) ++last;
      traces.push_back(point_trace(at, ends.subspan(first, last - first)));
    }
    // Facets that touch it inside of a cell are in no trace.
    const bool dot = std::binary_search(dots_.begin(), dots_.end(), at);
    if (!every_position_ && (free_in_a_wedge(traces) || (!dot && free_by_itself(traces)))) return;
    if (!overlaps({arrangement_.points.source(at), 0, 0, 0, 0, 0}, part)) part.found.points.push_back(at);
  }

  bool counts(PointId point) const { return scope_ == nullptr || scope_->points[point]; }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const Collision& collision_;
  LoneContacts lone_;
  bool every_position_;
  StageWatch& watch_;
  const ArrangementScope* scope_;
  std::vector<bool> outside_;  // cells of the boundary, and tight ones
  std::vector<bool> touched_;  // points in the closure of something outside
  std::vector<PointId> dots_;  // points that facets touch inside of a cell
  Answers lone_groups_;        // per group
  double fraction_ = 0;
  TightFeatures result_;
};

}  // namespace

TightFeatures tight_features(const SumSpace& space, const FacetTable& table, const SolidArrangement& arrangement,
                             const std::vector<bool>& boundary, const Collision& collision, bool every_position,
                             StageWatch& watch, const ArrangementScope* scope) {
  return Tight(space, arrangement, boundary, collision, LoneContacts(space, table, collision.p(), collision.q()),
               every_position, watch, scope)
      .run();
}

}  // namespace dymsum::spatial
