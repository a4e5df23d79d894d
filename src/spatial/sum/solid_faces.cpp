#include "spatial/sum/solid_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/merged_cells.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

class Assembler {
 public:
  Assembler(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
            StageWatch& watch, std::vector<SheetFace> sheet_faces)
      : boundary_(boundary),
        space_(*boundary.space),
        arrangement_(*boundary.arrangement),
        pairs_(boundary, p, q, watch),
        sum_(sum),
        watch_(watch),
        sheet_faces_(std::move(sheet_faces)) {}

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

  /// The sign of b's position less a's, by x, y, z.
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

  /// Sorts by x, y, z: by the doubles of x first, then intervals in which these do not decide.
  void sort_points(std::vector<PointId>& points) const {
    struct Key {
      double x;
      PointId point;
      auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys;
    keys.reserve(points.size());
    double radius = 0;
    for (const PointId p : points) {
      const Approx& at = arrangement_.points.approx(p);
      keys.push_back({at.at.x, p}), radius = std::max(radius, at.radius);
    }
    watch_.sort(keys, std::less<>());
    for (std::size_t k = 0; k < keys.size(); ++k) points[k] = keys[k].point;
    const double near = 4 * radius + space_.span() * 0x1p-50;
    for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
      for (last = first + 1; last < keys.size() && keys[last].x - keys[last - 1].x <= near;) ++last;
      std::sort(points.begin() + static_cast<std::ptrdiff_t>(first), points.begin() + static_cast<std::ptrdiff_t>(last),
                [&](PointId a, PointId b) { return order(a, b) > 0; });
    }
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
    sort_points(used);
    name_.assign(arrangement_.points.size(), kNoId);
    auto source = std::make_shared<SpatialPositions>();
    source->space = boundary_.space;
    double world[3], offset[3];
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space_.line(axis);
      world[axis] = std::ldexp(1.0, line.unit), offset[axis] = line.p_offset + line.q_offset;
    }
    for (std::uint32_t k = 0; k < used.size(); ++k) {
      name_[used[k]] = k;
      const Approx& at = arrangement_.points.approx(used[k]);
      source->vertices.push_back(arrangement_.points.source(used[k]));
      sum_.vertex_contacts.push_back(pairs_.of_point(used[k]));
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

  /// The position at which the contacts of a face are requested: at its first vertex, beside its first edge.
  FeaturePairs::Position position_of(const std::vector<std::vector<std::uint32_t>>& loops, const PlaneGroup& group,
                                     int side) const {
    return {group, point_of_[loops[0][0]], point_of_[loops[0][1]], side};
  }

  /// The face of P's mesh beside the first edge of a sheet's face.
  std::uint32_t face_of(const SheetFace& face, const std::vector<std::vector<std::uint32_t>>& loops) const {
    for (const SheetFace::Side& side : face.sides)
      if (side.from == point_of_[loops[0][0]] && side.to == point_of_[loops[0][1]]) return side.face;
    return face.face;
  }

  void add_faces(std::vector<CellPolygon> polygons) {
    std::vector<SpatialFace> faces(polygons.size());
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
    using Entry = std::pair<std::vector<std::vector<std::uint32_t>>, std::array<SolidContact, 2>>;
    std::vector<Entry> entries;
    for (CellPolygon& polygon : polygons) {
      const int front = tight_side(polygon.cell);
      auto loops = named(std::move(polygon.loops));
      const auto position = position_of(loops, arrangement_.groups[arrangement_.group_of(polygon.cell)], front);
      entries.push_back({std::move(loops), {pairs_.of_face(position, front), pairs_.of_face(position, -front)}});
    }
    std::sort(entries.begin(), entries.end());
    for (Entry& entry : entries) {
      sum_.tight_faces.push_back(std::move(entry.first));
      sum_.tight_face_contacts.push_back(entry.second);
    }
  }

  void add_tight_lines(const std::vector<TightLine>& lines) {
    struct Entry {
      std::array<std::uint32_t, 2> ends;
      std::vector<SolidContact> contacts;
    };
    std::vector<Entry> entries;
    for (const TightLine& line : lines) {
      const std::uint32_t from = name_[line.from], to = name_[line.to];
      const auto piece = boundary_.tight.segments[from < to ? line.first : line.last];
      entries.push_back({{std::min(from, to), std::max(from, to)}, pairs_.of_facets_along(piece[0], piece[1])});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.ends < b.ends; });
    for (Entry& entry : entries) {
      sum_.tight_segments.push_back(entry.ends);
      sum_.tight_segment_contacts.push_back(std::move(entry.contacts));
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
  std::size_t first_sheet_face_ = 0;  // among all polygons
  std::vector<bool> of_sheet_;        // per face of the sum
  std::vector<PointId> point_of_;     // per vertex
  std::vector<std::uint32_t> name_;   // per point of the arrangement
};

}  // namespace

void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, std::vector<SheetFace> sheet_faces) {
  Assembler(boundary, p, q, sum, watch, std::move(sheet_faces)).run();
}

}  // namespace dymsum::spatial
