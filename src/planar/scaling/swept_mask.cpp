#include "planar/scaling/swept_mask.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace dymsum::planar {
namespace {

struct Bitmap {
  int rows = 0, columns = 0;
  std::size_t words = 0;
  std::vector<std::uint64_t> bits;

  Bitmap(int r, int c) : rows(r), columns(c), words((c + 63) / 64), bits(words * r, 0) {}
  std::uint64_t* row(int r) { return bits.data() + words * r; }
  const std::uint64_t* row(int r) const { return bits.data() + words * r; }
  bool get(int r, int c) const { return (row(r)[c / 64] >> (c % 64)) & 1; }

  void set_run(int r, int first, int last) {
    std::uint64_t* w = row(r);
    const int a = first / 64, b = last / 64;
    const std::uint64_t head = ~std::uint64_t{0} << (first % 64), tail = ~std::uint64_t{0} >> (63 - last % 64);
    if (a == b) {
      w[a] |= head & tail;
      return;
    }
    w[a] |= head;
    for (int i = a + 1; i < b; ++i) w[i] = ~std::uint64_t{0};
    w[b] |= tail;
  }
};

struct Run {
  int first, last;
};

struct RunRows {
  std::vector<Run> runs;
  std::vector<std::uint32_t> start;
  explicit RunRows(const Bitmap& map) {
    for (int r = 0; r < map.rows; ++r) {
      start.push_back(static_cast<std::uint32_t>(runs.size()));
      append(map, r);
    }
    start.push_back(static_cast<std::uint32_t>(runs.size()));
  }

 private:
  void append(const Bitmap& map, int r) {
    const std::uint64_t* w = map.row(r);
    int c = 0;
    while (c < map.columns) {
      std::uint64_t word = w[c / 64] >> (c % 64);
      if (word == 0) {
        c = (c / 64 + 1) * 64;
        continue;
      }
      c += std::countr_zero(word);
      const int first = c;
      for (;;) {
        word = ~w[c / 64] >> (c % 64);
        if (word != 0) {
          c += std::countr_zero(word);
          break;
        }
        c = (c / 64 + 1) * 64;
        if (c >= map.columns) break;
      }
      c = std::min(c, map.columns);
      runs.push_back({first, c - 1});
    }
  }
};

struct Raster {
  Bitmap inner;  // cells that lie in the interior of a component at every scale, with the rim below
  Bitmap touch;  // cells that hold a point of the operand at every scale, up to the rim
};

// As for the static mask: an inner cell keeps this rim from the boundary, at every scale.
constexpr double kRim = 32 * kReach;

struct Place2 {
  double x, y;
};

// An edge that meets a cell at both ends of the window meets it in between: its places form a plane piece in (x, y, tau), which is convex.
void touch_at_both_ends(const Grid& cells, Place2 a0, Place2 b0, Place2 a1, Place2 b1, std::vector<std::array<int, 3>>& scratch,
                        Bitmap& touch) {
  scratch.clear();
  for_each_cell_run(cells, a0.x, a0.y, b0.x, b0.y, [&](int r, int first, int last) { scratch.push_back({r, first, last}); });
  for_each_cell_run(cells, a1.x, a1.y, b1.x, b1.y, [&](int r, int first, int last) {
    const int k = r - scratch[0][0];
    if (k < 0 || k >= static_cast<int>(scratch.size())) return;
    const int from = std::max(first, scratch[k][1]), to = std::min(last, scratch[k][2]);
    if (from <= to) touch.set_run(r, from, to);
  });
}

template <class At>
Raster rasterize(const Operand& o, const Grid& cells, bool moves, const At& at) {
  Raster raster{Bitmap(cells.rows, cells.columns), Bitmap(cells.rows, cells.columns)};
  Bitmap boundary(cells.rows, cells.columns);
  std::vector<int> winding(std::size_t(cells.rows) * (cells.columns + 1), 0);
  std::vector<std::array<int, 3>> scratch;
  const double rim = kRim * cells.cell;
  for (const Loop& loop : o.loops)
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t s = o.source[i], t = o.source[o.next[i]];
      const Place2 a0 = at(s, 0), b0 = at(t, 0), a1 = moves ? at(s, 1) : a0, b1 = moves ? at(t, 1) : b0;
      const double x[4] = {a0.x, b0.x, b1.x, a1.x}, y[4] = {a0.y, b0.y, b1.y, a1.y};
      for_each_swept_run(cells, x, y, rim, [&](int r, int first, int last) { boundary.set_run(r, first, last); });
      touch_at_both_ends(cells, a0, b0, a1, b1, scratch, raster.touch);
      const double ax = a0.x, ay = a0.y, bx = b0.x, by = b0.y;
      const int sign = ay < by ? 1 : -1;
      const double low = ay < by ? ay : by, high = ay < by ? by : ay;
      const double slope = (bx - ax) / (by - ay);
      // Rows whose centre line the edge crosses, half-open in y.
      int r = static_cast<int>(std::ceil(low * cells.per_cell - 0.5));
      for (r = std::max(r, 0); r < cells.rows; ++r) {
        const double yc = (r + 0.5) * cells.cell;
        if (yc < low) continue;
        if (yc >= high) break;
        const double xc = ax + (yc - ay) * slope;
        const int c = std::clamp(static_cast<int>(std::ceil(xc * cells.per_cell - 0.5)), 0, cells.columns);
        winding[std::size_t(r) * (cells.columns + 1) + c] -= sign;
      }
    }
  for (int r = 0; r < cells.rows; ++r) {
    int w = 0;
    for (int c = 0; c < cells.columns; ++c) {
      w += winding[std::size_t(r) * (cells.columns + 1) + c];
      if (w > 0 && !boundary.get(r, c)) raster.inner.row(r)[c / 64] |= std::uint64_t{1} << (c % 64);
    }
  }
  for (std::size_t i = 0; i < raster.touch.bits.size(); ++i) raster.touch.bits[i] |= raster.inner.bits[i];
  return raster;
}

// Corners (i, j), between columns i - 1 and i and rows j - 1 and j, whose four cells are inner.
Bitmap inner_corners(const Bitmap& inner) {
  Bitmap e(inner.rows, inner.columns);
  for (int r = 1; r < inner.rows; ++r) {
    std::uint64_t carry = 0;
    for (std::size_t w = 0; w < inner.words; ++w) {
      const std::uint64_t both = inner.row(r)[w] & inner.row(r - 1)[w];
      e.row(r)[w] = both & ((both << 1) | carry);
      carry = both >> 63;
    }
  }
  return e;
}

// target |= a row of bits moved right.
void or_shifted(std::uint64_t* target, std::size_t target_words, const std::uint64_t* row, std::size_t words, int shift) {
  const std::size_t skip = static_cast<std::size_t>(shift) / 64;
  const int by = shift % 64;
  std::uint64_t carry = 0;
  for (std::size_t w = 0; w < words; ++w) {
    const std::uint64_t v = row[w];
    target[skip + w] |= (by == 0 ? v : v << by) | carry;
    carry = by == 0 ? 0 : v >> (64 - by);
  }
  if (carry != 0 && skip + words < target_words) target[skip + words] |= carry;
}

// Rows of b widened to the right by 2^m - 1 cells, for m = 0, 1, ...
class WidenedRows {
 public:
  WidenedRows(const Bitmap& b, int widest) : words_((b.columns + widest + 63) / 64 + 1), rows_(b.rows) {
    levels_.push_back(std::vector<std::uint64_t>(words_ * b.rows, 0));
    for (int r = 0; r < b.rows; ++r) std::copy(b.row(r), b.row(r) + b.words, levels_[0].begin() + static_cast<std::ptrdiff_t>(words_ * r));
    for (int width = 1; 2 * width <= widest; width *= 2) {
      levels_.push_back(levels_.back());
      const std::vector<std::uint64_t>& from = levels_[levels_.size() - 2];
      for (int r = 0; r < b.rows; ++r) or_shifted(&levels_.back()[words_ * r], words_, &from[words_ * r], used(b.columns + width), width);
    }
  }
  /// target |= row r of b, widened to runs of `width`, moved right by `shift`: two overlapping widenings of a power of two.
  void add(std::uint64_t* target, std::size_t target_words, int r, int width, int shift) const {
    const int level = std::bit_width(static_cast<unsigned>(width)) - 1;
    const std::uint64_t* row = &levels_[static_cast<std::size_t>(level)][words_ * r];
    const std::size_t words = std::min(words_, target_words - static_cast<std::size_t>(shift) / 64);
    or_shifted(target, target_words, row, words, shift);
    const int rest = width - (1 << level);
    if (rest > 0) or_shifted(target, target_words, row, std::min(words_, target_words - static_cast<std::size_t>(shift + rest) / 64), shift + rest);
  }

 private:
  std::size_t used(int columns) const { return std::min(words_, static_cast<std::size_t>((columns + 63) / 64)); }
  std::size_t words_;
  int rows_;
  std::vector<std::vector<std::uint64_t>> levels_;
};

// target |= a + b, plus [0, spread] in both axes.
void add_sums(Bitmap& target, const Bitmap& a, const Bitmap& b, int spread) {
  const RunRows runs(a);
  int widest = 1;
  for (const Run& run : runs.runs) widest = std::max(widest, run.last - run.first + 1 + spread);
  const WidenedRows wide(b, widest);
  std::vector<std::uint8_t> filled(static_cast<std::size_t>(b.rows), 0);
  for (int r = 0; r < b.rows; ++r)
    for (std::size_t w = 0; w < b.words; ++w) filled[static_cast<std::size_t>(r)] |= b.row(r)[w] != 0;
  for (int i = 0; i < a.rows; ++i)
    for (std::uint32_t k = runs.start[i]; k < runs.start[i + 1]; ++k)
      for (int j = 0; j < b.rows; ++j) {
        if (!filled[static_cast<std::size_t>(j)]) continue;
        for (int d = 0; d <= spread; ++d)
          wide.add(target.row(i + j + d), target.words, j, runs.runs[k].last - runs.runs[k].first + 1 + spread, runs.runs[k].first);
      }
}

}  // namespace

SweptMask::SweptMask(const Lattice& unscaled, const std::array<Operand, 2>& operands, const WindowFrame& frame, int cells, bool use) {
  std::array<double, 2> width{unscaled.points[0]->width, unscaled.points[1]->width};
  std::array<double, 2> height{unscaled.points[0]->height, unscaled.points[1]->height};
  width[frame.moving] *= frame.tau1;
  height[frame.moving] *= frame.tau1;
  const double longer = std::max(width[0] + width[1], height[0] + height[1]);
  Grid g;
  g.cell = longer / cells;
  g.per_cell = cells / longer;
  std::array<Grid, 2> part{g, g};
  for (int op = 0; op < 2; ++op) {
    part[op].columns = static_cast<int>(width[op] * g.per_cell) + 2;
    part[op].rows = static_cast<int>(height[op] * g.per_cell) + 2;
  }
  grid_ = g;
  grid_.columns = part[0].columns + part[1].columns;
  grid_.rows = part[0].rows + part[1].rows;
  Bitmap dead(grid_.rows, grid_.columns);
  if (use) {
    const auto raster = [&](std::uint32_t op) {
      const std::vector<double>&x = unscaled.points[op]->x, &y = unscaled.points[op]->y;
      if (op != frame.moving) return rasterize(operands[op], part[op], false, [&](std::uint32_t v, int) { return Place2{x[v], y[v]}; });
      return rasterize(operands[op], part[op], true, [&](std::uint32_t v, int end) {
        const double tau = end == 0 ? frame.tau0 : frame.tau1;
        return Place2{tau * x[v] + frame.shift_x(tau), tau * y[v] + frame.shift_y(tau)};
      });
    };
    const Raster rp = raster(0), rq = raster(1);
    const Bitmap corners_p = inner_corners(rp.inner), corners_q = inner_corners(rq.inner);
    const auto any = [](const Bitmap& map) { return std::any_of(map.bits.begin(), map.bits.end(), [](std::uint64_t w) { return w != 0; }); };
    // Inner cells that form no block of four still make pairs.
    if (!any(corners_p) || !any(corners_q)) add_sums(dead, rp.inner, rq.inner, 1);
    add_sums(dead, corners_p, rq.touch, 0);
    add_sums(dead, corners_q, rp.touch, 0);
  }
  words_ = dead.words;
  bits_ = std::move(dead.bits);
  const std::size_t w = std::size_t(grid_.columns) + 1;
  sums_.assign(w * (grid_.rows + 1), 0);
  for (int r = 0; r < grid_.rows; ++r) {
    std::uint32_t live = 0;
    for (int c = 0; c < grid_.columns; ++c) {
      const bool d = this->dead(r, c);
      dead_cells_ += d;
      live += !d;
      sums_[(r + 1) * w + c + 1] = sums_[r * w + c + 1] + live;
    }
  }
}

}  // namespace dymsum::planar
