#include "spatial/sum/solid_faces.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

using Loop = std::vector<PointId>;

/// Which cells belong to what is assembled, and the side from which it is seen: 0 for cells that do not, 1 for the
/// normal's side, -1 for the other one.
struct Selection {
  std::vector<std::int8_t> side;
};

/// Faces as loops of points of the arrangement.
struct Polygon {
  std::vector<Loop> loops;
  std::uint32_t cell = 0;  ///< one of its cells
};

/// Pieces of lines that neighbouring cells of one plane share and that nothing else selected touches are no borders.
class Merger {
 public:
  Merger(const SumSpace& space, const SolidArrangement& arrangement, const Selection& selection)
      : space_(space), arrangement_(arrangement), selection_(selection) {}

  std::vector<Polygon> run() {
    count_walls();
    std::vector<Polygon> polygons;
    for (const PlaneGroup& group : arrangement_.groups) trace(group, polygons);
    return polygons;
  }
  /// The points at which borders turn.
  const std::vector<bool>& corners() {
    if (corner_.empty()) find_corners();
    return corner_;
  }

 private:
  static std::uint64_t key(PointId a, PointId b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
  }
  std::uint64_t key(const PlaneGroup& group, std::uint32_t edge) const {
    const CellEdge& e = group.cells.edges[edge];
    return key(arrangement_.point(group, e.a), arrangement_.point(group, e.b));
  }
  int side(const PlaneGroup& group, std::uint32_t cell) const {
    return cell == kNoId ? 0 : selection_.side[group.first_cell + cell];
  }

  /// How many selected cells come to every piece.
  void count_walls() {
    for (const PlaneGroup& group : arrangement_.groups) {
      for (std::uint32_t e = 0; e < group.cells.edges.size(); ++e) {
        const CellEdge& edge = group.cells.edges[e];
        for (const std::uint32_t cell : {edge.left, edge.right})
          if (side(group, cell) != 0) walls_.push_back(key(group, e));
      }
    }
    std::sort(walls_.begin(), walls_.end());
  }
  bool merged(const PlaneGroup& group, std::uint32_t e) const {
    const CellEdge& edge = group.cells.edges[e];
    const int left = side(group, edge.left);
    if (left == 0 || left != side(group, edge.right)) return false;
    const auto [first, last] = std::equal_range(walls_.begin(), walls_.end(), key(group, e));
    return last - first == 2;
  }

  void trace(const PlaneGroup& group, std::vector<Polygon>& polygons) {
    const PlaneCells& cells = group.cells;
    const bool any = std::any_of(cells.cells.begin(), cells.cells.end(),
                                 [&, c = group.first_cell](const Cell&) mutable { return selection_.side[c++] != 0; });
    if (!any) return;
    std::vector<std::uint32_t> next(2 * cells.edges.size(), kNoId), cell_of(next.size(), kNoId),
        parent(cells.cells.size());
    for (std::uint32_t c = 0; c < cells.cells.size(); ++c) {
      for (std::uint32_t l = cells.cells[c].first_loop; l < cells.cells[c].last_loop; ++l) {
        const std::uint32_t begin = cells.loops[l], end = cells.loops[l + 1];
        for (std::uint32_t k = begin; k < end; ++k) {
          next[cells.half_edges[k]] = cells.half_edges[k + 1 < end ? k + 1 : begin];
          cell_of[cells.half_edges[k]] = c;
        }
      }
    }
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    std::vector<bool> inner(cells.edges.size());
    for (std::uint32_t e = 0; e < cells.edges.size(); ++e) {
      inner[e] = merged(group, e);
      if (inner[e]) parent[root(cells.edges[e].left)] = root(cells.edges[e].right);
    }
    std::vector<std::uint32_t> polygon_of(cells.cells.size(), kNoId);
    std::vector<bool> seen(next.size());
    for (std::uint32_t h = 0; h < next.size(); ++h) {
      if (seen[h] || cell_of[h] == kNoId || side(group, cell_of[h]) == 0 || inner[h / 2]) continue;
      std::uint32_t& polygon = polygon_of[root(cell_of[h])];
      if (polygon == kNoId) {
        polygon = static_cast<std::uint32_t>(polygons.size());
        polygons.push_back({{}, group.first_cell + cell_of[h]});
      }
      Loop loop;
      for (std::uint32_t g = h; !seen[g];) {
        seen[g] = true;
        const CellEdge& e = cells.edges[g / 2];
        loop.push_back(arrangement_.point(group, g & 1 ? e.b : e.a));
        borders_.push_back({loop.back(), arrangement_.point(group, g & 1 ? e.a : e.b), group.plane, e.cut});
        g = next[g];
        while (inner[g / 2]) g = next[g ^ 1];
      }
      if (side(group, cell_of[h]) < 0) std::reverse(loop.begin(), loop.end());
      polygons[polygon].loops.push_back(std::move(loop));
    }
  }

  struct Border {
    PointId a, b;
    PlaneId plane, cut;
  };

  /// A point is no corner where all borders run along one line.
  void find_corners() {
    corner_.assign(arrangement_.points.size(), false);
    std::vector<std::uint32_t> first(arrangement_.points.size(), kNoId);
    for (std::uint32_t k = 0; k < borders_.size(); ++k) {
      for (const PointId at : {borders_[k].a, borders_[k].b}) {
        if (corner_[at]) continue;
        if (first[at] == kNoId) first[at] = k;
        else if (!on_line(borders_[first[at]], borders_[k])) corner_[at] = true;
      }
    }
  }
  bool on_line(const Border& x, const Border& y) const {
    const auto on = [&](PointId p) {
      const PointSource& s = arrangement_.points.source(p);
      const Approx& a = arrangement_.points.approx(p);
      return space_.side(x.plane, s, a) == 0 && space_.side(x.cut, s, a) == 0;
    };
    return on(y.a) && on(y.b);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const Selection& selection_;
  std::vector<std::uint64_t> walls_;
  std::vector<Border> borders_;
  std::vector<bool> corner_;
};

class Assembler {
 public:
  Assembler(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum)
      : boundary_(boundary), space_(*boundary.space), arrangement_(*boundary.arrangement), p_(p), q_(q), sum_(sum) {}

  void run() {
    std::vector<Polygon> faces = polygons(boundary_selection());
    std::vector<Polygon> tight = polygons(tight_selection());
    std::vector<std::array<PointId, 2>> segments = tight_lines();
    name_vertices(faces, tight, segments);
    add_faces(faces);
    for (Polygon& polygon : tight) sum_.tight_faces.push_back(named(polygon));
    std::sort(sum_.tight_faces.begin(), sum_.tight_faces.end());
    for (const auto& [a, b] : segments)
      sum_.tight_segments.push_back({std::min(name_[a], name_[b]), std::max(name_[a], name_[b])});
    std::sort(sum_.tight_segments.begin(), sum_.tight_segments.end());
    for (const PointId p : boundary_.tight.points) sum_.tight_points.push_back(name_[p]);
    std::sort(sum_.tight_points.begin(), sum_.tight_points.end());
  }

 private:
  const Cell& cell(std::uint32_t id, const PlaneGroup*& group) const {
    group = &arrangement_.groups[arrangement_.group_of(id)];
    return group->cells.cells[id - group->first_cell];
  }

  Selection boundary_selection() const {
    Selection selection{std::vector<std::int8_t>(arrangement_.cell_count)};
    for (const PlaneGroup& group : arrangement_.groups)
      for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c)
        if (boundary_.boundary[group.first_cell + c])
          selection.side[group.first_cell + c] = group.cells.cells[c].front > 0 ? 1 : -1;
    return selection;
  }
  Selection tight_selection() const {
    Selection selection{std::vector<std::int8_t>(arrangement_.cell_count)};
    for (const std::uint32_t c : boundary_.tight.cells) {
      // Seen from the side to which the first component of the normal that is not zero points.
      const PlaneId plane = arrangement_.groups[arrangement_.group_of(c)].plane;
      int side = 0;
      for (int axis = 0; axis < 3 && side == 0; ++axis) side = space_.exact_normal(plane, axis);
      selection.side[c] = static_cast<std::int8_t>(side);
    }
    return selection;
  }

  /// Faces without points in the middle of straight borders.
  std::vector<Polygon> polygons(const Selection& selection) const {
    Merger merger(space_, arrangement_, selection);
    std::vector<Polygon> result = merger.run();
    const std::vector<bool>& corner = merger.corners();
    for (Polygon& polygon : result)
      for (Loop& loop : polygon.loops) std::erase_if(loop, [&](PointId p) { return !corner[p]; });
    return result;
  }

  /// Tight segments in line with each other as one.
  std::vector<std::array<PointId, 2>> tight_lines() const {
    std::vector<std::array<PointId, 2>> segments = boundary_.tight.segments;
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < segments.size() && !more; ++i) {
        for (std::size_t j = i + 1; j < segments.size() && !more; ++j) {
          for (int k = 0; k < 4 && !more; ++k) {
            const PointId a = segments[i][k / 2], b = segments[j][k % 2];
            const PointId from = segments[i][1 - k / 2], to = segments[j][1 - k % 2];
            if (a != b || !between(from, a, to)) continue;
            segments[i] = {from, to};
            segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(j));
            more = true;
          }
        }
      }
    }
    return segments;
  }
  /// Whether b lies on the segment from a to c: all coordinates in one proportion.
  bool between(PointId a, PointId b, PointId c) const {
    exact::BigRational u[3], v[3];
    for (int axis = 0; axis < 3; ++axis) {
      const exact::BigRational m = space_.exact_coordinate(arrangement_.points.source(b), axis);
      u[axis] = m - space_.exact_coordinate(arrangement_.points.source(a), axis);
      v[axis] = space_.exact_coordinate(arrangement_.points.source(c), axis) - m;
    }
    return u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] &&
           u[0] * v[0] + u[1] * v[1] + u[2] * v[2] > 0;
  }

  /// Of b's position less a's, by x, y, z.
  int order(PointId a, PointId b) const {
    if (a == b) return 0;
    const Approx &u = arrangement_.points.approx(a), &v = arrangement_.points.approx(b);
    const double gap[3] = {v.at.x - u.at.x, v.at.y - u.at.y, v.at.z - u.at.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(gap[axis]) > 2 * (u.radius + v.radius) + space_.span() * 0x1p-50) return gap[axis] > 0 ? 1 : -1;
      const int s = space_.exact_order(arrangement_.points.source(a), arrangement_.points.source(b), axis);
      if (s != 0) return s;
    }
    return 0;
  }

  void name_vertices(const std::vector<Polygon>& faces, const std::vector<Polygon>& tight,
                     const std::vector<std::array<PointId, 2>>& segments) {
    std::vector<PointId> used;
    for (const std::vector<Polygon>* list : {&faces, &tight})
      for (const Polygon& polygon : *list)
        for (const Loop& loop : polygon.loops) used.insert(used.end(), loop.begin(), loop.end());
    for (const auto& s : segments) used.insert(used.end(), s.begin(), s.end());
    used.insert(used.end(), boundary_.tight.points.begin(), boundary_.tight.points.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::sort(used.begin(), used.end(), [&](PointId a, PointId b) { return order(a, b) > 0; });
    name_.assign(arrangement_.points.size(), kNoId);
    auto source = std::make_shared<SpatialPositions>();
    double world[3], offset[3];
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space_.line(axis);
      world[axis] = std::ldexp(1.0, line.exponent), offset[axis] = line.p_offset + line.q_offset;
    }
    for (std::uint32_t k = 0; k < used.size(); ++k) {
      name_[used[k]] = k;
      const Approx& at = arrangement_.points.approx(used[k]);
      source->vertices.push_back(arrangement_.points.source(used[k]));
      sum_.vertices.push_back(
          {at.at.x * world[0] + offset[0], at.at.y * world[1] + offset[1], at.at.z * world[2] + offset[2]});
      for (int axis = 0; axis < 3; ++axis) {
        const double size = (space_.span() + at.radius) * world[axis] + std::abs(offset[axis]);
        sum_.at_error = std::max(sum_.at_error, at.radius * world[axis] + size * 0x1p-51);
      }
    }
    SpatialSumInternals::set_positions(sum_, std::move(source));
  }

  /// Loops by names, each from its smallest one on, the outer one first.
  std::vector<std::vector<std::uint32_t>> named(const Polygon& polygon) const {
    std::vector<std::vector<std::uint32_t>> loops;
    for (const Loop& loop : polygon.loops) {
      std::vector<std::uint32_t> names;
      for (const PointId p : loop) names.push_back(name_[p]);
      std::rotate(names.begin(), first_corner(names), names.end());
      loops.push_back(std::move(names));
    }
    // The outer loop holds the smallest vertex; where a hole's loop does, too, the hole turns the other way, and its
    // second vertex tells: counter-clockwise order from the smallest vertex is the plane's, so the areas' signs differ.
    std::sort(loops.begin(), loops.end());
    if (loops.size() > 1) {
      std::size_t outer = 0;
      double most = area(loops[0]);
      for (std::size_t k = 1; k < loops.size(); ++k)
        if (loops[k][0] == loops[0][0] && area(loops[k]) > most) most = area(loops[k]), outer = k;
      std::rotate(loops.begin(), loops.begin() + static_cast<std::ptrdiff_t>(outer),
                  loops.begin() + static_cast<std::ptrdiff_t>(outer) + 1);
    }
    return loops;
  }
  /// Where the smallest rotation of a loop begins; a loop may come by its smallest vertex several times.
  static std::vector<std::uint32_t>::iterator first_corner(std::vector<std::uint32_t>& names) {
    auto best = names.begin();
    for (auto at = names.begin() + 1; at < names.end(); ++at) {
      const auto i = at - names.begin(), j = best - names.begin();
      const auto n = static_cast<std::ptrdiff_t>(names.size());
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::uint32_t x = names[static_cast<std::size_t>((i + k) % n)],
                            y = names[static_cast<std::size_t>((j + k) % n)];
        if (x == y) continue;
        if (x < y) best = at;
        break;
      }
    }
    return best;
  }
  double area(const std::vector<std::uint32_t>& loop) const {
    const auto at = [&](std::uint32_t v) { return Vec3{sum_.vertices[v].x, sum_.vertices[v].y, sum_.vertices[v].z}; };
    Vec3 n;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      n = n + cross(at(loop[k]) - at(loop[0]), at(loop[k + 1]) - at(loop[0]));
    return length(n);
  }

  void add_faces(const std::vector<Polygon>& polygons) {
    std::vector<std::uint32_t> patches;
    struct Entry {
      SpatialFace face;
      std::uint32_t patch;
    };
    std::vector<Entry> entries;
    for (const Polygon& polygon : polygons) {
      Entry entry;
      entry.face.loops = named(polygon);
      std::tie(entry.face.p, entry.face.q) = provenance(polygon.cell);
      entry.patch = boundary_.patch[polygon.cell];
      entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.face.loops < b.face.loops; });
    std::vector<std::uint32_t> shell(arrangement_.cell_count, kNoId);
    for (Entry& entry : entries) {
      if (entry.patch == kNoId) throw std::logic_error("solid sum: a boundary cell that links refute");
      std::uint32_t& s = shell[entry.patch];
      if (s == kNoId) s = static_cast<std::uint32_t>(sum_.shells++);
      entry.face.shell = s;
      sum_.faces.push_back(std::move(entry.face));
    }
  }

  /// The smallest features among the facets in a cell's plane whose corners' box holds a corner of the cell. The facets
  /// of a group tile or overlap; any that covers the cell will do.
  std::pair<SolidFeature, SolidFeature> provenance(std::uint32_t id) const {
    const PlaneGroup* group = nullptr;
    const Cell& c = cell(id, group);
    const std::int8_t side = c.front > 0 ? 1 : -1;
    for (const std::uint32_t f : group->facets) {
      const TableFacet& facet = boundary_.table.facets[f];
      if (facet.side == side && covers(facet, *group, c)) return features(facet.facet);
    }
    throw std::logic_error("solid sum: a cell without a facet");
  }
  /// Whether the convex facet covers the cell: all corners of the cell lie on or within its borders.
  bool covers(const TableFacet& facet, const PlaneGroup& group, const Cell& c) const {
    if (group.facets.size() == 1) return true;
    const Plane& plane = space_.plane(group.plane);
    (void)plane;
    for (std::uint32_t k = group.cells.loops[c.first_loop]; k < group.cells.loops[c.first_loop + 1]; ++k) {
      const std::uint32_t h = group.cells.half_edges[k];
      const CellEdge& e = group.cells.edges[h / 2];
      const PointId at = arrangement_.point(group, h & 1 ? e.b : e.a);
      for (int i = 0; i < facet.facet.corners; ++i)
        if (!inside_border(facet, i, at)) return false;
    }
    return true;
  }
  bool inside_border(const TableFacet& facet, int border, PointId at) const {
    // Left of the border, seen against the facet's normal, in rational coordinates where doubles do not decide.
    const int n = facet.facet.corners;
    const SumPoint a = facet.facet.corner[border], b = facet.facet.corner[(border + 1) % n];
    const Vec3 normal = static_cast<double>(facet.side) * space_.plane(facet.plane).n;
    const Vec3 from = space_.approx(a), d = space_.approx(b) - from;
    const Approx& p = arrangement_.points.approx(at);
    const double v = dot(normal, cross(d, p.at - from));
    const double size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * space_.sum_radius();
    const double error = size * (space_.span() * 0x1p-46 + 4 * p.radius + 16 * space_.sum_radius());
    if (v > error) return true;
    if (v < -error) return false;
    return exactly_inside(facet, a, b, at);
  }
  bool exactly_inside(const TableFacet& facet, SumPoint a, SumPoint b, PointId at) const {
    using exact::BigRational;
    const auto coordinate = [&](SumPoint s, int axis) {
      return space_.exact_coordinate({PointSource::Kind::sum, s.p, s.q, 0}, axis);
    };
    BigRational d[3], w[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = coordinate(b, axis) - coordinate(a, axis);
      w[axis] = space_.exact_coordinate(arrangement_.points.source(at), axis) - coordinate(a, axis);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int up = space_.exact_normal(facet.plane, axis) * facet.side;
      if (up == 0) continue;
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      return BigRational(d[i] * w[j] - d[j] * w[i]).sign() * up >= 0;
    }
    return false;
  }

  std::pair<SolidFeature, SolidFeature> features(const SumFacet& f) const {
    using Kind = SolidFeature::Kind;
    const auto edge = [](const SolidOperand& s, std::uint32_t w) {
      const auto [a, b] = std::minmax(s.wedges[w].from, s.wedges[w].to);
      return SolidFeature{Kind::edge, a, b};
    };
    switch (f.kind) {
      case SumFacet::Kind::face_vertex:
        return {{Kind::face, p_.face[f.p], 0}, {Kind::vertex, f.q, 0}};
      case SumFacet::Kind::vertex_face:
        return {{Kind::vertex, f.p, 0}, {Kind::face, q_.face[f.q], 0}};
      case SumFacet::Kind::edge_edge:
        break;
    }
    return {edge(p_, f.p), edge(q_, f.q)};
  }

  const SolidBoundary& boundary_;
  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const SolidOperand &p_, &q_;
  SpatialSum& sum_;
  std::vector<std::uint32_t> name_;  // per point of the arrangement
};

}  // namespace

void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum) {
  Assembler(boundary, p, q, sum).run();
}

}  // namespace dymsum::spatial
