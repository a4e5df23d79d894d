#include "planar/result/result_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "exact/grid.h"
#include "planar/result/sum_skeleton.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;

/// The rings of a sum as chains of visits, of its vertices and of those that lie inside its edges: each visit has one
/// whole sector of the set on its left.
class RingVisits {
 public:
  struct Visit {
    std::uint32_t vertex = 0, edge = 0, chain = 0;  // of the skeleton; the edge that leaves, by its first vertex
    std::uint32_t next = 0, prev = 0;
  };

  explicit RingVisits(const SumSkeleton& skeleton) : skeleton_(skeleton) {
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

  const std::vector<Visit>& visits() const { return visits_; }

 private:
  void add(std::uint32_t e, std::uint32_t vertex) {
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
  void join_sectors(std::uint32_t position, const std::vector<std::uint32_t>& here) {
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

  const SumSkeleton& skeleton_;
  std::vector<Visit> visits_;
  std::uint32_t first_ = 0;                                 // visit of the ring
  std::map<std::uint32_t, std::vector<std::uint32_t>> at_;  // position -> visits
};

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
  const auto add = [&](const SumVertex& v) {
    positions.push_back(exact::in_lowest_terms(exact_source(sum)->homogeneous(v)));
  };
  const auto add_ring = [&](const SumRing& ring) { std::for_each(ring.vertices.begin(), ring.vertices.end(), add); };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add_ring);
  }
  for (const SumSegment& s : sum.segments) {
    add(s.from);
    add(s.to);
  }
  std::for_each(sum.points.begin(), sum.points.end(), add);
  return positions;
}

EngineRegion region_of_result(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  return RegionWriter(skeleton, positions_of(sum)).write();
}

}  // namespace dymsum::planar
