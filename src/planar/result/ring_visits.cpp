#include "planar/result/ring_visits.h"

#include <algorithm>

namespace dymsum::planar {

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

}  // namespace dymsum::planar
