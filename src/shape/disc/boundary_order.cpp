#include "shape/disc/boundary_order.h"

namespace dymsum::shape {

namespace {

/// Half-edges: 2 e walks edge e upwards, 2 e + 1 downwards. The site lies on the left of either.
std::uint32_t site_of(const Complex& complex, std::uint32_t half) {
  const Edge& edge = complex.edges[half / 2];
  return half % 2 == 0 ? edge.left : edge.right;
}

/// The next half-edge with the same face on its left: the spoke after this one clockwise about its end.
std::vector<std::uint32_t> followers(const Complex& complex) {
  std::vector<std::uint32_t> next(2 * complex.edges.size(), kNoIndex);
  for (std::uint32_t node = 0; node < complex.nodes.size(); ++node) {
    const std::uint32_t first = complex.first_spoke[node], last = complex.first_spoke[node + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const Spoke& in = complex.spokes[i];
      const Spoke& out = complex.spokes[i == first ? last - 1 : i - 1];
      next[2 * in.edge + (in.up ? 1 : 0)] = 2 * out.edge + (out.up ? 0 : 1);
    }
  }
  return next;
}

/// Appends the half-edges of a site in the order of its positions. Rays to infinity part them into two runs at most,
/// the second of which comes from there.
void append_site(const Complex& complex, const std::vector<std::uint32_t>& halves,
                 const std::vector<std::uint32_t>& next, std::vector<std::uint8_t>& has_previous,
                 BoundaryOrder& order) {
  const auto append_run = [&](std::uint32_t half) {
    for (const std::uint32_t begin = half;;) {
      order.item_of[half / 2][half % 2] = static_cast<std::uint32_t>(order.items.size());
      order.items.push_back({half / 2, site_of(complex, half), half % 2 == 0});
      const std::uint32_t follower = next[half];
      if (follower == kNoIndex || follower == begin || site_of(complex, follower) != site_of(complex, half)) return;
      half = follower;
    }
  };
  std::vector<std::uint32_t> from_position, from_infinity;
  for (const std::uint32_t half : halves) {
    if (has_previous[half]) continue;
    const bool infinite = half % 2 == 1 && complex.edges[half / 2].high == kNoIndex;
    (infinite ? from_infinity : from_position).push_back(half);
  }
  // A point all around which there is something has no first position.
  if (from_position.empty() && from_infinity.empty() && !halves.empty()) from_position.push_back(halves.front());
  for (const std::uint32_t half : from_position) append_run(half);
  for (const std::uint32_t half : from_infinity) append_run(half);
}

}  // namespace

BoundaryOrder boundary_order(const Complex& complex) {
  BoundaryOrder order;
  const std::vector<std::uint32_t> next = followers(complex);
  std::vector<std::uint8_t> has_previous(next.size(), 0);
  std::vector<std::vector<std::uint32_t>> halves(complex.sites.size());
  for (std::uint32_t half = 0; half < next.size(); ++half) {
    halves[site_of(complex, half)].push_back(half);
    if (next[half] != kNoIndex && site_of(complex, next[half]) == site_of(complex, half)) has_previous[next[half]] = 1;
  }
  order.item_of.resize(complex.edges.size());
  for (std::uint32_t site = 0; site < complex.sites.size(); ++site) {
    if (site == 0 || complex.sites[site].loop != complex.sites[site - 1].loop) {
      order.first_site.push_back(site);
      order.first_item.push_back(static_cast<std::uint32_t>(order.items.size()));
    }
    append_site(complex, halves[site], next, has_previous, order);
  }
  order.first_site.push_back(static_cast<std::uint32_t>(complex.sites.size()));
  order.first_item.push_back(static_cast<std::uint32_t>(order.items.size()));
  return order;
}

}  // namespace dymsum::shape
