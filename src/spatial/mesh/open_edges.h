// Open edges, those with one face, closed where one answer is obvious: cracks between vertices that were meant to be
// one, and small holes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

// T-junctions: edges with one face along which vertices of other faces lie, as exporters write them.

/// Whether w lies beside the segment from u to v, between its ends, and no further from it than 2^-13 of its length: so
/// near that what lies between is no face of anything, but what rounding left. Exact.
bool is_near_edge(const Point3& u, const Point3& v, const Point3& w);

/// Whether the corners of a triangle are nearly on one line: one of them is_near_edge of the others.
bool is_needle(const std::vector<Point3>& vertices, const Face& face);

struct EdgeSplits {
  std::vector<std::uint32_t> at;  ///< of every edge of a face that was split: the first vertex that it was split at
  double largest_gap = 0;         ///< of a vertex from the edge that it was put into, up to a relative error of 2^-48
};

/// Puts vertices into the open edges of faces, those with one face: where other open edges lead from one end to the
/// other along vertices that are near it (is_near_edge), these; otherwise those vertices of other open edges that lie
/// on it exactly. Faces stay where they are but for that. O((n + k) log n) for n edges, k pairs of an open edge and a
/// vertex of another one within its box; beyond 5 10^7 of these the other edges are left alone.
EdgeSplits split_open_edges(const std::vector<Point3>& vertices, std::vector<Face>& faces);

struct ClosedCracks {
  std::vector<std::uint32_t> merged;  ///< vertices that became another one
  double furthest = 0;                ///< the largest distance between the two
};

/// Vertices of open edges that are no further than `width` (nothing: 2^-20 of the surface's diagonal) from another one,
/// and no neighbours of it in a face, become that: the first one in the order by x, y, z. O(n log n) where few are that
/// near along x.
ClosedCracks close_cracks(const std::vector<Point3>& vertices, std::vector<Face>& faces,
                          std::optional<double> width = std::nullopt);

struct FilledHoles {
  std::vector<std::uint32_t> at;      ///< a vertex of every hole
  std::vector<std::uint32_t> beside;  ///< of every face that was added: one that was there, at the hole
  double longest = 0;                 ///< the open edges of one, together
};

/// Loops of open edges that meet no other one, together no longer than `length` (nothing: half of the surface's
/// diagonal, and at most 64 edges): each gets triangles, behind the other faces, which run as the faces around it do.
/// O(n log n), and O(k^2) for a hole of k edges.
FilledHoles fill_holes(const std::vector<Point3>& vertices, std::vector<Face>& faces,
                       std::optional<double> length = std::nullopt);

}  // namespace dymsum::spatial
