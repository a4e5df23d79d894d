// The facets of the reduced convolution near a box, by bounding spheres over pairs of features: a node of P and one of
// Q whose spheres' sum misses the box make no facet there (Behar 2016, 7.2.2).
#pragma once

#include <array>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/local/sphere_tree.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

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
