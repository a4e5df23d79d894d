// All places where segments of a soup meet: proper crossings, and touches (every sign that is zero).
#pragma once

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
  std::vector<Crossing> crossings;
  std::vector<Touch> touches;
  std::vector<std::pair<WalkPair, WalkPair>> same;  ///< different pairs at the same place
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
  CrossingFinder(const Soup& soup, Meetings& out, const Chain* chain = nullptr) : soup_(soup), chain_(chain), out_(out) {}

  void all_pairs();
  /// Just these pairs of segments.
  void pairs(std::span<const std::array<std::uint32_t, 2>> list);
  void grid(const Grid& grid, const InteriorMask* mask, std::vector<DeadMark>& dead_marks);
  std::size_t peak_bytes() const { return peak_bytes_; }

  const std::function<bool(double)>* poll = nullptr;
  bool stopped = false;
  /// Segments from this number on belong to no chain: their shared ends are meetings like any other.
  std::uint32_t first_unchained = 0xffffffff;

 private:
  struct Entry {
    double ax, ay, bx, by, dx, dy, error;
    WalkPair start, end;
    std::uint32_t id;
  };
  Entry entry(std::uint32_t s) const;
  void test(const Entry& a, const Entry& b, double o1, double o2);
  void exact_test(const Entry& a, const Entry& b);
  void add_crossing(const Entry& a, const Entry& b, double a_start, double a_end, double b_start, double b_end);
  void add_touch(std::uint32_t segment, WalkPair pair);
  void test_cell(std::span<const std::uint32_t> ids);
  void finish();

  const Soup& soup_;
  const Chain* chain_;
  Meetings& out_;
  const Grid* grid_ = nullptr;
  const InteriorMask* mask_ = nullptr;
  int row_ = 0, column_ = 0;
  std::vector<Entry> cell_;
  std::vector<Crossing> ambiguous_;  // found near a cell border, perhaps several times
  std::size_t peak_bytes_ = 0;
};

}  // namespace dymsum::planar
