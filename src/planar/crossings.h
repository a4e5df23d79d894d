// All places where segments of a soup meet: proper crossings, and touches (every sign that is zero).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "planar/chain.h"
#include "planar/grid.h"
#include "planar/interior_mask.h"
#include "planar/soup.h"

namespace dymsum::planar {

/// Segments a and b cross properly; sign = sign(d_a x d_b); parameters with error bounds.
struct Crossing {
  std::uint32_t a, b;
  double ta, tb;
  float ea, eb;
  std::int32_t sign;
};

/// The end point `pair` of some segment lies in the relative interior of `segment`.
struct Touch {
  std::uint32_t segment;
  WalkPair pair;
  double t;
  float error;
};

struct Meetings {
  explicit Meetings(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : crossings(memory), touches(memory), same(memory) {}

  Array<Crossing> crossings;
  Array<Touch> touches;
  Array<std::pair<WalkPair, WalkPair>> same;  ///< different pairs at the same place
  std::uint64_t cell_entries = 0, pair_tests = 0, exact_signs = 0;
};

/// A point at parameter t of a segment that lies in a dead cell.
struct DeadMark {
  std::uint32_t segment;
  double t;
};

/// Finds the meetings of pairs of segments: all of them without a mask, at least those outside dead cells with one. `poll` is
/// called now and then and stops the search when it returns false.
class CrossingFinder {
 public:
  CrossingFinder(const Soup& soup, Meetings& out, const Chain* chain = nullptr)
      : soup_(soup), chain_(chain), out_(out), keys_(soup.memory), cell_(soup.memory), near_(soup.memory), ambiguous_(soup.memory) {}

  void all_pairs();
  /// Just these pairs of segments.
  void pairs(std::span<const std::array<std::uint32_t, 2>> list);
  void grid(const Grid& grid, const InteriorMask* mask, Array<DeadMark>& dead_marks);
  std::size_t peak_bytes() const { return peak_bytes_; }

  const std::function<bool(double)>* poll = nullptr;
  bool stopped = false;
  /// Segments from this number on belong to no chain: their shared ends are meetings like any other.
  std::uint32_t first_unchained = 0xffffffff;

 private:
  // Boxes in 15-bit quanta of the span, four to a word, so that one subtraction compares all four bounds.
  struct BoxKey {
    std::uint64_t low, high;
  };
  void make_keys();
  void test(std::uint32_t a, std::uint32_t b);
  void exact_test(std::uint32_t a, std::uint32_t b);
  void add_crossing(std::uint32_t a, std::uint32_t b, double a_start, double a_end, double b_start, double b_end);
  void add_touch(std::uint32_t segment, WalkPair pair);
  void test_cell(std::span<const std::uint32_t> ids);
  void finish();

  const Soup& soup_;
  const Chain* chain_;
  Meetings& out_;
  const Grid* grid_ = nullptr;
  const InteriorMask* mask_ = nullptr;
  int row_ = 0, column_ = 0;
  Array<BoxKey> keys_;
  Array<std::uint64_t> cell_;       // the low keys of the segments of one cell
  Array<std::uint32_t> near_;       // those whose boxes meet the box of one of them
  Array<Crossing> ambiguous_;  // found near a cell border, perhaps several times
  std::size_t peak_bytes_ = 0;
};

}  // namespace dymsum::planar
