#include "spatial/sum/solid_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_order.h"

namespace dymsum::spatial {
namespace {

// Cells of one plane put together to polygons.

/// The cells that belong to what is put together, and the side from which it is seen: 0 for cells that do not, 1 for
/// the normal's side, -1 for the other one.
struct Selection {
  std::vector<std::int8_t> side;
};

/// A polygon as loops of points of the arrangement, counter-clockwise around its inside.
struct CellPolygon {
  std::vector<std::vector<PointId>> loops;
  std::uint32_t cell = 0;  ///< one of its cells
};

/// Pieces of lines that neighbouring cells of one plane share and that nothing else selected touches are no face edges.
class Merger {
 public:
  Merger(const SumSpace& space, const SolidArrangement& arrangement, const Selection& selection, StageWatch& watch)
      : space_(space),
        arrangement_(arrangement),
        selection_(selection),
        watch_(watch),
        parts_((arrangement.groups.size() + kPart - 1) / kPart) {}

  std::vector<CellPolygon> run() {
    count_walls();
    in_parts([&](Part& part, const PlaneGroup& group) { trace(group, part); });
    collect(polygons_, &Part::polygons), collect(face_edges_, &Part::face_edges);
    find_corners();
    watch_.run_intervals(polygons_.size(), kPart, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        for (std::vector<PointId>& loop : polygons_[k].loops)
          std::erase_if(loop, [&](PointId p) { return corner_[p] == 0; });
    });
    return std::move(polygons_);
  }

 private:
  struct FaceEdge {
    PointId a, b;
    PlaneId plane, cut;
  };
  /// What an interval of groups gives.
  struct Part {
    std::vector<CellPolygon> polygons;
    std::vector<FaceEdge> face_edges;
    struct Scratch {
      std::vector<std::uint32_t> next, cell_of, parent, polygon_of;  // per half-edge; per cell
      std::vector<std::uint8_t> inner, seen;                         // per edge; per half-edge
    } scratch;
  };
  static constexpr std::size_t kPart = 64;

  template <class F>
  void in_parts(F f) {
    watch_.run_intervals(arrangement_.groups.size(), kPart, [&](std::size_t k, std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last; ++g)
        if (is_selected(arrangement_.groups[g])) f(parts_[k], arrangement_.groups[g]);
      parts_[k].scratch = {};
    });
  }
  template <class T>
  void collect(std::vector<T>& all, std::vector<T> Part::*some) {
    for (Part& part : parts_) {
      std::move((part.*some).begin(), (part.*some).end(), std::back_inserter(all));
      base::free_memory(part.*some);
    }
  }
  bool is_selected(const PlaneGroup& group) const {
    const auto first = selection_.side.begin() + group.first_cell;
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(group.cells.cells.size()),
                       [](std::int8_t side) { return side != 0; });
  }

  int side(const PlaneGroup& group, std::uint32_t cell) const {
    return cell == kNoId ? 0 : selection_.side[group.first_cell + cell];
  }

  /// How many selected cells come to every piece, up to three.
  void count_walls() {
    first_edge_.push_back(0);
    for (const PlaneGroup& group : arrangement_.groups)
      first_edge_.push_back(first_edge_.back() + static_cast<std::uint32_t>(group.cells.edges.size()));
    edge_of_.resize(first_edge_.back()), walls_.resize(arrangement_.edge_ends.size());
    watch_.run_intervals(walls_.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) count_walls(static_cast<std::uint32_t>(e));
    });
  }
  void count_walls(std::uint32_t edge) {
    int walls = 0;
    for (const EdgeUse use : arrangement_.uses(edge)) {
      edge_of_[first_edge_[use.group] + use.edge] = edge;
      const PlaneGroup& group = arrangement_.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      walls += (side(group, e.left) != 0) + (side(group, e.right) != 0);
    }
    walls_[edge] = static_cast<std::uint8_t>(std::min(walls, 3));
  }
  bool merged(const PlaneGroup& group, std::uint32_t e) const {
    const CellEdge& edge = group.cells.edges[e];
    const int left = side(group, edge.left);
    if (left == 0 || left != side(group, edge.right)) return false;
    return walls_[edge_of_[first_edge_[&group - arrangement_.groups.data()] + e]] == 2;
  }

  void trace(const PlaneGroup& group, Part& part) const {
    const PlaneCells& cells = group.cells;
    auto& [next, cell_of, parent, polygon_of, inner, seen] = part.scratch;
    next.assign(2 * cells.edges.size(), kNoId), cell_of.assign(next.size(), kNoId), parent.resize(cells.cells.size());
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
    const auto root = [&parent = parent](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    inner.resize(cells.edges.size()), seen.assign(next.size(), 0);
    for (std::uint32_t e = 0; e < cells.edges.size(); ++e) {
      inner[e] = merged(group, e);
      if (inner[e]) parent[root(cells.edges[e].left)] = root(cells.edges[e].right);
    }
    std::vector<CellPolygon>& polygons = part.polygons;
    polygon_of.assign(cells.cells.size(), kNoId);
    for (std::uint32_t h = 0; h < next.size(); ++h) {
      if (seen[h] || cell_of[h] == kNoId || side(group, cell_of[h]) == 0 || inner[h / 2]) continue;
      std::uint32_t& polygon = polygon_of[root(cell_of[h])];
      if (polygon == kNoId) {
        polygon = static_cast<std::uint32_t>(polygons.size());
        polygons.push_back({{}, group.first_cell + cell_of[h]});
      }
      std::vector<PointId> loop;
      for (std::uint32_t g = h; !seen[g];) {
        seen[g] = true;
        const CellEdge& e = cells.edges[g / 2];
        loop.push_back(arrangement_.point(group, g & 1 ? e.b : e.a));
        part.face_edges.push_back({loop.back(), arrangement_.point(group, g & 1 ? e.a : e.b), group.plane, e.cut});
        g = next[g];
        while (inner[g / 2]) g = next[g ^ 1];
      }
      if (side(group, cell_of[h]) < 0) std::reverse(loop.begin(), loop.end());
      polygons[polygon].loops.push_back(std::move(loop));
    }
  }

  /// A point is no corner where all face edges run along one line.
  void find_corners() {
    if (face_edges_.empty()) return;
    corner_.assign(arrangement_.points.size(), 0);
    std::vector<std::uint32_t> first(arrangement_.points.size(), kNoId);
    for (std::uint32_t k = 0; k < face_edges_.size(); ++k)
      for (const PointId at : {face_edges_[k].a, face_edges_[k].b})
        if (first[at] == kNoId) first[at] = k;
    watch_.run_intervals(face_edges_.size(), 1024, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        for (const PointId at : {face_edges_[k].a, face_edges_[k].b}) {
          if (base::shared_byte(corner_[at]) == 0 && !on_line(face_edges_[first[at]], face_edges_[k], at))
            base::set_shared_byte(corner_[at], 1);
        }
      }
    });
  }
  /// Whether two face edges with an end in common run along one line.
  bool on_line(const FaceEdge& x, const FaceEdge& y, PointId common) const {
    if (x.plane == y.plane && x.cut == y.cut) return true;
    const PointId end = y.a == common ? y.b : y.a;
    const PointSource& s = arrangement_.points.source(end);
    const Approx& a = arrangement_.points.approx(end);
    return space_.side(x.plane, s, a) == 0 && space_.side(x.cut, s, a) == 0;
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const Selection& selection_;
  StageWatch& watch_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> first_edge_, edge_of_;  // per group; of its edges: which one of the arrangement each is
  std::vector<std::uint8_t> walls_;                  // per edge of the arrangement
  std::vector<CellPolygon> polygons_;
  std::vector<FaceEdge> face_edges_;
  std::vector<std::uint8_t> corner_;  // per point
};

/// The selected cells as polygons: a piece of a line that two of them in one plane share, and nothing else that is
/// selected touches, is no face edge; a point where all face edges run along one line is no corner.
std::vector<CellPolygon> merged_cells(const SumSpace& space, const SolidArrangement& arrangement,
                                      const Selection& selection, StageWatch& watch) {
  return Merger(space, arrangement, selection, watch).run();
}

class Assembler {
 public:
  Assembler(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
            StageWatch& watch, CornerContacts* corners)
      : boundary_(boundary),
        space_(*boundary.space),
        arrangement_(*boundary.arrangement),
        pairs_(boundary, p, q, watch),
        sum_(sum),
        watch_(watch),
        corners_(corners) {}

  void run() {
    std::vector<CellPolygon> faces = merged_cells(space_, arrangement_, boundary_selection(), watch_);
    std::vector<CellPolygon> tight;
    if (!boundary_.tight.cells.empty()) tight = merged_cells(space_, arrangement_, tight_selection(), watch_);
    const std::vector<TightLine> lines = joined_lines(space_, arrangement_.points, boundary_.tight.segments);
    name_vertices(faces, tight, lines);
    add_faces(faces);
    add_edge_contacts();
    add_tight_faces(tight);
    add_tight_lines(lines);
    add_tight_points();
  }

 private:
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
    for (const std::uint32_t c : boundary_.tight.cells) selection.side[c] = tight_side(c);
    return selection;
  }
  /// Tight faces are seen from the side to which the first component of the normal that is not zero points.
  std::int8_t tight_side(std::uint32_t cell) const {
    const PlaneId plane = arrangement_.groups[arrangement_.group_of(cell)].plane;
    int side = 0;
    for (int axis = 0; axis < 3 && side == 0; ++axis) side = space_.exact_normal(plane, axis);
    return static_cast<std::int8_t>(side);
  }

  void name_vertices(const std::vector<CellPolygon>& faces, const std::vector<CellPolygon>& tight,
                     const std::vector<TightLine>& lines) {
    std::vector<PointId>& used = point_of_;
    std::vector<bool> listed(arrangement_.points.size());
    const auto use = [&](PointId p) {
      if (!listed[p]) used.push_back(p);
      listed[p] = true;
    };
    for (const std::vector<CellPolygon>* list : {&faces, &tight})
      for (const CellPolygon& polygon : *list)
        for (const std::vector<PointId>& loop : polygon.loops) std::for_each(loop.begin(), loop.end(), use);
    for (const TightLine& line : lines) use(line.from), use(line.to);
    std::for_each(boundary_.tight.points.begin(), boundary_.tight.points.end(), use);
    VertexOrder(space_, arrangement_.points).sort(used, watch_.threads());
    name_.assign(arrangement_.points.size(), kNoId);
    auto source = std::make_shared<SpatialPositions>();
    source->space = boundary_.space;
    const VertexPositions positions(space_);
    for (std::uint32_t k = 0; k < used.size(); ++k) {
      name_[used[k]] = k;
      source->vertices.push_back(arrangement_.points.source(used[k]));
      sum_.vertex_contacts.push_back(pairs_.of_point(used[k]));
      positions.add(arrangement_.points.approx(used[k]), sum_);
    }
    SpatialSumInternals::set_positions(sum_, std::move(source));
  }

  /// Loops by names, each from its smallest one on, the outer one first.
  std::vector<std::vector<std::uint32_t>> named(const CellPolygon& polygon) const {
    std::vector<std::vector<std::uint32_t>> loops;
    for (const std::vector<PointId>& loop : polygon.loops) {
      std::vector<std::uint32_t> names;
      for (const PointId p : loop) names.push_back(name_[p]);
      start_at_smallest(names);
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
  double area(const std::vector<std::uint32_t>& loop) const {
    const auto at = [&](std::uint32_t v) { return Vec3{sum_.vertices[v].x, sum_.vertices[v].y, sum_.vertices[v].z}; };
    Vec3 n;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      n = n + cross(at(loop[k]) - at(loop[0]), at(loop[k + 1]) - at(loop[0]));
    return length(n);
  }

  /// The position at which the contacts of a face are requested: at its first vertex, beside its first edge; or the
  /// same of another edge of the outer loop.
  FeaturePairs::Position position_of(const std::vector<std::vector<std::uint32_t>>& loops, const PlaneGroup& group,
                                     int side, std::size_t edge = 0) const {
    const std::vector<std::uint32_t>& outer = loops[0];
    return {group, point_of_[outer[edge]], point_of_[outer[(edge + 1) % outer.size()]], side};
  }
  /// What contact_at(position) tells beside every edge of the outer loop; once where that is one for all.
  template <class F>
  auto beside_edges(const std::vector<std::vector<std::uint32_t>>& loops, const PlaneGroup& group, int side,
                    F contact_at) const {
    std::vector<decltype(contact_at(position_of(loops, group, side)))> all;
    const std::size_t edges = group.facets.size() == 1 ? 1 : loops[0].size();
    for (std::size_t k = 0; k < edges; ++k) all.push_back(contact_at(position_of(loops, group, side, k)));
    if (std::equal(all.begin() + 1, all.end(), all.begin())) all.resize(1);
    return all;
  }

  void add_faces(const std::vector<CellPolygon>& polygons) {
    std::vector<SpatialFace> faces(polygons.size());
    std::vector<std::vector<SolidContact>> beside(corners_ ? polygons.size() : 0);
    std::vector<std::uint32_t> order(faces.size()), shell(arrangement_.cell_count, kNoId);
    watch_.run_intervals(faces.size(), kPart, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const CellPolygon& polygon = polygons[k];
        const PlaneGroup& group = arrangement_.groups[arrangement_.group_of(polygon.cell)];
        const int side = group.cells.cells[polygon.cell - group.first_cell].front > 0 ? 1 : -1;
        faces[k].loops = named(polygon);
        const SolidContact contact = pairs_.of_face(position_of(faces[k].loops, group, side), side);
        faces[k].p = contact.p, faces[k].q = contact.q;
        if (corners_)
          beside[k] = beside_edges(faces[k].loops, group, side,
                                   [&](const FeaturePairs::Position& at) { return pairs_.of_face(at, side); });
        order[k] = static_cast<std::uint32_t>(k);
      }
    });
    const auto begins = [&](std::uint32_t k) { return std::pair(faces[k].loops[0][0], faces[k].loops[0][1]); };
    watch_.sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const auto x = begins(a), y = begins(b);
      return x != y ? x < y : faces[a].loops < faces[b].loops;
    });
    sum_.faces.reserve(faces.size());
    for (const std::uint32_t k : order) {
      const std::uint32_t patch = boundary_.patch[polygons[k].cell];
      if (patch == kNoId) throw std::logic_error("solid sum: a boundary cell that links refute");
      std::uint32_t& s = shell[patch];
      if (s == kNoId) s = static_cast<std::uint32_t>(sum_.shells++);
      faces[k].shell = s;
      sum_.faces.push_back(std::move(faces[k]));
      if (corners_) corners_->faces.push_back(std::move(beside[k]));
    }
  }

  void add_edge_contacts() {
    const std::vector<SpatialEdge> edges = edges_of(sum_.faces);
    std::vector<std::optional<SolidContact>> contacts(edges.size());
    watch_.run_intervals(edges.size(), kPart, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        contacts[k] = pairs_.of_edge(point_of_[edges[k].from], point_of_[edges[k].to]);
    });
    SpatialSumInternals::set_edge_contacts(sum_, std::move(contacts));
  }

  void add_tight_faces(const std::vector<CellPolygon>& polygons) {
    struct Entry {
      std::vector<std::vector<std::uint32_t>> loops;
      std::array<SolidContact, 2> contacts;
      TightFaceCorners corners;
    };
    std::vector<Entry> entries;
    for (const CellPolygon& polygon : polygons) {
      const int front = tight_side(polygon.cell);
      const PlaneGroup& group = arrangement_.groups[arrangement_.group_of(polygon.cell)];
      const auto both = [&](const FeaturePairs::Position& at) {
        return std::array{pairs_.of_face(at, front), pairs_.of_face(at, -front)};
      };
      Entry& entry = entries.emplace_back();
      entry.loops = named(polygon);
      entry.contacts = both(position_of(entry.loops, group, front));
      if (corners_) entry.corners = {beside_edges(entry.loops, group, front, both), group.plane, front};
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.loops, a.contacts) < std::tie(b.loops, b.contacts);
    });
    for (Entry& entry : entries) {
      sum_.tight_faces.push_back(std::move(entry.loops));
      sum_.tight_face_contacts.push_back(entry.contacts);
      if (corners_) corners_->tight_faces.push_back(std::move(entry.corners));
    }
  }

  void add_tight_lines(const std::vector<TightLine>& lines) {
    struct Entry {
      std::array<std::uint32_t, 2> ends;
      std::array<std::vector<SolidContact>, 2> contacts;
    };
    const auto contacts_of = [&](std::uint32_t piece) {
      const auto [a, b] = boundary_.tight.segments[piece];
      return pairs_.of_facets_along(a, b);
    };
    std::vector<Entry> entries;
    for (const TightLine& line : lines) {
      const std::uint32_t from = name_[line.from], to = name_[line.to];
      const std::uint32_t first = from < to ? line.first : line.last, last = from < to ? line.last : line.first;
      Entry& entry = entries.emplace_back(Entry{{std::min(from, to), std::max(from, to)}, {contacts_of(first), {}}});
      if (corners_) entry.contacts[1] = contacts_of(last);
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.ends < b.ends; });
    for (Entry& entry : entries) {
      sum_.tight_segments.push_back(entry.ends);
      if (corners_) corners_->tight_segments.push_back(entry.contacts);
      sum_.tight_segment_contacts.push_back(std::move(entry.contacts[0]));
    }
  }

  void add_tight_points() {
    for (const PointId p : boundary_.tight.points) sum_.tight_points.push_back(name_[p]);
    std::sort(sum_.tight_points.begin(), sum_.tight_points.end());
    for (const std::uint32_t v : sum_.tight_points)
      sum_.tight_point_contacts.push_back(pairs_.of_facets_at(point_of_[v]));
  }

  static constexpr std::size_t kPart = 64;
  const SolidBoundary& boundary_;
  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const FeaturePairs pairs_;
  SpatialSum& sum_;
  StageWatch& watch_;
  CornerContacts* corners_;          // null where nobody asks
  std::vector<PointId> point_of_;    // per vertex
  std::vector<std::uint32_t> name_;  // per point of the arrangement
};

}  // namespace

void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, CornerContacts* corners) {
  Assembler(boundary, p, q, sum, watch, corners).run();
}

}  // namespace dymsum::spatial
