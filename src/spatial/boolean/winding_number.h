// How often closed surfaces of triangles go around a position.
#pragma once

#include <vector>

#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

class WindingNumber {
 public:
  /// Of triangles of the space's P, where its Q is one vertex. Keeps the references.
  WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles);

  /// The triangles above a position that is on none of them: those seen from below their backs less those seen from
  /// below their fronts. Exact. O(log n + k) for k triangles in line with it along z.
  int at(const Flag& x) const;

 private:
  const SumSpace& space_;
  const std::vector<Triangle>& triangles_;
  BoxTree tree_;
};

}  // namespace dymsum::spatial
