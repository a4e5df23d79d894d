// All positions where segments of a soup meet: proper crossings, and touches (every sign that is zero).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box_sweep.h"
#include "base/poll.h"
#include "planar/arrangement/soup.h"
#include "planar/mask/interior_mask.h"

namespace dymsum::planar {

/// Segments a and b cross properly, a's direction to the right of b's: d_a x d_b > 0. The parameters' errors are not
/// kept, as they follow from the segments: Soup::parameter_error.
struct Crossing {
  std::uint32_t a, b;
  double ta, tb;
};
static_assert(sizeof(Crossing) == 24, "the largest array of a sum with many crossings");

/// The end point `pair` of some segment lies in the relative interior of `segment`.
struct Touch {
  std::uint32_t segment;
  WalkPair pair;
  double t;
  float error;
};

struct Meetings {
  /// Parameters that are farther apart than this need no comparison of their errors, unless `rough`. Any value is
  /// right.
  static constexpr double kApart = 0x1p-29;
  explicit Meetings(Scratch* memory = nullptr) : crossings(memory), touches(memory), same(memory) {}

  Array<Crossing> crossings;
  Array<Touch> touches;
  Array<std::pair<WalkPair, WalkPair>> same;  ///< different pairs at the same position
  bool rough = false;                         ///< some crossing has a parameter that errs by half of kApart or more
  std::uint64_t cell_entries = 0, pair_tests = 0, exact_signs = 0;
};

/// A point at parameter t of a segment that lies in a covered cell.
struct CoveredMark {
  std::uint32_t segment;
  double t;
};

/// A part of a segment, by parameters.
struct SegmentPiece {
  std::uint32_t segment;
  double low, high;
};

/// Finds the meetings of pairs of segments: all of them without a mask, at least those outside covered cells with one.
class CrossingFinder {
 public:
  CrossingFinder(const Soup& soup, Meetings& out, const Chain* chain = nullptr, const Poll* poll = nullptr)
      : soup_(soup),
        chain_(chain),
        next_(chain != nullptr ? chain->next() : std::span<const std::uint32_t>{}),
        first_unchained_(chain != nullptr ? chain->first_unchained() : kNone),
        poll_(poll),
        out_(out),
        keys_(soup.memory),
        cell_(soup.memory),
        near_(soup.memory),
        ambiguous_(soup.memory) {}

  /// Every pair of boxes is looked at: the reference.
  void all_pairs();
  /// Boxes in the order of their left sides: each is compared with those that start before it ends, eight at a time.
  /// With a mask crossings in covered cells are left out.
  void sweep(const InteriorMask* mask = nullptr);
  /// The same for disjoint pieces of segments: crossings outside them are left out, as far as parameters that err by
  /// less than `reach`, a distance, tell.
  void sweep(std::span<const SegmentPiece> pieces, double reach);
  /// Just these pairs of segments.
  void pairs(std::span<const std::array<std::uint32_t, 2>> list);
  void grid(const Grid& grid, const InteriorMask* mask, Array<CoveredMark>& covered_marks);

 private:
  // Boxes in 15-bit quanta of the span, four to a word, so that one subtraction compares all four bounds.
  struct BoxKey {
    std::uint64_t low, high;
  };
  BoxQuanta quanta(const SoupBox& box, double per_quantum) const;
  double quanta_per_unit() const;
  void make_keys();
  void find_followers(std::uint32_t* follower) const;
  struct ByteBoxes;
  void compare_all();
  // Whether to go on; of rounds that take long.
  void query(std::uint32_t round, std::uint32_t rounds) const {
    if (poll_ != nullptr && round % 256 == 255) (*poll_)(double(round) / rounds);
  }
  struct Probe;
  Probe probe(std::uint32_t s) const;
  bool undecided(const Probe& a, std::uint32_t b);
  bool undecided_strangers(const Probe& a, std::uint32_t b);
  void test(const Probe& a, std::uint32_t b);
  void exact_test(std::uint32_t a, std::uint32_t b);
  int side(std::uint32_t s, WalkPair v, double x, double y);
  bool between(std::uint32_t s, WalkPair v, double x, double y);
  void meet_pieces(const SegmentPiece& piece, std::span<const std::uint32_t> others);
  SoupBox box_of(const SegmentPiece& piece) const;
  enum class Owned { no, yes, unsure };
  Owned owned_by_pieces(std::uint32_t a, std::uint32_t b, double t, double u) const;
  static void make_room(Array<Crossing>& list);
  bool in_covered_cell(std::uint32_t a, std::uint32_t b, double t) const;
  void add_crossing(std::uint32_t a, std::uint32_t b, double a_start, double a_end, double b_start, double b_end);
  void add_touch(std::uint32_t segment, WalkPair pair);
  struct CellLists;
  CellLists list_cells(Array<CoveredMark>& covered_marks) const;
  void test_cell(std::span<const std::uint32_t> ids);
  void finish();

  const Soup& soup_;
  const Chain* chain_;
  std::span<const std::uint32_t> next_;  // empty: no chains
  std::uint32_t first_unchained_;
  const Poll* poll_;
  Meetings& out_;
  const Grid* grid_ = nullptr;
  const InteriorMask* mask_ = nullptr;
  int row_ = 0, column_ = 0;
  std::span<const SegmentPiece> pieces_;
  const SegmentPiece *piece_ = nullptr, *other_piece_ = nullptr;  // those whose segments are being compared
  double piece_reach_ = 0;
  Array<BoxKey> keys_;
  Array<std::uint64_t> cell_;  // the low keys of the segments of one cell
  Array<std::uint32_t> near_;  // those whose boxes meet the box of one of them, or of one segment in a sweep
  Array<Crossing> ambiguous_;  // found near the edge of a cell, perhaps several times
};

// Monotone; one quantum more at the upper end covers the rounding of the coordinates. They lie in [0, span], up to that
// rounding.
inline BoxQuanta CrossingFinder::quanta(const SoupBox& b, double per_quantum) const {
  const auto quantum = [&](double v) { return static_cast<int>(v * per_quantum); };
  const int ax = quantum(b.ax), ay = quantum(b.ay), bx = quantum(b.bx), by = quantum(b.by);
  const auto number = [](int v) { return static_cast<std::int16_t>(v); };
  return {number(std::min(ax, bx)), number(std::min(ay, by)), number(std::max(ax, bx) + 1),
          number(std::max(ay, by) + 1)};
}

}  // namespace dymsum::planar
