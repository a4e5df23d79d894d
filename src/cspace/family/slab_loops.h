// The loops of an obstacle's boundary in any slab, found in time proportional to their length.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// Patches of each slab are those of the last of every kEvery slabs that are still there, and those that began since.
/// What follows a patch along the boundary changes while it is there: each change is kept.
class SlabLoops {
 public:
  explicit SlabLoops(const CspaceObstacle& obstacle);

  /// The loops as CspaceObstacle::loops has them, in some order: patches one after the other, loop after loop.
  struct Loops {
    std::vector<std::uint32_t> patches;
    std::vector<std::uint32_t> ends;  ///< of each loop in `patches`
  };
  Loops in(std::uint32_t slab) const;
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kEvery = 32;
  struct Follower {
    std::uint32_t since = 0, patch = 0;  ///< slabs counted from the patch's own beginning
  };

  bool is_there(std::uint32_t patch, std::uint32_t slab) const;
  std::uint32_t since_begin(std::uint32_t patch, std::uint32_t slab) const;
  std::uint32_t follower(std::uint32_t patch, std::uint32_t slab) const;
  std::vector<std::uint32_t> patches_in(std::uint32_t slab) const;
  void index_patches();
  void link_patches();

  const std::vector<Patch>& patches_;
  std::uint32_t slabs_;
  std::vector<std::uint32_t> first_beginning_, beginning_;  ///< slab -> patches that begin there
  std::vector<std::uint32_t> first_kept_, kept_;            ///< every kEvery slabs: patches there
  std::vector<std::uint32_t> first_follower_;               ///< patch -> its followers
  std::vector<Follower> followers_;
};

// Where the vertices of a slice stand at an orientation, in doubles with a proved bound.

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
