// Labelled segments whose left sides lie in the open set M: what the arrangement works on. It has never heard of convolutions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/scratch.h"
#include "planar/convolution.h"
#include "planar/lattice.h"
#include "planar/operand.h"

namespace dymsum::planar {

/// A pair of walk vertices (P, Q).
using WalkPair = Pair;

/// A labelled segment: walk edge of operand `side` + walk vertex of the other.
struct SoupSegment {
  std::uint32_t side_edge = 0, vertex = 0;
  std::uint32_t side() const { return side_edge >> 31; }
  std::uint32_t edge() const { return side_edge & 0x7fffffff; }
};

using SoupBox = EdgeBox;

/// A walk edge moved to a vertex.
inline SoupBox moved(const EdgeBox& e, double x, double y) { return {e.ax + x, e.ay + y, e.bx + x, e.by + y, e.dx, e.dy}; }

/// The error of a sum of two vertices: two rounded coordinates, and the sum rounded.
inline double sum_error(const Lattice& lattice) { return lattice.exact_doubles ? 0 : 0x1p-51 * lattice.span; }

class Soup {
 public:
  Soup(const Lattice& lattice, const Operand& p, const Operand& q,
       Scratch* memory = nullptr)
      : lattice(lattice), operands{&p, &q}, segments(memory), boxes(memory), memory(memory) {
    const double roundings = lattice.span;
    // cross(d, v - a): d once rounded, v and a two roundings each and one more for the difference, two products, one sum; at most
    // 16 roundings of |d|_1 span.
    side_error = lattice.exact_doubles ? 0 : 0x1p-49 * roundings;
    point_error = sum_error(lattice);
  }

  SoupBox box(const WalkSegment& w) const {
    const Operand& other = *operands[1 - w.side];
    return moved(operands[w.side]->boxes[w.edge], other.x[w.vertex], other.y[w.vertex]);
  }
  /// All segments of a convolution, in the order of their ids.
  void add(const ReducedConvolution& convolution) {
    std::size_t i = size();
    segments.resize(i + convolution.size());
    boxes.resize(segments.size());
    SoupSegment* segment = segments.data() + i;
    SoupBox* to = boxes.data() + i;
    convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges, std::uint32_t lo,
                                  std::uint32_t count) {
      const EdgeBox* own = operands[side]->boxes.data();
      const double vx = operands[1 - side]->x[v], vy = operands[1 - side]->y[v];
      for (std::uint32_t k = 0, at = lo; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1) {
        const std::uint32_t e = edges[at];
        *segment++ = {(side << 31) | e, v};
        *to++ = moved(own[e], vx, vy);
      }
    });
  }
  void reserve(std::size_t n) {
    segments.reserve(n);
    boxes.reserve(n);
  }
  void add(const WalkSegment& w, const SoupBox& b) {
    segments.push_back({(w.side << 31) | w.edge, w.vertex});
    boxes.push_back(b);
  }

  std::size_t size() const { return segments.size(); }
  double dx(std::uint32_t s) const { return boxes[s].dx; }
  double dy(std::uint32_t s) const { return boxes[s].dy; }
  /// |cross computed in doubles - exact| is at most this for the directed line of s.
  double error(std::uint32_t s) const { return side_error * (std::abs(dx(s)) + std::abs(dy(s))); }

  /// A bound on the error of the parameter of s where it crosses t properly, computed from its ends' sides of t.
  /// Numerator and denominator err by at most 1.5 and 3 side errors; the quotient is at most 1 and rounded twice. The
  /// denominator is the cross product of the directions but for one side error; where it is so small that 8 side errors
  /// are not enough, the bound is larger than 1.
  double parameter_error(std::uint32_t s, std::uint32_t t) const {
    return 8 * error(t) / std::abs(dx(s) * dy(t) - dy(s) * dx(t)) + 0x1p-50;
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
  /// By source vertices, as the lattice wants them.
  Segment exact(std::uint32_t s) const {
    const SoupSegment& g = segments[s];
    return {operands[g.side()]->edge(g.edge()), operands[1 - g.side()]->source[g.vertex]};
  }
  Pair exact(WalkPair v) const { return {operands[0]->source[v.p], operands[1]->source[v.q]}; }

  int cross(std::uint32_t s, std::uint32_t t) const {
    const double a = dx(s) * dy(t), b = dy(s) * dx(t), value = a - b;
    // Scaled components carry three roundings each: seven in a product, one in the difference.
    const double bound = 0x1p-49 * (std::abs(a) + std::abs(b)) + 0x1p-1000;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    if (lattice.exact_doubles) return (value > 0) - (value < 0);
    return lattice.cross(exact(s).edge, exact(t).edge);
  }
  int dot(std::uint32_t s, std::uint32_t t) const { return lattice.dot(exact(s).edge, exact(t).edge); }

  const Lattice& lattice;
  std::array<const Operand*, 2> operands;
  Array<SoupSegment> segments;
  Array<SoupBox> boxes;
  Scratch* memory;  ///< of the arrays of everything that is done with this soup
  double side_error = 0, point_error = 0;
};

}  // namespace dymsum::planar
