// Open edges, those with one face, closed where one answer is obvious: cracks between vertices that were meant to be
// one, and small holes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

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
