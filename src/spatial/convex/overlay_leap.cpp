// Moves so long that hardly anything stays: all arcs of the walker are walked, without a look at what was, and the
// walks find the faces' vertices too.
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "spatial/convex/overlay.h"

namespace dymsum::spatial {

/// Every face but the first is reached along an arc from a neighbour whose vertex is known; the other arcs join faces
/// whose vertices are known then.
void Overlay::leap() {
  const int w = walker_;
  const Polytope& mine = poly(w);
  std::fill(head_[1 - w].begin(), head_[1 - w].end(), kNoCrossing);
  std::fill(vertex_until_[w].begin(), vertex_until_[w].end(), clock_);
  touched_.resize(poly(1 - w).edge_count());
  std::iota(touched_.begin(), touched_.end(), 0);
  std::fill(is_touched_[1 - w].begin(), is_touched_[1 - w].end(), 1);
  const std::uint32_t first = visits_[w][0].face;
  if (climb(w, first, extreme_[w][first], signs_.row_now(w, first))) note_face(w, first);
  for (std::size_t i = 1; i < visits_[w].size(); ++i) {
    const Visit& visit = visits_[w][i];
    const std::uint32_t v = walk_to_face(visit.via, extreme_[w][visit.from]);
    relink_arc(visit.via / 2);
    if (extreme_[w][visit.face] == v) continue;
    extreme_[w][visit.face] = v;
    note_face(w, visit.face);
  }
  for (const std::uint32_t e : chords_) {
    walk_between(e, extreme_[w][mine.face[2 * e]], extreme_[w][mine.face[2 * e + 1]]);
    relink_arc(e);
  }
  work_.vertex_checks += mine.face_count();
  work_.arc_checks = mine.edge_count();
}

/// From the face of h, in the cell of v, along the arc of h to the face beyond: the half-edges of the other operand
/// across whose arcs it leads, in the order of the arc's direction, into walk_, and the vertex of that face. The arc is
/// shorter than half a circle, so the face lies in the cell at hand unless it lies beyond the arc across which the
/// circle leaves that cell.
std::uint32_t Overlay::walk_to_face(HalfEdge h, std::uint32_t v) {
  const int w = walker_;
  const Polytope& other = poly(1 - w);
  const std::uint32_t face = poly(w).face[twin(h)];
  const Vec3 edge = signs_.mapped_edge(1 - w, h / 2), along = (h & 1) ? -edge : edge, row = signs_.row_now(w, face);
  const double error = signs_.error(w);
  walk_.clear();
  for (;; ++work_.steps) {
    if (walk_.size() > other.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    const HalfEdge over = exit_now(h, v, along);
    const double beyond = dot(row, other.along(over));
    if (beyond < -error || (beyond <= error && signs_.sign_now(w, face, over) < 0)) break;
    walk_.push_back(over);
    v = other.target(over);
  }
  if (h & 1) {
    std::reverse(walk_.begin(), walk_.end());
    for (HalfEdge& over : walk_) over = twin(over);
  }
  return v;
}

/// The same along the arc of an edge both of whose faces' vertices are known.
void Overlay::walk_between(std::uint32_t e, std::uint32_t v, std::uint32_t end) {
  const Polytope& other = poly(1 - walker_);
  const Vec3 along = signs_.mapped_edge(1 - walker_, e);
  walk_.clear();
  for (; v != end; ++work_.steps) {
    if (walk_.size() > other.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    const HalfEdge over = exit_now(2 * e, v, along);
    walk_.push_back(over);
    v = other.target(over);
  }
}

/// Makes walk_ the crossings of an arc of the walker, and lists them at the arcs of the other operand. A crossing of
/// the same two edges keeps its number.
void Overlay::relink_arc(std::uint32_t e) {
  const int w = walker_, op = 1 - w;
  bool changed = false;
  std::uint32_t old = head_[w][e], last = kNoCrossing;
  const auto link = [&](std::uint32_t id) { (last == kNoCrossing ? head_[w][e] : crossings_[last].next[w]) = id; };
  for (const HalfEdge over : walk_) {
    std::uint32_t id = old, before = kNoCrossing;  // the rest of the old list is searched, from where it should be
    while (id != kNoCrossing && edge_of(op, crossings_[id]) != over / 2)
      before = std::exchange(id, crossings_[id].next[w]);
    if (id == kNoCrossing) {
      id = add_crossing(e, over);
      changed = true;
    } else {
      (before == kNoCrossing ? old : crossings_[before].next[w]) = crossings_[id].next[w];
      changed = changed || before != kNoCrossing || across(w, crossings_[id]) != over;
      crossings_[id].q = crossing_of(w, e, over).q;
      crossings_[id].next[op] = std::exchange(head_[op][over / 2], id);
    }
    crossing_until_[id] = clock_;  // not looked at
    link(id);
    last = id;
  }
  link(kNoCrossing);
  work_.arcs_changed += changed || old != kNoCrossing;
  while (old != kNoCrossing) free_crossing(std::exchange(old, crossings_[old].next[w]));
}

}  // namespace dymsum::spatial
