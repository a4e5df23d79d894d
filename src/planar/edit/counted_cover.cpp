#include "planar/edit/counted_cover.h"

#include <algorithm>
#include <bit>

namespace dymsum::planar {
namespace {

// Calls f(row, first, last) for every run of set bits.
template <class F>
void for_each_run(const Bitmap& map, F&& f) {
  for (int r = 0; r < map.rows; ++r) {
    const std::uint64_t* const w = map.row(r);
    for (int c = 0; c < map.columns;) {
      const std::uint64_t word = w[c / 64] >> (c % 64);
      if (word == 0) {
        c = (c / 64 + 1) * 64;
        continue;
      }
      c += std::countr_zero(word);
      const int first = c;
      while (c < map.columns && map.get(r, c)) {
        const std::uint64_t gap = ~w[c / 64] >> (c % 64);
        c = gap == 0 ? (c / 64 + 1) * 64 : c + std::countr_zero(gap);
      }
      c = std::min(c, map.columns);
      f(r, first, c - 1);
    }
  }
}

// More changed cells than this are counted anew from all runs.
constexpr std::uint64_t kFewCells = 400;

std::uint64_t differing(const Bitmap& a, const Bitmap& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.bits.size(); ++i)
    count += static_cast<std::uint64_t>(std::popcount(a.bits[i] ^ b.bits[i]));
  return count;
}

// counts += the number of ways in which a cell is a sum of one of each. Runs of lengths k and l make a trapezoid,
// whose second differences are four numbers.
void add_counts(std::vector<std::int32_t>& counts, const Grid& grid, const Bitmap& a, const Bitmap& b) {
  const std::size_t width = static_cast<std::size_t>(grid.columns) + 2;
  std::vector<std::int32_t> second(width * static_cast<std::size_t>(grid.rows), 0);
  for_each_run(a, [&](int row, int first, int last) {
    for_each_run(b, [&](int other_row, int other_first, int other_last) {
      std::int32_t* const at = &second[static_cast<std::size_t>(row + other_row) * width];
      ++at[first + other_first];
      --at[last + 1 + other_first];
      --at[first + other_last + 1];
      ++at[last + other_last + 2];
    });
  });
  for (int r = 0; r < grid.rows; ++r) {
    const std::int32_t* const at = &second[static_cast<std::size_t>(r) * width];
    std::int32_t* const to = &counts[static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns)];
    std::int32_t slope = 0, count = 0;
    for (int c = 0; c < grid.columns; ++c) {
      slope += at[c];
      count += slope;
      to[c] += count;
    }
  }
}

}  // namespace

CountedCover::CountedCover(const Operand& p, const Operand& q, int cells)
    : width_{p.points->width, q.points->width},
      height_{p.points->height, q.points->height},
      covered_(0, 0) {
  const SumGrid grid(width_, height_, cells);
  part_ = grid.part;
  grid_ = grid.whole;
  covered_ = Bitmap(grid_.rows, grid_.columns);
  counts_.assign(static_cast<std::size_t>(grid.whole.rows) * static_cast<std::size_t>(grid.whole.columns), 0);
  proofs_.push_back(proofs_of(p, part_[0]));
  proofs_.push_back(proofs_of(q, part_[1]));
  count_all();
  settle();
}

bool CountedCover::any_live(int row0, int column0, int row1, int column1) const {
  const std::size_t a = static_cast<std::size_t>(column0) / 64, b = static_cast<std::size_t>(column1) / 64;
  const std::uint64_t head = ~std::uint64_t{0} << (column0 % 64), tail = ~std::uint64_t{0} >> (63 - column1 % 64);
  for (int r = row0; r <= row1; ++r) {
    const std::uint64_t* const w = covered_.row(r);
    for (std::size_t i = a; i <= b; ++i)
      if ((~w[i] & (i == a ? head : ~std::uint64_t{0}) & (i == b ? tail : ~std::uint64_t{0})) != 0) return true;
  }
  return false;
}

bool CountedCover::holds(const Operand& p, const Operand& q) const {
  return p.points->width <= width_[0] && p.points->height <= height_[0] && q.points->width <= width_[1] &&
         q.points->height <= height_[1];
}

CountedCover::Proofs CountedCover::proofs_of(const Operand& o, const Grid& cells) const {
  Raster raster = fine_raster(o, cells);
  return {inner_corners(raster.inner), std::move(raster.touch)};
}

void CountedCover::count_all() {
  std::fill(counts_.begin(), counts_.end(), 0);
  add_counts(counts_, grid(), proofs_[0].corners, proofs_[1].touch);
  add_counts(counts_, grid(), proofs_[1].corners, proofs_[0].touch);
  for (std::uint32_t k = 0; k < counts_.size(); ++k) flipped_.push_back(k);
}

void CountedCover::add_cell(int row, int column, int change, const Bitmap& other) {
  const int columns = grid().columns;
  for_each_run(other, [&](int r, int first, int last) {
    const std::size_t from = static_cast<std::size_t>(row + r) * static_cast<std::size_t>(columns) +
                             static_cast<std::size_t>(column + first);
    for (std::size_t k = from, end = from + static_cast<std::size_t>(last - first); k <= end; ++k) {
      counts_[k] += change;
      if (counts_[k] == (change > 0 ? 1 : 0)) flipped_.push_back(static_cast<std::uint32_t>(k));
    }
  });
}

void CountedCover::replace(const Bitmap& before, const Bitmap& after, const Bitmap& other) {
  for (int r = 0; r < before.rows; ++r)
    for (std::size_t w = 0; w < before.words; ++w)
      for (std::uint64_t bits = before.row(r)[w] ^ after.row(r)[w]; bits != 0; bits &= bits - 1) {
        const int c = static_cast<int>(w) * 64 + std::countr_zero(bits);
        add_cell(r, c, after.get(r, c) ? 1 : -1, other);
        ++changed_cells_;
      }
}

// Brings the covered cells in line with the counts; those that are covered no longer.
std::vector<GridCell> CountedCover::settle() {
  std::vector<GridCell> lost;
  const auto columns = static_cast<std::uint32_t>(grid().columns);
  for (const std::uint32_t k : flipped_) {
    const GridCell cell{static_cast<int>(k / columns), static_cast<int>(k % columns)};
    const bool was = covered(cell.row, cell.column), is = counts_[k] > 0;
    if (was == is) continue;
    covered_.row(cell.row)[cell.column / 64] ^= std::uint64_t{1} << (cell.column % 64);
    if (!is) lost.push_back(cell);
  }
  flipped_.clear();
  return lost;
}

std::vector<GridCell> CountedCover::update(const std::array<const Operand*, 2>& operands,
                                           const std::array<bool, 2>& changed) {
  changed_cells_ = 0;
  for (std::size_t op = 0; op < 2; ++op) {
    if (!changed[op]) continue;
    Proofs after = proofs_of(*operands[op], part_[op]);
    Proofs &before = proofs_[op], &other = proofs_[1 - op];
    if (differing(before.corners, after.corners) + differing(before.touch, after.touch) > kFewCells) {
      before = std::move(after);
      changed_cells_ += kFewCells;
      count_all();
      continue;
    }
    replace(before.corners, after.corners, other.touch);
    replace(before.touch, after.touch, other.corners);
    before = std::move(after);
  }
  return settle();
}

}  // namespace dymsum::planar
