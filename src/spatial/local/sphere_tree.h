// Bounding spheres in a tree, whose shape is made once and whose spheres are fitted again when things move.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

struct Sphere {
  Vec3 centre;
  double radius = 0;
};

class SphereTree {
 public:
  struct Node {
    Sphere sphere;
    std::uint32_t left = 0, right = 0;  ///< of an inner node
    std::uint32_t item = 0;             ///< of a leaf
    bool leaf() const { return left == right; }
  };

  SphereTree() = default;
  /// Divides by medians of the centres. O(n log^2 n).
  explicit SphereTree(const std::vector<Sphere>& spheres);
  /// New spheres of the same things. O(n).
  void fit(const std::vector<Sphere>& spheres);

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t k) const { return nodes_[k]; }

 private:
  std::uint32_t build(const std::vector<Sphere>& spheres, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_;  // children behind their parents
  std::vector<std::uint32_t> order_;
};

}  // namespace dymsum::spatial
