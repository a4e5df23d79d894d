#include "spatial/sum/surface_topology.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/scratch.h"

namespace dymsum::spatial {

SurfaceTopology topology_of(const MeshData& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.faces.size());
  UnionFind pieces(static_cast<std::uint32_t>(mesh.vertices.size()));
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
      edges.emplace_back(std::min(a, b), std::max(a, b));
      pieces.unite(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  SurfaceTopology found;
  for (std::uint32_t v = 0; v < pieces.size(); ++v) found.pieces += pieces.root(v) == v;
  found.euler = static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(edges.size()) +
                static_cast<std::int64_t>(mesh.faces.size());
  return found;
}

}  // namespace dymsum::spatial
