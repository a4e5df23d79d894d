// A slice of the configuration-space obstacle as a map: on which side of its boundary a point lies, and what a straight
// way meets. Exact; doubles with bounds decide first.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

using Position = ExactSource::Position;

/// A rational point behind doubles within error() of it. The rational one of a vertex is made when it is first wanted,
/// so a SlicePoint is used by one thread, and those of a sum not longer than it.
class SlicePoint {
 public:
  explicit SlicePoint(Position exact);
  explicit SlicePoint(Point p);
  SlicePoint(const PlanarSum& sum, const SumVertex& vertex);

  Point at() const { return at_; }
  double error() const { return error_; }
  const Position& exact() const;

 private:
  Point at_;
  double error_ = 0;
  const PlanarSum* sum_ = nullptr;
  const SumVertex* vertex_ = nullptr;
  mutable std::optional<Position> exact_;
};

/// The sign of (b - a) x (c - a).
int side(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c);
int compare_x(const SlicePoint& a, const SlicePoint& b);
int compare_y(const SlicePoint& a, const SlicePoint& b);
bool same(const SlicePoint& a, const SlicePoint& b);
/// Whether p lies on the closed segment from a to b.
bool on_segment(const SlicePoint& a, const SlicePoint& b, const SlicePoint& p);
/// a + share (b - a).
Position along(const Position& a, const Position& b, const exact::BigRational& fraction);

class SliceMap {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// An edge of a ring, the slice on its left.
  struct Edge {
    std::uint32_t from = 0, to = 0;  ///< numbers of spots
    Contact before, contact;
  };
  enum class Where : std::uint8_t { outside, touching, inside };

  /// How far a straight way is free: wholly, or up to the fraction `first` of it, where an edge may be named.
  struct Passage {
    bool free = true;
    exact::BigRational first;
    std::uint32_t edge = kNone;
  };

  /// Requires: a slice with Semantics::open, or a closed one for ways on which touching is forbidden.
  explicit SliceMap(PlanarSum slice);
  SliceMap(const SliceMap&) = delete;
  SliceMap& operator=(const SliceMap&) = delete;

  const std::vector<SlicePoint>& spots() const { return spots_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// Spots that are the ends of the tight segments; a tight point is both of its ends.
  const std::vector<std::array<std::uint32_t, 2>>& cracks() const { return cracks_; }

  /// Roughly what the map takes, with exact positions of all spots.
  std::size_t bytes() const;

  /// Touching: on the boundary of the open slice, tight features included, or on a piece of the slice without area.
  /// O(n).
  Where where(const SlicePoint& p) const;
  /// An edge that p lies on, or kNone.
  std::uint32_t edge_at(const SlicePoint& p) const;
  /// The straight way from a to b against the open slice; against the closed one where touching is forbidden.
  /// The first fraction is that of the earliest point after which every neighbourhood is entered, or of the earliest
  /// touch.
  Passage passage(const SlicePoint& a, const SlicePoint& b, bool touching_allowed) const;

 private:
  void add(const SumRing& ring);
  std::array<std::uint32_t, 2> add(const SumVertex& from, const SumVertex& to);
  bool on_any(const std::vector<std::array<std::uint32_t, 2>>& pieces, const SlicePoint& p) const;
  void add_meetings(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c, const SlicePoint& d,
                    std::uint32_t edge, std::vector<std::pair<exact::BigRational, std::uint32_t>>& to) const;
  Passage standing(const SlicePoint& a, bool touching_allowed) const;

  PlanarSum slice_;
  std::vector<SlicePoint> spots_;
  std::vector<Edge> edges_;
  std::vector<std::array<std::uint32_t, 2>> cracks_, wires_;  // wires: pieces without area
};

}  // namespace dymsum::planar
