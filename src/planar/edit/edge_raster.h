// The raster of an operand edge by edge, as counts: what an edge adds, taking it away removes.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/edit/walk_changes.h"
#include "planar/mask/interior_mask.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Inner corners and touched cells of an operand with area, those of fine_raster (mask/interior_mask), kept while its
/// edges change.
class EdgeRaster {
 public:
  /// `origin`: the input position of the corner of the first cell; coordinates count units of `unit`. They are computed
  /// from those of the input, so that an edge is taken from the cells to which it was added, wherever the lattice
  /// begins.
  EdgeRaster(const Operand& o, const Grid& cells, Point origin, double unit);

  const Bitmap& corners() const { return corners_; }
  const Bitmap& touch() const { return touch_; }

  /// A cell that is a corner or touched now and was not, or was and is not.
  struct Flip {
    int row, column;
    bool set;
  };
  struct Flips {
    std::vector<Flip> corners, touch;
  };
  /// Follows an edit. Cost: the cells of edges that come or go,
  /// and of their rows a 64th.
  Flips update(const Operand& before, const Operand& after, const WalkChanges& changes);

 private:
  void change_edge(const Operand& o, std::uint32_t edge, int by);
  void change_run(std::vector<std::uint16_t>& counts, int row, int first, int last, int by);
  void settle(Flips& flips);

  Grid cells_;
  Point origin_;
  double per_unit_;
  Bitmap parity_, inner_, touch_, corners_;  // parity_: changes of the winding number's parity along a row
  std::vector<std::uint16_t> touch_count_, bound_count_;
  std::vector<std::uint8_t> dirty_;  // rows
};

}  // namespace dymsum::planar
