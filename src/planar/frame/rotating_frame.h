// One frame of a rotating sum: which segments of the window exist at its angle, where they cross, and the cycles they
// make. In doubles with proved bounds; where those do not decide, the frame is not generic and has to be computed from
// scratch.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/doubles.h"
#include "base/memory_budget.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {

class RotatingFrame {
 public:
  static constexpr std::uint32_t kEnd = kNone;

  /// A sub-edge of a cycle: of a piece, from the crossing with one segment to that with another, or from or to the
  /// segment's end.
  struct Step {
    std::uint32_t piece = 0, segment = 0;
    std::uint32_t from = kEnd, to = kEnd;                    ///< segments
    std::uint32_t from_crossing = kEnd, to_crossing = kEnd;  ///< of this frame
    bool straight = false;  ///< the next one goes straight on: where rings of an operand touch, its edges are cut
  };
  struct Cycle {
    std::uint32_t first = 0, last = 0;  ///< steps [first, last)
    int turning = 0;                    ///< the turning number: 1 for counter-clockwise ones
  };
  /// Two pieces cross: the boundary of what is right of both arrives on one and leaves on the other, turning right.
  struct Crossing {
    std::uint32_t in = 0, out = 0;  ///< pieces
    double t_in = 0, t_out = 0;     ///< as fractions of the segments
    double e_in = 0, e_out = 0;     ///< bounds on their errors
  };

  /// A frame in no window yet.
  RotatingFrame() = default;
  explicit RotatingFrame(const RotatingWindow& window) { enter(window); }
  RotatingFrame(const RotatingFrame&) = delete;
  RotatingFrame& operator=(const RotatingFrame&) = delete;

  /// Frames are made in this window from now on; its arrays take the place of those of the window before.
  void enter(const RotatingWindow& window);
  /// Computes the frame at the midpoint of the window + delta, whose cos and sin err by at most 2^-49. False where
  /// doubles do not decide; then nothing here means anything.
  bool compute(double delta, Heading heading);

  const RotatingWindow& window() const { return *window_; }
  const std::vector<Cycle>& cycles() const { return cycles_; }
  const std::vector<Step>& steps() const { return steps_; }
  const std::vector<Crossing>& crossings() const { return crossings_; }
  Heading heading() const { return heading_; }
  std::size_t bytes() const;
  double delta() const { return delta_; }

  Point position(Pair v) const {
    return {window_->forms().points(0)[v.p].x + turned_[v.q].x, window_->forms().points(0)[v.p].y + turned_[v.q].y};
  }
  double point_error() const { return kTurnedPosition * window_->forms().span(); }
  /// The position at which a step ends, and a bound on the error of each coordinate.
  struct Located {
    Point at;
    double error = 0;
  };
  Located end_of(const Step& s) const;
  /// A point of the segment that lies inside a sub-edge, each coordinate within 2 point_error(); nothing where doubles
  /// do not know one.
  std::optional<Point> midpoint_of(const Step& s) const;
  const Point& turned(std::uint32_t v) const { return turned_[v]; }
  Point direction(const WalkSegment& s) const {
    return s.side == 0 ? window_->forms().edge(0, s.edge) : turned_edge_[s.edge];
  }
  /// The ends of a step as fractions of the segment.
  double from_fraction(const Step& s) const { return s.from_crossing == kEnd ? 0 : crossings_[s.from_crossing].t_out; }
  double to_fraction(const Step& s) const { return s.to_crossing == kEnd ? 1 : crossings_[s.to_crossing].t_in; }

 private:
  /// A segment at this angle: start, vector, |vector|_1, and a bound on the error of the side of a position.
  struct Placed {
    Two at{}, d{};
    double length1 = 0, error = 0;
  };
  /// The segments of a candidate.
  struct Meeting {
    std::uint32_t a = 0, b = 0;
  };
  /// Where to take one from.
  struct Busy {
    std::uint32_t segment = 0, p = 0, q = 0, edge = 0;
  };
  /// How a walk that comes to the end of a piece goes on: over a run of quiet pieces to its last one, or to one of two
  /// pieces, whichever exists. Nowhere from dead tails.
  struct Continuation {
    std::array<std::uint32_t, 2> next{kNone, kNone};
    std::uint32_t leap = kNone;
    std::uint32_t segment = 0;  ///< of the piece
  };
  /// Two segments that may cross: k = a x b; the sides of the start of b against a and, reflected, of the start of a
  /// against b; bounds on their errors.
  struct Near {
    Two starts{}, error{};
    double k = 0;
    std::uint32_t candidate = 0;
  };
  /// A crossing on a piece.
  struct Entry {
    double t = 0;
    float error = 0;  ///< rounded up
    std::uint32_t crossing = 0;
    bool out() const { return (crossing & kOut) != 0; }
    std::uint32_t index() const { return crossing & ~kOut; }
  };
  /// The range of a piece as fractions of its segment, and where its crossings are listed.
  struct Interval {
    Two range{0, 1};
    Entry* entries = nullptr;
  };
  static constexpr std::uint32_t kOut = 0x80000000;  ///< the boundary leaves the crossing on this piece
  bool place_segments(double delta);
  void find_near();
  bool find_crossings();
  static bool provably_beside(const Placed& a, const Placed& b);
  static void insert(Entry* list, std::uint32_t k, Entry entry);
  bool link_crossings();
  bool find_cycles();
  bool find_plain_cycles();
  std::uint32_t count(std::uint32_t piece) const { return count_[piece]; }
  const Entry& entry(std::uint32_t piece, std::uint32_t k) const { return entries_[window_->first_of[piece] + k]; }
  std::uint32_t partner(std::uint32_t piece, std::uint32_t crossing) const;
  /// The crossing at which a walk arrives that leaves one; kNone where it ends.
  std::uint32_t successor(std::uint32_t crossing) {
    return next_[crossing] == kOnward ? onward(crossings_[crossing].out, kNone, nullptr) : next_[crossing];
  }
  /// The same for a walk that comes to the end of a piece; kRound when it gets to the piece `begin`. `path` takes the
  /// pieces after the first one.
  std::uint32_t onward(std::uint32_t piece, std::uint32_t begin, std::vector<std::uint32_t>* path);
  static constexpr std::uint32_t kOnward = 0xfffffffe, kRound = 0xfffffffd;
  std::uint32_t record(std::uint32_t crossing);
  bool close(std::uint32_t first);
  int half(const RotatingSegment& s, Point d);

  const RotatingWindow* window_ = nullptr;
  Heading heading_;
  double delta_ = 0;
  std::vector<Point> turned_, turned_edge_;
  base::CountedArray<Continuation> continuations_;  // by piece
  std::array<base::CountedArray<Busy>, 2> busy_;    // segments with candidates, by side
  base::CountedArray<Placed> placed_;               // by segment, of busy ones; anything where it does not exist
  std::vector<std::uint8_t> exists_;
  base::CountedArray<Meeting> meetings_;  // of candidates
  base::CountedArray<Near> near_;         // candidates that may cross: the first near_count_
  std::size_t near_count_ = 0;
  std::vector<Crossing> crossings_;
  base::CountedArray<std::uint32_t>
      count_;  // of entries, by piece; the positions are those of the window's index of candidates
  base::CountedArray<Entry> entries_;       // along each piece
  base::CountedArray<Interval> intervals_;  // by piece
  std::vector<std::uint32_t>
      next_;  // crossing -> the crossing at which one arrives, kNone, or kOnward: past the end of the piece
  std::vector<std::uint8_t> seen_, walked_;  // crossing; piece without crossings
  std::vector<std::uint32_t> path_;
  std::vector<Step> steps_;
  std::vector<Cycle> cycles_;
  bool proved_ = true;
};

}  // namespace dymsum::planar
