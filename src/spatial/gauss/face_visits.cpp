#include "spatial/gauss/face_visits.h"

namespace dymsum::spatial {
namespace {

/// The number of a face's edges from which on the next faces round it are climbed for from one another.
constexpr std::uint32_t kManyEdges = 8;

}  // namespace

FaceVisits::FaceVisits(const Polytope& solid) {
  std::vector<std::uint8_t> seen(solid.face_count(), 0);
  seen[0] = 1;
  all.push_back({0, 0, 0, 0});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t f = all[i].face;
    HalfEdge h = solid.first[f];
    std::uint32_t near = f, edges = 0;
    do {
      const std::uint32_t g = solid.face[twin(h)];
      if (!seen[g]) all.push_back({g, f, h, near});
      seen[g] = 1;
      if (++edges >= kManyEdges) near = g;
      h = solid.next[h];
    } while (h != solid.first[f]);
  }
}

ArcPlan::ArcPlan(const Polytope& solid, const FaceVisits& visits) {
  std::vector<bool> visited(solid.edge_count(), false);
  std::vector<std::uint32_t> level(visits.all.size(), 0);
  levels.push_back(0);
  for (std::uint32_t i = 1; i < visits.all.size(); ++i) {
    const FaceVisits::Visit& visit = visits.all[i];
    visited[visit.via / 2] = true;
    level[visit.face] = level[visit.from] + 1;
    if (level[visit.face] == levels.size()) levels.push_back(i);
  }
  levels.push_back(static_cast<std::uint32_t>(visits.all.size()));
  for (std::uint32_t e = 0; e < visited.size(); ++e)
    if (!visited[e]) chords.push_back(e);
}

}  // namespace dymsum::spatial
