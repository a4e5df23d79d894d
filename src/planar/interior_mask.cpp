#include "planar/interior_mask.h"

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

// Runs of set bits of one row.
void append_runs(const Bitmap& map, int r, std::vector<Run>& runs) {
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

struct RunRows {
  std::vector<Run> runs;
  std::vector<std::uint32_t> start;
  explicit RunRows(const Bitmap& map) {
    for (int r = 0; r < map.rows; ++r) {
      start.push_back(static_cast<std::uint32_t>(runs.size()));
      append_runs(map, r, runs);
    }
    start.push_back(static_cast<std::uint32_t>(runs.size()));
  }
};

// One operand on the lattice of cells.
struct Raster {
  Bitmap inner;  // cells that lie in the interior of a component, with the rim below
  Bitmap touch;  // cells that certainly hold a point of the operand, up to the rim
};

// Boundary cells are those within 32 kReach cells of the boundary, so that an inner cell keeps a rim of that width.
constexpr double kRim = 32 * kReach;

Raster rasterize(const Operand& o, const Grid& cells) {
  Raster raster{Bitmap(cells.rows, cells.columns), Bitmap(cells.rows, cells.columns)};
  Bitmap boundary(cells.rows, cells.columns);
  std::vector<int> winding(std::size_t(cells.rows) * (cells.columns + 1), 0);
  const double rim = kRim * cells.cell;
  bool has_area = false;
  for (const Loop& loop : o.loops) {
    const bool area = loop.kind == LoopKind::outer || loop.kind == LoopKind::hole;
    has_area |= area;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t t = o.next[i];
      const double ax = o.x[i], ay = o.y[i], bx = o.x[t], by = o.y[t];
      const int r0 = cells.row(std::min(ay, by) - rim), c0 = cells.column(std::min(ax, bx) - rim);
      if (r0 == cells.row(std::max(ay, by) + rim) && c0 == cells.column(std::max(ax, bx) + rim)) {
        // Inside one cell with its rim: the common case of fine operands.
        raster.touch.set_run(r0, c0, c0);
        if (area) boundary.set_run(r0, c0, c0);
        if (!area || (ay - (r0 + 0.5) * cells.cell < 0) == (by - (r0 + 0.5) * cells.cell < 0)) continue;
      } else {
        for_each_cell_run(cells, ax, ay, bx, by, [&](int r, int first, int last) { raster.touch.set_run(r, first, last); });
        if (!area) continue;
        for_each_cell_run(cells, ax, ay, bx, by, [&](int r, int first, int last) { boundary.set_run(r, first, last); }, kRim);
      }
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
  }
  if (!has_area) return raster;
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

// target |= a + b, plus [0, spread] in both axes: all sums of a cell (or corner) of a and a cell of b.
void add_sums(Bitmap& target, const RunRows& a, int rows_a, const RunRows& b, int rows_b, int spread) {
  for (int i = 0; i < rows_a; ++i)
    for (std::uint32_t k = a.start[i]; k < a.start[i + 1]; ++k)
      for (int j = 0; j < rows_b; ++j)
        for (std::uint32_t l = b.start[j]; l < b.start[j + 1]; ++l)
          for (int d = 0; d <= spread; ++d)
            target.set_run(i + j + d, a.runs[k].first + b.runs[l].first, a.runs[k].last + b.runs[l].last + spread);
}

}  // namespace

InteriorMask::InteriorMask(const Operand& p, const Operand& q, int cells) {
  const std::array<double, 2> width{p.points->width, q.points->width};
  const std::array<double, 2> height{p.points->height, q.points->height};
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
  const Raster rp = rasterize(p, part[0]), rq = rasterize(q, part[1]);
  Bitmap dead(grid_.rows, grid_.columns);
  const RunRows inner_p(rp.inner), inner_q(rq.inner), touch_p(rp.touch), touch_q(rq.touch);
  const RunRows corners_p(inner_corners(rp.inner)), corners_q(inner_corners(rq.inner));
  // Inner cells that form no block of four still make pairs.
  if (corners_p.runs.empty() || corners_q.runs.empty()) add_sums(dead, inner_p, part[0].rows, inner_q, part[1].rows, 1);
  add_sums(dead, corners_p, part[0].rows, touch_q, part[1].rows, 0);
  add_sums(dead, touch_p, part[0].rows, corners_q, part[1].rows, 0);
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
