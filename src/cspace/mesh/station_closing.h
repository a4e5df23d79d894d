// Closing the mesh of an obstacle at one event angle.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "cspace/mesh/obstacle_rails.h"
#include "dymsum/obstacle_mesh.h"

namespace dymsum::cspace {

/// A corner of a closed walk, and the patch of the edge that leaves it.
struct WalkCorner {
  std::uint32_t joint = 0, patch = 0;
};

/// The edges of the pieces that end, run forwards, and of those that begin, run backwards, as closed walks: a walk
/// turns from the ones to the others wherever a joint is there on both sides. Between two such joints the boundary
/// before and the boundary after are the same set, so every walk goes along each of its lines as often in either
/// direction.
std::vector<std::vector<WalkCorner>> closing_walks(const ObstacleLayout& layout, const Station& station);

/// A vertex of the mesh and the patch of the edge that leaves it.
struct RingCorner {
  std::uint32_t vertex = 0, patch = 0;
};

/// Closes rings of one station by triangles whose edges are those of the ring and, twice, others: the smallest ear is
/// cut off until nothing is left, which never leaves the lines of a ring that encloses nothing. Edges that are there
/// already are avoided. O(n^2).
class RingCloser {
 public:
  explicit RingCloser(ObstacleMesh& mesh) : mesh_(mesh) {}
  void add_edge(std::uint32_t a, std::uint32_t b);
  void close(std::vector<RingCorner> ring);

 private:
  double cost(const std::vector<RingCorner>& ring, std::size_t at) const;
  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  void add_triangle(const RingCorner& a, const RingCorner& b, const RingCorner& c);

  ObstacleMesh& mesh_;
  std::unordered_set<std::uint64_t> edges_;
};

}  // namespace dymsum::cspace
