#include "planar/result/sum_skeleton.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "planar/position/exact_source.h"

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

}  // namespace dymsum::planar
