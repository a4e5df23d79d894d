// The edges of a mesh by their sides. Half-edge h is the side of an edge that belongs to one face; it runs from
// origin[h] to origin[next[h]], and the face's half-edges are consecutive, in the order of its vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

struct HalfEdges {
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<std::uint32_t> face_begin;  ///< per face its first half-edge; one more at the end
  std::vector<std::uint32_t> origin, face, next;
  std::vector<std::uint32_t> twin;  ///< the other side; kNone without exactly one that runs the other way

  std::size_t size() const { return origin.size(); }
  std::uint32_t target(std::uint32_t h) const { return origin[next[h]]; }
  std::uint32_t previous(std::uint32_t h) const {
    return h == face_begin[face[h]] ? face_begin[face[h] + 1] - 1 : h - 1;
  }
};

/// A half-edge with its ends, the smaller one first.
struct EdgeSide {
  std::uint64_t ends = 0;
  std::uint32_t half_edge = 0;
  friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
};

/// All but the twins. Requires faces of at least one vertex. Throws std::length_error from 2^32 - 1 half-edges on.
HalfEdges half_edges_without_twins(const std::vector<Face>& faces);
/// All sides, those of one edge next to each other. O(n log n).
std::vector<EdgeSide> edge_sides(const HalfEdges& edges);
/// Calls f(first, last) for the sides [first, last) of every edge.
template <class F>
void for_each_edge(const std::vector<EdgeSide>& sides, F f) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].ends == sides[first].ends) ++last;
    f(&sides[first], &sides[0] + last);
  }
}
void join_twins(HalfEdges& edges, const std::vector<EdgeSide>& sides);

/// The half-edges of faces, with their twins.
HalfEdges half_edges(const std::vector<Face>& faces);

/// Numbers the sets of faces that are connected by twins, in the order of their first faces.
struct Shells {
  std::vector<std::uint32_t> of_face;
  std::uint32_t count = 0;
};
Shells find_shells(const HalfEdges& edges);

}  // namespace dymsum::spatial
