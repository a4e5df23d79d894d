// Blocks of 8 x 8 cells in one word, and the sums of two of them.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "planar/mask/covered_cells.h"

namespace dymsum::planar {

/// The side of a brick in cells. Byte r of its word is row r, bit c of that byte column c.
inline constexpr int kBrick = 8;

/// A bitmap in bricks, with one empty brick around it.
class Bricks {
 public:
  explicit Bricks(const Bitmap& cells);
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  /// Requires: -1 <= row <= rows(), likewise for columns.
  std::uint64_t at(int row, int column) const {
    return words_[static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(columns_ + 2) +
                  static_cast<std::size_t>(column + 1)];
  }
  std::size_t bytes() const { return words_.size() * sizeof words_[0]; }

 private:
  int rows_, columns_;
  std::vector<std::uint64_t> words_;
};

/// Four bricks that meet in a corner.
struct FourBricks {
  std::uint64_t below_left, below, left, at;
};

/// The cells o of a brick, of those not in `known`, for which o = u + k with u in `a` and k in the four bricks, `at`
/// being the brick at the same position as o for u = 0; with `known`. Stops when all are.
inline std::uint64_t brick_sum(std::uint64_t a, const FourBricks& b, std::uint64_t known) {
  constexpr std::uint64_t kColumn = 0x0101010101010101;
  for (int c = 0; c < kBrick; ++c) {
    std::uint64_t rows = (a >> c) & kColumn;
    if (rows == 0) continue;
    // Moved right by c columns.
    const std::uint64_t from_left = c == 0 ? 0 : kColumn * (0xffu >> (8 - c));
    const auto moved = [&](std::uint64_t left, std::uint64_t right) {
      return c == 0 ? right : ((right << c) & ~from_left) | ((left >> (8 - c)) & from_left);
    };
    const std::uint64_t low = moved(b.below_left, b.below), high = moved(b.left, b.at);
    for (; rows != 0; rows &= rows - 1) {
      const int up = std::countr_zero(rows);  // eight times the row
      known |= up == 0 ? high : (high << up) | (low >> (64 - up));
    }
    if (known == ~std::uint64_t{0}) break;
  }
  return known;
}

}  // namespace dymsum::planar
