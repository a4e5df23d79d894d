#include "spatial/gauss/face_pairs.h"

namespace dymsum::spatial {

FacePairs::FacePairs(const Polytope& p, const Polytope& q) {
  for (int op = 0; op < 2; ++op) {
    const Polytope& mine = op == 0 ? p : q;
    parallel[op].assign(mine.face_count(), kNoFace);
    start[op].assign(2 * mine.edge_count(), 0);
  }
}

void FacePairs::join() {
  for (const FacePair& pair : all) {
    parallel[0][pair.p] = pair.q;
    parallel[1][pair.q] = pair.p;
  }
}

void FacePairs::part() {
  for (const FacePair& pair : all) parallel[0][pair.p] = parallel[1][pair.q] = kNoFace;
}

/// The direction in which the other operand's half-edge `other`, an edge of the face that face[mine] of operand op is
/// parallel to, leads a little way along the arc of `mine` from there: whether its target is further out (1) or its
/// origin (-1).
int FacePairs::side_beyond(const Signs& signs, int op, HalfEdge mine, HalfEdge other) const {
  const Polytope &a = signs.poly(op), &b = signs.poly(1 - op);
  const std::uint32_t f = a.face[mine], f_end = a.face[twin(mine)];
  if (const int s = signs.true_sign(op, f_end, other)) return s;
  // The edges are parallel: the arcs lie on one another for a while, the infinitesimal rotation puts them beside each
  // other.
  const std::uint32_t g = b.face[other], g_end = b.face[twin(other)];
  if (parallel[op][f_end] == g_end) {
    // The arcs are on one side for their whole lengths: seen from either operand and either end it is the side at the
    // right face of P.
    const std::uint32_t right = signs.poly(0).face[(op == 0 ? mine : other) | 1];
    return signs.sign_now(op, op == 0 ? right : parallel[0][right], other);
  }
  const int here = signs.sign_now(op, f, other), there = signs.sign_now(op, f_end, other);
  if (here == there) return here;
  // If they cross meanwhile, that crossing is left out.
  const bool crossing = signs.sign_now(1 - op, g, mine) != signs.sign_now(1 - op, g_end, mine);
  return crossing ? there : here;
}

}  // namespace dymsum::spatial
