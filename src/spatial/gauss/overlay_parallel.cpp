// Faces of P and Q that face the same way. The infinitesimal rotation puts their directions a little apart, and near
// them each arc of the one would cross about half the arcs of the other: n m crossings that no true facet has. They are
// left out: arcs that begin or end in the same direction do not count as crossing. Instead every arc of such a face
// begins in the cell that it enters a little way off, further than the infinitesimal rotation moves anything.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spatial/gauss/most_rise.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// The face of the other operand that face f of operand op, whose extreme vertex is known, is truly parallel to.
std::uint32_t Overlay::parallel_face(int op, std::uint32_t f) const {
  const Polytope& other = poly(1 - op);
  const std::uint32_t v = extreme_[op][f], begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  const Vec3 row = signs_.row_now(op, f);
  std::uint32_t first = size, second = size;
  look_above(other, v, row, -signs_.error(op), [&](std::uint32_t k) {
    if (second == size && signs_.true_sign(op, f, other.ring[begin + k]) == 0) (first == size ? first : second) = k;
  });
  if (second == size) return kNoFace;
  // Two level edges are neighbours in the ring, and the face lies on the left of the first of the two.
  return other.ring_face[begin + (second == first + 1 ? first : second)];
}

/// Which way the other operand's half-edge `other`, an edge of the face that face[mine] of operand op is parallel to,
/// leads a little way along the arc of `mine` from there: whether its target is further out (1) or its origin (-1).
int Overlay::side_beyond(int op, HalfEdge mine, HalfEdge other) const {
  const Polytope &a = poly(op), &b = poly(1 - op);
  const std::uint32_t f = a.face[mine], f_end = a.face[twin(mine)];
  if (const int s = signs_.true_sign(op, f_end, other)) return s;
  // The edges are parallel: the arcs lie on one another for a while, the infinitesimal rotation puts them beside each
  // other.
  const std::uint32_t g = b.face[other], g_end = b.face[twin(other)];
  if (parallel_[op][f_end] == g_end) {
    // For their whole lengths: seen from either operand and either end on the same side, that at the right face of P.
    const std::uint32_t right = poly(0).face[(op == 0 ? mine : other) | 1];
    return signs_.sign_now(op, op == 0 ? right : parallel_[0][right], other);
  }
  const int here = signs_.sign_now(op, f, other), there = signs_.sign_now(op, f_end, other);
  if (here == there) return here;
  // Where they cross meanwhile, that crossing is left out.
  const bool crossing = signs_.sign_now(1 - op, g, mine) != signs_.sign_now(1 - op, g_end, mine);
  return crossing ? there : here;
}

/// The cell that the arc of each half-edge of face f of operand op, which is parallel to face g of the other one,
/// begins in. Going round f, the arcs turn one way, and so do the cells. Calls changed(half-edge) for those that it
/// changes.
template <class Changed>
void Overlay::start_arcs(int op, std::uint32_t f, std::uint32_t g, const Changed& changed) {
  const Polytope &mine = poly(op), &other = poly(1 - op);
  HalfEdge at = other.first[g];  // leaves the cell at hand
  HalfEdge h = mine.first[f];
  std::uint32_t turned = 0;
  do {
    // The next one while it rises; at first, from a vertex that may be on the far side, until one is reached that does.
    const auto rises = [&](HalfEdge edge) { return side_beyond(op, h, edge) > 0; };
    if (h == mine.first[f])
      while (!rises(at)) at = other.next[at];
    while (rises(at)) {
      at = other.next[at];
      if (++turned > 4 * (other.edge_count() + 1))
        throw std::logic_error("Overlay: a face without an outermost vertex");
    }
    std::uint32_t& start = start_[op][h];
    if (start != other.origin[at]) {
      start = other.origin[at];
      changed(h);
    }
    h = mine.next[h];
  } while (h != mine.first[f]);
}

/// From nothing, with all extreme vertices known.
void Overlay::find_pairs() {
  for (const FacePair& pair : pairs_) parallel_[0][pair.p] = parallel_[1][pair.q] = kNoFace;
  pairs_.clear();
  if (has_flat_edges_) return;
  for (std::uint32_t f = 0; f < poly(0).face_count(); ++f) {
    if (vertex_until_[0][f] > clock_) continue;  // all edges at the extreme vertex provably fall
    const std::uint32_t g = parallel_face(0, f);
    if (g != kNoFace) pairs_.push_back({f, g});
  }
  join_pairs();
  const auto changed = [](HalfEdge) {};
  for (const FacePair& pair : pairs_) {
    start_arcs(0, pair.p, pair.q, changed);
    start_arcs(1, pair.q, pair.p, changed);
  }
}

void Overlay::join_pairs() {
  for (const FacePair& pair : pairs_) {
    parallel_[0][pair.p] = pair.q;
    parallel_[1][pair.q] = pair.p;
  }
}

/// In updates, from the walker's faces whose vertices have no certificate (`faces`) and are right now: arcs of pairs
/// that part, meet or turn against each other begin elsewhere.
void Overlay::follow_pairs(std::span<const std::uint32_t> faces) {
  const int w = walker_;
  parted_.swap(pairs_);
  pairs_.clear();
  for (const FacePair& pair : parted_) parallel_[0][pair.p] = parallel_[1][pair.q] = kNoFace;
  if (!has_flat_edges_)
    for (const std::uint32_t f : faces) {
      const std::uint32_t g = parallel_face(w, f);
      if (g != kNoFace) pairs_.push_back(w == 0 ? FacePair{f, g} : FacePair{g, f});
    }
  std::sort(pairs_.begin(), pairs_.end());
  join_pairs();
  const auto mine = [w](const FacePair& pair) { return w == 0 ? pair.p : pair.q; };
  const auto others = [w](const FacePair& pair) { return w == 0 ? pair.q : pair.p; };
  for (const FacePair& pair : pairs_) {
    const bool stays = std::binary_search(parted_.begin(), parted_.end(), pair);
    if (!stays) break_arcs_of(mine(pair), others(pair));
    start_arcs(w, mine(pair), others(pair), [&](HalfEdge h) { break_arc(h / 2, kEnds); });
    start_arcs(1 - w, others(pair), mine(pair), [&](HalfEdge h) { touch(1 - w, h / 2); });
    if (climb(1 - w, others(pair), extreme_[1 - w][others(pair)], signs_.row_now(1 - w, others(pair))))
      note_face(1 - w, others(pair));
  }
  for (const FacePair& pair : parted_) {
    if (std::binary_search(pairs_.begin(), pairs_.end(), pair)) continue;
    break_arcs_of(mine(pair), others(pair));
    const std::uint32_t g = others(pair);
    if (parallel_[1 - w][g] == kNoFace && climb(1 - w, g, extreme_[1 - w][g], signs_.row_now(1 - w, g)))
      note_face(1 - w, g);
  }
}

/// All arcs of face f of the walker, and of face g of the other operand.
void Overlay::break_arcs_of(std::uint32_t f, std::uint32_t g) {
  const int w = walker_;
  for (HalfEdge h = poly(w).first[f];;) {
    break_arc(h / 2, kEnds);
    if ((h = poly(w).next[h]) == poly(w).first[f]) break;
  }
  for (HalfEdge h = poly(1 - w).first[g];;) {
    touch(1 - w, h / 2);
    if ((h = poly(1 - w).next[h]) == poly(1 - w).first[g]) break;
  }
}

/// Before a long move is followed: the pairs that stay, and where their arcs begin now.
void Overlay::keep_pairs() {
  const int w = walker_;
  for (const FacePair& pair : pairs_) parallel_[0][pair.p] = parallel_[1][pair.q] = kNoFace;
  std::size_t stay = 0;
  for (const FacePair& pair : pairs_) {
    const std::uint32_t f = w == 0 ? pair.p : pair.q, g = w == 0 ? pair.q : pair.p;
    // The vertices are noted as changed only where nothing else will do so.
    const std::uint32_t before = extreme_[w][f], other_before = extreme_[1 - w][g];
    const bool changed = climb(w, f, before, signs_.row_now(w, f));
    if (parallel_face(w, f) != g) {
      extreme_[w][f] = before;
      continue;
    }
    if (changed) note_face(w, f);
    if (climb(1 - w, g, other_before, signs_.row_now(1 - w, g))) note_face(1 - w, g);
    pairs_[stay++] = pair;
  }
  pairs_.resize(stay);
  join_pairs();
  const auto changed = [](HalfEdge) {};
  for (const FacePair& pair : pairs_) {
    start_arcs(0, pair.p, pair.q, changed);
    start_arcs(1, pair.q, pair.p, changed);
  }
}

/// After a long move, whose walks went through the crossings near pairs that it did not know of. The walk to a face of
/// such a pair has come to an arc on which it lies: the last cell is one of those round the other face of the pair, and
/// the circle, which goes through that, enters or leaves the cell across one of its two arcs there.
void Overlay::repair_new_pairs() {
  const int w = walker_;
  expired_.swap(on_arcs_);
  on_arcs_.clear();
  expired_.push_back(visits_[w][0].face);  // which was climbed for
  for (const FacePair& pair : pairs_) expired_.push_back(w == 0 ? pair.p : pair.q);
  std::sort(expired_.begin(), expired_.end());
  expired_.erase(std::unique(expired_.begin(), expired_.end()), expired_.end());
  const std::size_t kept = pairs_.size();
  follow_pairs(expired_);
  if (pairs_.size() == kept) return;
  for (const std::uint32_t e : broken_)
    for (std::uint32_t id = head_[w][e]; id != kNoCrossing; id = crossings_[id].next[w]) {
      crossing_until_[id] = kBeforeAll;
      break_arc(e, 1);
    }
  repair_broken();
}

}  // namespace dymsum::spatial
