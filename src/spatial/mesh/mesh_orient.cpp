#include "spatial/mesh/mesh_orient.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/face_plane.h"
#include "spatial/mesh/shell_nesting.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {
namespace {

void turn_over(Face& face) { std::reverse(face.begin() + 1, face.end()); }

/// A face and the one across an edge; `agree` when they run through it in opposite directions.
struct Neighbour {
  std::uint32_t face;
  bool agree;
};

std::vector<std::vector<Neighbour>> neighbours(const std::vector<Face>& faces) {
  std::vector<std::vector<Neighbour>> found(faces.size());
  const HalfEdges edges = half_edges_without_twins(faces);
  const std::vector<EdgeSide> sides = edge_sides(edges);
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first != 2) return;
    const std::uint32_t g = first[0].half_edge, h = first[1].half_edge;
    const bool agree = edges.origin[g] != edges.origin[h];
    found[edges.face[g]].push_back({edges.face[h], agree});
    found[edges.face[h]].push_back({edges.face[g], agree});
  });
  return found;
}

std::vector<bool> disagreeing_faces(const std::vector<Face>& faces) {
  const std::vector<std::vector<Neighbour>> beside = neighbours(faces);
  std::vector<bool> turned(beside.size()), reached(beside.size());
  for (std::uint32_t start = 0; start < beside.size(); ++start) {
    if (reached[start]) continue;
    reached[start] = true;
    std::vector<std::uint32_t> shell{start};
    for (std::size_t i = 0; i < shell.size(); ++i) {
      for (const Neighbour& n : beside[shell[i]]) {
        if (reached[n.face]) continue;
        reached[n.face] = true;
        turned[n.face] = turned[shell[i]] == n.agree;
        shell.push_back(n.face);
      }
    }
    const auto count = std::count_if(shell.begin(), shell.end(), [&](std::uint32_t f) { return turned[f]; });
    if (2 * static_cast<std::size_t>(count) <= shell.size()) continue;
    for (const std::uint32_t f : shell) turned[f] = !turned[f];
  }
  return turned;
}

/// Joins all edges; false where the surface is not closed, or not valid for other reasons.
bool is_closed(HalfEdges& edges, const MeshData& data) {
  const std::vector<EdgeSide> sides = edge_sides(edges);
  bool even = true, several = false;
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    const auto along = std::count_if(
        first, last, [&](const EdgeSide& s) { return edges.origin[s.half_edge] == edges.origin[first->half_edge]; });
    even &= 2 * along == last - first;
    several |= last - first > 2;
  });
  return even && (!several || all_faces_valid(data)) && !join_around(edges, sides, data);
}

/// None where a face is not valid by itself, so that Mesh::create refuses it.
std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells) {
  if (shells.count < 2 || !all_faces_valid(data)) return std::vector<std::vector<std::uint32_t>>(shells.count);
  const Triangles triangles = triangulated(data);
  return shells_around(data, shells, triangles, boxes_of(data.vertices, triangles.triangles));
}

}  // namespace

bool all_faces_valid(const MeshData& data) {
  return std::all_of(data.faces.begin(), data.faces.end(), [&](const Face& face) {
    Face sorted = face;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() && !face_error(data.vertices, face);
  });
}

std::vector<std::uint32_t> turn_faces(MeshData& data) {
  const std::vector<bool> turned = disagreeing_faces(data.faces);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < turned.size(); ++f) {
    if (!turned[f]) continue;
    turn_over(data.faces[f]);
    faces.push_back(f);
  }
  return faces;
}

namespace {

/// What every shell is to become.
struct ShellFates {
  std::vector<bool> turned, cavity, dropped;
};

/// Inward exactly where an odd number of others lie around.
ShellFates as_cavities(const std::vector<int>& signs, const std::vector<std::vector<std::uint32_t>>& around,
                       const ShellRepairs& repairs) {
  ShellFates fates{std::vector<bool>(signs.size()), std::vector<bool>(signs.size()), std::vector<bool>(signs.size())};
  for (std::size_t s = 0; s < signs.size(); ++s) {
    const bool inner = around[s].size() % 2 == 1, wrong = signs[s] == (inner ? 1 : -1);
    for (const std::uint32_t next : around[s])  // the innermost one of them
      if (inner && around[next].size() + 1 == around[s].size() && signs[next] == signs[s]) fates.cavity[s] = true;
    fates.turned[s] = wrong && (fates.cavity[s] ? repairs.nested.has_value() : repairs.reverse);
    fates.cavity[s] = fates.cavity[s] && repairs.nested;
  }
  return fates;
}

/// The fates of shells by the winding number on both sides of every shell.
ShellFates as_bodies(std::vector<int> signs, const std::vector<std::vector<std::uint32_t>>& around,
                     const ShellRepairs& repairs) {
  ShellFates fates{std::vector<bool>(signs.size()), std::vector<bool>(signs.size()), std::vector<bool>(signs.size())};
  for (std::size_t s = 0; s < signs.size(); ++s) {
    if (!around[s].empty() || signs[s] > 0 || !repairs.reverse) continue;
    fates.turned[s] = true;
    signs[s] = 1;
  }
  for (std::size_t s = 0; s < signs.size(); ++s) {
    int outside = 0;
    for (const std::uint32_t t : around[s]) outside += signs[t];
    const int inside = outside + signs[s];
    fates.dropped[s] = (outside != 0) == (inside != 0);
    if (!fates.dropped[s] && (inside != 0) != (signs[s] > 0)) fates.turned[s] = repairs.reverse;
  }
  return fates;
}

}  // namespace

TurnedShells turn_shells(MeshData& data, const ShellRepairs& repairs) {
  HalfEdges edges = half_edges_without_twins(data.faces);
  if (!is_closed(edges, data)) return {};
  const Shells shells = find_shells(edges);
  const std::vector<int> signs = shell_signs(data, shells);
  const bool bodies = repairs.nested == NestedShells::solid;
  const std::vector<std::vector<std::uint32_t>> around = shells_around(data, shells);
  const ShellFates fates = bodies ? as_bodies(signs, around, repairs) : as_cavities(signs, around, repairs);
  TurnedShells result;
  if (std::find(fates.dropped.begin(), fates.dropped.end(), true) != fates.dropped.end())
    result.dropped.resize(data.faces.size());
  std::vector<bool> seen(shells.count);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    const std::uint32_t s = shells.of_face[f];
    const bool first = !seen[s];
    seen[s] = true;
    if (fates.turned[s]) turn_over(data.faces[f]);
    if (first && fates.turned[s]) result.turned.push_back(f);
    if (first && fates.cavity[s]) result.cavities.push_back(f);
    if (first && fates.dropped[s]) result.bodies.push_back(f);
    if (fates.dropped[s]) result.dropped[f] = true;
  }
  return result;
}

}  // namespace dymsum::spatial
