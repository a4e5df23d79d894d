#include "spatial/mesh/half_edges.h"

#include <algorithm>
#include <stdexcept>

namespace dymsum::spatial {

HalfEdges half_edges_without_twins(const std::vector<Face>& faces) {
  std::size_t count = 0;
  for (const Face& face : faces) count += face.size();
  if (count >= HalfEdges::kNone) throw std::length_error("a mesh of 2^32 half-edges");
  HalfEdges edges;
  edges.face_begin.reserve(faces.size() + 1);
  for (std::vector<std::uint32_t>* list : {&edges.origin, &edges.face, &edges.next}) list->reserve(count);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto begin = static_cast<std::uint32_t>(edges.size());
    edges.face_begin.push_back(begin);
    for (const std::uint32_t v : faces[f]) {
      edges.origin.push_back(v);
      edges.face.push_back(f);
      edges.next.push_back(static_cast<std::uint32_t>(edges.size()));
    }
    if (edges.size() > begin) edges.next.back() = begin;
  }
  edges.face_begin.push_back(static_cast<std::uint32_t>(count));
  edges.twin.assign(count, HalfEdges::kNone);
  return edges;
}

std::vector<EdgeSide> edge_sides(const HalfEdges& edges) {
  std::vector<EdgeSide> sides(edges.size());
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    const std::uint32_t a = edges.origin[h], b = edges.target(h);
    const auto [low, high] = std::minmax(a, b);
    sides[h] = {std::uint64_t{low} << 32 | high, h};
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

void join_twins(HalfEdges& edges, const std::vector<EdgeSide>& sides) {
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first != 2 || edges.origin[first[0].half_edge] == edges.origin[first[1].half_edge]) return;
    edges.twin[first[0].half_edge] = first[1].half_edge;
    edges.twin[first[1].half_edge] = first[0].half_edge;
  });
}

HalfEdges half_edges(const std::vector<Face>& faces) {
  HalfEdges edges = half_edges_without_twins(faces);
  join_twins(edges, edge_sides(edges));
  return edges;
}

Shells find_shells(const HalfEdges& edges) {
  Shells shells;
  shells.of_face.assign(edges.face_begin.size() - 1, HalfEdges::kNone);
  std::vector<std::uint32_t> open;
  for (std::uint32_t start = 0; start < shells.of_face.size(); ++start) {
    if (shells.of_face[start] != HalfEdges::kNone) continue;
    shells.of_face[start] = shells.count;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      for (std::uint32_t h = edges.face_begin[f]; h < edges.face_begin[f + 1]; ++h) {
        if (edges.twin[h] == HalfEdges::kNone) continue;
        const std::uint32_t g = edges.face[edges.twin[h]];
        if (shells.of_face[g] != HalfEdges::kNone) continue;
        shells.of_face[g] = shells.count;
        open.push_back(g);
      }
    }
    ++shells.count;
  }
  return shells;
}

}  // namespace dymsum::spatial
