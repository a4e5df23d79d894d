// What can be said of the mesh of an obstacle without the obstacle.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dymsum/obstacle_mesh.h"

namespace dymsum {
namespace {

/// An edge from its smaller to its larger vertex, and which way a triangle runs along it.
struct Use {
  std::uint64_t edge = 0;
  bool forward = false;
  friend auto operator<=>(const Use&, const Use&) = default;
};

std::vector<Use> uses_of(const ObstacleMesh& mesh) {
  std::vector<std::uint32_t> same(mesh.vertices.size());
  std::iota(same.begin(), same.end(), 0u);
  for (const auto& [bottom, top] : mesh.seam) same[bottom] = top;
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (const ObstacleTriangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = same[t.vertices[k]], b = same[t.vertices[(k + 1) % 3]];
      uses.push_back({(std::min(a, b) << 32) | std::max(a, b), a < b});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace

MeshClosure closure(const ObstacleMesh& mesh) {
  MeshClosure found;
  const std::vector<Use> uses = uses_of(mesh);
  for (std::size_t k = 0; k < uses.size();) {
    std::uint64_t forward = 0, backward = 0;
    const std::uint64_t edge = uses[k].edge;
    for (; k < uses.size() && uses[k].edge == edge; ++k) ++(uses[k].forward ? forward : backward);
    ++found.edges;
    found.open += forward != backward ? 1 : 0;
    found.crowded += forward == backward && forward > 1 ? 1 : 0;
  }
  for (const ObstacleTriangle& t : mesh.triangles) {
    if (!t.closing) continue;
    const Configuration &a = mesh.vertices[t.vertices[0]], &b = mesh.vertices[t.vertices[1]],
                        &c = mesh.vertices[t.vertices[2]];
    found.closing_area += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  return found;
}

/// The flow of (x, 0, 0) through the triangles; nothing flows through the end planes.
double enclosed_volume(const ObstacleMesh& mesh) {
  double volume = 0;
  for (const ObstacleTriangle& t : mesh.triangles) {
    const Configuration &a = mesh.vertices[t.vertices[0]], &b = mesh.vertices[t.vertices[1]],
                        &c = mesh.vertices[t.vertices[2]];
    const double normal_x = (b.y - a.y) * (c.theta - a.theta) - (b.theta - a.theta) * (c.y - a.y);
    volume += (a.x + b.x + c.x) / 6 * normal_x;
  }
  return volume;
}

MeshData mesh_data(const ObstacleMesh& mesh) {
  MeshData data;
  const double scale = mesh.extent / (2 * std::numbers::pi);
  for (const Configuration& v : mesh.vertices) data.vertices.push_back({v.x, v.y, v.theta * scale});
  for (const ObstacleTriangle& t : mesh.triangles) data.faces.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
  return data;
}

}  // namespace dymsum
