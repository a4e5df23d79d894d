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

std::size_t turn_faces(MeshData& data) {
  const std::vector<bool> turned = disagreeing_faces(data.faces);
  for (std::size_t f = 0; f < turned.size(); ++f)
    if (turned[f]) turn_over(data.faces[f]);
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
}

TurnedShells turn_shells(MeshData& data) {
  HalfEdges edges = half_edges_without_twins(data.faces);
  if (!is_closed(edges, data)) return {};
  const Shells shells = find_shells(edges);
  const std::vector<int> signs = shell_signs(data, shells);
  const std::vector<std::vector<std::uint32_t>> around = shells_around(data, shells);
  TurnedShells turned;
  std::vector<bool> wrong(shells.count);
  for (std::uint32_t s = 0; s < shells.count; ++s) {
    const bool cavity = around[s].size() % 2 == 1;
    wrong[s] = signs[s] == (cavity ? 1 : -1);
    turned.count += wrong[s];
    for (const std::uint32_t next : around[s])  // the innermost one of them
      turned.cavities += cavity && around[next].size() + 1 == around[s].size() && signs[next] == signs[s];
  }
  for (std::size_t f = 0; f < data.faces.size(); ++f)
    if (wrong[shells.of_face[f]]) turn_over(data.faces[f]);
  return turned;
}

}  // namespace dymsum::spatial
