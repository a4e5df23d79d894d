// The scales at which a solid part fits: along a path past obstacles, at one position inside a container, or anywhere
// inside it; and the sums of many scaled copies of one solid.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/scale.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// A contact of part and obstacle at one exact scale.
struct SolidScaleContact {
  SolidFeature part, obstacle;  ///< a vertex and a face, a face and a vertex, or two edges
  std::uint32_t leg = 0;        ///< of a path: between waypoints leg and leg + 1
  Rational along;               ///< of a path: how far along that leg, in [0, 1]
  RationalPoint3 at;            ///< where the reference point of the part stands
  friend bool operator==(const SolidScaleContact&, const SolidScaleContact&) = default;
};

/// A closed interval of scales; without `low` it begins at 0 (not included), without `high` it has no end.
struct SolidScaleInterval {
  std::optional<Rational> low, high;
  std::vector<SolidScaleContact> at_low, at_high;  ///< the contacts that begin or end exactly there
};

/// An exact set of scales.
struct SolidScaleRange {
  std::vector<SolidScaleInterval> free;  ///< in order, disjoint
  std::uint64_t critical = 0;            ///< scales at which something comes into contact
  std::uint64_t tested = 0;              ///< scales at which the question was decided exactly

  bool contains(const Scale& s) const;
  /// The trap: the scale up to which all smaller parts are free, and just above which the path is blocked. None: never
  /// blocked. Zero: blocked at every small scale.
  std::optional<Rational> trap() const;
};

/// The scales s for which s `part` (about the origin of its coordinates), moved along the path, never overlaps the
/// obstacles; touching is allowed. `path` is a polyline of translations with at least one waypoint. Exact. Errors:
/// unsupported_operand for a path without waypoints, empty operands, thin parts and more than 8,192 bits;
/// not_finite; cancelled. Cost: for L waypoints and N facets O(L N) exact values, and O(L N) signs for every one of
/// them. Source: Behar 2016, 6.6.1.
Result<SolidScaleRange> solid_scale_range(const Mesh& part, const std::vector<Point3>& path, const Mesh& obstacles,
                                          const Progress& progress = {});
/// The same along a path of fractions.
Result<SolidScaleRange> solid_scale_range(const Mesh& part, std::span<const RationalPoint3> path, const Mesh& obstacles,
                                          const Progress& progress = {});

/// The scales at which s `part`, placed at `at`, lies inside the container. Errors as above.
Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Point3& at,
                                        const Progress& progress = {});
/// The same at a position in fractions.
template <std::same_as<RationalPoint3> Position>
Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Position& at,
                                        const Progress& progress = {});

/// The scales at which s `part` lies inside the container at some translation: erode(container, s part) is not empty.
/// Its contacts are those at the tight segments and points that are left at an end. Errors as above. Cost: the events
/// of a SolidScaleEvents, and a sum for every gap between those that change the topology.
Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Progress& progress = {});

/// One copy of a master solid: scaled about its origin, then moved.
struct ScaledSolidCopy {
  Scale scale;
  Point3 at;
};
/// Its sum, not moved.
struct SolidCopySum {
  SpatialSum sum;
  Point3 at;  ///< add it to every position
};
/// The obstacles s_i P + z_i of an environment summed with Q: for each copy the sum s_i P (+) Q, in the order given.
/// The convolution is the same at all scales and made once; copies of equal scale share a sum. Errors:
/// unsupported_operand for thin parts and coordinates of more than 8,192 bits; cancelled.
Result<std::vector<SolidCopySum>> scaled_solid_copies(const Mesh& master, const Mesh& q,
                                                      const std::vector<ScaledSolidCopy>& copies,
                                                      const Progress& progress = {});

}  // namespace dymsum
