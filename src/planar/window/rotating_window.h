// A window of angles for a rotating sum: the pieces of convolution segments that can bound the sum somewhere in it, and
// the pairs of pieces that may meet. Built once; frames inside the window only look here.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/box_sweep.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "base/scratch.h"
#include "planar/motion/turning_forms.h"
#include "planar/window/frame_window.h"
#include "planar/window/rotation_mask.h"

namespace dymsum::planar {

// Pairs of boxes that meet: a sweep over their left sides in 15-bit numbers, eight at a time, in each of several
// horizontal strips.

class BoxPairs {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  /// Takes boxes within [0, extent] in both axes; what lies beyond counts as at the rim.
  explicit BoxPairs(double extent, Scratch* memory = nullptr);

  void reserve(std::size_t n) { boxes_.reserve(n); }
  /// The next box, number 0, 1, ...
  void add(double x0, double y0, double x1, double y1) {
    boxes_.push_back({quantum(x0), quantum(y0), quantum(x1), quantum(y1)});
  }

  /// Every two boxes that meet, once, and some that nearly do; only some of them if there are more than `most`, or if
  /// a stop is requested. O(n log n + pairs of a strip that meet in x / 8).
  Array<Pair> find(std::size_t most = ~std::size_t{0}, const base::StopToken& stop = {});

 private:
  struct Box {
    std::int16_t x0, y0, x1, y1;
  };
  // Monotone, so boxes that meet do so in quanta too.
  std::int16_t quantum(double v) const {
    return static_cast<std::int16_t>(std::clamp(v * per_unit_, 0.0, double{kBoxQuanta - 1}));
  }

  int strips() const;
  void sweep(Array<std::uint64_t>& order, std::int16_t low, std::size_t most);

  double per_unit_ = 0;
  Scratch* memory_;
  Array<Box> boxes_;
  Array<Pair> pairs_;
  Array<std::int16_t> sides_;  // of the boxes of a strip in their order: left, low, high
  std::size_t count_ = 0;
};

// Pieces at the midpoint of a range of angles: which of them stay apart throughout it, four pairs at a time in floats.

class PieceLines {
 public:
  /// Serves coordinates of sums up to `span`; `half`: the range reaches so far from its midpoint, at most a radian.
  PieceLines(double span, double half, Scratch* memory = nullptr);

  void reserve(std::size_t n) { pieces_.reserve(n); }
  /// The next piece: of the segment of an edge of operand `side` with vector d that starts at the sum of a fixed and a
  /// turning vertex, the part from share `head` to `tail`.
  void add(std::uint32_t side, Point fixed, Point turning, Point d, double head, double tail) {
    const auto to = [&](double v) { return static_cast<float>(v * scale_); };
    pieces_.push_back({Four{to(fixed.x), to(fixed.y), to(turning.x), to(turning.y)},
                       Four{to(d.x), to(d.y), static_cast<float>(head), static_cast<float>(tail)},
                       Four{to(std::abs(d.x) + std::abs(d.y)), side == 0 ? 0.0F : 1.0F, 0, 0}});
  }

  /// Bit k of four is set where pieces a[k] and b[k] provably meet at no angle of the range, as both ends of one stay
  /// on the same side of the other one's line. Some that stay apart are not found.
  std::uint32_t apart(const std::array<std::uint32_t, 4>& a, const std::array<std::uint32_t, 4>& b) const;

 private:
  using Four = float __attribute__((vector_size(16)));
  struct Piece {
    Four positions;  ///< fixed and turning vertex
    Four line;       ///< vector, head, tail
    Four rest;       ///< |vector|_1, side
  };
  /// The lines of four pieces, one in each lane.
  struct Lines {
    Four fx, fy, tx, ty, dx, dy, head, tail, length, side;
  };
  Lines lines(const std::array<std::uint32_t, 4>& of) const;

  double scale_;
  float half_, second_;
  Array<Piece> pieces_;
};

/// A segment that is live somewhere in the window. Windows are kept, so all of this is as small as it can be.
struct RotatingSegment : WalkSegment {
  bool throughout = false;          ///< it exists at every angle of the window
  RotationCatalog::Span span = {};  ///< it exists there, relative to the midpoint of the window
  Pair end = {};
  std::uint32_t first_piece = 0, last_piece = 0;  ///< its pieces [first_piece, last_piece)
  std::array<std::uint32_t, 2> next{kNone,
                                    kNone};  ///< the live segments that may continue it; at most one exists at a time
  Pair start() const { return TurningForms::start(*this); }
};

/// An interval of a segment between its ends or positions that lie in dead cells at every angle of the window. What
/// reaches one is false.
struct RotatingPiece {
  double head = 0, tail = 1;  ///< as fractions of the segment
  std::uint32_t segment = 0;
  std::uint32_t follower = kNone;  ///< a quiet piece that follows it at every angle of the window
  std::uint32_t run_last = kNone;  ///< of a quiet one: where followers lead to
  bool head_cut = false, tail_cut = false;
  bool tail_dead = false;  ///< behind the tail nothing alive can follow, at no angle of the window
  bool quiet = false;      ///< whole, there at every angle of the window, and nothing meets it
};

/// Two pieces that may meet.
struct RotationCandidate {
  std::uint32_t a = 0, b = 0;
};

class RotatingWindow : public CandidateIndex {
 public:
  /// Angles within `half` of `midpoint`, a little more being covered. `mask` off: no cell is dead. Given up where boxes
  /// of more than `most_pairs` pairs of pieces meet, and when a stop is requested. Requires `half` below a radian:
  /// bounds of turning_forms.h count on that, and spans on less than a quarter turn (RotationCatalog::span).
  RotatingWindow(const RotationGrid& grid, const RotationCatalog& catalog, double midpoint, double half, bool mask,
                 std::size_t most_pairs = ~std::size_t{0}, const base::StopToken& stop = {});

  bool complete = true;  ///< not given up

  double midpoint = 0, half = 0;
  Heading heading;            ///< of the midpoint
  std::vector<Point> turned;  ///< vertices of the rotating operand there, about its centre
  base::CountedArray<RotatingSegment> segments;
  base::CountedArray<RotatingPiece> pieces;
  base::CountedArray<RotationCandidate> candidates;
  std::vector<std::uint32_t> changing;  ///< segments that do not exist at every angle
  std::vector<std::uint32_t> rounds;    ///< whole pieces that may follow each other all round, without quiet ones
  std::vector<std::uint32_t> circles;   ///< quiet pieces whose followers lead back to them, one of each circle
  std::uint64_t all_segments = 0, pair_tests = 0, cells = 0;  ///< what building it looked at; cells of the mask

  const TurningForms& forms() const { return forms_; }
  /// The live segment of that name, or kNone.
  std::uint32_t find(const WalkSegment& s) const;
  std::uint32_t segment_of(std::uint32_t piece) const { return pieces[piece].segment; }
  std::size_t bytes() const;

 private:
  /// A segment at the midpoint: the vertices it starts with, its vector, and how far a point of it moves from there in
  /// either axis.
  struct Swept {
    Point fixed, turning, d;
    Point reach;
    std::uint32_t side = 0;
    double x() const { return fixed.x + turning.x; }
    double y() const { return fixed.y + turning.y; }
  };
  struct Box {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  };
  /// The live segments of a vertex with edges of a side, in the order of the edges.
  struct Turn {
    std::uint32_t first = 0, last = 0;
  };
  struct Making;  ///< what is needed until it is made
  std::uint32_t find_in_order(const WalkSegment& s) const;
  Swept swept(const WalkSegment& s, const Making& making) const;
  void add_segments(const CoveredCells& dead, Making& making);
  void add_segment(const WalkSegment& walk, const CoveredCells& dead, Making& making) const;
  void add_pieces(const Swept& w, const CoveredCells& dead, Making& making) const;
  void find_cuts(Point start, Point d, Point reach, const CoveredCells& dead, Array<double>& cuts) const;
  Box box_of(const RotatingPiece& p, const Swept& w, double reach) const;
  void find_candidates(const CoveredCells& dead, Making& making);
  Array<std::array<std::uint32_t, 2>> near_pairs(Making& making);
  void find_next();
  void find_dead_tails();
  void find_runs();
  void find_rounds();

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  double shift_ = 0;                        // of coordinates to those of the grid
  bool masked_ = false;                     // cells may be dead
  std::array<std::vector<Turn>, 2> turns_;  // by side and vertex
};

// A window of angles as moving sums keep it, and what such windows are made of.

/// What never changes while an operand rotates. Windows and the thread that makes them share it.
struct TurnedOperands {
  /// The smaller operand, which moves in windows, as operand 1.
  explicit TurnedOperands(std::shared_ptr<const OperandPair> base)
      : pair(std::move(base)), forms(*pair), catalog(forms) {}
  TurnedOperands(const TurnedOperands&) = delete;
  TurnedOperands& operator=(const TurnedOperands&) = delete;

  std::shared_ptr<const OperandPair> pair;
  TurningForms forms;
  RotationCatalog catalog;
};

struct TurnedWindow final : FrameWindow {
  TurnedWindow(std::shared_ptr<const TurnedOperands> of, RotatingWindow w)
      : operands(std::move(of)), window(std::move(w)) {}

  /// Angles come round; doubles of them err, so a window's ends are left a little early.
  bool covers(double angle) const override {
    return std::abs(std::remainder(angle - window.midpoint, kTurn)) <= window.half - kAngleDifference;
  }
  double end(bool up) const override { return up ? window.midpoint + window.half : window.midpoint - window.half; }
  std::size_t bytes() const override { return window.bytes(); }

  std::shared_ptr<const TurnedOperands> operands;  // outlive the window
  RotatingWindow window;
};

}  // namespace dymsum::planar
