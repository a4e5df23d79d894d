// The patches of an obstacle cut at theta = pi and laid out by layers, and the curves along which they meet.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dymsum/cspace_obstacle.h"

namespace dymsum::cspace {

inline constexpr std::uint32_t kNobody = 0xffffffff;

/// A patch, or the part of one on one side of theta = pi: it covers the layers [first, last].
struct Piece {
  std::uint32_t patch = 0, first = 0, last = 0;
  std::array<std::uint32_t, 2> joint{};  ///< left, right
};

/// The common curve of two pieces: the right ends of `before`, the left ends of `after`. kNobody: nobody is there.
struct Rail {
  std::uint32_t joint = 0, first = 0, last = 0;
  std::uint32_t before = kNobody, after = kNobody;
};

/// What ends and begins at an event angle or at pi.
struct Station {
  double theta = 0;
  std::uint32_t below = 0, above = 0;            ///< layers
  std::vector<std::uint32_t> ending, beginning;  ///< pieces
  /// Joints that are the same point here under two names, below -> above and back.
  std::unordered_map<std::uint32_t, std::uint32_t> name_above, name_below;
};

/// Layer k lies below station k; layer 0 begins at theta = -pi, and the last station is pi, where both planes are one.
/// A joint is where two contacts follow each other along the boundary: a sum of two vertices, or a pair of contacts
/// that cross. There is at most one of an index in a layer.
struct ObstacleLayout {
  std::vector<Station> stations;
  std::vector<Piece> pieces;
  std::vector<Rail> rails;
  std::vector<std::vector<std::uint32_t>> rails_of_joint;                 ///< by layer
  std::vector<std::array<std::vector<std::uint32_t>, 2>> rails_of_piece;  ///< left, right; by layer

  /// Whether the boundary has this joint in a layer. O(log rails).
  bool alive(std::uint32_t joint, std::uint32_t layer) const;
  /// The joint of the layer above that continues one of the layer below, or kNobody; and the other way round.
  std::uint32_t above(const Station& station, std::uint32_t joint) const;
  std::uint32_t below(const Station& station, std::uint32_t joint) const;
};

/// O(patches log patches).
ObstacleLayout lay_out(const CspaceObstacle& obstacle);

/// Finds joints that change their names where edges are aligned: (edge, vertex) becomes (edge, next vertex) on the same
/// line, so that the crossings with other contacts stay where they are. Fills name_above and name_below.
void name_joints_at_alignments(ObstacleLayout& layout, const CspaceObstacle& obstacle);

/// The vertices and edges of a region by their indices; edge k runs from vertex k to next[k].
struct RingTable {
  std::vector<Point> at;
  std::vector<std::uint32_t> next, previous;
  std::vector<std::uint32_t>
      first_visit;  ///< the smallest index of a vertex at the same point: where rings touch, not its own
};
RingTable ring_table(const Region& region);

}  // namespace dymsum::cspace
