// The triangles that bound a solid, and those of them that are nearest to a position.
#pragma once

#include <cstdint>
#include <vector>

#include "check/triangle_distance.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::check {

using spatial::Vec3;

/// A position of a triangle near another one, and what of the triangle it lies on.
struct NearOnTriangle {
  static constexpr int kFace = 6;
  Vec3 at;
  int feature = kFace;  ///< 0 to 2: a vertex; 3 to 5: the edge from vertex feature - 3 to the next one
};

class NearTriangles {
 public:
  /// Requires: a triangle; `set` outlives this. `reach`: no coordinate of a position is larger.
  NearTriangles(const spatial::ExactSet& set, double reach);

  ExactTriangle exact(std::uint32_t triangle) const;
  /// The nearest position as far as doubles know.
  NearOnTriangle near(const Vec3& p, std::uint32_t triangle) const;
  /// No less than the distance of a position from the triangle, p being the nearest doubles of the position: that of a
  /// position of the triangle, which is a nearest one as far as doubles know.
  double distance_above(const Vec3& p, std::uint32_t triangle) const;
  /// What of distance_above is for rounding.
  double slack() const { return slack_; }
  /// One that is nearest, by distance_above. O(log n).
  std::uint32_t rough_nearest(const Vec3& p) const;

  struct Nearest {
    exact::BigRational squared;
    RationalVector at;
    std::uint32_t triangle = 0;
  };
  /// Exactly: of all triangles that doubles do not prove to be further away. p are the nearest doubles.
  Nearest nearest(const RationalVector& exact, const Vec3& p) const;

 private:
  const spatial::ExactSet& set_;
  spatial::BoxTree tree_;
  double reach_ = 0, slack_ = 0;
};

}  // namespace dymsum::check
