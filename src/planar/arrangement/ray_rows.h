// Rays to the right through the segments of a soup: which ones they pass, exactly. Segments are listed by rows of their
// heights, so that a ray looks at those of its row alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/memory_budget.h"
#include "planar/arrangement/soup.h"

namespace dymsum::planar {

class RayRows {
 public:
  /// O(n): a segment counts in all rows that it reaches, about 8 n in all.
  explicit RayRows(const Soup& soup);

  /// Calls f(segment, by) for those that the ray to +x passes which starts at x moved infinitely little to the right of
  /// its segment, then infinitely less ahead: `by` is 1 for a segment that runs up, which goes around counter-clockwise
  /// what lies left of it, and -1 for one that runs down. Requires: x is no node.
  template <class F>
  void for_each_passed(const SegmentPosition& x, F&& f) const {
    const Lattice& lattice = soup_.lattice;
    const Point d = lattice.vector(x.on.edge);
    // The sign of the height of a vertex over x where that height is zero.
    const int tie = d.x != 0 ? (d.x > 0 ? 1 : -1) : (d.y > 0 ? -1 : 1);
    const auto height = [&](WalkPair v) {
      const int h = lattice.compare_coordinate(soup_.exact(v), x, 1);
      return h != 0 ? h : tie;
    };
    const double margin = x.error + margin_;
    // A row's segments reach it with the margin of their ends; the position errs by its own.
    const std::size_t low = row(x.y - x.error), high = row(x.y + x.error);
    for (std::size_t r = low; r <= high; ++r)
      for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k) {
        const std::uint32_t s = listed_[k];
        const SoupBox& b = soup_.boxes[s];
        const double bottom = std::min(b.ay, b.by), top = std::max(b.ay, b.by);
        if (std::max(low, row(bottom - margin_)) != r) continue;  // each in one row
        if (top < x.y - margin || bottom > x.y + margin || std::max(b.ax, b.bx) < x.x - margin) continue;
        const int from = height(soup_.start(s)), to = height(soup_.end(s));
        if (from == to) continue;
        int side = lattice.side(soup_.exact(s), x);
        if (side == 0) side = -lattice.dot(soup_.exact(s).edge, x.on.edge);
        if (side == 0) side = lattice.cross(soup_.exact(s).edge, x.on.edge);
        // An upward segment is passed from its left, a downward one from its right.
        if (side == to) f(s, to);
      }
  }

 private:
  std::size_t row(double y) const {
    const double r = (y - low_) * per_row_;
    return r <= 0 ? 0 : r >= last_ ? static_cast<std::size_t>(last_) : static_cast<std::size_t>(r);
  }

  const Soup& soup_;
  double low_ = 0, per_row_ = 0, last_ = 0, margin_ = 0;
  base::CountedArray<std::uint32_t> first_, listed_;
};

}  // namespace dymsum::planar
