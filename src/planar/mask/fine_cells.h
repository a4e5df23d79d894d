// A second grid, eight times as fine as that of the interior mask, in those of its cells where that pays.
// Lemma and proof are those of the mask: docs/design/planar-sum.md, "interior mask".
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "planar/mask/interior_mask.h"

namespace dymsum::planar {

/// When crowded cells of a mask are refined; always, whatever that costs, is for tests.
enum class Refine { where_it_pays, always };

// Blocks of 8 x 8 cells in one word, and the sums of two of them.

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

/// Corners of one operand and touched cells of the other in bricks: which fine cells are sums of both.
class BrickPairs {
 public:
  BrickPairs(const Bitmap& corners, const Bitmap& touch);
  /// The cells of a brick of the sum that are sums of a corner and a touched cell, together with those known. O(bricks
  /// of an operand / 64).
  std::uint64_t covered(int row, int column, std::uint64_t known);
  std::size_t bytes() const;

 private:
  struct Position {
    int row = 0, column = 0;
  };
  std::uint64_t with(Position corner, Position sum, std::uint64_t known) const;
  std::uint64_t with_recent(Position sum, std::uint64_t known) const;
  void remember(Position corner, Position sum);

  Bricks corners_, touch_;
  Bitmap some_corner_;     // bricks with corners
  Bitmap touch_reversed_;  // bit kMargin + j of row r: whether brick (r, columns - j) of the touched cells, or one left
                           // of or below it, has any
  struct Success {
    Position corner, sum;
  };
  static constexpr std::size_t kRecent = 6;
  std::vector<Success> recent_;  // bricks that covered something for the last sums: likely for the next one
  std::size_t next_recent_ = 0;
};

/// Fine cells covered by int P + Q or P + int Q, each grown by 8 kReach fine cells.
class FineCells {
 public:
  /// No cell is refined, nor will be.
  explicit FineCells(InteriorMask& mask);
  FineCells(const Operand& p, const Operand& q, InteriorMask& mask);
  /// Proves what it can of one live cell of the mask, once; one that is covered as a whole is covered in the mask, too.
  /// Returns how many fine cells are covered.
  int refine(int row, int column);

  /// Eight times as fine as the mask's.
  const Grid& grid() const { return grid_; }
  const InteriorMask& mask() const { return *mask_; }
  /// The live cells in a cell of the mask, as a brick.
  std::uint64_t live(int row, int column) const {
    if (mask_->covered(row, column)) return 0;
    const std::uint32_t b = brick_[index(row, column)];
    return b == kWhole ? ~std::uint64_t{0} : live_[b];
  }
  bool covered(double x, double y) const {
    const int r = grid_.row(y), c = grid_.column(x);
    return ((live(r / kBrick, c / kBrick) >> (r % kBrick * 8 + c % kBrick)) & 1) == 0;
  }
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kWhole = 0xffffffff;
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(mask_->grid().columns) +
           static_cast<std::size_t>(column);
  }

  InteriorMask* mask_;
  Grid grid_;
  std::vector<std::uint32_t> brick_;  // per cell of the mask
  std::vector<std::uint64_t> live_;
  std::optional<BrickPairs> p_around_q_, q_around_p_;
};

/// What is known to be covered, if anything: cells of a mask, and fine cells where there are some.
struct KnownCover {
  const InteriorMask* mask = nullptr;
  const FineCells* fine = nullptr;
  bool covers(double x, double y) const {
    if (fine != nullptr) return fine->covered(x, y);
    return mask != nullptr && mask->covered(mask->grid().row(y), mask->grid().column(x));
  }
};

}  // namespace dymsum::planar
