// Points in the interior of both operands, well away from their boundaries: where one of them lies deep in the other
// operand the two overlap, also where all that is near are edges that run along each other.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "cspace/events/overlap_filter.h"

namespace dymsum::planar {

class InnerPoints {
 public:
  /// One beside each edge where there is room.
  InnerPoints(const TurningForms& forms, const OverlapFilter& filter);

  /// Asked about one heading and margin only. True only if the open sum of heading h holds `at` (of the forms' doubles)
  /// and all positions within `margin` of it, at all angles at which the operand that turns moves by no more than the
  /// rest of `margin`.
  bool inside(Point at, Heading h, double margin);

 private:
  bool find(Point at, Heading h, double margin);
  bool inside(std::uint32_t op, std::size_t k, Point at, Heading h, double margin) const;

  const TurningForms& forms_;
  const OverlapFilter& filter_;
  std::array<std::vector<Point>, 2> points_;
  std::array<std::size_t, 2> last_{};  // what answered last
  // Answers for cells of the plane, of one heading and margin.
  std::map<std::array<std::int64_t, 2>, bool> known_;
};

}  // namespace dymsum::planar
