// Whether a face of a frame of a rotating sum lies in the sum, in doubles with proved bounds: the collision test where
// nothing is close.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planar/frame/rotating_frame.h"

namespace dymsum::planar {

class RotatingOverlap {
 public:
  enum class Answer : std::uint8_t { free, overlap, unknown };
  struct Result {
    Answer answer = Answer::unknown;
    std::uint32_t fixed_edge = 0, turning_edge = 0;  ///< of an overlap: walk edges that cross
  };

  explicit RotatingOverlap(const TurningForms& forms) : forms_(forms) {}

  /// Whether the face to the right of a sub-edge lies in the open sum. Requires: both operands are connected. With the
  /// sub-edge's middle as the position, a vertex of one operand touches an edge of the other from outside. They overlap
  /// when another pair of edges crosses; when every other pair lies apart, they do not, as no boundary enters the other
  /// operand anywhere. O(n m) for the edges in the other one's box.
  Result right_of(const RotatingFrame& frame, const RotatingFrame::Step& s);

 private:
  struct Edge {
    double ax, ay, bx, by, dx, dy, x0, y0, x1, y1;  ///< ends, vector and box
    std::uint32_t number;
  };
  struct Box {
    double x0, y0, x1, y1;
  };
  static Box box_of(const std::vector<Point>& points);
  void collect(const Operand& o, const std::vector<Point>& points, const std::vector<Point>& vectors, const Box& box,
               std::vector<Edge>& edges) const;

  const TurningForms& forms_;
  std::vector<Point> turning_;  // the turning operand reflected, at the position
  std::array<std::vector<Point>, 2> vectors_;
  std::vector<Edge> of_fixed_, of_turning_;
  std::vector<std::uint32_t> near_;
};

}  // namespace dymsum::planar
