#include "planar/result/result_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/grid.h"
#include "planar/position/exact_source.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {
namespace {

bool before(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace

SumSkeleton::SumSkeleton(const PlanarSum& sum) : source_(exact_source(sum)) {
  if (sum.parts.empty() && sum.segments.empty() && sum.points.empty()) return;
  if (!source_) throw std::logic_error("PlanarSum: vertices without a source of exact positions");
  const NearestPoint nearest_point(*source_);
  for (std::size_t i = 0; i < sum.parts.size(); ++i) {
    const auto part = static_cast<std::int64_t>(i);
    std::int64_t ring = 0;
    add_ring(sum.parts[i].outer, nearest_point, part, ring);
    for (const SumRing& hole : sum.parts[i].holes) add_ring(hole, nearest_point, part, ++ring);
  }
  const auto next = [&] { return static_cast<std::uint32_t>(nearest.size()); };
  for (const SumSegment& s : sum.segments) {
    const Chain chain{next(), 2, false, {}, {}};
    add_vertex(s.from, nearest_point);
    add_vertex(s.to, nearest_point);
    add_chain(chain);
  }
  for (const SumVertex& v : sum.points) {
    const Chain chain{next(), 1, false, {}, {}};
    add_vertex(v, nearest_point);
    add_chain(chain);
  }
  spots_.resize(nearest.size());
  find_positions();
}

void SumSkeleton::add_vertex(const SumVertex& vertex, const NearestPoint& nearest_point) {
  nearest.push_back(nearest_point(vertex));
  named_.push_back(&vertex);
}

void SumSkeleton::add_ring(const SumRing& ring, const NearestPoint& nearest_point, std::int64_t part,
                           std::int64_t index) {
  const Chain chain{static_cast<std::uint32_t>(nearest.size()), static_cast<std::uint32_t>(ring.vertices.size()), true,
                    part, index};
  for (const SumVertex& v : ring.vertices) add_vertex(v, nearest_point);
  add_chain(chain);
}

const Spot& SumSkeleton::spot(std::uint32_t vertex) const {
  std::unique_ptr<const Spot>& kept = spots_[vertex];
  if (!kept) kept = std::make_unique<const Spot>(Spot{source_->position(*named_[vertex]), nearest[vertex]});
  return *kept;
}

int SumSkeleton::compare(std::uint32_t a, std::uint32_t b) const {
  if (nearest[a].x != nearest[b].x) return nearest[a].x < nearest[b].x ? -1 : 1;
  if (same_position(*named_[a], *named_[b])) return 0;
  return planar::compare(spot(a), spot(b));
}

void SumSkeleton::add_chain(Chain chain) {
  const auto index = static_cast<std::uint32_t>(chains.size());
  for (std::uint32_t k = 0; k + 1 < chain.count; ++k) edges.push_back({chain.first + k, chain.first + k + 1, index});
  if (chain.closed) edges.push_back({chain.first + chain.count - 1, chain.first, index});
  chains.push_back(chain);
}

void SumSkeleton::find_positions() {
  std::vector<std::uint32_t> order(nearest.size());
  std::iota(order.begin(), order.end(), 0u);
  // Vertices of one nearest point follow each other in any exact order; exact positions are made for these alone.
  const auto exact_order = [&](std::uint32_t a, std::uint32_t b) {
    if (before(nearest[a], nearest[b])) return -1;
    if (before(nearest[b], nearest[a])) return 1;
    return same_position(*named_[a], *named_[b]) ? 0 : planar::compare(spot(a).exact, spot(b).exact);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int sign = exact_order(a, b);
    return sign != 0 ? sign < 0 : a < b;
  });
  position.resize(nearest.size());
  for (const std::uint32_t v : order) {
    if (positions.empty() || exact_order(positions.back(), v) != 0) positions.push_back(v);
    position[v] = positions.back();
  }
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> SumSkeleton::first_collision() const {
  for (std::size_t i = 1; i < positions.size(); ++i)
    if (nearest[positions[i - 1]] == nearest[positions[i]]) return std::pair{positions[i - 1], positions[i]};
  return std::nullopt;
}

std::vector<SumSkeleton::VertexOnEdge> SumSkeleton::contacts() const {
  std::vector<VertexOnEdge> found;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto [a, b, chain] = edges[e];
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    visit_positions_in_box(nearest[a], nearest[b], [&, a = a, b = b](std::uint32_t v) {
      if (v == position[a] || v == position[b] || orientation_filtered(nearest[a], nearest[b], nearest[v]) != 0) return;
      if (on_segment(spot(a), spot(b), spot(v))) found.push_back({e, v});
    });
    if (found.size() - static_cast<std::size_t>(first) < 2) continue;
    const bool forward = compare(a, b) < 0;
    std::sort(found.begin() + first, found.end(), [&](const VertexOnEdge& s, const VertexOnEdge& t) {
      const int sign = compare(s.vertex, t.vertex);
      return forward ? sign < 0 : sign > 0;
    });
  }
  return found;
}

namespace {

// The rings of a result as visits of positions, each with one sector of the set beside it.

/// The rings of a sum as chains of visits, of its vertices and of those that lie inside its edges: each visit has one
/// whole sector of the set on its left. Requires that the skeleton outlives this.
class RingVisits {
 public:
  struct Visit {
    std::uint32_t vertex = 0, edge = 0, chain = 0;  ///< of the skeleton; the edge that leaves, by its first vertex
    std::uint32_t next = 0, prev = 0;
  };

  explicit RingVisits(const SumSkeleton& skeleton);

  const std::vector<Visit>& visits() const { return visits_; }
  /// The visits of every position: those of one position, in the order of the rings.
  const std::map<std::uint32_t, std::vector<std::uint32_t>>& at() const { return at_; }

 private:
  void add(std::uint32_t e, std::uint32_t vertex);
  void join_sectors(std::uint32_t position, const std::vector<std::uint32_t>& here);

  const SumSkeleton& skeleton_;
  std::vector<Visit> visits_;
  std::uint32_t first_ = 0;                                 // visit of the ring
  std::map<std::uint32_t, std::vector<std::uint32_t>> at_;  // position -> visits
};

RingVisits::RingVisits(const SumSkeleton& skeleton) : skeleton_(skeleton) {
  std::vector<std::uint8_t> of_ring(skeleton.nearest.size(), 0);
  for (const SumSkeleton::Edge& e : skeleton.edges)
    if (skeleton.chains[e.chain].closed) of_ring[skeleton.position[e.from]] = 1;
  std::vector<SumSkeleton::VertexOnEdge> cuts;
  for (const SumSkeleton::VertexOnEdge& c : skeleton.contacts())
    if (of_ring[c.vertex] != 0) cuts.push_back(c);
  auto cut = cuts.begin();
  for (std::uint32_t e = 0; e < skeleton.edges.size(); ++e) {
    add(e, skeleton.edges[e].from);
    for (; cut != cuts.end() && cut->edge == e; ++cut) add(e, cut->vertex);
  }
  for (const auto& [position, here] : at_)
    if (here.size() > 1) join_sectors(position, here);
}

void RingVisits::add(std::uint32_t e, std::uint32_t vertex) {
  const SumSkeleton::Edge& edge = skeleton_.edges[e];
  const SumSkeleton::Chain& chain = skeleton_.chains[edge.chain];
  if (!chain.closed) return;
  const auto index = static_cast<std::uint32_t>(visits_.size());
  const bool starts = vertex == chain.first && edge.from == chain.first;
  if (starts) first_ = index;
  visits_.push_back({vertex, edge.from, edge.chain, first_, starts ? index : index - 1});
  if (!starts) visits_[index - 1].next = index;
  visits_[first_].prev = index;
  at_[skeleton_.position[vertex]].push_back(index);
}

// Counter-clockwise around a position, sectors of the set run from a ray that leaves to one that arrives.
void RingVisits::join_sectors(std::uint32_t position, const std::vector<std::uint32_t>& here) {
  struct Ray {
    std::uint32_t to, visit;  // the visit here that it leaves from, or the one before it
    bool leaves;
  };
  std::vector<Ray> rays;
  for (const std::uint32_t v : here) {
    rays.push_back({visits_[visits_[v].next].vertex, v, true});
    rays.push_back({visits_[visits_[v].prev].vertex, visits_[v].prev, false});
  }
  const Spot& z = skeleton_.spot(position);
  const auto half = [&](const Ray& r) {
    const Spot& to = skeleton_.spot(r.to);
    const int y = compare_y(to, z);
    return y > 0 || (y == 0 && compare_x(to, z) > 0) ? 0 : 1;
  };
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
    const int half_a = half(a), half_b = half(b);
    return half_a != half_b ? half_a < half_b : orientation(z, skeleton_.spot(a.to), skeleton_.spot(b.to)) > 0;
  });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (rays[i].leaves) continue;
    const std::uint32_t in = rays[i].visit, out = rays[(i + rays.size() - 1) % rays.size()].visit;
    visits_[in].next = out;
    visits_[out].prev = in;
  }
}

/// Visits in the order of a ring.
using Path = std::vector<std::uint32_t>;

/// Simple rings of visits: a ring that comes back to a position is cut there.
std::vector<Path> simple_paths(const SumSkeleton& skeleton, const std::vector<RingVisits::Visit>& visits) {
  std::vector<Path> paths;
  std::vector<std::uint8_t> seen(visits.size(), 0);
  for (std::uint32_t start = 0; start < visits.size(); ++start) {
    Path path;
    std::map<std::uint32_t, std::size_t> at;  // position -> length of the path before it
    for (std::uint32_t v = start; seen[v] == 0; v = visits[v].next) {
      seen[v] = 1;
      const std::uint32_t position = skeleton.position[visits[v].vertex];
      if (const auto back = at.find(position); back != at.end()) {
        const std::size_t before = back->second;
        paths.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(before), path.end());
        for (const std::uint32_t w : paths.back()) at.erase(skeleton.position[visits[w].vertex]);
        path.resize(before);
      }
      at[position] = path.size();
      path.push_back(v);
    }
    if (!path.empty()) paths.push_back(std::move(path));
  }
  return paths;
}

/// The vertices of a sum in the order of its skeleton.
std::vector<const SumVertex*> vertices_of(const PlanarSum& sum) {
  std::vector<const SumVertex*> vertices;
  for_each_vertex(sum, [&](const SumVertex& v) { vertices.push_back(&v); });
  return vertices;
}

/// Writes rings of visits as rings of a sum.
class RingWriter {
 public:
  RingWriter(const PlanarSum& sum, const SumSkeleton& skeleton, const RingVisits& rings)
      : skeleton_(skeleton), visits_(rings.visits()), vertices_(vertices_of(sum)) {
    // A position that is a sum of two vertices is that of every visit there.
    for (const auto& [position, here] : rings.at())
      for (const std::uint32_t v : here)
        if (vertices_[visits_[v].vertex]->corner_p != SumVertex::kNone)
          corner_[position] = vertices_[visits_[v].vertex];
  }

  SumRing ring(const Path& path) const {
    SumRing out;
    for (std::size_t k = 0; k < path.size(); ++k) {
      const std::uint32_t before = path[(k + path.size() - 1) % path.size()], after = path[(k + 1) % path.size()];
      const std::uint32_t here = visits_[path[k]].vertex;
      if (orientation(spot(before), spot(path[k]), spot(after)) == 0) continue;  // straight on
      SumVertex v = *vertices_[here];
      v.in = vertices_[visits_[before].edge]->out;
      v.out = vertices_[visits_[path[k]].edge]->out;
      const auto corner = corner_.find(skeleton_.position[here]);
      v.corner_p = corner == corner_.end() ? SumVertex::kNone : corner->second->corner_p;
      v.corner_q = corner == corner_.end() ? SumVertex::kNone : corner->second->corner_q;
      if (corner != corner_.end()) v.at = corner->second->at;
      out.vertices.push_back(v);
    }
    return out;
  }

  /// The corner at the lexicographically smallest position bends as the ring does.
  bool counter_clockwise(const Path& path) const {
    const auto before = [&](std::uint32_t a, std::uint32_t b) { return compare(spot(a), spot(b)) < 0; };
    const auto least = std::min_element(path.begin(), path.end(), before);
    const auto k = static_cast<std::size_t>(least - path.begin());
    return orientation(spot(path[(k + path.size() - 1) % path.size()]), spot(path[k]),
                       spot(path[(k + 1) % path.size()])) > 0;
  }

 private:
  const Spot& spot(std::uint32_t visit) const { return skeleton_.spot(visits_[visit].vertex); }

  const SumSkeleton& skeleton_;
  const std::vector<RingVisits::Visit>& visits_;
  std::vector<const SumVertex*> vertices_;
  std::map<std::uint32_t, const SumVertex*> corner_;  // by position
};

bool has_holes(const SumPart& part) { return !part.holes.empty(); }

}  // namespace

void separate_parts(PlanarSum& sum) {
  if (std::none_of(sum.parts.begin(), sum.parts.end(), has_holes)) return;
  const SumSkeleton skeleton(sum);
  const RingVisits rings(skeleton);
  const auto shared = [](const auto& here) { return here.second.size() > 1; };
  if (std::count_if(rings.at().begin(), rings.at().end(), shared) < 2) return;
  const RingWriter writer(sum, skeleton, rings);
  std::vector<SumRing> joined;
  std::vector<std::uint8_t> outer;
  for (const Path& path : simple_paths(skeleton, rings.visits())) {
    joined.push_back(writer.ring(path));
    outer.push_back(writer.counter_clockwise(path));
  }
  const ExactSource& source = *exact_source(sum);
  std::vector<SumPart> parts = group_rings(std::move(joined), outer, source, sum.at_error);
  canonicalize(parts, source, sum.at_error);
  sum.parts = std::move(parts);
}

namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;

/// Rings, segments and points one after the other, by vertices of the skeleton.
class RegionWriter {
 public:
  RegionWriter(const SumSkeleton& skeleton, const std::vector<HomogeneousPoint>& positions)
      : skeleton_(skeleton), positions_(positions) {}

  void add(std::vector<Point>& to, std::uint32_t vertex, std::uint32_t edge) {
    to.push_back(skeleton_.nearest[vertex]);
    out_.vertex_indices.push_back(vertex);
    out_.edge_indices.push_back(edge);
    fractions_.push_back(positions_[vertex]);
    doubles_ &= is_double(positions_[vertex], skeleton_.nearest[vertex]);
  }
  void add_rings() {
    const RingVisits rings(skeleton_);
    const auto& visits = rings.visits();
    out_.touching = true;
    std::vector<std::uint8_t> seen(visits.size(), 0);
    // The interior of a part is connected: one of its rings runs along the outer one, and the part begins with it.
    for (std::uint32_t v = 0; v < visits.size(); ++v) {
      if (seen[v] != 0) continue;
      const bool outer = skeleton_.chains[visits[v].chain].ring == 0;
      if (outer) out_.own.parts.emplace_back();
      Part& part = out_.own.parts.back();
      Ring& ring = outer ? part.outer : part.holes.emplace_back();
      for (std::uint32_t k = v; seen[k] == 0; k = visits[k].next) {
        seen[k] = 1;
        add(ring, visits[k].vertex, visits[k].edge);
      }
    }
  }
  EngineRegion write() {
    add_rings();
    for (const SumSkeleton::Chain& chain : skeleton_.chains) {
      if (chain.closed) continue;
      std::vector<Point>& to = chain.count == 1 ? out_.own.points : out_.own.polylines.emplace_back();
      for (std::uint32_t k = 0; k < chain.count; ++k) add(to, chain.first + k, chain.first + k);
    }
    if (!doubles_) out_.fractions = std::make_shared<const std::vector<HomogeneousPoint>>(std::move(fractions_));
    return std::move(out_);
  }

 private:
  const SumSkeleton& skeleton_;
  const std::vector<HomogeneousPoint>& positions_;
  EngineRegion out_;
  std::vector<HomogeneousPoint> fractions_;
  bool doubles_ = true;
};

}  // namespace

bool is_double(const HomogeneousPoint& position, Point nearest) {
  if (msb(position.w) != lsb(position.w) || !std::isfinite(nearest.x) || !std::isfinite(nearest.y)) return false;
  const HomogeneousPoint own = exact::homogeneous(nearest.x, nearest.y);
  return own.x * position.w == position.x * own.w && own.y * position.w == position.y * own.w;
}

std::vector<HomogeneousPoint> positions_of(const PlanarSum& sum) {
  std::vector<HomogeneousPoint> positions;
  for_each_vertex(
      sum, [&](const SumVertex& v) { positions.push_back(exact::in_lowest_terms(exact_source(sum)->homogeneous(v))); });
  return positions;
}

EngineRegion region_of_result(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  return RegionWriter(skeleton, positions_of(sum)).write();
}

}  // namespace dymsum::planar
