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

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/merged_cells.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_order.h"

namespace dymsum::spatial {
namespace {

class Assembler {
 public:
  Assembler(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
            StageWatch& watch, std::vector<SheetFace> sheet_faces, CornerContacts* corners)
      : boundary_(boundary),
        space_(*boundary.space),
        arrangement_(*boundary.arrangement),
        pairs_(boundary, p, q, watch),
        sum_(sum),
        watch_(watch),
        sheet_faces_(std::move(sheet_faces)),
        corners_(corners) {}

  void run() {
    std::vector<PointId> corners;
    for (const SheetFace& face : sheet_faces_)
      for (const std::vector<PointId>& loop : face.loops) corners.insert(corners.end(), loop.begin(), loop.end());
    std::vector<CellPolygon> faces = merged_cells(space_, arrangement_, boundary_selection(), corners, watch_);
    first_sheet_face_ = faces.size();
    for (SheetFace& face : sheet_faces_) faces.push_back({std::move(face.loops), face.cell});
    std::vector<CellPolygon> tight;
    if (!boundary_.tight.cells.empty()) tight = merged_cells(space_, arrangement_, tight_selection(), {}, watch_);
    const std::vector<TightLine> lines = joined_lines(space_, arrangement_.points, boundary_.tight.segments);
    name_vertices(faces, tight, lines);
    add_faces(std::move(faces));
    add_edge_contacts();
    add_tight_faces(std::move(tight));
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
  std::vector<std::vector<std::uint32_t>> named(std::vector<std::vector<PointId>> loops) const {
    for (std::vector<std::uint32_t>& loop : loops) {
      for (std::uint32_t& p : loop) p = name_[p];
      start_at_smallest(loop);
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

  /// The face of P's mesh beside the first edge of a sheet's face.
  std::uint32_t face_of(const SheetFace& face, const std::vector<std::vector<std::uint32_t>>& loops) const {
    for (const SheetFace::Side& side : face.sides)
      if (side.from == point_of_[loops[0][0]] && side.to == point_of_[loops[0][1]]) return side.face;
    return face.face;
  }

  void add_faces(std::vector<CellPolygon> polygons) {
    std::vector<SpatialFace> faces(polygons.size());
    std::vector<std::vector<SolidContact>> beside(corners_ ? polygons.size() : 0);
    std::vector<std::uint32_t> order(faces.size()), shell(arrangement_.cell_count, kNoId);
    watch_.run_intervals(faces.size(), kPart, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        order[k] = static_cast<std::uint32_t>(k);
        faces[k].loops = named(std::move(polygons[k].loops));
        if (k >= first_sheet_face_) {
          const std::uint32_t face = face_of(sheet_faces_[k - first_sheet_face_], faces[k].loops);
          faces[k].p = {SolidFeature::Kind::face, face, 0}, faces[k].q = {SolidFeature::Kind::vertex, 0, 0};
          continue;
        }
        const PlaneGroup& group = arrangement_.groups[arrangement_.group_of(polygons[k].cell)];
        const int side = group.cells.cells[polygons[k].cell - group.first_cell].front > 0 ? 1 : -1;
        const SolidContact contact = pairs_.of_face(position_of(faces[k].loops, group, side), side);
        faces[k].p = contact.p, faces[k].q = contact.q;
        if (corners_)  // sums have no sheets
          beside[k] = beside_edges(faces[k].loops, group, side,
                                   [&](const FeaturePairs::Position& at) { return pairs_.of_face(at, side); });
      }
    });
    const auto begins = [&](std::uint32_t k) { return std::pair(faces[k].loops[0][0], faces[k].loops[0][1]); };
    watch_.sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const auto x = begins(a), y = begins(b);
      return x != y ? x < y : faces[a].loops < faces[b].loops;
    });
    sum_.faces.reserve(faces.size()), of_sheet_.reserve(faces.size());
    for (const std::uint32_t k : order) {
      of_sheet_.push_back(k >= first_sheet_face_);
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
    const EdgeList list = edge_list(sum_.faces);
    std::vector<std::optional<SolidContact>> contacts(list.size());
    watch_.run_intervals(list.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const PointId from = point_of_[list.edges[k].from], to = point_of_[list.edges[k].to];
        const auto of = list.faces_of(k);
        const bool is_sheets = std::any_of(of.begin(), of.end(), [&](std::uint32_t f) { return of_sheet_[f]; });
        contacts[k] = is_sheets ? edge_of_p(from, to) : pairs_.of_edge(from, to);
      }
    });
    SpatialSumInternals::set_edge_contacts(sum_, std::move(contacts));
  }
  /// Of two vertices of P that an edge of a sheet joins.
  SolidContact edge_of_p(PointId from, PointId to) const {
    const std::uint32_t a = arrangement_.points.source(from).a, b = arrangement_.points.source(to).a;
    return {{SolidFeature::Kind::edge, std::min(a, b), std::max(a, b)}, {SolidFeature::Kind::vertex, 0, 0}};
  }

  void add_tight_faces(std::vector<CellPolygon> polygons) {
    struct Entry {
      std::vector<std::vector<std::uint32_t>> loops;
      std::array<SolidContact, 2> contacts;
      TightFaceCorners corners;
    };
    std::vector<Entry> entries;
    for (CellPolygon& polygon : polygons) {
      const int front = tight_side(polygon.cell);
      const PlaneGroup& group = arrangement_.groups[arrangement_.group_of(polygon.cell)];
      const auto both = [&](const FeaturePairs::Position& at) {
        return std::array{pairs_.of_face(at, front), pairs_.of_face(at, -front)};
      };
      Entry& entry = entries.emplace_back();
      entry.loops = named(std::move(polygon.loops));
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
  std::vector<SheetFace> sheet_faces_;
  CornerContacts* corners_;           // may be null
  std::size_t first_sheet_face_ = 0;  // among all polygons
  std::vector<bool> of_sheet_;        // per face of the sum
  std::vector<PointId> point_of_;     // per vertex
  std::vector<std::uint32_t> name_;   // per point of the arrangement
};

}  // namespace

void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, std::vector<SheetFace> sheet_faces, CornerContacts* corners) {
  Assembler(boundary, p, q, sum, watch, std::move(sheet_faces), corners).run();
}

}  // namespace dymsum::spatial
