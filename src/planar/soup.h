// Labelled segments whose left sides lie in the open set M: what the arrangement works on. It has never heard of convolutions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

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

/// Rounded end points, for filters.
struct SoupBox {
  double ax, ay, bx, by;
};

class Soup {
 public:
  Soup(const Lattice& lattice, const Operand& p, const Operand& q) : lattice(lattice), operands{&p, &q} {
    const double roundings = lattice.span;
    // cross(d, v - a): d once rounded, v and a two roundings each and one more for the difference, two products, one sum; at most
    // 16 roundings of |d|_1 span.
    side_error = lattice.exact_doubles ? 0 : 0x1p-49 * roundings;
    // A segment end: the sum of two rounded coordinates, rounded.
    point_error = lattice.exact_doubles ? 0 : 0x1p-51 * roundings;
  }

  void reserve(std::size_t n) {
    segments.reserve(n);
    boxes.reserve(n);
  }
  SoupBox box(const WalkSegment& w) const {
    const Operand &o = *operands[w.side], &other = *operands[1 - w.side];
    const std::uint32_t a = o.source[w.edge], b = o.source[o.next[w.edge]], v = other.source[w.vertex];
    const double vx = lattice.x[1 - w.side][v], vy = lattice.y[1 - w.side][v];
    const auto &x = lattice.x[w.side], &y = lattice.y[w.side];
    return {x[a] + vx, y[a] + vy, x[b] + vx, y[b] + vy};
  }
  void add(const WalkSegment& w, const SoupBox& b) {
    segments.push_back({(w.side << 31) | w.edge, w.vertex});
    boxes.push_back(b);
  }

  std::size_t size() const { return segments.size(); }
  double dx(std::uint32_t s) const { return operands[segments[s].side()]->ex[segments[s].edge()]; }
  double dy(std::uint32_t s) const { return operands[segments[s].side()]->ey[segments[s].edge()]; }
  /// |cross computed in doubles - exact| is at most this for the directed line of s.
  double error(std::uint32_t s) const { return side_error * (std::abs(dx(s)) + std::abs(dy(s))); }

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
    return lattice.cross(exact(s).edge, exact(t).edge);
  }
  int dot(std::uint32_t s, std::uint32_t t) const { return lattice.dot(exact(s).edge, exact(t).edge); }

  const Lattice& lattice;
  std::array<const Operand*, 2> operands;
  std::vector<SoupSegment> segments;
  std::vector<SoupBox> boxes;
  double side_error = 0, point_error = 0;
};

}  // namespace dymsum::planar
