#include "planar/edit/edge_raster.h"

#include <algorithm>
#include <bit>

namespace dymsum::planar {

EdgeRaster::EdgeRaster(const Operand& o, const Grid& cells, Point origin, double unit)
    : cells_(cells),
      origin_(origin),
      per_unit_(1 / unit),
      parity_(cells.rows, cells.columns),
      inner_(cells.rows, cells.columns),
      touch_(cells.rows, cells.columns),
      corners_(cells.rows, cells.columns),
      touch_count_(static_cast<std::size_t>(cells.rows) * static_cast<std::size_t>(cells.columns), 0),
      bound_count_(touch_count_),
      dirty_(static_cast<std::size_t>(cells.rows), 1) {
  for (std::uint32_t e = 0; e < o.size(); ++e) change_edge(o, e, 1);
  Flips all;
  settle(all);
}

void EdgeRaster::change_run(std::vector<std::uint16_t>& counts, int row, int first, int last, int by) {
  dirty_[static_cast<std::size_t>(row)] = 1;
  const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_.columns);
  for (int c = first; c <= last; ++c)
    counts[at + static_cast<std::size_t>(c)] =
        static_cast<std::uint16_t>(counts[at + static_cast<std::size_t>(c)] + by);
}

// The cells are those of the mask's rasters: of an edge that stays in two by two cells its ends, and its whole box as
// boundary.
void EdgeRaster::change_edge(const Operand& o, std::uint32_t edge, int by) {
  const Point from = o.points->input[o.source[edge]], to = o.points->input[o.source[o.next[edge]]];
  const struct {
    double ax, ay, bx, by;
  } b{(from.x - origin_.x) * per_unit_, (from.y - origin_.y) * per_unit_, (to.x - origin_.x) * per_unit_,
      (to.y - origin_.y) * per_unit_};
  const double rim = kRim * cells_.cell;
  const auto cell = [&](double v) { return static_cast<int>(v * cells_.per_cell); };
  const int r0 = cell(std::min(b.ay, b.by) - rim), r1 = cell(std::max(b.ay, b.by) + rim);
  const int c0 = cell(std::min(b.ax, b.bx) - rim), c1 = cell(std::max(b.ax, b.bx) + rim);
  if (r1 - r0 <= 1 && c1 - c0 <= 1) {
    change_run(touch_count_, cell(b.ay), cell(b.ax), cell(b.ax), by);
    change_run(touch_count_, cell(b.by), cell(b.bx), cell(b.bx), by);
    for (int r = r0; r <= r1; ++r) change_run(bound_count_, r, c0, c1, by);
  } else {
    for_each_cell_run(cells_, b.ax, b.ay, b.bx, b.by,
                      [&](int r, int first, int last) { change_run(touch_count_, r, first, last, by); });
    for_each_cell_run(
        cells_, b.ax, b.ay, b.bx, b.by,
        [&](int r, int first, int last) { change_run(bound_count_, r, first, last, by); }, kRim);
  }
  for_each_centre_line(cells_, b.ax, b.ay, b.bx, b.by, [&](int r, int c) {
    dirty_[static_cast<std::size_t>(r)] = 1;
    if (c < cells_.columns) parity_.row(r)[c / 64] ^= std::uint64_t{1} << (c % 64);
  });
}

namespace {

void replace_word(std::uint64_t& word, std::uint64_t to, int row, std::size_t w, std::vector<EdgeRaster::Flip>& flips) {
  for (std::uint64_t bits = word ^ to; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits);
    flips.push_back({row, static_cast<int>(w) * 64 + bit, ((to >> bit) & 1) != 0});
  }
  word = to;
}

}  // namespace

void EdgeRaster::settle(Flips& flips) {
  const auto columns = static_cast<std::size_t>(cells_.columns);
  const auto set_bits = [&](const std::vector<std::uint16_t>& counts, int row, std::size_t w) {
    std::uint64_t bits = 0;
    const std::size_t from = w * 64, to = std::min(columns, from + 64);
    const std::uint16_t* const at = counts.data() + static_cast<std::size_t>(row) * columns;
    for (std::size_t c = from; c < to; ++c) bits |= static_cast<std::uint64_t>(at[c] != 0) << (c - from);
    return bits;
  };
  for (int r = 0; r < cells_.rows; ++r) {
    if (!dirty_[static_cast<std::size_t>(r)]) continue;
    std::uint64_t before = 0;  // all ones where the parity is odd
    for (std::size_t w = 0; w < parity_.words; ++w) {
      std::uint64_t odd = parity_.row(r)[w];
      for (int by = 1; by < 64; by *= 2) odd ^= odd << by;
      odd ^= before;
      before = 0 - (odd >> 63);
      inner_.row(r)[w] = odd & ~set_bits(bound_count_, r, w);
      replace_word(touch_.row(r)[w], inner_.row(r)[w] | set_bits(touch_count_, r, w), r, w, flips.touch);
    }
  }
  // Corner (i, j) looks at columns i - 1 and i of rows j - 1 and j.
  for (int r = 1; r < cells_.rows; ++r) {
    if (!dirty_[static_cast<std::size_t>(r)] && !dirty_[static_cast<std::size_t>(r - 1)]) continue;
    std::uint64_t carry = 0;
    for (std::size_t w = 0; w < inner_.words; ++w) {
      const std::uint64_t both = inner_.row(r)[w] & inner_.row(r - 1)[w];
      replace_word(corners_.row(r)[w], both & ((both << 1) | carry), r, w, flips.corners);
      carry = both >> 63;
    }
  }
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{0});
}

EdgeRaster::Flips EdgeRaster::update(const Operand& before, const Operand& after, const WalkChanges& changes) {
  changes.for_each_gone_edge(before.size(), [&](std::uint32_t e) { change_edge(before, e, -1); });
  for (const std::uint32_t e : changes.new_edges()) change_edge(after, e, 1);
  Flips flips;
  settle(flips);
  return flips;
}

}  // namespace dymsum::planar
