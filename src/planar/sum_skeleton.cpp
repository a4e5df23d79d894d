#include "planar/sum_skeleton.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace dymsum::planar {

namespace {

bool nearest_before(const Spot& a, const Spot& b) {
  return a.nearest.x < b.nearest.x || (a.nearest.x == b.nearest.x && a.nearest.y < b.nearest.y);
}

}  // namespace

SumSkeleton::SumSkeleton(const PlanarSum& sum) {
  if (sum.parts.empty() && sum.segments.empty() && sum.points.empty()) return;
  if (!sum.source) throw std::logic_error("PlanarSum: vertices without a source of exact positions");
  const ExactSource& source = *sum.source;
  for (std::size_t i = 0; i < sum.parts.size(); ++i) {
    const auto part = static_cast<std::int64_t>(i);
    std::int64_t ring = 0;
    add_ring(sum.parts[i].outer, source, part, ring);
    for (const SumRing& hole : sum.parts[i].holes) add_ring(hole, source, part, ++ring);
  }
  const auto next = [&] { return static_cast<std::uint32_t>(vertices.size()); };
  for (const SumSegment& s : sum.segments) {
    const Chain chain{next(), 2, false, {}, {}};
    vertices.push_back(make_spot(source.position(s.from)));
    vertices.push_back(make_spot(source.position(s.to)));
    add_chain(chain);
  }
  for (const SumVertex& v : sum.points) {
    const Chain chain{next(), 1, false, {}, {}};
    vertices.push_back(make_spot(source.position(v)));
    add_chain(chain);
  }
  find_places();
}

void SumSkeleton::add_ring(const SumRing& ring, const ExactSource& source, std::int64_t part, std::int64_t number) {
  const Chain chain{static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(ring.vertices.size()), true,
                    part, number};
  for (const SumVertex& v : ring.vertices) vertices.push_back(make_spot(source.position(v)));
  add_chain(chain);
}

void SumSkeleton::add_chain(Chain chain) {
  const auto number = static_cast<std::uint32_t>(chains.size());
  for (std::uint32_t k = 0; k + 1 < chain.count; ++k) edges.push_back({chain.first + k, chain.first + k + 1, number});
  if (chain.closed) edges.push_back({chain.first + chain.count - 1, chain.first, number});
  chains.push_back(chain);
}

void SumSkeleton::find_places() {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (nearest_before(vertices[a], vertices[b])) return true;
    if (nearest_before(vertices[b], vertices[a])) return false;
    const int sign = compare(vertices[a].exact, vertices[b].exact);
    return sign != 0 ? sign < 0 : a < b;
  });
  place.resize(vertices.size());
  for (const std::uint32_t v : order) {
    const bool known = !places.empty() && !nearest_before(vertices[places.back()], vertices[v]) &&
                       compare(vertices[places.back()].exact, vertices[v].exact) == 0;
    if (!known) places.push_back(v);
    place[v] = places.back();
  }
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> SumSkeleton::first_collision() const {
  for (std::size_t i = 1; i < places.size(); ++i)
    if (vertices[places[i - 1]].nearest == vertices[places[i]].nearest) return std::pair{places[i - 1], places[i]};
  return std::nullopt;
}

std::vector<SumSkeleton::VertexOnEdge> SumSkeleton::contacts() const {
  std::vector<VertexOnEdge> found;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    const Spot& a = vertices[edge.from];
    const Spot& b = vertices[edge.to];
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    visit_places_in_box(a.nearest, b.nearest, [&](std::uint32_t v) {
      if (v != place[edge.from] && v != place[edge.to] && on_segment(a, b, vertices[v])) found.push_back({e, v});
    });
    const bool forward = compare(a, b) < 0;
    std::sort(found.begin() + first, found.end(), [&](const VertexOnEdge& s, const VertexOnEdge& t) {
      const int sign = compare(vertices[s.vertex], vertices[t.vertex]);
      return forward ? sign < 0 : sign > 0;
    });
  }
  return found;
}

}  // namespace dymsum::planar
