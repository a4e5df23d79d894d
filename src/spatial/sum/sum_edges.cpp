#include "spatial/sum/sum_edges.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "base/parallel_sort.h"

namespace dymsum::spatial {

std::vector<SpatialEdge> edges_of(const std::vector<SpatialFace>& faces, int threads) {
  std::vector<std::array<std::uint32_t, 3>> sides;  // from, to, face
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (const std::vector<std::uint32_t>& loop : faces[f].loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto [a, b] = std::minmax(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]);
        sides.push_back({a, b, f});
      }
    }
  }
  base::parallel_sort(sides, threads, std::less<>());
  std::vector<SpatialEdge> edges;
  edges.reserve(sides.size() / 2);
  for (const auto& [a, b, f] : sides) {
    if (edges.empty() || edges.back().from != a || edges.back().to != b) edges.push_back({a, b, {}, std::nullopt});
    if (edges.back().faces.empty() || edges.back().faces.back() != f) edges.back().faces.push_back(f);
  }
  return edges;
}

}  // namespace dymsum::spatial
