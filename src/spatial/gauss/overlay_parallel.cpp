// Faces of P and Q that face the same way. The infinitesimal rotation puts their directions a little apart, and near
// them each arc of the one would cross about half the arcs of the other: n m crossings that no true facet has. They are
// left out: arcs that begin or end in the same direction do not count as crossing. Instead every arc of such a face
// begins in the cell that it enters a little way off, further than the infinitesimal rotation moves anything.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spatial/gauss/overlay.h"
#include "spatial/gauss/polytope.h"

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

/// Finds the pairs from nothing, with all extreme vertices known.
void Overlay::find_pairs() {
  pairs_.part();
  pairs_.all.clear();
  if (has_flat_edges()) return;
  for (std::uint32_t f = 0; f < poly(0).face_count(); ++f) {
    if (vertex_until_[0][f] > clock_) continue;  // all edges at the extreme vertex provably fall
    const std::uint32_t g = parallel_face(0, f);
    if (g != kNoFace) pairs_.all.push_back({f, g});
  }
  pairs_.join();
  const auto changed = [](HalfEdge) {};
  for (const FacePair& pair : pairs_.all) {
    pairs_.start_arcs(signs_, 0, pair.p, pair.q, changed);
    pairs_.start_arcs(signs_, 1, pair.q, pair.p, changed);
  }
}

/// Finds what updates change of pairs, from the walker's faces whose vertices have no certificate (`faces`) and are
/// right now: arcs of pairs that part, meet or turn against each other begin elsewhere.
void Overlay::follow_pairs(std::span<const std::uint32_t> faces) {
  const int w = walker_;
  pairs_.part();
  pairs_.parted.swap(pairs_.all);
  pairs_.all.clear();
  if (!has_flat_edges())
    for (const std::uint32_t f : faces) {
      const std::uint32_t g = parallel_face(w, f);
      if (g != kNoFace) pairs_.all.push_back(w == 0 ? FacePair{f, g} : FacePair{g, f});
    }
  std::sort(pairs_.all.begin(), pairs_.all.end());
  pairs_.join();
  const auto mine = [w](const FacePair& pair) { return w == 0 ? pair.p : pair.q; };
  const auto others = [w](const FacePair& pair) { return w == 0 ? pair.q : pair.p; };
  for (const FacePair& pair : pairs_.all) {
    const bool stays = std::binary_search(pairs_.parted.begin(), pairs_.parted.end(), pair);
    if (!stays) break_arcs_of(mine(pair), others(pair));
    pairs_.start_arcs(signs_, w, mine(pair), others(pair), [&](HalfEdge h) { break_arc(h / 2, kEnds); });
    pairs_.start_arcs(signs_, 1 - w, others(pair), mine(pair), [&](HalfEdge h) { arcs_.touch(1 - w, h / 2); });
    if (climb(1 - w, others(pair), extreme_[1 - w][others(pair)], signs_.row_now(1 - w, others(pair))))
      note_face(1 - w, others(pair));
  }
  for (const FacePair& pair : pairs_.parted) {
    if (std::binary_search(pairs_.all.begin(), pairs_.all.end(), pair)) continue;
    break_arcs_of(mine(pair), others(pair));
    const std::uint32_t g = others(pair);
    if (pairs_.parallel[1 - w][g] == kNoFace && climb(1 - w, g, extreme_[1 - w][g], signs_.row_now(1 - w, g)))
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
    arcs_.touch(1 - w, h / 2);
    if ((h = poly(1 - w).next[h]) == poly(1 - w).first[g]) break;
  }
}

/// Keeps, before a long move is followed, the pairs that stay, and where their arcs begin now.
void Overlay::keep_pairs() {
  const int w = walker_;
  pairs_.part();
  std::size_t stay = 0;
  for (const FacePair& pair : pairs_.all) {
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
    pairs_.all[stay++] = pair;
  }
  pairs_.all.resize(stay);
  pairs_.join();
  const auto changed = [](HalfEdge) {};
  for (const FacePair& pair : pairs_.all) {
    pairs_.start_arcs(signs_, 0, pair.p, pair.q, changed);
    pairs_.start_arcs(signs_, 1, pair.q, pair.p, changed);
  }
}

/// Repairs pairs after a long move, whose walks went through the crossings near pairs that it did not know of. The walk
/// to a face of such a pair has come to an arc on which it lies: the last cell is one of those round the other face of
/// the pair, and the circle, which goes through that, enters or leaves the cell across one of its two arcs there.
void Overlay::repair_new_pairs() {
  const int w = walker_;
  expired_.swap(leap_.on_arcs);
  leap_.on_arcs.clear();
  expired_.push_back(visits_[w].all[0].face);  // which was climbed for
  for (const FacePair& pair : pairs_.all) expired_.push_back(w == 0 ? pair.p : pair.q);
  std::sort(expired_.begin(), expired_.end());
  expired_.erase(std::unique(expired_.begin(), expired_.end()), expired_.end());
  const std::size_t kept = pairs_.all.size();
  follow_pairs(expired_);
  if (pairs_.all.size() == kept) return;
  for (const std::uint32_t e : broken_)
    for (std::uint32_t id = arcs_.head[w][e]; id != kNoCrossing; id = arcs_[id].next[w]) {
      arcs_.until[id] = kBeforeAll;
      break_arc(e, 1);
    }
  repair_broken();
}

}  // namespace dymsum::spatial
