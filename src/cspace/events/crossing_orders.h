// Lines that cross a segment at nearly the same places all through a window, as beside a crowded quarter turn: most
// pairs of them keep their order, and make no event.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cspace/events/window_ends.h"

namespace dymsum::planar {

/// The position at which the line of another segment crosses one.
struct LineCrossing {
  std::uint32_t other = 0;
  double low = 0, high = 0;  ///< of the parameter along the segment, at all angles
  std::uint32_t order = 0;   ///< of two with one number, other than 0, the lines keep their order along the segment
};

/// Whether parallel segments have the same direction.
inline bool same_direction(const TurningForms& forms, const WalkSegment& b, const WalkSegment& c) {
  const Point d = forms.edge(b.side, b.edge), e = forms.edge(c.side, c.edge);
  return forms.parallel(b, c) && d.x * e.x + d.y * e.y > 0;
}

class CrossingOrders {
 public:
  CrossingOrders(const EventWindow& window, const TurningForms& forms, const WindowEnds& ends)
      : w_(window), forms_(forms), ends_(ends) {}

  /// Numbers the crossings of segment i, which are sorted by `low`, where many of them overlap. In the order of their
  /// positions at the midpoint, neighbours that are never at one position within the window prove that of all between:
  /// places are continuous functions of the angle, as no line is parallel to the segment.
  void find(std::uint32_t i, std::vector<LineCrossing>& list) const;

 private:
  struct Position;
  void find(const WalkSegment& a, std::span<LineCrossing> run, std::uint32_t& orders) const;
  void sort_unclear(const WalkSegment& a, std::vector<Position>& positions) const;
  int order_beside_end(const WalkSegment& a, const Position& x, const Position& y) const;
  bool never_zero(const TrigForm2& g, double error) const;
  bool keep_order(const WalkSegment& a, const Position& x, const Position& y) const;

  const EventWindow& w_;
  const TurningForms& forms_;
  const WindowEnds& ends_;
};

}  // namespace dymsum::planar
