// A path of translations against the open sum of obstacles and a scaled, reflected part.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "dymsum/scale_range.h"
#include "planar/arrangement/soup.h"
#include "planar/convolution/convolution.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/scaling_forms.h"

namespace dymsum::planar {

class PathFree {
 public:
  /// Operand 0: obstacles and waypoints; operand 1: the reflected part, scaled, and its reference point.
  PathFree(std::shared_ptr<const OperandPair> base, std::uint32_t first_waypoint, std::uint32_t waypoints,
           std::uint32_t reference, std::uint32_t beside);

  /// Scales at which something comes into contact with the path, with what does.
  using Critical = std::map<exact::BigRational, std::vector<ScaleContact>>;
  /// `query` is called with the fraction that is done, and may throw.
  Critical critical(const std::function<void(double)>& query) const;
  /// Whether the part at this scale overlaps the obstacles nowhere on the path.
  bool free(const exact::BigRational& s) const;

 private:
  Pair waypoint(std::uint32_t k) const { return {first_ + k, reference_}; }
  Segment leg(std::uint32_t k) const { return {{0, first_ + k, first_ + k + 1}, reference_}; }
  bool leg_free(std::uint32_t k, const Lattice& lattice, class Collision& collision) const;
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
