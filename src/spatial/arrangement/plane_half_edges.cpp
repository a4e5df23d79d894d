#include "spatial/arrangement/plane_half_edges.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>

namespace dymsum::spatial {

void PlaneHalfEdges::run(const std::vector<CellEdge>& edges) {
  edges_ = &edges;
  index_points();
  begin_.assign(point_.size() + 1, 0);
  for (const std::uint32_t v : vertex_) ++begin_[v + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  out_.resize(count()), next_.resize(count());
  position_.assign(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t h = 0; h < count(); ++h) out_[position_[vertex_[h]]++] = h;
  for (std::size_t v = 0; v < point_.size(); ++v) {
    const std::uint32_t first = begin_[v], last = begin_[v + 1];
    if (last - first > 2) sort_around(first, last);
    // The next half-edge runs along the face to the left: clockwise around the end.
    for (std::uint32_t k = first; k < last; ++k) next_[out_[k] ^ 1] = out_[k == first ? last - 1 : k - 1];
  }
}

std::uint32_t PlaneHalfEdges::last_around(std::uint32_t point) const {
  const std::uint32_t first = begin_[point], last = begin_[point + 1];
  for (std::uint32_t k = first; k < last; ++k)
    if (last - first == 1 || turn(out_[k], out_[k + 1 < last ? k + 1 : first]) < 0) return out_[k];
  // Two half-edges leave in opposite directions at no lowest point.
  throw std::logic_error("plane_half_edges: no outer side at a lowest point");
}

int PlaneHalfEdges::turn(std::uint32_t g, std::uint32_t h) const {
  const PlaneId a = edge(g).cut, b = edge(h).cut;
  return a == b ? 0 : direction(g) * direction(h) * points_.space().det(points_.plane(), a, b);
}

void PlaneHalfEdges::index_points() {
  const std::size_t slots = std::bit_ceil(2 * std::size_t{count()} + 1);
  slot_.assign(slots, kNoId);
  point_.clear(), vertex_.resize(count());
  for (std::uint32_t h = 0; h < count(); ++h) {
    const PointId p = from(h);
    std::size_t at = (p * 0x9e3779b1u) & (slots - 1);
    while (slot_[at] != kNoId && point_[slot_[at]] != p) at = (at + 1) & (slots - 1);
    if (slot_[at] == kNoId) {
      slot_[at] = static_cast<std::uint32_t>(point_.size());
      point_.push_back(p);
    }
    vertex_[h] = slot_[at];
  }
}

void PlaneHalfEdges::sort_around(std::uint32_t first, std::uint32_t last) {
  const std::uint32_t reference = out_[first];
  // 0 along the reference, 1 less than half a turn from it, 2 opposite, 3 beyond.
  sectors_.clear();
  for (std::uint32_t k = first; k < last; ++k) {
    const int t = k == first ? 0 : turn(reference, out_[k]);
    sectors_.push_back({k == first ? 0 : t > 0 ? 1 : t < 0 ? 3 : 2, out_[k]});
  }
  std::sort(sectors_.begin(), sectors_.end(), [&](const Sector& g, const Sector& h) {
    if (g.sector != h.sector || g.sector == 0 || g.sector == 2) return g.sector < h.sector;
    return turn(g.half_edge, h.half_edge) > 0;
  });
  for (std::uint32_t k = first; k < last; ++k) out_[k] = sectors_[k - first].half_edge;
}

}  // namespace dymsum::spatial
