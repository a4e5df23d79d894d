// The cycles of the frames of a rotating sum: which of them bound it, and which continues which.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/frames.h"
#include "planar/frame/frame_rings.h"
#include "planar/frame/rotating_frame.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// Whether a face of a frame lies in the sum, in doubles with proved bounds: the collision test where nothing is close.
class RotatingOverlap {
 public:
  enum class Answer : std::uint8_t { free, overlap, unknown };
  struct Result {
    Answer answer = Answer::unknown;
    std::uint32_t fixed_edge = 0, turning_edge = 0;  ///< of an overlap: walk edges that cross
  };

  explicit RotatingOverlap(const TurningForms& forms) : forms_(forms) {}

  /// Whether the face to the right of a sub-edge lies in the open sum. Requires: both operands are connected. With the
  /// sub-edge's midpoint as the position, a vertex of one operand touches an edge of the other from outside. They
  /// overlap when another pair of edges crosses; when every other pair lies apart, they do not, as no boundary enters
  /// the other operand anywhere. O(n m) for the edges in the other one's box.
  Result right_of(const RotatingFrame& frame, const RotatingFrame::Step& s);

 private:
  struct Edge {
    double ax, ay, bx, by, dx, dy, x0, y0, x1, y1;  ///< ends, vector and box
    std::uint32_t index;
  };
  struct Box {
    double x0, y0, x1, y1;
  };
  static Box box_of(const std::vector<Point>& points);
  template <class VectorOf>
  void collect(const Operand& o, const std::vector<Point>& points, const VectorOf& vector_of, const Box& box,
               std::vector<Edge>& edges) const;
  void collect_edges(const RotatingFrame& frame, Point z);
  int sides(const Edge& line, const Edge& e) const;

  const TurningForms& forms_;
  std::vector<Point> turning_;  // the rotating operand reflected, at the position
  std::vector<Edge> of_fixed_, of_turning_;
  std::vector<std::uint32_t> near_;
};

class RotatingLoops {
 public:
  struct Loop : LoopStatus {
    std::uint32_t first = 0, last = 0;  ///< steps [first, last)
  };

  /// `swapped`: P is the moving operand, operand 1 of the forms.
  RotatingLoops(const TurningForms& forms, bool connected, bool swapped)
      : forms_(forms), connected_(connected), swapped_(swapped), overlap_(forms) {}

  /// Takes the cycles of a frame over. What the frame before knew is used if both lie in one window; `identities` gives
  /// fresh names.
  void update(const RotatingFrame& frame, ExactFrame& exact, RingIdentities& identities, FrameWork& work,
              FrameChanges& changes);
  /// Nothing is known any more of the frame before.
  void forget() {
    loops_.clear();
    steps_.clear();
    known_ = false;
  }
  /// Puts the frame before into the indices of a new window's segments, before its first frame.
  void renumber(const RotatingWindow& from, const RotatingWindow& to);

  const std::vector<Loop>& loops() const { return loops_; }
  std::vector<Loop>& loops() { return loops_; }
  bool known() const { return known_; }
  std::size_t bytes() const { return bytes_of(steps_, old_steps_, loops_, old_); }

 private:
  /// What identifies a sub-edge in a window.
  struct Known {
    std::uint32_t segment = 0, from = 0, to = 0;
    std::uint32_t loop = 0;
    std::uint32_t next = kNone;  ///< another one on the same segment
  };
  class AngleInterval;
  const Known* match(const RotatingFrame::Step& s) const;
  bool inherit(const RotatingFrame& frame, Loop& loop, FrameWork& work);
  bool witnessed(const RotatingFrame& frame, Loop& loop);
  static bool undisturbed(const AngleInterval& all, const RotatingWindow& window, const RotatingFrame::Step& s);
  const RotatingFrame::Step& longest_of(const RotatingFrame& frame, const Loop& loop) const;
  bool covered(const RotatingFrame& frame, Loop& loop, ExactFrame& exact, FrameWork& work);
  bool covers(const CrossingEdges& edges, const RotatingFrame& frame, const RotatingFrame::Located& z) const;
  void follow(const RotatingFrame& frame, RingIdentities& identities, FrameChanges& changes);
  Segment source_segment(std::uint32_t segment, const RotatingWindow& window) const;

  const TurningForms& forms_;
  bool connected_, swapped_;
  RotatingOverlap overlap_;
  bool known_ = false;
  double last_delta_ = 0;  // of the frame before, in the window
  std::vector<Loop> loops_, old_;
  std::vector<Known> steps_, old_steps_;
  std::vector<std::uint32_t> head_;  // segment -> old steps
  std::vector<std::uint8_t> decided_;
  RecentEdges<16> recent_;  // of any loop
  RingClaims claims_;
};

}  // namespace dymsum::planar
