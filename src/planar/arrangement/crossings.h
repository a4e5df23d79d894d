// All positions where segments of a soup meet: proper crossings, and touches (every sign that is zero).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box_sweep.h"
#include "base/poll.h"
#include "base/scratch.h"
#include "planar/mask/interior_mask.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

// Labelled segments whose left sides lie in the open set M, and how they hang together at their ends: what the
// arrangement works on. A label names the ends of a segment, and the segment itself for exact signs; which segments
// there are, and why, is not known here.

/// A labelled segment: walk edge of operand `side` + walk vertex of the other.
struct SoupSegment {
  std::uint32_t side_edge = 0, vertex = 0;
  std::uint32_t side() const { return side_edge >> 31; }
  std::uint32_t edge() const { return side_edge & 0x7fffffff; }
};

using SoupBox = EdgeBox;

/// A walk edge moved to a vertex.
inline SoupBox moved(const EdgeBox& e, double x, double y) {
  return {e.ax + x, e.ay + y, e.bx + x, e.by + y, e.dx, e.dy};
}

/// The error of a sum of two vertices.
inline double sum_error(const Lattice& lattice) { return lattice.exact_doubles ? 0 : kSumPoint * lattice.span; }

class Soup {
 public:
  Soup(const Lattice& lattice, const Operand& p, const Operand& q, Scratch* memory = nullptr)
      : lattice(lattice), operands{&p, &q}, segments(memory), boxes(memory), memory(memory) {
    side_error = lattice.exact_doubles ? 0 : kSumSide * lattice.span;
    point_error = sum_error(lattice);
  }

  SoupBox box(const WalkSegment& w) const {
    const Operand& other = *operands[1 - w.side];
    return moved(operands[w.side]->boxes[w.edge], other.x[w.vertex], other.y[w.vertex]);
  }
  void reserve(std::size_t n) {
    segments.reserve(n);
    boxes.reserve(n);
  }
  void add(const WalkSegment& w, const SoupBox& b) {
    segments.push_back({(w.side << 31) | w.edge, w.vertex});
    boxes.push_back(b);
  }
  void add(const WalkSegment& w) { add(w, box(w)); }
  /// The last one.
  void drop_last() {
    segments.pop_back();
    boxes.pop_back();
  }

  std::size_t size() const { return segments.size(); }
  double dx(std::uint32_t s) const { return boxes[s].dx; }
  double dy(std::uint32_t s) const { return boxes[s].dy; }
  /// |cross computed in doubles - exact| is at most this for the directed line of s.
  double error(std::uint32_t s) const { return error(boxes[s]); }
  double error(const SoupBox& b) const { return side_error * (std::abs(b.dx) + std::abs(b.dy)) + exact::kUnderflow; }

  /// A bound on the error of the parameter of s where it crosses t properly, computed from its ends' sides of t. It is
  /// at least 1 where the directions are too nearly parallel.
  double parameter_error(std::uint32_t s, std::uint32_t t) const {
    return kCrossingFractions * error(t) / std::abs(dx(s) * dy(t) - dy(s) * dx(t)) + kFractionRoundings;
  }
  /// The error of each coordinate of start + t d, where t errs by `t_error`.
  double step_error(double t_error, double dx, double dy) const {
    return 2 * point_error + (t_error + kStepLength) * std::max(std::abs(dx), std::abs(dy)) + kStepSum * lattice.span;
  }

  WalkPair start(std::uint32_t s) const {
    const SoupSegment& g = segments[s];
    return g.side() == 0 ? WalkPair{g.edge(), g.vertex} : WalkPair{g.vertex, g.edge()};
  }
  WalkPair end(std::uint32_t s) const {
    const SoupSegment& g = segments[s];
    const std::uint32_t next = operands[g.side()]->next[g.edge()];
    return g.side() == 0 ? WalkPair{next, g.vertex} : WalkPair{g.vertex, next};
  }
  /// The segment by its source vertices, as the lattice wants them.
  Segment exact(std::uint32_t s) const {
    const SoupSegment& g = segments[s];
    return {operands[g.side()]->edge(g.edge()), operands[1 - g.side()]->source[g.vertex]};
  }
  Pair exact(WalkPair v) const { return {operands[0]->source[v.p], operands[1]->source[v.q]}; }

  int cross(std::uint32_t s, std::uint32_t t) const {
    const double a = dx(s) * dy(t), b = dy(s) * dx(t), value = a - b;
    const double bound = kScaledEdgeCross * (std::abs(a) + std::abs(b)) + exact::kUnderflow;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    if (lattice.exact_doubles) return (value > 0) - (value < 0);
    if (integral()) return sign(cross_value(s, t));
    return lattice.cross(exact(s).edge, exact(t).edge);
  }

  /// Whether exact signs are those of the 64-bit integers below: coordinates of 29 bits, sums of 30, differences of 31,
  /// products of 61, their sums of 62 (exact/grid.h). Pair sums are exact doubles then.
  bool integral() const { return lattice.to_integers != 0; }
  std::int64_t integer(double v) const { return static_cast<std::int64_t>(v * lattice.to_integers); }
  std::int64_t cross_value(std::uint32_t s, std::uint32_t t) const {
    return integer(dx(s)) * integer(dy(t)) - integer(dy(s)) * integer(dx(t));
  }
  /// d_s x (v - start) and d_s . (v - start) for the pair sum v = (x, y).
  std::int64_t side_value(std::uint32_t s, double x, double y) const {
    const SoupBox& b = boxes[s];
    return integer(b.dx) * integer(y - b.ay) - integer(b.dy) * integer(x - b.ax);
  }
  std::int64_t along_value(std::uint32_t s, double x, double y) const {
    const SoupBox& b = boxes[s];
    return integer(b.dx) * integer(x - b.ax) + integer(b.dy) * integer(y - b.ay);
  }
  std::int64_t length_value(std::uint32_t s) const {
    const std::int64_t x = integer(dx(s)), y = integer(dy(s));
    return x * x + y * y;
  }
  static int sign(std::int64_t v) { return (v > 0) - (v < 0); }
  /// Pair sums are equal exactly where their doubles are.
  bool exact_sums() const { return lattice.exact_doubles || integral(); }
  int dot(std::uint32_t s, std::uint32_t t) const { return lattice.dot(exact(s).edge, exact(t).edge); }

  const Lattice& lattice;
  std::array<const Operand*, 2> operands;
  Array<SoupSegment> segments;
  Array<SoupBox> boxes;
  Scratch* memory;  ///< of the arrays of everything that is done with this soup
  double side_error = 0, point_error = 0;
};

/// A segment that starts or ends at a pair.
struct Incidence {
  std::uint32_t segment = 0;
  bool starts = false;
};

class Chain {
 public:
  explicit Chain(Scratch* memory) : next_(memory) {}
  virtual ~Chain() = default;
  /// The segment that continues s at its end in the generic case, or kNone.
  std::uint32_t next(std::uint32_t s) const { return next_[s]; }
  std::span<const std::uint32_t> next() const { return next_; }
  /// Segments from this index on belong to no chain: their shared ends are meetings like any other.
  std::uint32_t first_unchained() const { return first_unchained_; }
  /// Appends all segments that start or end at a pair of walk vertices.
  virtual void incident(WalkPair v, Array<Incidence>& out) const = 0;

 protected:
  Array<std::uint32_t> next_;
  std::uint32_t first_unchained_ = kNone;
};

/// Segments a and b cross properly, a's direction to the right of b's: d_a x d_b > 0. The parameters' errors are not
/// kept, as they follow from the segments: Soup::parameter_error.
struct Crossing {
  std::uint32_t a, b;
  double ta, tb;
};
static_assert(sizeof(Crossing) == 24, "the largest array of a sum with many crossings");

/// The end point `pair` of some segment lies in the relative interior of `segment`.
struct Touch {
  std::uint32_t segment;
  WalkPair pair;
  double t;
  float error;
};

struct Meetings {
  /// Parameters that are farther apart than this need no comparison of their errors, unless `rough`. Any value is
  /// right.
  static constexpr double kApart = 0x1p-29;
  explicit Meetings(Scratch* memory = nullptr) : crossings(memory), touches(memory), same(memory) {}

  Array<Crossing> crossings;
  Array<Touch> touches;
  Array<std::pair<WalkPair, WalkPair>> same;  ///< different pairs at the same position
  bool rough = false;                         ///< some crossing has a parameter that errs by half of kApart or more
  std::uint64_t cell_entries = 0, pair_tests = 0, exact_signs = 0;
};

/// A point at parameter t of a segment that lies in a covered cell.
struct CoveredMark {
  std::uint32_t segment;
  double t;
};

/// A part of a segment, by parameters.
struct SegmentPiece {
  std::uint32_t segment;
  double low, high;
};

/// Finds the meetings of pairs of segments: all of them without a mask, at least those outside covered cells with one.
class CrossingFinder {
 public:
  CrossingFinder(const Soup& soup, Meetings& out, const Chain* chain = nullptr, const Poll* poll = nullptr)
      : soup_(soup),
        chain_(chain),
        next_(chain != nullptr ? chain->next() : std::span<const std::uint32_t>{}),
        first_unchained_(chain != nullptr ? chain->first_unchained() : kNone),
        poll_(poll),
        out_(out),
        keys_(soup.memory),
        cell_(soup.memory),
        near_(soup.memory),
        ambiguous_(soup.memory) {}

  /// Every pair of boxes is looked at: the reference.
  void all_pairs();
  /// Boxes in the order of their left sides: each is compared with those that start before it ends, eight at a time.
  /// With a mask crossings in covered cells are left out.
  void sweep(const InteriorMask* mask = nullptr);
  /// The same for disjoint pieces of segments: crossings outside them are left out, as far as parameters that err by
  /// less than `reach`, a distance, tell.
  void sweep(std::span<const SegmentPiece> pieces, double reach);
  /// Just these pairs of segments.
  void pairs(std::span<const std::array<std::uint32_t, 2>> list);
  void grid(const Grid& grid, const InteriorMask* mask, Array<CoveredMark>& covered_marks);

 private:
  // Boxes in 15-bit quanta of the span, four to a word, so that one subtraction compares all four bounds.
  struct BoxKey {
    std::uint64_t low, high;
  };
  BoxQuanta quanta(const SoupBox& box, double per_quantum) const;
  double quanta_per_unit() const;
  void make_keys();
  void find_followers(std::uint32_t* follower) const;
  struct ByteBoxes;
  void compare_all();
  // Whether to go on; of rounds that take long.
  void query(std::uint32_t round, std::uint32_t rounds) const {
    if (poll_ != nullptr && round % 256 == 255) (*poll_)(double(round) / rounds);
  }
  struct Probe;
  Probe probe(std::uint32_t s) const;
  bool undecided(const Probe& a, std::uint32_t b);
  bool undecided_strangers(const Probe& a, std::uint32_t b);
  void test(const Probe& a, std::uint32_t b);
  void exact_test(std::uint32_t a, std::uint32_t b);
  int side(std::uint32_t s, WalkPair v, double x, double y);
  bool between(std::uint32_t s, WalkPair v, double x, double y);
  void meet_pieces(const SegmentPiece& piece, std::span<const std::uint32_t> others);
  SoupBox box_of(const SegmentPiece& piece) const;
  enum class Owned { no, yes, unsure };
  Owned owned_by_pieces(std::uint32_t a, std::uint32_t b, double t, double u) const;
  static void make_room(Array<Crossing>& list);
  bool in_covered_cell(std::uint32_t a, std::uint32_t b, double t) const;
  void add_crossing(std::uint32_t a, std::uint32_t b, double a_start, double a_end, double b_start, double b_end);
  void add_touch(std::uint32_t segment, WalkPair pair);
  struct CellLists;
  CellLists list_cells(Array<CoveredMark>& covered_marks) const;
  void test_cell(std::span<const std::uint32_t> ids);
  void finish();

  const Soup& soup_;
  const Chain* chain_;
  std::span<const std::uint32_t> next_;  // empty: no chains
  std::uint32_t first_unchained_;
  const Poll* poll_;
  Meetings& out_;
  const Grid* grid_ = nullptr;
  const InteriorMask* mask_ = nullptr;
  int row_ = 0, column_ = 0;
  std::span<const SegmentPiece> pieces_;
  const SegmentPiece *piece_ = nullptr, *other_piece_ = nullptr;  // those whose segments are being compared
  double piece_reach_ = 0;
  Array<BoxKey> keys_;
  Array<std::uint64_t> cell_;  // the low keys of the segments of one cell
  Array<std::uint32_t> near_;  // those whose boxes meet the box of one of them, or of one segment in a sweep
  Array<Crossing> ambiguous_;  // found near the edge of a cell, perhaps several times
};

// Monotone; one quantum more at the upper end covers the rounding of the coordinates. They lie in [0, span], up to that
// rounding.
inline BoxQuanta CrossingFinder::quanta(const SoupBox& b, double per_quantum) const {
  const auto quantum = [&](double v) { return static_cast<int>(v * per_quantum); };
  const int ax = quantum(b.ax), ay = quantum(b.ay), bx = quantum(b.bx), by = quantum(b.by);
  const auto number = [](int v) { return static_cast<std::int16_t>(v); };
  return {number(std::min(ax, bx)), number(std::min(ay, by)), number(std::max(ax, bx) + 1),
          number(std::max(ay, by) + 1)};
}

}  // namespace dymsum::planar
