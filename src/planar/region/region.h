// Regions: their vertices, list by list, and what the engine takes of them: rings that touch cut apart, the
// complement of one in a frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::planar {

/// Calls f(list) for all lists of vertices of a RegionData, which may be const, in the order of the vertex indices:
/// each part's outer ring and holes, polylines, points.
template <class Data, class F>
void for_each_chain(Data& data, F f) {
  for (auto& part : data.parts) {
    f(part.outer);
    for (auto& hole : part.holes) f(hole);
  }
  for (auto& line : data.polylines) f(line);
  f(data.points);
}

}  // namespace dymsum::planar

namespace dymsum::exact {

// Regions as the engine takes them: with touching rings cut apart, and as the complement of one in a frame.

// The data of a region as the engine takes it.

struct HomogeneousPoint;

}  // namespace dymsum::exact

namespace dymsum::planar {

/// Region data for the engine, with the numbers its vertices and edges have in the region they come from.
struct EngineRegion {
  const RegionData* borrowed = nullptr;  ///< without touching points: the region's own data, which must outlive this
  RegionData own;
  bool touching = false;                                    ///< edges of different rings may follow each other
  std::vector<std::uint32_t> vertex_indices, edge_indices;  ///< empty: unchanged

  /// The exact positions of all vertices in their order, where some are no doubles: `own` has the nearest doubles then.
  /// Otherwise none.
  std::shared_ptr<const std::vector<exact::HomogeneousPoint>> fractions;

  const RegionData& data() const { return borrowed != nullptr ? *borrowed : own; }
  std::uint32_t vertex_index(std::uint32_t v) const { return vertex_indices.empty() ? v : vertex_indices[v]; }
  std::uint32_t edge_index(std::uint32_t e) const { return edge_indices.empty() ? e : edge_indices[e]; }
};

// The complement of a region inside a frame, for questions about what lies inside.

/// The angles by which Q may be rotated.
enum class Turning { none, any };

/// The frame with P cut out, under the numbers of P; the frame's own vertices and edges have the number
/// SumVertex::kNone. The frame is wide enough that its boundary plays no part in sums with -Q, or with
/// Q rotated by any angle.
EngineRegion complement_of(const Region& p, const Region& q, Turning turning = Turning::none);

/// Half the side of that frame around the origin, for the bounds of P and Q: smallest x and y, largest x and y.
double frame_margin(const std::array<double, 4>& p, const std::array<double, 4>& q, Turning turning);

/// The error for operands around which no such frame can be laid: a coordinate that no sum can take, or so large a one
/// that the frame's would be. Evidence is the operand's own coordinate.
std::optional<Error> too_large_to_frame(const Region& p, const Region& q);

// Regions whose rings touch, rewritten so that the engine's local view holds: at every visit of a vertex the wedge on
// the left is one whole sector of the region, and components have connected interiors.

/// The same set. Without touching points: the data as they are, borrowed. Otherwise edges are cut at touching points,
/// every way in is joined to the next way out clockwise, and rings are grouped anew; they may then visit a point
/// several times.
EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points);

}  // namespace dymsum::planar
