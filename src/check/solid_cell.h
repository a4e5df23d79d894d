// Convex cells of space between planes, cut in two by further planes, exactly.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "check/triangle_distance.h"
#include "exact/big.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::check {

using exact::BigInteger;
using spatial::Vec3;

/// a x + b y + c z + d, without common factor, and the same in doubles, divided by the largest of a, b and c.
struct Plane {
  std::array<BigInteger, 4> exact;
  std::array<double, 4> near{};
};

/// A position (x, y, z) / w, w > 0, and the nearest doubles.
struct SpacePoint {
  explicit SpacePoint(std::array<BigInteger, 4> homogeneous);
  explicit SpacePoint(const RationalVector& p);

  RationalVector rational() const;

  std::array<BigInteger, 4> exact;
  Vec3 near;
  std::vector<std::uint32_t> planes;  ///< that are known to pass through it, ascending
};
using SpacePointRef = std::shared_ptr<SpacePoint>;

/// The position that doubles are.
RationalVector exactly(const Vec3& v);

/// The sign of the plane's form at p: of doubles where these prove it.
int side_of(const Plane& plane, const SpacePoint& p);

/// Planes by index; equal ones have one.
class PlaneTable {
 public:
  /// Requires: a normal that is not zero.
  std::uint32_t add(std::array<BigInteger, 4> form);
  /// That through three positions that are not on one line.
  std::uint32_t add(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c);
  /// That through p at right angles to n.
  std::uint32_t add(const RationalVector& n, const RationalVector& p);
  const Plane& operator[](std::uint32_t plane) const { return planes_[plane]; }
  /// The position on all three. Requires that it is one.
  SpacePointRef meeting_of(std::uint32_t p, std::uint32_t q, std::uint32_t r) const;

 private:
  std::map<std::array<BigInteger, 4>, std::uint32_t> index_;
  std::deque<Plane> planes_;
};

/// The convex hull of its vertices. All corners are among these; each knows the planes of facets that it lies on, so
/// that two ends of an edge have two planes in common. New vertices lie on three planes that were there: their digits
/// do not grow from cut to cut.
struct SolidCell {
  struct Facet {
    std::uint32_t plane;
    int side;  ///< of the plane, on which the cell is
  };
  std::vector<SpacePointRef> vertices;
  std::vector<Facet> facets;
};

/// The box between these coordinates. Requires: it has volume.
SolidCell box_cell(const Vec3& low, const Vec3& high, PlaneTable& planes);

/// Both sides of a cell; nothing where the plane misses its inside.
struct HalvedSolidCell {
  SolidCell negative, positive;
};
std::optional<HalvedSolidCell> halved(const SolidCell& cell, std::uint32_t plane, const PlaneTable& planes);

}  // namespace dymsum::check
