// The segments of the convolution near a box, found in trees of discs, or among those that were near the last one.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "planar/local/feature_discs.h"
#include "planar/local/posed_regions.h"

namespace dymsum::planar {

/// In scaled doubles.
struct ScaledBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class NearSegments {
 public:
  /// For poses with these scales; others of the same ratio do, too.
  NearSegments(const Operand& p, const Operand& q, const std::array<Point, 2>& stretch);

  /// A superset of the segments of the reduced convolution that meet the box: edges and convex vertices whose
  /// directions meet, or nearly, as doubles tell.
  base::CountedArray<WalkSegment> find(const PosedRegions& posed, const ScaledBox& box);
  /// The same among the pairs that were near the last box, kept with a margin; these are found anew where operands and
  /// box have moved further than that since.
  base::CountedArray<WalkSegment> update(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);
  /// All of them, whatever the box.
  base::CountedArray<WalkSegment> all(const PosedRegions& posed) const;

  bool rebuilt() const { return rebuilt_; }  ///< by the last call
  std::uint64_t pairs() const { return pairs_; }

 private:
  struct Wanted {
    ScaledBox box;
    double turn = 0;  ///< directions may differ by so much
  };
  base::CountedArray<WalkSegment> search(const PosedRegions& posed, const Wanted& wanted);
  void search_side(const PosedRegions& posed, const Wanted& wanted, std::uint32_t side,
                   base::CountedArray<WalkSegment>& found);
  bool is_near(const PosedRegions& posed, const WalkSegment& s, const Wanted& wanted) const;
  bool still_holds(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);

  std::array<const Operand*, 2> operands_;
  std::array<FeatureDiscs, 2> edges_, vertices_;
  bool rebuilt_ = false;
  std::uint64_t pairs_ = 0;

  struct Kept {
    base::CountedArray<WalkSegment> segments;
    PosePair poses;
    ScaledBox box;  ///< with its margin
    double turn = 0;
    int scale = 0;
    std::uint64_t calls = 0;  ///< since it was made, and how far operands have moved
    double moved = 0;
  };
  std::optional<Kept> kept_;
};

}  // namespace dymsum::planar
