#include "planar/position/ring_slabs.h"

#include <algorithm>
#include <bit>

namespace dymsum::planar {

RingSlabs::RingSlabs(std::span<const std::vector<NearSpot>> rings) {
  for (const std::vector<NearSpot>& ring : rings) levels_.insert(levels_.end(), ring.begin(), ring.end());
  std::sort(levels_.begin(), levels_.end(), [](const NearSpot& a, const NearSpot& b) { return compare_y(a, b) < 0; });
  const auto same = [](const NearSpot& a, const NearSpot& b) { return compare_y(a, b) == 0; };
  levels_.erase(std::unique(levels_.begin(), levels_.end(), same), levels_.end());
  if (levels_.size() > 1) leaves_ = std::bit_ceil(static_cast<std::uint32_t>(levels_.size() - 1));
  take_edges(rings);
  fill_nodes();
}

/// The first level that is not below v.
std::uint32_t RingSlabs::level_of(const NearSpot& v) const {
  const auto below = [](const NearSpot& level, const NearSpot& at) { return compare_y(level, at) < 0; };
  return static_cast<std::uint32_t>(std::lower_bound(levels_.begin(), levels_.end(), v, below) - levels_.begin());
}

void RingSlabs::take_edges(std::span<const std::vector<NearSpot>> rings) {
  for (const std::vector<NearSpot>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const NearSpot &a = ring[k], &b = ring[k + 1 == ring.size() ? 0 : k + 1];
      const std::uint32_t from = level_of(a), to = level_of(b);
      if (from == to) {
        const bool forward = compare_x(a, b) < 0;
        flats_.push_back({forward ? a : b, forward ? b : a, from});
      } else {
        edges_.push_back(from < to ? Edge{a, b, from, to} : Edge{b, a, to, from});
      }
    }
  std::sort(flats_.begin(), flats_.end(), [](const Flat& a, const Flat& b) {
    return a.level != b.level ? a.level < b.level : compare_x(a.left, b.left) < 0;
  });
}

/// The nodes whose slabs together are the edge's height, none above another one.
template <class Visit>
void RingSlabs::for_each_node(const Edge& edge, Visit&& visit) const {
  for (std::uint32_t l = edge.from + leaves_, r = edge.to + leaves_; l < r; l /= 2, r /= 2) {
    if (l % 2 == 1) visit(l++);
    if (r % 2 == 1) visit(--r);
  }
}

void RingSlabs::fill_nodes() {
  starts_.assign(2 * std::size_t{leaves_} + 1, 0);
  for (const Edge& edge : edges_) for_each_node(edge, [&](std::uint32_t node) { ++starts_[node + 1]; });
  for (std::size_t node = 1; node < starts_.size(); ++node) starts_[node] += starts_[node - 1];
  members_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for_each_node(edges_[e], [&](std::uint32_t node) { members_[next[node]++] = e; });
  const auto left = [this](std::uint32_t a, std::uint32_t b) { return a != b && left_of(edges_[a], edges_[b]); };
  for (std::size_t node = 0; node + 1 < starts_.size(); ++node)
    std::sort(members_.begin() + starts_[node], members_.begin() + starts_[node + 1], left);
}

// Whether the first of two edges is left of the other, given that they do not meet between the heights that they share.
// Where the upper one of the lower ends lies on the other edge, the lower one of the upper ends does not.
bool RingSlabs::left_of(const Edge& a, const Edge& b) {
  const int low = a.from >= b.from ? orientation(b.low, b.high, a.low) : -orientation(a.low, a.high, b.low);
  if (low != 0) return low > 0;
  return (a.to <= b.to ? orientation(b.low, b.high, a.high) : -orientation(a.low, a.high, b.high)) > 0;
}

/// The edges to the left of z decide. Requires that z lies in the closed slab; where that is on one of its ends, the
/// answer is that of the points of the slab next to z, unless an edge of the slab passes z.
Location RingSlabs::in_slab(std::uint32_t slab, const NearSpot& z) const {
  std::uint32_t left = 0;
  for (std::uint32_t node = leaves_ + slab; node > 0; node /= 2) {
    std::uint32_t first = starts_[node], last = starts_[node + 1];
    left -= first;
    while (first < last) {
      const std::uint32_t midpoint = first + (last - first) / 2;
      const Edge& edge = edges_[members_[midpoint]];
      const int side = orientation(edge.low, edge.high, z);
      if (side == 0) return Location::boundary;
      if (side < 0) {
        first = midpoint + 1;
      } else {
        last = midpoint;
      }
    }
    left += first;
  }
  return left % 2 == 1 ? Location::inside : Location::outside;
}

bool RingSlabs::on_flat(std::uint32_t level, const NearSpot& z) const {
  const auto after = std::partition_point(flats_.begin(), flats_.end(), [&](const Flat& flat) {
    return flat.level < level || (flat.level == level && compare_x(flat.left, z) <= 0);
  });
  return after != flats_.begin() && (after - 1)->level == level && compare_x((after - 1)->right, z) >= 0;
}

Location RingSlabs::locate(const NearSpot& z) const {
  const std::uint32_t level = level_of(z);
  if (level == levels_.size()) return Location::outside;
  const bool at_level = compare_y(levels_[level], z) == 0;
  if (!at_level) return level == 0 ? Location::outside : in_slab(level - 1, z);
  if (on_flat(level, z)) return Location::boundary;
  if (level > 0 && in_slab(level - 1, z) == Location::boundary) return Location::boundary;
  return level + 1 < levels_.size() ? in_slab(level, z) : Location::outside;
}

}  // namespace dymsum::planar
