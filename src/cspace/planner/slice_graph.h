// The free positions of one slice as a graph: trapezoids between vertical lines through the vertices, and the tight
// features that join them by touching. Ways in it are exact.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "cspace/motion/slice_map.h"

namespace dymsum::planar {

class SliceGraph {
 public:
  static constexpr std::uint32_t kBottom = 0xfffffffe, kTop = 0xffffffff;

  /// A convex piece of the closed free space, between two edges with nothing in between them from one line to another.
  struct Trapezoid {
    std::uint32_t from = 0, to = 0;            ///< vertical lines, from the left
    std::uint32_t low = kBottom, high = kTop;  ///< edges of the map, or the frame
    Position centre;                           ///< strictly inside
    Point near;                                ///< it, rounded
    double size = 0;                           ///< about its area
    std::uint32_t face = 0;                    ///< of the open free space
  };

  /// Requires: the map outlives the graph; all positions lie strictly within `frame` of the origin. With touching the
  /// cracks are part of the free space, and faces that touch are joined. At most 3 n trapezoids of n edges, for
  /// O(n log n) filtered signs, and O(n k) steps, k edges over one position.
  SliceGraph(const SliceMap& map, bool touching, double frame);

  const std::vector<Trapezoid>& trapezoids() const { return trapezoids_; }
  std::uint32_t faces() const { return faces_; }
  std::uint32_t groups() const { return groups_; }
  /// Roughly what the graph takes, without the map.
  std::size_t bytes() const;
  /// A connected piece: a face, or with touching what is joined to it.
  std::uint32_t group_of(std::uint32_t node) const { return group_[node]; }
  /// The edges of the slice with that face on their right, increasing; none for the whole plane.
  const std::vector<std::uint32_t>& edges_of(std::uint32_t face) const { return edges_of_face_[face]; }
  /// Trapezoids, then cracks, by index: the centre of one, the ends of the other.
  std::vector<Position> positions_of(std::uint32_t node) const;
  std::uint32_t nodes() const { return static_cast<std::uint32_t>(group_.size()); }
  /// The closed trapezoids, then the tight features, that hold p.
  std::vector<std::uint32_t> nodes_at(const SlicePoint& p) const;
  /// The group of a free position; kNone where it is none.
  std::uint32_t group_at(const SlicePoint& p) const;
  /// The corners of a free way between two positions of one group, both included: few, not the shortest.
  std::vector<Position> way(const Position& from, const Position& to) const;

 private:
  struct Line {  // a vertical line, through a spot or at x
    double at = 0, error = 0;
    exact::BigRational x;
    const SlicePoint* through = nullptr;
    const exact::BigRational& exact() const { return through != nullptr ? through->exact().x : x; }
  };
  // Most are never passed, so that where they are passed is made when it is wanted.
  struct Link {
    std::uint32_t to = 0;
    std::uint32_t line = 0, low = kBottom, high = kTop;  // the midpoint between two edges on a line
    const SlicePoint* touch = nullptr;                   // or this position
  };
  void add_lines();
  void sweep_lines();
  void step_into(std::uint32_t column, const std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& over) const;
  static Line midpoint_between(const Line& from, const Line& to);
  void end_at(Trapezoid& t, std::uint32_t line) const;
  void join_sides(std::uint32_t line, const std::vector<std::uint32_t>& ended, const std::vector<std::uint32_t>& begun);
  void join_touching();
  void join_at(const SlicePoint& p, const std::vector<std::uint32_t>& nodes);
  void name_faces();
  int compare_heights(std::uint32_t e, std::uint32_t f, const Line& line, std::uint32_t rank) const;
  std::array<double, 2> height(std::uint32_t edge, const Line& line) const;  // with its error
  exact::BigRational exact_height(std::uint32_t edge, const exact::BigRational& x) const;
  exact::BigRational midpoint_of(std::uint32_t low, std::uint32_t high, const Line& line) const;
  bool holds(const Trapezoid& t, const SlicePoint& p) const;
  void link(std::uint32_t a, std::uint32_t b, Link how);
  Position via(const Link& l) const;
  std::vector<std::uint32_t> nodes_at(const SlicePoint& p, std::uint32_t line, bool on_line) const;
  std::vector<Position> pulled(const std::vector<Position>& corners) const;
  const SlicePoint& left(std::uint32_t edge) const;
  const SlicePoint& right(std::uint32_t edge) const;

  const SliceMap& map_;
  bool touching_;
  double frame_;
  std::vector<Line> lines_;
  std::vector<std::uint32_t> rank_;    // of the spots: their line
  std::vector<Trapezoid> trapezoids_;  // by their left lines, from below
  std::vector<std::vector<Link>> links_;
  std::deque<SlicePoint> crossings_;  // of cracks
  std::vector<std::uint32_t> group_;
  std::vector<std::vector<std::uint32_t>> edges_of_face_;
  std::uint32_t faces_ = 0, groups_ = 0;
};

}  // namespace dymsum::planar
