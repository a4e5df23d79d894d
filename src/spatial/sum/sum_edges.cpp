#include "spatial/sum/sum_edges.h"

#include <algorithm>
#include <numeric>

namespace dymsum::spatial {

void start_at_smallest(std::vector<std::uint32_t>& loop) {
  const std::size_t n = loop.size();
  std::size_t best = 0;
  for (std::size_t at = 1; at < n; ++at) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t x = loop[(at + k) % n], y = loop[(best + k) % n];
      if (x == y) continue;
      if (x < y) best = at;
      break;
    }
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best), loop.end());
}

}  // namespace dymsum::spatial

namespace dymsum {

namespace spatial {
namespace {

SolidFeature spanned(const SolidFeature& a, const SolidFeature& b) {
  if (a == b) return a;
  return {SolidFeature::Kind::edge, std::min(a.a, b.a), std::max(a.a, b.a)};
}

/// The contact along an edge of a convex sum, between vertices at which vertices touch, one edge touches a vertex, or
/// two parallel edges touch.
SolidContact between(const SolidContact& a, const SolidContact& b) { return {spanned(a.p, b.p), spanned(a.q, b.q)}; }

/// Calls f(a, b, face) for all sides of faces, from a vertex to a larger one.
template <class F>
void for_each_side(const std::vector<SpatialFace>& faces, F f) {
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    for (const std::vector<std::uint32_t>& loop : faces[face].loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto [a, b] = std::minmax(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]);
        f(a, b, face);
      }
    }
  }
}

}  // namespace

std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces) {
  struct Side {
    std::uint32_t to, face;
    auto operator<=>(const Side&) const = default;
  };
  // Edges are listed by their smaller ends, then at each of these.
  std::vector<std::uint32_t> begin(1, 0);
  for_each_side(faces, [&](std::uint32_t a, std::uint32_t, std::uint32_t) {
    if (begin.size() < a + std::size_t{2}) begin.resize(a + std::size_t{2}, 0);
    ++begin[a + std::size_t{1}];
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Side> sides(begin.back());
  std::vector<std::uint32_t> position(begin.begin(), begin.end() - 1);
  for_each_side(faces, [&](std::uint32_t a, std::uint32_t b, std::uint32_t face) { sides[position[a]++] = {b, face}; });
  std::vector<SpatialEdge> edges;
  edges.reserve(sides.size() / 2);
  for (std::uint32_t a = 0; a + 1 < begin.size(); ++a) {
    const auto first = sides.begin() + begin[a], last = sides.begin() + begin[a + 1];
    std::sort(first, last);
    for (auto side = first; side != last; ++side) {
      if (side == first || side->to != edges.back().to) {
        edges.push_back({a, side->to, {}, std::nullopt});
        edges.back().faces.reserve(2);
      }
      if (edges.back().faces.empty() || edges.back().faces.back() != side->face)
        edges.back().faces.push_back(side->face);
    }
  }
  return edges;
}

}  // namespace spatial

std::vector<SpatialEdge> SpatialSum::edges() const {
  std::vector<SpatialEdge> edges = spatial::edges_of(faces);
  if (is_convex()) {
    for (SpatialEdge& edge : edges)
      edge.contact = spatial::between(*vertex_contacts[edge.from], *vertex_contacts[edge.to]);
  } else {
    for (std::size_t k = 0; k < edges.size(); ++k) edges[k].contact = edge_contacts_[k];
  }
  return edges;
}

}  // namespace dymsum
