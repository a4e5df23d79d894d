// A path of translations against the open sum of obstacles and a scaled, reflected part.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "dymsum/scale_range.h"
#include "planar/arrangement/crossings.h"
#include "planar/convolution/convolution.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

// What holds a scaled part at a scale at which it has no freedom left.

/// Numbers of obstacle vertices and edges as they are told, by those of the operand.
struct ObstacleIndices {
  std::vector<std::uint32_t> vertices, edges;
};

/// Everything in which part and obstacles touch when the part stands at a tight point of a sum at scale s: a vertex
/// inside an edge, or two vertices; and the vertices inside edges that keep touching along an interval of a tight
/// segment. Sorted by position. Requires: the sum is that of obstacles (operand 0) and a reflected part (operand 1)
/// that scales. O(n m T) doubles for T tight features, exact arithmetic for what they do not distinguish.
std::vector<ScaleContact> tight_contacts(const OperandPair& base, const PlanarSum& sum, const exact::BigRational& s,
                                         const ObstacleIndices& indices);

class PathFree {
 public:
  /// Operand 0: obstacles and waypoints; operand 1: the reflected part, scaled, and its reference point.
  PathFree(std::shared_ptr<const OperandPair> base, std::uint32_t first_waypoint, std::uint32_t waypoints,
           std::uint32_t reference, std::uint32_t beside);

  /// Scales at which something comes into contact with the path, with what does.
  using Critical = std::map<exact::BigRational, std::vector<ScaleContact>>;
  /// `query` is called with the fraction that is done, and may throw. Doubles leave out what provably never touches;
  /// `all_exactly`: nothing, for tests.
  Critical critical(const std::function<void(double)>& query, bool all_exactly = false) const;
  /// A position of the path, near the one that was found, at which the part at this scale overlaps the obstacles; none
  /// if it does so nowhere on the path. `leg` is looked at first, and then is the one that is blocked.
  std::optional<ExactSource::Position> blocked_at(const exact::BigRational& s, std::uint32_t& leg) const;
  bool free(const exact::BigRational& s) const {
    std::uint32_t leg = 0;
    return !blocked_at(s, leg);
  }

 private:
  Pair waypoint(std::uint32_t k) const { return {first_ + k, reference_}; }
  Segment leg(std::uint32_t k) const { return {{0, first_ + k, first_ + k + 1}, reference_}; }
  std::optional<ExactSource::Position> blocked_on(std::uint32_t k, const Lattice& lattice,
                                                  class Collision& collision) const;
  ExactSource::Position on_leg(std::uint32_t k, double t) const;
  void add(Critical& to, const exact::BigRational& s, const WalkSegment* wall, const WalkPair* corner,
           std::uint32_t leg, Pair position, bool on_leg) const;

  std::shared_ptr<const OperandPair> base_;
  ExactForms forms_;
  ReducedConvolution convolution_;
  std::vector<WalkSegment> walls_;
  std::vector<WalkPair> corners_;
  std::uint32_t first_, count_, reference_, beside_;
};

}  // namespace dymsum::planar
