// T-junctions: edges with one face along which vertices of other faces lie, as exporters write them.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
