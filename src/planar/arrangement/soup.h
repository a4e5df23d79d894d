// Labelled segments whose left sides lie in the open set M, and how they hang together at their ends: what the
// arrangement works on. A label names the ends of a segment, and the segment itself for exact signs; which segments
// there are, and why, is not known here.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/scratch.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
