// A window of scales: the pieces of convolution segments that can bound the sum somewhere in it, and the pairs of
// pieces that can meet. Built once; frames inside the window only look here.
//
// One operand is held fixed and the other multiplied by tau: c(tau) = fixed + tau moving. With the scaled operand
// moving, tau is the scale; with the other one moving, tau is its inverse and everything is divided by the scale, which
// changes no sign. The smaller operand moves, so sweeps are short. All positions along segments are linear in tau when
// measured in multiples of the unscaled edge vector.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/doubles.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "base/scratch.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/frame_window.h"

namespace dymsum::planar {

class CoverMemory;
class CoveredCells;
class ReducedConvolution;

/// How the moving operand's coordinate x stands at parameter tau in the window's frame: tau x + (tau1 - tau) centre.
/// The fixed operand's coordinates stand as they are. The frame moves with the operand's centre, so that sweeps are
/// half as long; it never enters an exact sign.
struct WindowFrame {
  std::uint32_t moving = 0;  ///< operand
  double tau0 = 1, tau1 = 1;
  double centre_x = 0, centre_y = 0;
  double shift_x(double tau) const { return (tau1 - tau) * centre_x; }
  double shift_y(double tau) const { return (tau1 - tau) * centre_y; }
};

/// a + b tau.
struct Linear {
  double a = 0, b = 0;
  double at(double tau) const { return a + b * tau; }
};

/// The position of a point that moves with tau, in the window's coordinates.
struct MovingPoint {
  Linear x, y;
  double error = 0;  ///< anywhere in the window
  Two at(double tau) const { return Two{x.a, y.a} + Two{x.b, y.b} * both(tau); }
};

/// A segment of the reduced convolution that is live somewhere in the window.
struct LiveSegment {
  WalkSegment walk;
  std::uint32_t id;  ///< in the convolution
  Linear x, y;       ///< where it starts
  double dx, dy;     ///< the unscaled edge vector
  bool moving;       ///< an edge of the moving operand: its length is tau, otherwise 1
  WalkPair start, end;
  Contact contact;
  std::uint32_t first_piece = 0, last_piece = 0;  ///< its pieces [first_piece, last_piece)

  double length(double tau) const { return moving ? tau : 1; }
};

/// An interval of a live segment between its ends or positions in dead cells. What reaches into a dead cell is false.
/// Where segments lie along each other at every scale, a piece can end where another one begins that goes on, or be
/// covered by another one as a whole.
struct Piece {
  std::uint32_t segment = 0;
  bool head_cut = false, tail_cut = false;  ///< ends in a dead cell instead of at the segment's end
  bool handed_on = false;                   ///< ends at `tail_at`, where another piece begins
  bool covered = false;                     ///< counts for nothing
  Linear head, tail;                        ///< where, when cut; the tail also when handed on
  double tail_error = 0;
  WalkPair tail_at;
  std::uint32_t next = kNone;  ///< the piece that continues at an uncut tail
  std::int8_t next_turn = 0;   ///< sign of the turn into it
  std::uint8_t half = 0;       ///< of the directions: 0 for [0, pi), 1 for the others
};

/// Two pieces that may meet in the window. They cross properly at the scales of one open interval; doubles know it up
/// to brackets: not outside (out_low, out_high), provably inside (in_low, in_high), and exact signs decide in between.
struct Candidate {
  std::uint32_t a, b;       ///< pieces
  Linear ta, tb;            ///< where on a and on b
  double error_a, error_b;  ///< of ta and tb, anywhere in the window
  double out_low, in_low, in_high, out_high;
  std::int32_t sign;  ///< of d_a x d_b; 0: parallel, they never cross properly
};

inline constexpr std::uint32_t kTouchBit = 0x80000000;

/// The common end of some segments that lies on a piece's line at every scale: parallel edges of both operands at
/// reflex vertices.
struct PersistentTouch {
  std::uint32_t piece = 0, node = 0;
  Linear t;
  double error = 0;
  double out_low, in_low, in_high, out_high;  ///< inside the piece, as for Candidate
  std::uint32_t in_ray = 0, out_ray = 0;      ///< in the node
  std::uint32_t at = 0;                       ///< place in the piece's list, while inside
};

/// A pair of vertices with persistent touches: the rays there in counter-clockwise order.
struct PersistentNode {
  struct Ray {
    std::uint32_t piece = 0, touch = kNone;  ///< kNone: the piece's own end
    bool out = false;
    std::uint32_t group = 0;  ///< equal for equal directions
  };
  WalkPair at;
  std::uint32_t first_ray = 0, last_ray = 0;
  bool hands_on = false;  ///< pieces end here that others continue, so something meets here at every scale
  bool covered = false;   ///< lies in the open sum throughout the window: it counts for nothing
};

struct WindowSettings {
  WindowFrame frame;
  int cells = 64;  ///< along the grid's longer side
  bool mask = true;
  bool covers = true;  ///< leave out crossings and nodes that two edges prove covered while they exist
  bool edges_prove = true;  ///< edges that cross prove a position covered: two polylines do not in an open sum
  std::uint64_t most_pairs = UINT64_MAX;  ///< the window is abandoned when more boxes of pieces meet
  CoverMemory* memory = nullptr;          ///< of windows of the same convolution
  base::StopToken stop;                   ///< the window is abandoned when that is requested
  std::function<void()> again;            ///< if there is one, called every so many pairs; it may throw
  double shrink = 1;  ///< tests: sweep masks and pairs over this fraction of the window only; less than 1 is wrong
};

class Window : public CandidateIndex {
 public:
  Window(const OperandPair& base, const ReducedConvolution& convolution, const WindowSettings& settings);

  const OperandPair& base() const { return base_; }
  const WindowFrame& frame() const { return frame_; }
  double span() const { return span_; }  ///< coordinates in the window are at most this
  bool covers(double tau) const { return tau > frame_.tau0 && tau < frame_.tau1; }

  base::CountedArray<LiveSegment> segments;
  base::CountedArray<Piece> pieces;
  base::CountedArray<Candidate> candidates;
  /// Segments that run back along each other from a common end at every scale.
  std::vector<std::array<std::uint32_t, 2>> folds;
  std::vector<PersistentTouch> touches;
  std::vector<std::uint32_t> first_touch;  ///< piece -> its touches [first_touch[i], first_touch[i + 1])
  std::vector<PersistentNode> nodes;
  std::vector<PersistentNode::Ray> rays;
  std::vector<std::uint32_t> head_ray, tail_ray, node_of_ray;  ///< piece -> ray at its end or kNone; ray -> node
  std::vector<std::array<std::uint32_t, 2>> touching;          ///< segments that meet in such nodes
  base::CountedArray<std::uint32_t> live;                      ///< id in the convolution -> live segment or kNone
  /// Sums of two points, which no segment has; with components without area in both operands.
  std::vector<WalkPair> points;
  bool edges_prove = true;  ///< WindowSettings::edges_prove

  /// The sign of d_a x d_b of two segments.
  int cross(std::uint32_t a, std::uint32_t b) const;
  Segment exact(std::uint32_t segment) const;
  /// The end of a piece that is not cut there: the pair of vertices, and the position on its segment with its error.
  WalkPair end_pair(const Piece& p) const { return p.handed_on ? p.tail_at : segments[p.segment].end; }
  Linear end_position(const Piece& p) const {
    if (p.tail_cut || p.handed_on) return p.tail;
    return segments[p.segment].moving ? Linear{0, 1} : Linear{1, 0};
  }
  /// The sum of two vertices; without its error, which is that of all such points.
  MovingPoint position(WalkPair v) const {
    const Operand &p = base_.operands[0], &q = base_.operands[1];
    const auto at = [&](double of_p, double of_q) {
      return frame_.moving == 0 ? Linear{of_q, of_p} : Linear{of_p, of_q};
    };
    return {at(p.x[v.p], q.x[v.q]), at(p.y[v.p], q.y[v.q])};
  }
  Pair exact(WalkPair v) const { return {base_.operands[0].source[v.p], base_.operands[1].source[v.q]}; }
  std::uint64_t pair_tests = 0;
  bool abandoned = false;  ///< more pairs than allowed, or stopped: nothing here is to be used
  std::size_t bytes() const;

 private:
  void add_live(const ReducedConvolution& convolution, const WindowFrame& swept, const CoveredCells& mask,
                Scratch* memory);
  void add_without_area();
  LiveSegment segment(const WalkSegment& w, std::uint32_t id) const;
  void link_pieces(const ReducedConvolution& convolution);

  const OperandPair& base_;
  WindowFrame frame_;
  double span_ = 0;
};

}  // namespace dymsum::planar
