// The region with its cuts as a planar graph: points, sections of edges and cuts between them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/poll.h"
#include "shape/decompose/cut_search.h"
#include "shape/decompose/wall.h"

namespace dymsum::shape {

/// A vertex of the graph, exactly and with bounds.
struct Spot {
  RationalPoint at;
  exact::Interval x, y;
};

/// A section of an edge or of a cut inside the region, between neighbouring points.
struct WallSection {
  std::uint32_t from, to;  ///< points, in the direction of the wall
  std::uint32_t wall;      ///< edges, then cuts
};

struct Sections {
  std::vector<Spot> spots;  ///< the vertices of the region first
  std::vector<Wall> walls;  ///< edges, then cuts
  std::uint32_t edges = 0;
  std::vector<WallSection> all;
};
Sections make_sections(const RingTable& table, const std::vector<PlacedCut>& cuts);

/// Half-edge 2s runs along section s, 2s + 1 against it. The one that follows with the same piece on the left; for
/// those against an edge, which bound nothing, any number.
std::vector<std::uint32_t> following(const Sections& sections);

/// The sign of a.x - b.x and of a.y - b.y. Exact.
int compare_x(const Spot& a, const Spot& b);
int compare_y(const Spot& a, const Spot& b);
/// The sign of (b - a) x (c - a). Exact.
int turn_sign(const Spot& a, const Spot& b, const Spot& c);

}  // namespace dymsum::shape
