#include "depth/gap_filling.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <tuple>

#include "spatial/boundary/collision.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/local/local_boundary.h"
#include "spatial/local/near_facets.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::bench {

using namespace spatial;

namespace {

using Kind = SumFacet::Kind;

auto key(const SumFacet& f) { return std::tie(f.kind, f.p, f.q); }
struct ByFeatures {
  bool operator()(const SumFacet& a, const SumFacet& b) const { return key(a) < key(b); }
};
using Facets = std::set<SumFacet, ByFeatures>;

/// What lies around a feature of one operand.
struct Surroundings {
  const SolidOperand& solid;
  std::vector<std::uint32_t> cone_of;                 // per vertex, or Wedge::kNone
  std::vector<std::vector<std::uint32_t>> convex_at;  // per vertex: its convex wedges

  explicit Surroundings(const SolidOperand& operand)
      : solid(operand), cone_of(operand.vertices.size(), Wedge::kNone), convex_at(operand.vertices.size()) {
    for (std::uint32_t c = 0; c < solid.cones.size(); ++c) cone_of[solid.cones[c].vertex] = c;
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != Wedge::Bend::convex) continue;
      convex_at[solid.wedges[w].from].push_back(w), convex_at[solid.wedges[w].to].push_back(w);
    }
  }
  template <class F>
  void for_each_edge_of(std::uint32_t triangle, F f) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t w = solid.wedge_of[3 * triangle + k];
      if (w != Wedge::kNone && solid.wedges[w].bend == Wedge::Bend::convex) f(w);
    }
  }
  /// From a vertex along convex edges to one than which no neighbour is higher.
  std::uint32_t climb(std::uint32_t vertex, Vec3 up, const std::vector<Vec3>& at) const {
    for (bool higher = true; higher;) {
      higher = false;
      for (const std::uint32_t w : convex_at[vertex]) {
        const Wedge& e = solid.wedges[w];
        const std::uint32_t other = e.from == vertex ? e.to : e.from;
        if (dot(up, at[other] - at[vertex]) <= 0) continue;
        vertex = other, higher = true;
        break;
      }
    }
    return vertex;
  }
};

/// Facets that hold in a space, from some that held before.
class Repair {
 public:
  Repair(const SumSpace& space, const Surroundings& p, const Surroundings& q, Facets& facets, GapFillingWork& work)
      : space_(space), p_(p), q_(q), facets_(facets), work_(work) {}

  void run(const Facets& before) {
    std::vector<SumFacet> ended;
    for (const SumFacet& f : before)
      if (holds(f)) facets_.insert(f);
      else ended.push_back(f);
    work_.ended += ended.size();
    for (const SumFacet& f : ended) repair(f);
  }

 private:
  bool holds(const SumFacet& f) const {
    switch (f.kind) {
      case Kind::face_vertex:
        return supports(DirectionSource::Of::p, p_, f.p, q_, f.q);
      case Kind::vertex_face:
        return supports(DirectionSource::Of::q, q_, f.q, p_, f.p);
      case Kind::edge_edge:
        break;
    }
    // Of the other side it is another facet, with other corners.
    const int side = facet_side(space_, p_.solid, q_.solid, f.p, f.q);
    return side != 0 && edge_edge_facet(p_.solid, q_.solid, f.p, f.q, side).corner == f.corner;
  }
  bool supports(DirectionSource::Of of, const Surroundings& faces, std::uint32_t t, const Surroundings& vertices,
                std::uint32_t v) const {
    const std::uint32_t c = vertices.cone_of[v];
    return c != Wedge::kNone && makes_facet(space_, of, faces.solid, t, vertices.solid, vertices.solid.cones[c]);
  }

  void repair(const SumFacet& f) {
    switch (f.kind) {
      case Kind::face_vertex:
        return repair_face(DirectionSource::Of::p, p_, f.p, q_, f.q);
      case Kind::vertex_face:
        return repair_face(DirectionSource::Of::q, q_, f.q, p_, f.p);
      case Kind::edge_edge:
        return repair_edges(f.p, f.q);
    }
  }
  void repair_face(DirectionSource::Of of, const Surroundings& faces, std::uint32_t t, const Surroundings& vertices,
                   std::uint32_t v) {
    const std::vector<Vec3>&at = of == DirectionSource::Of::p ? space_.p() : space_.q(),
          &other = of == DirectionSource::Of::p ? space_.q() : space_.p();
    const Triangle& corners = faces.solid.triangles[t];
    const Vec3 up = cross(at[corners[1]] - at[corners[0]], at[corners[2]] - at[corners[0]]);
    const std::uint32_t top = vertices.climb(v, up, other);
    if (supports(of, faces, t, vertices, top)) add(face_vertex_facet(of, faces.solid, t, top));
    for (const std::uint32_t end : {v, top})
      for (const std::uint32_t w : vertices.convex_at[end])
        faces.for_each_edge_of(t, [&](std::uint32_t e) {
          try_edges(of == DirectionSource::Of::p ? e : w, of == DirectionSource::Of::p ? w : e);
        });
  }
  void repair_edges(std::uint32_t e, std::uint32_t g) {
    const Wedge &a = p_.solid.wedges[e], &b = q_.solid.wedges[g];
    for (const std::uint32_t t : {b.left, b.right}) q_.for_each_edge_of(t, [&](std::uint32_t w) { try_edges(e, w); });
    for (const std::uint32_t t : {a.left, a.right}) p_.for_each_edge_of(t, [&](std::uint32_t w) { try_edges(w, g); });
    for (const std::uint32_t t : {a.left, a.right})
      for (const std::uint32_t v : {b.from, b.to})
        if (supports(DirectionSource::Of::p, p_, t, q_, v))
          add(face_vertex_facet(DirectionSource::Of::p, p_.solid, t, v));
    for (const std::uint32_t t : {b.left, b.right})
      for (const std::uint32_t v : {a.from, a.to})
        if (supports(DirectionSource::Of::q, q_, t, p_, v))
          add(face_vertex_facet(DirectionSource::Of::q, q_.solid, t, v));
  }
  void try_edges(std::uint32_t e, std::uint32_t g) {
    if (!tried_.insert({e, g}).second) return;
    if (const int side = facet_side(space_, p_.solid, q_.solid, e, g); side != 0)
      add(edge_edge_facet(p_.solid, q_.solid, e, g, side));
  }
  void add(const SumFacet& f) { work_.repaired += facets_.insert(f).second; }

  const SumSpace& space_;
  const Surroundings &p_, &q_;
  Facets& facets_;
  GapFillingWork& work_;
  std::set<std::array<std::uint32_t, 2>> tried_;
};

/// The cells about an edge with one free side.
template <class F>
void for_each_wall(const SolidArrangement& arrangement, std::uint32_t edge, F f) {
  for (const EdgeUse use : arrangement.uses(edge)) {
    const PlaneGroup& group = arrangement.groups[use.group];
    const CellEdge& e = group.cells.edges[use.edge];
    for (const std::uint32_t c : {e.left, e.right})
      if (c != kNoId && (group.cells.cells[c].front > 0) != (group.cells.cells[c].back > 0)) f(group.first_cell + c);
  }
}

/// Patches of the surface, which end where more or fewer than two cells meet, each with a test of its own: links of our
/// own stages take it that no facet is missing.
std::vector<bool> free_cells(const SolidBoundary& boundary, const spatial::SolidPair& pair,
                             const ClipWalls::Scopes& scopes) {
  const SolidArrangement& arrangement = *boundary.arrangement;
  std::vector<std::uint32_t> parent(arrangement.cell_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  std::vector<std::uint32_t> walls;
  for (std::uint32_t e = 0; e < arrangement.edge_ends.size(); ++e) {
    if (!scopes.inside_linked[e]) continue;
    walls.clear();
    for_each_wall(arrangement, e, [&](std::uint32_t c) { walls.push_back(c); });
    if (walls.size() == 2) parent[root(walls[0])] = root(walls[1]);
  }
  const Collision collision(*boundary.space, pair.p, pair.q);
  std::vector<std::int8_t> verdict(arrangement.cell_count, -1);
  std::vector<bool> free(arrangement.cell_count, false);
  for (const PlaneGroup& group : arrangement.groups)
    for (std::uint32_t k = 0; k < group.cells.cells.size(); ++k) {
      const Cell& cell = group.cells.cells[k];
      const std::uint32_t c = group.first_cell + k;
      if (!scopes.inside.cells[c] || (cell.front > 0) == (cell.back > 0)) continue;
      std::int8_t& known = verdict[root(c)];
      if (known < 0) known = !collision.meets(flag_at(arrangement, group, cell, cell.front > 0 ? 1 : -1));
      free[c] = known > 0;
    }
  return free;
}

/// The end of the surface inside the box that is furthest away from its sides, and that distance.
struct OpenEnd {
  Vec3 at;
  double room = 0;
};
std::optional<OpenEnd> open_end(const SolidBoundary& boundary, const ClipWalls::Scopes& scopes, const Box& reach) {
  const SolidArrangement& arrangement = *boundary.arrangement;
  std::optional<OpenEnd> best;
  for (std::uint32_t e = 0; e < arrangement.edge_ends.size(); ++e) {
    if (!scopes.inside_linked[e]) continue;
    int faces = 0;
    for_each_wall(arrangement, e, [&](std::uint32_t c) { faces += boundary.boundary[c]; });
    if (faces % 2 == 0) continue;
    const auto [a, b] = arrangement.edge_ends[e];
    const Vec3 x = 0.5 * (arrangement.points.approx(a).at + arrangement.points.approx(b).at);
    const double room = std::min({x.x - reach.low.x, x.y - reach.low.y, x.z - reach.low.z, reach.high.x - x.x,
                                  reach.high.y - x.y, reach.high.z - x.z});
    if (!best || room > best->room) best = OpenEnd{x, room};
  }
  return best;
}

}  // namespace

class GapFilling::State {
 public:
  State(const Mesh& p, const Mesh& q)
      : pair_(solid_pair(p, q)), p_(pair_.p), q_(pair_.q), near_(pair_), watch_(options_, stats_) {
    options_.tight = false, options_.threads = 1;
  }

  LocalPart in(const ClipBox& box, const PosePair& poses) {
    work_ = {};
    const SumBounds bounds = sum_bounds(pair_, poses);
    Facets facets;
    for (bool first = true;; first = false) {
      ClipWalls walls(box, bounds, true);
      PosedSpace space = posed_space(pair_, poses, walls.levels());
      const Box reach = walls.reach(*space.space, static_cast<std::uint32_t>(pair_.p.vertices.size()));
      if (first && started_) Repair(*space.space, p_, q_, facets, work_).run(kept_);
      if (!started_) find(*space.space, reach, facets);
      started_ = true;
      const exact::BigInteger scale = space.scale;
      LocalBoundary local = boundary_of(space, facets, box, walls, reach);
      const ClipWalls::Scopes scopes = walls.scopes(*local.boundary.space, *local.boundary.arrangement);
      local.boundary.boundary = free_cells(local.boundary, pair_, scopes);
      const std::optional<OpenEnd> end = open_end(local.boundary, scopes, reach);
      work_.closed = !end;
      const std::uint64_t before = work_.found;
      if (end) {
        ++work_.queries;
        find(*local.boundary.space, Box{end->at - end->room * Vec3{1, 1, 1}, end->at + end->room * Vec3{1, 1, 1}},
             facets);
      }
      if (end && work_.found > before) continue;
      kept_ = std::move(facets);
      return part_of(std::move(local), scale, box);
    }
  }

  const GapFillingWork& work() const { return work_; }

 private:
  void find(const SumSpace& space, const Box& box, Facets& facets) {
    for (const SumFacet& f : near_.find(space, box).facets) work_.found += facets.insert(f).second;
  }

  /// Facets that left the box are forgotten.
  LocalBoundary boundary_of(PosedSpace& space, Facets& facets, const ClipBox& box, ClipWalls& walls, const Box& reach) {
    ReducedConvolution near;
    std::erase_if(facets, [&](const SumFacet& f) { return !comes_near(*space.space, f, reach); });
    for (const SumFacet& f : facets) near.facets.push_back(f), near.planes.push_back(plane_of(f));
    const auto half = [](double low, double high) {
      return exact::BigRational((exact::exact_value(low) + exact::exact_value(high)) / 2);
    };
    const Centre centre{{half(box.low.x, box.high.x), half(box.low.y, box.high.y), half(box.low.z, box.high.z)}, false};
    return local_boundary(space, std::move(near), pair_, walls, centre, options_, stats_, watch_);
  }

  LocalPart part_of(LocalBoundary local, const exact::BigInteger& scale, const ClipBox& box) {
    LocalPart part;
    part.box = box;
    for (std::uint32_t c = 0; c < local.boundary.boundary.size(); ++c)
      if (local.boundary.boundary[c] && local.boundary.patch[c] == kNoId) return part;  // ends in the open
    assemble(local.boundary, pair_.p, pair_.q, part.boundary, watch_);
    auto positions = std::make_shared<SpatialPositions>(SpatialSumInternals::positions(part.boundary));
    positions->space = std::move(local.boundary.space);
    SpatialSumInternals::set_positions(part.boundary, std::move(positions));
    unscale(part.boundary, scale);
    part.where = !part.boundary.vertices.empty() ? LocalPart::Where::crossed
                 : local.centre_inside           ? LocalPart::Where::inside
                                                 : LocalPart::Where::outside;
    return part;
  }

  SpatialOptions options_;
  SpatialStats stats_;
  spatial::SolidPair pair_;
  Surroundings p_, q_;
  NearFacets near_;
  StageWatch watch_;
  Facets kept_;
  bool started_ = false;
  GapFillingWork work_;
};

GapFilling::GapFilling(const Mesh& p, const Mesh& q) : state_(std::make_unique<State>(p, q)) {}
GapFilling::~GapFilling() = default;
LocalPart GapFilling::in(const ClipBox& box, const SolidPose& p) { return state_->in(box, {p, {}}); }
const GapFillingWork& GapFilling::work() const { return state_->work(); }

}  // namespace dymsum::bench
