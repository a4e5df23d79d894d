// Planes of what touches in a sum that scales, by names.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/spatial_sum.h"
#include "spatial/mesh/grid_places.h"

namespace dymsum::spatial {

/// Of two meshes one of which scales.
class ScaledPlanes {
 public:
  ScaledPlanes(const Mesh& p, const Mesh& q, int moving);
  /// A hash of the hyperplane n . x = d0 + s d1 of what two features make, in lowest terms, whichever side is its
  /// front.
  std::uint64_t name(const SolidContact& contact) const;

 private:
  using Big3 = std::array<exact::BigInteger, 3>;
  Big3 place(int operand, std::uint32_t v) const;
  Big3 normal(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q, bool face_of_p) const;
  std::vector<std::uint32_t> vertices_of(int operand, const SolidFeature& feature) const;

  const Mesh *p_, *q_;
  int moving_;
  GridPlaces places_;
};

}  // namespace dymsum::spatial
