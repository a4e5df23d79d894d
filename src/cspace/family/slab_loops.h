// The loops of an obstacle's boundary in any slab, found in time proportional to their length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/cspace_obstacle.h"

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

}  // namespace dymsum::planar
