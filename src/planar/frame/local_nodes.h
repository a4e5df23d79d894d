// Segments near a box, and all positions at which they end, meet, or pass a wall: doubles with bounds, exact on demand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "planar/frame/near_segments.h"

namespace dymsum::planar {

struct LocalNode {
  enum class Kind : std::uint8_t { end, crossing, wall } kind = Kind::end;
  double x = 0, y = 0, off = 0;  ///< scaled, each coordinate off by at most so much
  std::uint32_t a = 0, b = 0;    ///< segment, and the other segment or the wall; of an end 0: start, 1: end
  bool in_box = false;           ///< in the closed box
  bool known = false;            ///< strictly inside the larger box, provably: all segments there are at hand
};

class LocalNodes {
 public:
  /// `segments`: those that meet the larger box.
  LocalNodes(const PosedRegions& posed, const LocalWalls& walls, base::CountedArray<WalkSegment> segments);

  std::size_t segment_count() const { return segments_.size(); }
  const WalkSegment& segment(std::uint32_t s) const { return segments_[s]; }
  /// The nodes along a segment, in its direction, each position once.
  const std::vector<std::uint32_t>& along(std::uint32_t s) const { return along_[s]; }
  /// Positions that are the same have one node: its number is the smallest of theirs, others do not occur.
  std::size_t node_count() const { return nodes_.size(); }
  const LocalNode& node(std::uint32_t n) const { return nodes_[n]; }
  const BigPosition& exact(std::uint32_t n) const;

  /// Signs of the directions of segments: of a coordinate, of their cross product.
  int direction(std::uint32_t s, int axis) const;
  int cross(std::uint32_t s, std::uint32_t t) const;
  const PosedRegions& posed() const { return posed_; }
  const LocalWalls& walls() const { return walls_; }

 private:
  struct Ends {
    Point a, b;
    Point d() const { return {b.x - a.x, b.y - a.y}; }
  };
  void find_meetings();
  void meet(std::uint32_t s, std::uint32_t t);
  void meet_on_one_line(std::uint32_t s, std::uint32_t t);
  void add_crossing(std::uint32_t s, std::uint32_t t);
  void add_walls(std::uint32_t s);
  void merge_same();
  std::vector<std::uint32_t> first_of_same_name() const;
  void place_in_boxes(LocalNode& node, std::uint32_t n);
  void sort_along(std::uint32_t s);
  int side(std::uint32_t s, std::uint32_t t, int end) const;
  int beyond(std::uint32_t s, int end, const LocalWall& wall) const;
  bool between_ends(std::uint32_t s, std::uint32_t t, int end) const;
  BigPoint exact_end(std::uint32_t s, int end) const;
  BigPoint exact_direction(std::uint32_t s) const { return exact_end(s, 1) - exact_end(s, 0); }
  BigPosition make_exact(const LocalNode& node) const;
  /// A position in pairs of doubles, each coordinate off by at most `off`.
  struct PairPosition {
    PairPoint at;
    double off = 0;
  };
  using PairEnds = std::array<PairPoint, 2>;
  const PairEnds& pair_ends(std::uint32_t s) const;
  Pair end_name(std::uint32_t s, std::uint32_t end) const;
  void place_finely(LocalNode& node) const;
  PairPosition make_pair_position(const LocalNode& node) const;
  /// The fraction of its segment at which a crossing or a wall is: n / w, both off by at most `off`.
  struct PairFraction {
    base::DoublePair n, w;
    double off = 0;
  };
  PairFraction pair_fraction(const LocalNode& node) const;
  bool provably_beside(const LocalNode& node, std::uint32_t u) const;
  bool provably_apart(std::uint32_t m, std::uint32_t n) const;
  class Merging;
  const PairPosition& pair_position(std::uint32_t n) const;
  int pair_order(std::uint32_t m, std::uint32_t n, int axis) const;

  const PosedRegions& posed_;
  const LocalWalls& walls_;
  base::CountedArray<WalkSegment> segments_;
  base::CountedArray<Ends> ends_;
  base::CountedArray<LocalNode> nodes_;
  std::vector<std::vector<std::uint32_t>> along_;
  mutable base::CountedArray<std::optional<BigPosition>> exact_;
  mutable base::CountedArray<std::optional<PairEnds>> pair_ends_;
  mutable base::CountedArray<std::optional<PairPosition>> pair_positions_;
};

}  // namespace dymsum::planar
