// Clipper 6 (Debian's libpolyclipping-dev), the permissive but inexact choice: coordinates are scaled to integers and
// every crossing is rounded to that grid.
#pragma once

#include <memory>

#include "dymsum/region.h"
#include "versus/rival.h"

namespace dymsum::bench {

/// Two operands as Clipper paths on one integer grid, built before any clock starts. Each must be one part without
/// holes: Clipper's MinkowskiSum takes single paths.
class ClipperOperands {
 public:
  ClipperOperands(const RegionData& p, const RegionData& q);
  ~ClipperOperands();

  /// ClipperLib::MinkowskiSum, which sums the two boundaries, joined with a translate of each operand to fill the
  /// inside.
  RivalAnswer sum(const Repeats& repeats) const;
  /// The same in a forked child, stopped after `limit_s` seconds.
  RivalAnswer sum_in_child(const Repeats& repeats, double limit_s) const;

 private:
  struct Paths;
  std::unique_ptr<Paths> paths_;
};

}  // namespace dymsum::bench
