#include "planar/mask/interior_mask.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

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

// target |= a row of bits moved right.
void or_shifted(std::uint64_t* target, std::size_t target_words, const std::uint64_t* row, std::size_t words,
                int shift) {
  const std::size_t skip = static_cast<std::size_t>(shift) / 64;
  const int by = shift % 64;
  target += skip;
  const std::size_t room = target_words - skip, n = std::min(words, room);
  if (by == 0) {
    for (std::size_t w = 0; w < n; ++w) target[w] |= row[w];
    return;
  }
  target[0] |= row[0] << by;
  for (std::size_t w = 1; w < n; ++w) target[w] |= (row[w] << by) | (row[w - 1] >> (64 - by));
  if (words < room) target[words] |= row[words - 1] >> (64 - by);
}

// The rows of a bitmap that hold anything, widened to the right by some cells more each time.
class WidenedRows {
 public:
  WidenedRows(const Bitmap& b, int widest)
      : words_((static_cast<std::size_t>(b.columns + widest) + 63) / 64), columns_(b.columns) {
    for (int r = 0; r < b.rows; ++r) {
      if (std::none_of(b.row(r), b.row(r) + b.words, [](std::uint64_t w) { return w != 0; })) continue;
      rows_.push_back(r);
      bits_.insert(bits_.end(), b.row(r), b.row(r) + b.words);
      bits_.resize(words_ * rows_.size(), 0);
    }
  }
  /// Requires: no less than the last time.
  void widen_to(int width) {
    while (width_ < width) {
      const int by = std::min(width_, width - width_);
      for (std::size_t k = 0; k < rows_.size(); ++k) widen(&bits_[words_ * k], by);
      width_ += by;
    }
  }
  /// Calls f(row, bits, words) for every row.
  template <class F>
  void for_each(F&& f) const {
    const std::size_t words = std::min(words_, (static_cast<std::size_t>(columns_ + width_ - 1) + 63) / 64);
    for (std::size_t k = 0; k < rows_.size(); ++k) f(rows_[k], &bits_[words_ * k], words);
  }

 private:
  // row |= row moved right, from its end on as it is read before it is written.
  void widen(std::uint64_t* row, int by) const {
    const std::size_t skip = static_cast<std::size_t>(by) / 64;
    const int shift = by % 64;
    for (std::size_t w = words_; w-- > skip;)
      row[w] |= (row[w - skip] << shift) | (shift == 0 || w == skip ? 0 : row[w - skip - 1] >> (64 - shift));
  }

  std::size_t words_;
  int columns_, width_ = 1;
  std::vector<int> rows_;
  std::vector<std::uint64_t> bits_;
};

// target |= a + b, plus [0, spread] in both axes. The runs of a of one length are added together, to rows of b that are
// as much wider.
void add_runs(Bitmap& target, const RunRows& a, const Bitmap& b, int spread) {
  struct Placed {
    int width, row, column;
  };
  std::vector<Placed> runs;
  runs.reserve(a.runs.size());
  for (std::size_t i = 0; i + 1 < a.start.size(); ++i)
    for (std::uint32_t k = a.start[i]; k < a.start[i + 1]; ++k)
      runs.push_back({a.runs[k].last - a.runs[k].first + 1 + spread, static_cast<int>(i), a.runs[k].first});
  if (runs.empty()) return;
  std::stable_sort(runs.begin(), runs.end(), [](const Placed& x, const Placed& y) { return x.width < y.width; });
  WidenedRows wide(b, runs.back().width);
  for (const Placed& run : runs) {
    wide.widen_to(run.width);
    wide.for_each([&](int row, const std::uint64_t* bits, std::size_t words) {
      for (int d = 0; d <= spread; ++d)
        or_shifted(target.row(run.row + row + d), target.words, bits, words, run.column);
    });
  }
}

// One interval for every row, none at first; in blocks, after the last row too, for comparing several at once.
struct Intervals {
  static constexpr std::size_t kBlock = 8;
  std::vector<int> first, last;
  /// An empty interval starts at `far` and ends at -far: with a smaller one that holds no run but the farther empty
  /// ones.
  Intervals(std::size_t rows, int far) : first(rows + kBlock, far), last(rows + kBlock, -far) {}
  void set(std::size_t row, Run run) {
    first[row] = run.first;
    last[row] = run.last;
  }
};

// Calls f(k) for the rows k in [0, n) of b for which run + b's interval does not lie in that of row `at` + k of
// `known`. f changes that.
template <class F>
void for_each_beyond(Run run, const Intervals& b, std::size_t n, const Intervals& known, std::size_t at, F&& f) {
  for (std::size_t k = 0; k < n; k += Intervals::kBlock) {
    const int *const b_first = &b.first[k], *const b_last = &b.last[k];
    const int *const known_first = &known.first[at + k], *const known_last = &known.last[at + k];
    int beyond = 0;
    for (std::size_t i = 0; i < Intervals::kBlock; ++i)
      beyond |= static_cast<int>(run.first + b_first[i] < known_first[i]) |
                static_cast<int>(run.last + b_last[i] > known_last[i]);
    if (beyond == 0) continue;
    for (std::size_t i = 0; i < Intervals::kBlock; ++i)
      if (run.first + b_first[i] < known_first[i] || run.last + b_last[i] > known_last[i]) f(k + i);
  }
}

// The same run by run. Of every row of the target one interval that is full is known, and what lies in it is not added
// once more: in sums of solid operands nearly everything, once the longest runs have been added.
void add_run_pairs(Bitmap& target, const RunRows& a, const RunRows& b, int spread) {
  const std::size_t rows_a = a.start.size() - 1, rows_b = b.start.size() - 1;
  const auto runs = [](const RunRows& map, std::size_t row) {
    return std::span<const Run>(map.runs.data() + map.start[row], map.runs.data() + map.start[row + 1]);
  };
  const auto longest = [](std::span<const Run> row) {
    return *std::max_element(row.begin(), row.end(), [](Run x, Run y) { return x.last - x.first < y.last - y.first; });
  };
  constexpr int kFar = 1 << 28;
  Intervals longest_b(rows_b, 2 * kFar), extent_b(rows_b, 2 * kFar),
      full(rows_a + rows_b + static_cast<std::size_t>(spread), kFar);
  for (std::size_t r = 0; r < rows_b; ++r)
    if (const auto row = runs(b, r); !row.empty()) {
      longest_b.set(r, longest(row));
      extent_b.set(r, {row.front().first, row.back().last});
    }
  const auto add = [&](std::size_t row, Run run) {
    const Run known{full.first[row], full.last[row]};
    if (run.first >= known.first && run.last <= known.last) return;
    const int r = static_cast<int>(row);
    if (run.first <= known.last + 1 && run.last + 1 >= known.first) {
      if (run.first < known.first) target.set_run(r, run.first, known.first);
      if (run.last > known.last) target.set_run(r, known.last, run.last);
      full.set(row, {std::min(run.first, known.first), std::max(run.last, known.last)});
      return;
    }
    target.set_run(r, run.first, run.last);
    if (run.last - run.first > known.last - known.first) full.set(row, run);
  };
  const auto wider = [&](Run run) { return Run{run.first, run.last + spread}; };
  struct Row {
    std::size_t row;
    Run longest;
  };
  std::vector<Row> order;
  for (std::size_t r = 0; r < rows_a; ++r)
    if (const auto row = runs(a, r); !row.empty()) order.push_back({r, wider(longest(row))});
  std::stable_sort(order.begin(), order.end(), [](const Row& x, const Row& y) {
    return x.longest.last - x.longest.first > y.longest.last - y.longest.first;
  });
  for (std::size_t d = 0; d <= static_cast<std::size_t>(spread); ++d) {
    for (const Row& a_row : order)
      for_each_beyond(a_row.longest, longest_b, rows_b, full, a_row.row + d, [&](std::size_t k) {
        add(a_row.row + d + k, {a_row.longest.first + longest_b.first[k], a_row.longest.last + longest_b.last[k]});
      });
    for (const Row& a_row : order) {
      const auto row = runs(a, a_row.row);
      const Run extent = wider({row.front().first, row.back().last});
      for_each_beyond(extent, extent_b, rows_b, full, a_row.row + d, [&](std::size_t k) {
        for (const Run& u : row)
          for (const Run& v : runs(b, k)) add(a_row.row + d + k, wider({u.first + v.first, u.last + v.last}));
      });
    }
  }
}

// Adds sums by pairs of runs, or by the runs of the one that has fewer of them and the other's words: whatever is less
// work.
void add_sums(Bitmap& target, const Bitmap& a, const Bitmap& b, int spread) {
  const RunRows runs_a(a), runs_b(b);
  const double per_word = 0.8;  // of one pair of runs
  const double words =
      static_cast<double>(std::min(runs_a.runs.size() * b.bits.size(), runs_b.runs.size() * a.bits.size()));
  if (static_cast<double>(runs_a.runs.size()) * static_cast<double>(runs_b.runs.size()) < per_word * words)
    return add_run_pairs(target, runs_a, runs_b, spread);
  if (runs_a.runs.size() * b.bits.size() <= runs_b.runs.size() * a.bits.size())
    return add_runs(target, runs_a, b, spread);
  add_runs(target, runs_b, a, spread);
}

}  // namespace

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

void CentreWindings::add_edge(double ax, double ay, double bx, double by) {
  const int sign = ay < by ? 1 : -1;
  for_each_centre_line(cells_, ax, ay, bx, by,
                       [&](int r, int c) { change_[std::size_t(r) * (cells_.columns + 1) + c] -= sign; });
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

void CentreParities::add_edge(double ax, double ay, double bx, double by) {
  for_each_centre_line(cells_, ax, ay, bx, by, [&](int r, int c) {
    if (c < cells_.columns) change_.row(r)[c / 64] ^= std::uint64_t{1} << (c % 64);
  });
}

void CentreParities::fill(const Bitmap& boundary, Raster& raster) const {
  for (int r = 0; r < cells_.rows; ++r) {
    std::uint64_t before = 0;  // all ones where the parity is odd
    for (std::size_t w = 0; w < change_.words; ++w) {
      std::uint64_t odd = change_.row(r)[w];
      for (int by = 1; by < 64; by *= 2) odd ^= odd << by;
      odd ^= before;
      before = 0 - (odd >> 63);
      const std::uint64_t inner = odd & ~boundary.row(r)[w];
      raster.inner.row(r)[w] |= inner;
      raster.touch.row(r)[w] |= inner;
    }
  }
}

SumGrid::SumGrid(std::array<double, 2> width, std::array<double, 2> height, int cells) {
  constexpr double kLeast = 0x1p-900;  // two points have no size
  const double longer = std::max({width[0] + width[1], height[0] + height[1], kLeast});
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

CoveredCells::CoveredCells(const Grid& grid, Counts counts) : grid_(grid), covered_(grid.rows, grid.columns) {
  if (counts == Counts::made) count();
}

CoveredCells::CoveredCells(const Grid& grid, const Raster& p, const Raster& q, Counts counts)
    : grid_(grid), covered_(grid.rows, grid.columns) {
  const Bitmap corners_p = inner_corners(p.inner), corners_q = inner_corners(q.inner);
  // Inner cells that form no block of four still make pairs.
  if (!corners_p.any() || !corners_q.any()) add_sums(covered_, p.inner, q.inner, 1);
  add_sums(covered_, corners_p, q.touch, 0);
  add_sums(covered_, corners_q, p.touch, 0);
  if (counts == Counts::made) count();
}

void CoveredCells::add(const Bitmap& inside) {
  for (std::size_t i = 0; i < covered_.bits.size(); ++i) covered_.bits[i] |= inside.bits[i];
}

void CoveredCells::count() {
  const std::size_t w = std::size_t(grid_.columns) + 1;
  covered_cells_ = 0;
  sums_.assign(w * (grid_.rows + 1), 0);
  for (int r = 0; r < grid_.rows; ++r) {
    std::uint32_t live = 0;
    for (int c = 0; c < grid_.columns; ++c) {
      const bool d = covered(r, c);
      covered_cells_ += d;
      live += !d;
      sums_[(r + 1) * w + c + 1] = sums_[r * w + c + 1] + live;
    }
  }
}

namespace {

// Rasterizes with the centres' winding numbers or parities.
template <class Centres>
Raster rasterize(const Operand& o, const Grid& cells) {
  RasterMaker<Centres> maker(cells);
  const double rim = kRim * cells.cell;
  // No clamps are needed: coordinates are not negative, and the raster reaches farther than the operand by a cell.
  const auto cell = [&](double v) { return static_cast<int>(v * cells.per_cell); };
  bool has_area = false;
  for (const Loop& loop : o.loops) {
    const bool area = loop.kind == LoopKind::outer || loop.kind == LoopKind::hole;
    has_area |= area;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) {
      const std::uint32_t t = o.next[i];
      const double ax = o.x[i], ay = o.y[i], bx = o.x[t], by = o.y[t];
      const int r0 = cell(std::min(ay, by) - rim), r1 = cell(std::max(ay, by) + rim);
      const int c0 = cell(std::min(ax, bx) - rim), c1 = cell(std::max(ax, bx) + rim);
      if (r1 - r0 <= 1 && c1 - c0 <= 1) {
        // Most edges of fine operands: the cells of both ends, and for the boundary the whole box.
        maker.touched().set(cell(ay), cell(ax));
        maker.touched().set(cell(by), cell(bx));
        if (!area) continue;
        maker.bound(r0, c0, c1);
        if (r1 != r0) maker.bound(r1, c0, c1);
      } else {
        maker.touch_edge(ax, ay, bx, by);
        if (!area) continue;
        maker.bound_edge(ax, ay, bx, by, kRim);
      }
      maker.wind_edge(ax, ay, bx, by);
    }
  }
  return has_area ? std::move(maker).with_area() : std::move(maker).without_area();
}

CoveredCells covered_cells_of(const Operand& p, const Operand& q, int cells) {
  const SumGrid grid({p.points->width, q.points->width}, {p.points->height, q.points->height}, cells);
  return CoveredCells(grid.whole, rasterize<CentreWindings>(p, grid.part[0]),
                      rasterize<CentreWindings>(q, grid.part[1]), CoveredCells::Counts::left_out);
}

}  // namespace

InteriorMask::InteriorMask(const Operand& p, const Operand& q, int cells)
    : CoveredCells(covered_cells_of(p, q, cells)), cells_(cells) {}

Raster fine_raster(const Operand& o, const Grid& cells) { return rasterize<CentreParities>(o, cells); }
Raster winding_raster(const Operand& o, const Grid& cells) { return rasterize<CentreWindings>(o, cells); }

}  // namespace dymsum::planar
