// The kinetic convolution: every vertex with the edges of the other operand that it meets while it turns the short way,
// reversed where it turns clockwise. Its winding number about x is the Euler characteristic of P and x - Q in common.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planar/convolution/convolution.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// The edges of an operand's component that a walk vertex of the other operand meets in its short turn: `count` of
/// `edges` (a cyclic list sorted by direction) from `lo` on. Side 0: edges of P + vertex of Q.
struct KineticTurn {
  std::uint32_t side = 0, vertex = 0;
  const std::vector<std::uint32_t>* edges = nullptr;
  std::uint32_t lo = 0, count = 0;
  int sign = 1;  ///< 1: a counter-clockwise turn; -1: a clockwise one, the edges are traversed reversed
};

/// Calls f for every vertex (its turn may be empty) of every pair of components of which at least one is
/// two-dimensional, without the holes that the pair fills (hole_is_filled). Turns are half-open as if the directions of
/// Q were turned counter-clockwise by an infinitesimal angle: (in, out] for vertices of Q, [in, out) for vertices of P,
/// and (out, in], [out, in) where they turn clockwise. Hence every pair of vertices starts as many segments as it ends.
/// Cost: O(n log n + n log m) and the calls, for n vertices of both and m edges of the larger component, per pair of
/// components.
void for_each_kinetic_turn(const Lattice& lattice, const Operand& p, const Operand& q,
                           const std::function<void(const KineticTurn&)>& f);

/// A segment of the kinetic convolution in the direction of its edge: crossing it from right to left changes the
/// winding number by `sign`.
struct KineticSegment {
  WalkSegment walk;
  int sign = 1;
};

std::vector<KineticSegment> kinetic_convolution(const Lattice& lattice, const Operand& p, const Operand& q);

}  // namespace dymsum::planar
