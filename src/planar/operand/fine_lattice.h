// The signs of a lattice by pairs of doubles: between the doubles that callers filter with and integers of hundreds of
// bits, as scales of events have them.
#pragma once

#include <optional>

#include "exact/interval.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// Each sign as the lattice's function of the same name, or nothing where the bounds of pairs of doubles leave it open:
/// never a wrong one. Differences of two vertices of one operand are those of doubles as given, so that what nearly
/// coincides is known to as many digits as anything else.
class FineLattice {
 public:
  /// Refers to the points. Of a rotated operand, and of scales beyond 900 bits, it says nothing.
  FineLattice(const LatticeDoubles& doubles, const std::optional<LatticeScale>& scale);

  std::optional<int> cross(const Edge& d, const Edge& e) const;
  std::optional<int> side(const Segment& s, Pair v) const;
  std::optional<int> along(const Segment& s, Pair v) const;
  std::optional<int> compare_coordinate(Pair a, Pair b, int axis) const;
  std::optional<int> side(const Segment& s, const SegmentPosition& x) const;
  std::optional<int> along(const Segment& s, const SegmentPosition& x) const;
  std::optional<int> compare(const Segment& on, const Cut& a, const Cut& b) const;
  std::optional<int> compare_coordinate(Pair a, const SegmentPosition& b, int axis) const;
  std::optional<int> compare_coordinate(const SegmentPosition& a, const SegmentPosition& b, int axis) const;

 private:
  using Fine = exact::FineInterval;
  struct Vec {
    Fine x, y;
    const Fine& on(int axis) const { return axis == 0 ? x : y; }
  };
  /// n / d, d > 0 or the whole line.
  struct Ratio {
    Fine n, d;
  };
  /// Where the mediant of a pair of cuts is requested, their numerators and denominators count as integers do.
  enum class As : std::uint8_t { quotient, integers };
  static Fine cross(const Vec& a, const Vec& b) { return a.x * b.y - a.y * b.x; }
  static Fine dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y; }
  Vec step(std::uint32_t op, std::uint32_t from, std::uint32_t to) const;
  Vec step(Pair from, Pair to) const;
  Vec edge(const Edge& e) const { return step(e.op, e.from, e.to); }
  Ratio parameter(const Segment& on, const Cut& cut, As as) const;
  Ratio ratio(const SegmentPosition& x) const;

  std::array<const PlacedPoints*, 2> points_;
  std::array<Vec, 2> factor_;  ///< of the steps of an operand
  Fine integer_;               ///< what an integer of the lattice is in these units
  bool decides_ = true;
};

}  // namespace dymsum::planar
