// Balls inside an operand. A ball of P plus a ball of Q is a ball of the open sum, wherever both operands stand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

struct InnerBalls {
  static constexpr std::size_t kNeighbours = 6;
  struct Ball {
    Vec3 centre;
    double radius = 0;
  };
  std::vector<Ball> balls;                                         ///< each inside the solid, proved in doubles
  std::vector<std::array<std::uint32_t, kNeighbours>> neighbours;  ///< of every ball others near it, or itself
};

/// Balls that touch the surface from inside, at the centres of some of its triangles, the largest first and none with
/// its centre in the inner half of another one. O(n) for every triangle tried, 200 at most.
InnerBalls inner_balls(const SolidOperand& solid);

}  // namespace dymsum::spatial
