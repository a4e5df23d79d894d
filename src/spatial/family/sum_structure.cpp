#include "spatial/family/sum_structure.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_order.h"

namespace dymsum::spatial {
namespace {

using Kind = PointSource::Kind;
using Loops = std::vector<std::vector<std::uint32_t>>;

/// What a space's planes were made from.
struct PlaneSources : SumSpace {
  static const PlaneSource& of(const SumSpace& space, PlaneId plane) {
    return (space.*(&PlaneSources::plane_sources_))[plane];
  }
};

/// The planes and edges of a space that a structure names, under their indices there, in the space's order.
class NamedSources {
 public:
  explicit NamedSources(const SumSpace& space)
      : space_(space), plane_(space.planes().size(), kNoId), edge_(space.edges().size(), kNoId) {}

  void use(const PointSource& point) {
    if (point.kind == Kind::edge) edge_[point.a] = 0, plane_[point.b] = 0;
    if (point.kind == Kind::planes) plane_[point.a] = plane_[point.b] = plane_[point.c] = 0;
  }
  void use(PlaneId plane) { plane_[plane] = 0; }

  void list(std::vector<PlaneSource>& planes, std::vector<SumEdge>& edges) {
    for (PlaneId id = 0; id < plane_.size(); ++id) {
      if (plane_[id] == kNoId) continue;
      plane_[id] = static_cast<std::uint32_t>(planes.size());
      planes.push_back(PlaneSources::of(space_, id));
    }
    for (EdgeId id = 0; id < edge_.size(); ++id) {
      if (edge_[id] == kNoId) continue;
      edge_[id] = static_cast<std::uint32_t>(edges.size());
      edges.push_back(space_.edges()[id]);
    }
  }
  std::uint32_t plane(PlaneId id) const { return plane_[id]; }
  PointSource named(PointSource point) const {
    if (point.kind == Kind::edge) point.a = edge_[point.a], point.b = plane_[point.b];
    if (point.kind == Kind::planes) point.a = plane_[point.a], point.b = plane_[point.b], point.c = plane_[point.c];
    return point;
  }

 private:
  const SumSpace& space_;
  std::vector<std::uint32_t> plane_, edge_;  // per one of the space: its index, kNoId where it is not used
};

std::pair<std::uint32_t, std::uint32_t> add_loops(const Loops& loops, SumStructure& structure) {
  const auto first = static_cast<std::uint32_t>(structure.loops.size());
  for (const std::vector<std::uint32_t>& loop : loops) {
    const auto begin = static_cast<std::uint32_t>(structure.corners.size());
    structure.corners.insert(structure.corners.end(), loop.begin(), loop.end());
    structure.loops.push_back({begin, static_cast<std::uint32_t>(structure.corners.size())});
  }
  return {first, static_cast<std::uint32_t>(structure.loops.size())};
}

void add_faces(const SpatialSum& sum, const CornerContacts& corners, SumStructure& structure) {
  for (std::size_t f = 0; f < sum.faces.size(); ++f) {
    SumStructure::Face& face = structure.faces.emplace_back();
    std::tie(face.first_loop, face.last_loop) = add_loops(sum.faces[f].loops, structure);
    face.first_contact = static_cast<std::uint32_t>(structure.contacts.size());
    structure.contacts.insert(structure.contacts.end(), corners.faces[f].begin(), corners.faces[f].end());
    face.last_contact = static_cast<std::uint32_t>(structure.contacts.size());
    face.shell = sum.faces[f].shell;
  }
  for (const SpatialEdge& edge : sum.edges()) structure.boundary_edges.push_back({edge.from, edge.to, edge.contact});
}

void add_tight(const SpatialSum& sum, CornerContacts& corners, const NamedSources& sources, SumStructure& structure) {
  for (std::size_t t = 0; t < sum.tight_faces.size(); ++t) {
    TightFaceCorners& at = corners.tight_faces[t];
    SumStructure::TightFace& face = structure.tight_faces.emplace_back();
    std::tie(face.first_loop, face.last_loop) = add_loops(sum.tight_faces[t], structure);
    face.contacts = std::move(at.contacts), face.plane = sources.plane(at.plane), face.front = at.front;
  }
  for (std::size_t t = 0; t < sum.tight_segments.size(); ++t)
    structure.tight_segments.push_back({sum.tight_segments[t], std::move(corners.tight_segments[t])});
  for (std::size_t t = 0; t < sum.tight_points.size(); ++t)
    structure.tight_points.push_back({sum.tight_points[t], sum.tight_point_contacts[t]});
}

template <class T>
std::uint64_t size_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

}  // namespace

std::uint64_t SumStructure::bytes() const {
  std::uint64_t all = sizeof(SumStructure) + size_of(planes) + size_of(edges) + size_of(vertices) +
                      size_of(vertex_contacts) + size_of(loops) + size_of(corners) + size_of(contacts) +
                      size_of(faces) + size_of(boundary_edges) + size_of(tight_faces) + size_of(tight_segments) +
                      size_of(tight_points);
  for (const TightFace& face : tight_faces) all += size_of(face.contacts);
  for (const TightSegment& segment : tight_segments) all += size_of(segment.contacts[0]) + size_of(segment.contacts[1]);
  for (const TightPoint& point : tight_points) all += size_of(point.contacts);
  return all;
}

SumStructure structure_of(const SpatialSum& sum, CornerContacts corners) {
  SumStructure structure;
  structure.face_vertex = sum.stats.face_vertex, structure.edge_edge = sum.stats.edge_edge;
  if (sum.vertices.empty()) return structure;
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  NamedSources sources(*positions.space);
  for (const PointSource& vertex : positions.vertices) sources.use(vertex);
  for (const TightFaceCorners& face : corners.tight_faces) sources.use(face.plane);
  sources.list(structure.planes, structure.edges);
  structure.vertices.reserve(positions.vertices.size());
  for (const PointSource& vertex : positions.vertices) structure.vertices.push_back(sources.named(vertex));
  structure.vertex_contacts = sum.vertex_contacts;
  structure.shells = static_cast<std::uint32_t>(sum.shells);
  add_faces(sum, corners, structure);
  add_tight(sum, corners, sources, structure);
  return structure;
}

namespace {

/// The vertices of a structure at a pose.
struct PlacedVertices {
  const std::vector<PointSource>& sources;
  std::vector<Approx> near;

  const PointSource& source(std::uint32_t v) const { return sources[v]; }
  const Approx& approx(std::uint32_t v) const { return near[v]; }
};

class Placer {
 public:
  Placer(const SumStructure& structure, std::shared_ptr<SumSpace> space)
      : structure_(structure), space_(std::move(space)) {}

  std::optional<SpatialSum> run() {
    space_->add_planes(structure_.planes);
    space_->add_edges(structure_.edges);
    for (const SumStructure::TightFace& face : structure_.tight_faces)
      if (is_turned_over(face)) return std::nullopt;
    sum_.stats.bits = space_->bits();
    add_vertices();
    add_faces();
    add_edges();
    add_tight_faces();
    add_tight_lines();
    return std::move(sum_);
  }

 private:
  void add_vertices() {
    const std::size_t n = structure_.vertices.size();
    PlacedVertices placed{structure_.vertices, {}};
    placed.near.reserve(n);
    for (const PointSource& v : structure_.vertices) placed.near.push_back(space_->approximate(v));
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    VertexOrder(*space_, placed).sort(order, 1);
    const VertexPositions positions(*space_);
    auto source = std::make_shared<SpatialPositions>();
    source->space = space_;
    source->vertices.reserve(n), sum_.vertices.reserve(n), sum_.vertex_contacts.reserve(n);
    name_.resize(n);
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t v = order[k];
      name_[v] = k;
      source->vertices.push_back(structure_.vertices[v]);
      sum_.vertex_contacts.push_back(structure_.vertex_contacts[v]);
      positions.add(placed.near[v], sum_);
    }
    SpatialSumInternals::set_positions(sum_, std::move(source));
  }

  /// A loop by names from its smallest rotation on; where in the structure's loop that begins.
  std::vector<std::uint32_t> named(const SumStructure::Loop& loop, std::size_t& start) const {
    const std::uint32_t* corners = structure_.corners.data() + loop.first;
    const std::size_t n = loop.last - loop.first;
    std::vector<std::uint32_t> names(n);
    std::size_t smallest = 0, times = 0;
    for (std::size_t k = 0; k < n; ++k) {
      names[k] = name_[corners[k]];
      if (names[k] < names[smallest]) smallest = k, times = 0;
      times += names[k] == names[smallest];
    }
    start = smallest;
    if (times == 1) {
      std::rotate(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(smallest), names.end());
      return names;
    }
    start_at_smallest(names);
    // The same rotation of a loop that comes by its smallest vertex several times.
    for (start = 0; start < n; ++start) {
      bool same = true;
      for (std::size_t k = 0; k < n && same; ++k) same = names[k] == name_[corners[(start + k) % n]];
      if (same) break;
    }
    return names;
  }
  /// The outer loop first, then holes in order; `start` as of named, of the outer one.
  Loops named(std::uint32_t first_loop, std::uint32_t last_loop, std::size_t& start) const {
    Loops loops;
    loops.reserve(last_loop - first_loop);
    std::size_t of_hole = 0;
    for (std::uint32_t l = first_loop; l < last_loop; ++l)
      loops.push_back(named(structure_.loops[l], l == first_loop ? start : of_hole));
    std::sort(loops.begin() + 1, loops.end());
    return loops;
  }

  void add_faces() {
    const std::size_t n = structure_.faces.size();
    std::vector<SpatialFace> faces(n);
    for (std::size_t f = 0; f < n; ++f) {
      const SumStructure::Face& face = structure_.faces[f];
      std::size_t start = 0;
      faces[f].loops = named(face.first_loop, face.last_loop, start);
      const bool one = face.last_contact - face.first_contact == 1;
      const SolidContact& contact = structure_.contacts[face.first_contact + (one ? 0 : start)];
      faces[f].p = contact.p, faces[f].q = contact.q;
    }
    std::vector<std::uint32_t> shell(structure_.shells, kNoId);
    sum_.faces.reserve(n);
    for (const std::uint32_t f : face_order(faces)) {
      std::uint32_t& s = shell[structure_.faces[f].shell];
      if (s == kNoId) s = static_cast<std::uint32_t>(sum_.shells++);
      faces[f].shell = s;
      sum_.faces.push_back(std::move(faces[f]));
    }
  }
  static std::vector<std::uint32_t> face_order(const std::vector<SpatialFace>& faces) {
    struct Key {
      std::uint64_t begins;
      std::uint32_t face;
    };
    std::vector<Key> keys(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const std::vector<std::uint32_t>& outer = faces[f].loops[0];
      keys[f] = {(static_cast<std::uint64_t>(outer[0]) << 32) | outer[1], f};
    }
    std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
      return a.begins != b.begins ? a.begins < b.begins : faces[a.face].loops < faces[b.face].loops;
    });
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const Key& key : keys) order.push_back(key.face);
    return order;
  }

  /// What touches along the edges, in the order of SpatialSum::edges.
  void add_edges() {
    struct Key {
      std::uint64_t ends;
      std::uint32_t edge;
    };
    std::vector<Key> keys;
    keys.reserve(structure_.boundary_edges.size());
    for (std::uint32_t e = 0; e < structure_.boundary_edges.size(); ++e) {
      const auto [a, b] = std::minmax(name_[structure_.boundary_edges[e].from], name_[structure_.boundary_edges[e].to]);
      keys.push_back({(static_cast<std::uint64_t>(a) << 32) | b, e});
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.ends < b.ends; });
    std::vector<std::optional<SolidContact>> contacts;
    contacts.reserve(keys.size());
    for (const Key& key : keys) contacts.push_back(structure_.boundary_edges[key.edge].contact);
    SpatialSumInternals::set_edge_contacts(sum_, std::move(contacts));
  }

  /// Whether a tight face is seen from its other side now: that to which the first component of the normal points that
  /// is not zero.
  bool is_turned_over(const SumStructure::TightFace& face) const {
    int front = 0;
    for (int axis = 0; axis < 3 && front == 0; ++axis) front = space_->exact_normal(face.plane, axis);
    return front != face.front;
  }
  void add_tight_faces() {
    std::vector<std::pair<Loops, std::array<SolidContact, 2>>> entries;
    for (const SumStructure::TightFace& face : structure_.tight_faces) {
      std::size_t start = 0;
      Loops loops = named(face.first_loop, face.last_loop, start);
      entries.emplace_back(std::move(loops), face.contacts[face.contacts.size() == 1 ? 0 : start]);
    }
    std::sort(entries.begin(), entries.end());
    for (auto& [loops, contacts] : entries) {
      sum_.tight_faces.push_back(std::move(loops));
      sum_.tight_face_contacts.push_back(contacts);
    }
  }
  void add_tight_lines() {
    std::vector<std::pair<std::array<std::uint32_t, 2>, const std::vector<SolidContact>*>> segments;
    for (const SumStructure::TightSegment& segment : structure_.tight_segments) {
      const std::uint32_t a = name_[segment.ends[0]], b = name_[segment.ends[1]];
      segments.push_back({{std::min(a, b), std::max(a, b)}, &segment.contacts[a < b ? 0 : 1]});
    }
    std::sort(segments.begin(), segments.end());
    for (const auto& [ends, contacts] : segments) {
      sum_.tight_segments.push_back(ends);
      sum_.tight_segment_contacts.push_back(*contacts);
    }
    std::vector<std::pair<std::uint32_t, const std::vector<SolidContact>*>> points;
    for (const SumStructure::TightPoint& point : structure_.tight_points)
      points.emplace_back(name_[point.vertex], &point.contacts);
    std::sort(points.begin(), points.end());
    for (const auto& [vertex, contacts] : points) {
      sum_.tight_points.push_back(vertex);
      sum_.tight_point_contacts.push_back(*contacts);
    }
  }

  const SumStructure& structure_;
  std::shared_ptr<SumSpace> space_;
  std::vector<std::uint32_t> name_;  // per vertex of the structure
  SpatialSum sum_;
};

}  // namespace

std::optional<SpatialSum> placed(const SumStructure& structure, PosedSpace space) {
  SpatialSum sum;
  if (!structure.vertices.empty()) {
    std::optional<SpatialSum> made = Placer(structure, std::move(space.space)).run();
    if (!made) return std::nullopt;
    sum = *std::move(made);
    unscale(sum, space.scale);
  }
  sum.stats.face_vertex = structure.face_vertex, sum.stats.edge_edge = structure.edge_edge;
  return sum;
}

}  // namespace dymsum::spatial
