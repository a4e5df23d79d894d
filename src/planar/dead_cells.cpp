#include "planar/dead_cells.h"

#include <bit>
#include <cmath>

namespace dymsum::planar {
namespace {

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

void CentreWindings::add_edge(double ax, double ay, double bx, double by) {
  const int sign = ay < by ? 1 : -1;
  const double low = ay < by ? ay : by, high = ay < by ? by : ay;
  // Rows whose centre line the edge crosses, half-open in y.
  for (int r = static_cast<int>(low * cells_.per_cell); r < cells_.rows; ++r) {
    const double yc = (r + 0.5) * cells_.cell;
    if (yc < low) continue;
    if (yc >= high) break;
    const double xc = ax + (yc - ay) * (bx - ax) / (by - ay);
    // Centres right of the edge; which side one within a rounding of it is counted on does not matter, as its cell is a
    // boundary cell.
    const int c = std::clamp(static_cast<int>(xc * cells_.per_cell + 0.5), 0, cells_.columns);
    change_[std::size_t(r) * (cells_.columns + 1) + c] -= sign;
  }
}

void CentreWindings::fill(const Bitmap& boundary, Raster& raster) const {
  for (int r = 0; r < cells_.rows; ++r) {
    int w = 0;
    for (int c = 0; c < cells_.columns; ++c) {
      w += change_[std::size_t(r) * (cells_.columns + 1) + c];
      if (w > 0 && !boundary.get(r, c)) raster.inner.row(r)[c / 64] |= std::uint64_t{1} << (c % 64);
    }
  }
  for (std::size_t i = 0; i < raster.touch.bits.size(); ++i) raster.touch.bits[i] |= raster.inner.bits[i];
}

SumGrid::SumGrid(std::array<double, 2> width, std::array<double, 2> height, int cells) {
  const double longer = std::max(width[0] + width[1], height[0] + height[1]);
  whole.cell = longer / cells;
  whole.per_cell = cells / longer;
  part = {whole, whole};
  for (int op = 0; op < 2; ++op) {
    part[op].columns = static_cast<int>(width[op] * whole.per_cell) + 2;
    part[op].rows = static_cast<int>(height[op] * whole.per_cell) + 2;
  }
  whole.columns = part[0].columns + part[1].columns;
  whole.rows = part[0].rows + part[1].rows;
}

DeadCells::DeadCells(const Grid& grid) : grid_(grid), dead_(grid.rows, grid.columns) { count(); }

DeadCells::DeadCells(const Grid& grid, const Raster& p, const Raster& q, Counts counts) : grid_(grid), dead_(grid.rows, grid.columns) {
  const Bitmap corners_p = inner_corners(p.inner), corners_q = inner_corners(q.inner);
  // Inner cells that form no block of four still make pairs.
  if (!corners_p.any() || !corners_q.any()) add_sums(dead_, p.inner, q.inner, 1);
  add_sums(dead_, corners_p, q.touch, 0);
  add_sums(dead_, corners_q, p.touch, 0);
  if (counts == Counts::made) count();
}

void DeadCells::count() {
  const std::size_t w = std::size_t(grid_.columns) + 1;
  sums_.assign(w * (grid_.rows + 1), 0);
  for (int r = 0; r < grid_.rows; ++r) {
    std::uint32_t live = 0;
    for (int c = 0; c < grid_.columns; ++c) {
      const bool d = dead(r, c);
      dead_cells_ += d;
      live += !d;
      sums_[(r + 1) * w + c + 1] = sums_[r * w + c + 1] + live;
    }
  }
}

}  // namespace dymsum::planar
