// Positions of the vertices of a sum as the doubles nearest to the exact ones, from pairs of doubles: for nearly all
// vertices these prove which double is the nearest.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/double_pair.h"
#include "spatial/convex/exact_places.h"

namespace dymsum::spatial {

class NearestPlaces {
 public:
  NearestPlaces(const ConvexOperands& source, const SolidPose& p, const SolidPose& q);

  /// The doubles nearest to the exact position of vertex p of P plus vertex q of Q; nothing where pairs of doubles do
  /// not tell.
  std::optional<Point3> operator()(std::uint32_t p, std::uint32_t q) const;

 private:
  struct Coordinate {
    base::DoublePair at;
    double size = 0;  ///< of its terms, all told
  };
  using Position = std::array<Coordinate, 3>;

  bool tells_ = false;
  std::array<std::vector<Position>, 2> posed_;
};

}  // namespace dymsum::spatial
