// Where the vertices of a slice stand at an orientation, in doubles with a proved bound.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// An orientation's cosine and sine, within eight roundings of 1.
struct Rotor {
  double cosine = 1, sine = 0;
};
Rotor rotor_of(const Orientation& theta);

/// The ends of an obstacle's patches.
class RotatedPositions {
 public:
  /// `base`: of the obstacle, operand 1 rotates.
  RotatedPositions(const OperandPair& base, const CspaceObstacle& obstacle);

  struct Placed {
    Point at;
    double error = 0;  ///< of both coordinates; infinite where doubles know too little
  };
  /// The end of a patch: a sum of two vertices, or the crossing with the line of the patch that follows.
  Placed end(std::uint32_t patch, std::uint32_t follower, Rotor rotor) const {
    const Line& own = lines_[patch];
    return own.corner ? corner(own, rotor) : crossing(own, lines_[follower], rotor);
  }
  /// That pair of vertices, by their indices, of a patch that ends in one.
  struct Corner {
    std::uint32_t p = SumVertex::kNone, q = SumVertex::kNone;
  };
  const Corner& corner_of(std::uint32_t patch) const { return corners_[patch]; }

 private:
  /// An edge and the vertex of the other operand that it is added to.
  struct Line {
    Point from, to, vertex;
    bool moves = false;  ///< the edge rotates; else the vertex does
    bool corner = false;
  };
  Placed corner(const Line& line, Rotor rotor) const;
  Placed crossing(const Line& on, const Line& other, Rotor rotor) const;

  double reach_ = 0;  ///< of both operands together, from the origin
  std::vector<Line> lines_;
  std::vector<Corner> corners_;
};

}  // namespace dymsum::planar
