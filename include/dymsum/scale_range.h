// The scales at which a part fits: along a path past obstacles, at one position inside a container, or anywhere inside
// it.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/rational.h"
#include "dymsum/scale.h"

namespace dymsum {

/// A contact of part and obstacle at one exact scale.
struct ScaleContact {
  enum class Kind : std::uint8_t {
    vertex_on_edge,    ///< a vertex of the part on an edge of the obstacle (or container)
    edge_on_vertex,    ///< an edge of the part on a vertex of the obstacle
    vertex_on_vertex,  ///< a vertex of the part on a vertex of the obstacle
  };
  Kind kind = Kind::vertex_on_edge;
  std::uint32_t part = 0;      ///< index of the part's vertex or edge
  std::uint32_t obstacle = 0;  ///< index of the obstacle's edge or vertex
  std::uint32_t leg = 0;       ///< of a path: between waypoints leg and leg + 1
  Rational along;              ///< of a path: how far along that leg, in [0, 1]
  RationalPoint
      at;  ///< where the reference point of the part stands; for a contact that slides, at its first such position
  friend bool operator==(const ScaleContact&, const ScaleContact&) = default;
};

/// A closed interval of scales; without `low` it begins at 0 (not included), without `high` it has no end.
struct ScaleInterval {
  std::optional<Rational> low, high;
  std::vector<ScaleContact> at_low, at_high;  ///< the contacts that begin or end exactly there
};

/// An exact set of scales.
struct ScaleRange {
  std::vector<ScaleInterval> free;  ///< in order, disjoint
  std::uint64_t critical = 0;       ///< scales at which something comes into contact
  std::uint64_t tested = 0;         ///< scales at which the question was decided exactly

  bool contains(const Scale& s) const;
  /// The trap: the scale up to which all smaller parts are free, and just above which the path is blocked. None: never
  /// blocked. Zero: blocked at every small scale.
  std::optional<Rational> trap() const;
};

/// The scales s for which s `part` (about the origin of its coordinates), moved along the path, never overlaps the
/// obstacles; touching is allowed. `path` is a polyline of translations with at least one waypoint. Valid is not
/// monotone in s unless the part is star-shaped about its reference point: hence a set. Exact. Errors:
/// unsupported_operand for a path without waypoints, empty or lower-dimensional operands, and as ScalingSum::create;
/// not_finite; cancelled. Cost: O(L N) exact values and, per value, O(L N) filtered signs, for L waypoints and N
/// convolution segments. Source: Behar 2016, 6.6.1.
Result<ScaleRange> scale_range(const Region& part, const std::vector<Point>& path, const Region& obstacles,
                               const Progress& progress = {});
/// The same along a path of fractions. Errors also: unsupported_operand where a waypoint, or a coordinate of the
/// obstacles, times the common denominator of the path is no double.
Result<ScaleRange> scale_range(const Region& part, std::span<const RationalPoint> path, const Region& obstacles,
                               const Progress& progress = {});

/// The scales at which s `part`, placed at `at`, lies inside the container. Errors here and below: as above,
/// coordinates beyond 2^996.
Result<ScaleRange> fit_range(const Region& part, const Region& container, Point at, const Progress& progress = {});
/// The same at a position in fractions. Errors also: unsupported_operand where a coordinate of the position, or of the
/// container, times the common denominator of the position is no double.
template <std::same_as<RationalPoint> Position>
Result<ScaleRange> fit_range(const Region& part, const Region& container, const Position& at,
                             const Progress& progress = {});

/// The scales at which s `part` lies inside the container at some translation: erode(container, s part) is not empty.
/// At an end of an interval the translations left are points and segments; its contacts are those at each of these
/// points, and those that hold along an interval of these segments. Cost: an exact frame per event of the scaling sum.
Result<ScaleRange> fit_range(const Region& part, const Region& container, const Progress& progress = {});

}  // namespace dymsum
