#include "planar/mask/fine_cells.h"

#include <algorithm>
#include <array>

namespace dymsum::planar {

Bricks::Bricks(const Bitmap& cells)
    : rows_((cells.rows + kBrick - 1) / kBrick), columns_((cells.columns + kBrick - 1) / kBrick) {
  const std::size_t width = static_cast<std::size_t>(columns_) + 2;
  words_.assign(width * (static_cast<std::size_t>(rows_) + 2), 0);
  for (int r = 0; r < cells.rows; ++r) {
    std::uint64_t* const to = &words_[static_cast<std::size_t>(r / kBrick + 1) * width + 1];
    const int shift = r % kBrick * 8;
    for (int c = 0; c < columns_; ++c) to[c] |= ((cells.row(r)[c / 8] >> (c % 8 * 8)) & 0xff) << shift;
  }
}

namespace {

// A word of zeros before and after what is read at any position.
constexpr int kMargin = 64;

Bitmap occupied(const Bricks& bricks) {
  Bitmap map(bricks.rows(), bricks.columns());
  for (int r = 0; r < map.rows; ++r)
    for (int c = 0; c < map.columns; ++c)
      if (bricks.at(r, c) != 0) map.set(r, c);
  return map;
}

Bitmap reversed_neighbourhoods(const Bricks& bricks) {
  Bitmap map(bricks.rows() + 1, bricks.columns() + 1 + 3 * kMargin);
  for (int r = 0; r <= bricks.rows(); ++r)
    for (int c = 0; c <= bricks.columns(); ++c)
      if ((bricks.at(r, c) | bricks.at(r - 1, c) | bricks.at(r, c - 1) | bricks.at(r - 1, c - 1)) != 0)
        map.set(r, kMargin + bricks.columns() - c);
  return map;
}

Grid finer(const Grid& g, int factor) {
  return {g.cell / factor, g.per_cell * factor, g.columns * factor, g.rows * factor};
}

}  // namespace

BrickPairs::BrickPairs(const Bitmap& corners, const Bitmap& touch)
    : corners_(corners),
      touch_(touch),
      some_corner_(occupied(corners_)),
      touch_reversed_(reversed_neighbourhoods(touch_)) {}

// Those of one brick of corners.
std::uint64_t BrickPairs::with(Position a, Position sum, std::uint64_t known) const {
  const int r = sum.row - a.row, c = sum.column - a.column;
  if (a.row < 0 || a.column < 0 || a.row >= corners_.rows() || a.column >= corners_.columns() || r < 0 || c < 0 ||
      r > touch_.rows() || c > touch_.columns())
    return known;
  return brick_sum(corners_.at(a.row, a.column),
                   {touch_.at(r - 1, c - 1), touch_.at(r - 1, c), touch_.at(r, c - 1), touch_.at(r, c)}, known);
}

std::uint64_t BrickPairs::with_recent(Position sum, std::uint64_t known) const {
  for (const Success& s : recent_) {
    known = with(s.corner, sum, known);
    known = with({s.corner.row + sum.row - s.sum.row, s.corner.column + sum.column - s.sum.column}, sum, known);
    if (known == ~std::uint64_t{0}) break;
  }
  return known;
}

void BrickPairs::remember(Position corner, Position sum) {
  if (recent_.size() < kRecent) recent_.push_back({corner, sum});
  else recent_[next_recent_++ % kRecent] = {corner, sum};
}

std::uint64_t BrickPairs::covered(int row, int column, std::uint64_t known) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  const Position sum{row, column};
  known = with_recent(sum, known);
  const int width = touch_.columns();
  const int first = std::max(0, column - width), last = std::min(corners_.columns() - 1, column);
  if (first > last) return known;
  // The touched bricks are read backwards: brick `column - a` is bit a + shift.
  const int shift = kMargin + width - column;
  for (int r = std::max(0, row - touch_.rows()); r <= std::min(corners_.rows() - 1, row) && known != kAll; ++r) {
    const std::uint64_t* const own = some_corner_.row(r);
    const std::uint64_t* const other = touch_reversed_.row(row - r);
    for (int w = first / 64; w <= last / 64 && known != kAll; ++w) {
      std::uint64_t both = own[w];
      if (both == 0) continue;
      const int from = 64 * w + shift, by = from % 64;  // more than column - width - 64 + shift = 0
      const std::uint64_t* const at = other + from / 64;
      both &= by == 0 ? at[0] : (at[0] >> by) | (at[1] << (64 - by));
      for (; both != 0 && known != kAll; both &= both - 1) {
        const Position corner{r, 64 * w + std::countr_zero(both)};
        const std::uint64_t more = with(corner, sum, known);
        if (more == known) continue;
        known = more;
        remember(corner, sum);
      }
    }
  }
  return known;
}

std::size_t BrickPairs::bytes() const {
  return corners_.bytes() + touch_.bytes() +
         (some_corner_.bits.size() + touch_reversed_.bits.size()) * sizeof some_corner_.bits[0];
}

FineCells::FineCells(InteriorMask& mask)
    : mask_(&mask),
      grid_(finer(mask.grid(), kBrick)),
      brick_(static_cast<std::size_t>(grid_.rows / kBrick) * (grid_.columns / kBrick), kWhole) {}

FineCells::FineCells(const Operand& p, const Operand& q, InteriorMask& mask) : FineCells(mask) {
  const SumGrid coarse({p.points->width, q.points->width}, {p.points->height, q.points->height}, mask.cells());
  const Raster of_p = fine_raster(p, finer(coarse.part[0], kBrick)),
               of_q = fine_raster(q, finer(coarse.part[1], kBrick));
  const Bitmap corners_p = inner_corners(of_p.inner), corners_q = inner_corners(of_q.inner);
  if (corners_p.any()) p_around_q_.emplace(corners_p, of_q.touch);
  if (corners_q.any()) q_around_p_.emplace(corners_q, of_p.touch);
}

int FineCells::refine(int row, int column) {
  std::uint64_t covered = 0;
  if (p_around_q_) covered = p_around_q_->covered(row, column, covered);
  if (q_around_p_ && covered != ~std::uint64_t{0}) covered = q_around_p_->covered(row, column, covered);
  if (covered == ~std::uint64_t{0}) {
    mask_->cover(row, column);
  } else {
    brick_[index(row, column)] = static_cast<std::uint32_t>(live_.size());
    live_.push_back(~covered);
  }
  return std::popcount(covered);
}

std::size_t FineCells::bytes() const {
  std::size_t bytes = brick_.size() * sizeof brick_[0] + live_.size() * sizeof live_[0];
  for (const std::optional<BrickPairs>* pairs : {&p_around_q_, &q_around_p_})
    if (*pairs) bytes += (*pairs)->bytes();
  return bytes;
}

}  // namespace dymsum::planar
