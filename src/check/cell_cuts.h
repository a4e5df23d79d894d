// Where to cut a convex cell so that its distance from triangles is bounded better.
#pragma once

#include <optional>

#include "check/near_triangles.h"
#include "check/solid_cell.h"

namespace dymsum::check {

class CellCuts {
 public:
  /// Both outlive this.
  CellCuts(const NearTriangles& triangles, PlaneTable& planes) : triangles_(triangles), planes_(planes) {}

  /// Cuts a cell whose distance the triangle bounds, by its vertex `worst`: where that triangle and the one that is
  /// nearest to `worst` are equally far; else beside the triangle; one cut in some in two halves, whatever the
  /// triangles are.
  std::optional<HalvedSolidCell> cut(const SolidCell& cell, std::uint32_t triangle, const SpacePoint& worst, int depth);

 private:
  std::optional<HalvedSolidCell> between(const SolidCell& cell, std::uint32_t t, std::uint32_t u,
                                         const SpacePoint& worst);
  std::optional<HalvedSolidCell> beside(const SolidCell& cell, std::uint32_t t, const SpacePoint& worst);
  std::optional<HalvedSolidCell> half(const SolidCell& cell);
  std::optional<HalvedSolidCell> near_plane(const SolidCell& cell, const Vec3& at, const Vec3& normal);
  std::optional<std::array<BigInteger, 4>> bisector(std::uint32_t t, int feature_of_t, std::uint32_t u,
                                                    int feature_of_u, const Vec3& at);

  const NearTriangles& triangles_;
  PlaneTable& planes_;
};

}  // namespace dymsum::check
