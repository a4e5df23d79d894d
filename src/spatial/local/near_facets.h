// The facets of the reduced convolution near a box, by bounding spheres over pairs of features: a node of P and one of
// Q whose spheres' sum misses the box make no facet there (Behar 2016, 7.2.2).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

// Bounding spheres in a tree, whose shape is made once and whose spheres are fitted again when things move.

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

class NearFacets {
 public:
  /// Requires operands without thin parts; the pair has to live as long.
  explicit NearFacets(const SolidPair& pair);

  /// All facets that meet the box, on the space's grid, and perhaps some beside it, each once, sorted by features.
  /// Exact: the rule of facets alone decides what doubles leave open.
  ReducedConvolution find(const SumSpace& space, const Box& box);
  std::uint64_t pairs() const { return pairs_; }  ///< of features that spheres left, at the last call

 private:
  struct Side {
    const SolidOperand& solid;
    std::vector<std::uint32_t> convex;  // wedges
    SphereTree faces, cones, edges;
    explicit Side(const SolidOperand& operand);
    void fit(const std::vector<Vec3>& at, double each);
  };

  const SolidPair& pair_;
  std::array<Side, 2> sides_;
  std::uint64_t pairs_ = 0;
};

}  // namespace dymsum::spatial
