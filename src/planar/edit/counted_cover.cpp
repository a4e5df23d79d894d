#include "planar/edit/counted_cover.h"

#include <algorithm>
#include <bit>
#include <numeric>

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

// counts += the number of pairs of one of each whose sum a cell is. Runs of lengths k and l make a trapezoid,
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

CountedCover::CountedCover(const PlacedPair& placed, int cells) : covered_(0, 0) {
  const Lattice& lattice = *placed.lattice;
  std::array<double, 2> width, height;
  for (std::size_t op = 0; op < 2; ++op) {
    const PlacedPoints& o = *lattice.points[op];
    const double margin = std::max(o.width, o.height) / 16;
    width[op] = o.width + 2 * margin;
    height[op] = o.height + 2 * margin;
    low_[op] = {o.offset.x - margin * lattice.unit, o.offset.y - margin * lattice.unit};
    high_[op] = {low_[op].x + width[op] * lattice.unit, low_[op].y + height[op] * lattice.unit};
  }
  stand_on(lattice);
  const SumGrid grid(width, height, cells);
  grid_ = grid.whole;
  covered_ = Bitmap(grid_.rows, grid_.columns);
  counts_.assign(static_cast<std::size_t>(grid.whole.rows) * static_cast<std::size_t>(grid.whole.columns), 0);
  rasters_.emplace_back(*placed.p, grid.part[0], low_[0], lattice.unit);
  rasters_.emplace_back(*placed.q, grid.part[1], low_[1], lattice.unit);
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

bool CountedCover::holds(const PlacedPair& placed) const {
  const Lattice& lattice = *placed.lattice;
  for (std::size_t op = 0; op < 2; ++op) {
    const PlacedPoints& o = *lattice.points[op];
    if (o.offset.x < low_[op].x || o.offset.y < low_[op].y || o.offset.x + o.width * lattice.unit > high_[op].x ||
        o.offset.y + o.height * lattice.unit > high_[op].y)
      return false;
  }
  return true;
}

void CountedCover::stand_on(const Lattice& lattice) {
  const auto gap = [&](std::size_t op) {
    const Point at = lattice.points[op]->offset;
    return Point{(at.x - low_[op].x) / lattice.unit, (at.y - low_[op].y) / lattice.unit};
  };
  shift_ = {gap(0).x + gap(1).x, gap(0).y + gap(1).y};
}

void CountedCover::count_all() {
  std::fill(counts_.begin(), counts_.end(), 0);
  add_counts(counts_, grid(), rasters_[0].corners(), rasters_[1].touch());
  add_counts(counts_, grid(), rasters_[1].corners(), rasters_[0].touch());
  flipped_.resize(counts_.size());
  std::iota(flipped_.begin(), flipped_.end(), 0u);
}

void CountedCover::add_cells(const std::vector<EdgeRaster::Flip>& flips, const Bitmap& other) {
  const auto columns = static_cast<std::size_t>(grid().columns);
  for (const EdgeRaster::Flip& flip : flips) {
    const std::int32_t change = flip.set ? 1 : -1, edge = flip.set ? 1 : 0;
    for_each_run(other, [&](int r, int first, int last) {
      const std::size_t from = static_cast<std::size_t>(flip.row + r) * columns + static_cast<std::size_t>(flip.column);
      for (std::size_t k = from + static_cast<std::size_t>(first); k <= from + static_cast<std::size_t>(last); ++k)
        if ((counts_[k] += change) == edge) flipped_.push_back(static_cast<std::uint32_t>(k));
    });
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

std::vector<GridCell> CountedCover::update(const PlacedPair& before, const PlacedPair& after,
                                           const std::array<WalkChanges, 2>& changes) {
  changed_cells_ = 0;
  stand_on(*after.lattice);
  const std::array<const Operand*, 2> was{before.p.get(), before.q.get()}, is{after.p.get(), after.q.get()};
  bool many = false;
  for (std::size_t op = 0; op < 2; ++op) {
    if (changes[op].unchanged()) continue;
    const EdgeRaster::Flips flips = rasters_[op].update(*was[op], *is[op], changes[op]);
    const std::size_t cells = flips.corners.size() + flips.touch.size();
    changed_cells_ += cells;
    many |= cells > kFewCells;
    if (many) continue;
    add_cells(flips.corners, rasters_[1 - op].touch());
    add_cells(flips.touch, rasters_[1 - op].corners());
  }
  if (many) count_all();
  return settle();
}

}  // namespace dymsum::planar
