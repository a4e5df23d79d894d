#include "spatial/convex/overlay.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dymsum::spatial {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kNever = -kForever;

/// Moves by more than this many cells start from neighbouring faces instead of from the vertices before: measured, see docs/design/convex-motion.md.
constexpr double kLeap = 2;

/// The numbers of the certificates that have ended.
void find_expired(const std::vector<double>& until, double clock, std::vector<std::uint32_t>& expired) {
  expired.resize(until.size());
  std::size_t n = 0;
  for (std::uint32_t i = 0; i < until.size(); ++i) {
    expired[n] = i;
    n += until[i] <= clock;
  }
  expired.resize(n);
}

}  // namespace

Overlay::Overlay(const Polytope& p, const Polytope& q) : signs_(p, q) {
  for (int op = 0; op < 2; ++op) {
    extreme_[op].assign(poly(op).face_count(), 0);
    vertex_until_[op].assign(poly(op).face_count(), kNever);
    head_[op].assign(poly(op).edge_count(), kNoCrossing);
  }
  for (int op = 0; op < 2; ++op) {
    const Polytope& mine = poly(op);
    std::vector<std::uint8_t> seen(mine.face_count(), 0);
    seen[0] = 1;
    visits_[op].push_back({0, 0});
    for (std::size_t i = 0; i < visits_[op].size(); ++i) {
      const std::uint32_t f = visits_[op][i].face;
      HalfEdge h = mine.first[f];
      do {
        const std::uint32_t g = mine.face[twin(h)];
        if (!seen[g]) visits_[op].push_back({g, f});
        seen[g] = 1;
        h = mine.next[h];
      } while (h != mine.first[f]);
    }
    cell_[op] = 2 / std::sqrt(static_cast<double>(poly(1 - op).vertex_count()));  // 4 pi = n pi r^2
  }
  arc_until_.assign(p.edge_count(), kNever);
  is_touched_q_.assign(q.edge_count(), 0);
}

/// Doubles cannot tell whether an edge rises: any that does will do. The vertex it leads to, or v itself, which is then extreme.
std::uint32_t Overlay::step_near_zero(int op, std::uint32_t f, std::uint32_t v) {
  for (const HalfEdge h : poly(1 - op).leaving(v))
    if (signs_.value(op, f, h) >= -signs_.error(op) && signs_.sign(op, f, h) > 0) return poly(1 - op).target(h);
  return v;
}

/// Walks from `start` to the extreme vertex of face f: every step is along an edge that rises, so none is taken twice. True when it is another one than
/// before.
bool Overlay::climb(int op, std::uint32_t f, std::uint32_t start) {
  const Polytope& other = poly(1 - op);
  const double error = signs_.error(op);
  const Vec3 row = signs_.row(op, f);
  const std::uint32_t before = extreme_[op][f];
  for (std::uint32_t v = start;; ++work_.steps) {
    const std::uint32_t begin = other.ring_start[v], end = other.ring_start[v + 1];
    const auto value = [&](std::uint32_t k) { return dot(row, other.ring_direction[k]); };
    double most = value(begin), also = value(begin + 1);  // two, so that comparisons need not wait for each other; rings have three or more
    std::uint32_t k = begin + 2;
    for (; k + 1 < end; k += 2) {
      const double a = value(k), b = value(k + 1);
      most = a > most ? a : most;
      also = b > also ? b : also;
    }
    if (k < end) also = std::max(also, value(k));
    most = std::max(most, also);
    if (most < -error) {
      vertex_until_[op][f] = clock_ + signs_.margin(op, most);
      extreme_[op][f] = v;
      return v != before;
    }
    if (most > error) {
      k = begin;
      while (value(k) != most) ++k;
      v = other.target(other.ring[k]);
      continue;
    }
    const std::uint32_t to = step_near_zero(op, f, v);
    if (to == v) {
      vertex_until_[op][f] = clock_;  // extreme, but at this very moment only
      extreme_[op][f] = v;
      return v != before;
    }
    v = to;
  }
}

/// The arc of edge e, which enters the cell of vertex v of the other operand and does not end there, leaves it across the arc of the half-edge from v
/// whose left face lies on the left of e's circle and whose right face lies on its right: the circle crosses the border of a convex cell once
/// outwards. Its slot in the ring.
std::uint32_t Overlay::leaving_slot(int op, std::uint32_t e, std::uint32_t v) const {
  const Polytope& other = poly(1 - op);
  const Vec3 along = poly(op).direction[e];
  const double error = signs_.error(1 - op);
  const std::uint32_t begin = other.ring_start[v], size = other.ring_start[v + 1] - begin;
  // Bit k: the face on the left of half-edge k of the ring lies on the left of the circle; the face on its right is that of the one before it.
  constexpr std::uint32_t kWord = 64;
  if (size <= kWord) {
    std::uint64_t left = 0;
    bool certain = true;
    for (std::uint32_t k = 0; k < size; ++k) {
      const double value = dot(signs_.row(1 - op, other.ring_face[begin + k]), along);
      left |= std::uint64_t{value > 0} << k;
      certain &= std::abs(value) > error;
    }
    const std::uint64_t right = (left << 1) | (left >> (size - 1));
    const std::uint64_t exits = left & ~right;
    if (certain && exits != 0) return begin + static_cast<std::uint32_t>(std::countr_zero(exits));
  }
  const auto on_left = [&](std::uint32_t k) { return signs_.sign(1 - op, other.ring_face[begin + k], 2 * e) > 0; };
  bool right = on_left(size - 1);
  for (std::uint32_t k = 0; k < size; ++k) {
    const bool left = on_left(k);
    if (left && !right) return begin + k;
    right = left;
  }
  throw std::logic_error("Overlay: an arc does not leave a cell that it enters");
}

/// The half-edges of the other operand that the arc of edge e crosses, from its left face to its right one, into walk_. Returns the margin of
/// all the signs that make it so.
double Overlay::walk(int op, std::uint32_t e) {
  const Polytope& other = poly(1 - op);
  const std::uint32_t left = poly(op).face[2 * e], right = poly(op).face[2 * e + 1];
  const std::uint32_t end = extreme_[op][right];
  double mine = kForever, theirs = kForever;
  walk_.clear();
  for (std::uint32_t v = extreme_[op][left]; v != end; ++work_.steps) {
    const HalfEdge exit = other.ring[leaving_slot(op, e, v)];
    if (walk_.size() > other.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    mine = std::min({mine, std::abs(signs_.value(op, left, exit)), std::abs(signs_.value(op, right, exit))});
    theirs = std::min({theirs, std::abs(signs_.value(1 - op, other.face[exit], 2 * e)), std::abs(signs_.value(1 - op, other.face[twin(exit)], 2 * e))});
    walk_.push_back(exit);
    v = other.target(exit);
  }
  return std::min(signs_.margin(op, mine), signs_.margin(1 - op, theirs));
}

/// Whether doubles prove that the arc of edge e of P, whose ends are where they were, has the crossings it had: they join its ends, so none is missing when
/// all are there. Renews the certificate.
bool Overlay::holds(std::uint32_t e) {
  const Polytope &p = poly(0), &q = poly(1);
  const Vec3 f_left = signs_.row(0, p.face[2 * e]), f_right = signs_.row(0, p.face[2 * e + 1]), along = p.direction[e];
  double mine = kForever, theirs = kForever;
  for (std::uint32_t id = head_[0][e]; id != kNoCrossing; id = crossings_[id].next[0]) {
    const HalfEdge h = crossings_[id].q;
    const Vec3 d = q.along(h);
    mine = std::min({mine, -dot(f_left, d), dot(f_right, d)});
    theirs = std::min({theirs, dot(signs_.row(1, q.face[h]), along), -dot(signs_.row(1, q.face[twin(h)]), along)});
  }
  if (!(mine > signs_.error(0) && theirs > signs_.error(1))) return false;
  arc_until_[e] = clock_ + std::min(signs_.margin(0, mine), signs_.margin(1, theirs));
  return true;
}

void Overlay::touch_q(std::uint32_t e) {
  if (is_touched_q_[e]) return;
  is_touched_q_[e] = 1;
  touched_q_.push_back(e);
}

std::uint32_t Overlay::add_crossing(std::uint32_t e, HalfEdge q) {
  std::uint32_t id;
  if (free_.empty()) {
    id = static_cast<std::uint32_t>(crossings_.size());
    crossings_.emplace_back();
  } else {
    id = free_.back();
    free_.pop_back();
  }
  crossings_[id] = {e, q, {kNoCrossing, head_[1][q / 2]}};
  head_[1][q / 2] = id;
  changes_.crossings.push_back(id);
  ++work_.crossings_added;
  touch_q(q / 2);
  return id;
}

/// Makes walk_ the crossings of edge e of P; a crossing of the same two edges keeps its id.
void Overlay::replace_crossings(std::uint32_t e) {
  old_.clear();
  for (std::uint32_t id = head_[0][e]; id != kNoCrossing; id = crossings_[id].next[0]) old_.push_back(id);
  std::uint32_t* link = &head_[0][e];
  std::uint32_t last = kNoCrossing;
  for (const HalfEdge q : walk_) {
    std::uint32_t id = kNoCrossing;
    for (std::uint32_t& o : old_) {
      if (o == kNoCrossing || crossings_[o].q / 2 != q / 2) continue;
      id = o;
      o = kNoCrossing;
      break;
    }
    if (id == kNoCrossing) {
      id = add_crossing(e, q);
      link = last == kNoCrossing ? &head_[0][e] : &crossings_[last].next[0];  // the pool may have moved
    } else if (crossings_[id].q != q) {
      crossings_[id].q = q;
      touch_q(q / 2);
    }
    *link = id;
    link = &crossings_[id].next[0];
    last = id;
  }
  *link = kNoCrossing;
  for (const std::uint32_t o : old_)
    if (o != kNoCrossing) remove_crossing(o);
}

void Overlay::remove_crossing(std::uint32_t id) {
  const std::uint32_t e = crossings_[id].q / 2;
  std::uint32_t* link = &head_[1][e];
  while (*link != id) link = &crossings_[*link].next[1];
  *link = crossings_[id].next[1];
  free_.push_back(id);
  ++work_.crossings_removed;
  touch_q(e);
}

/// Walks the arc of an edge of P and corrects its crossings.
void Overlay::walk_arc(std::uint32_t e) {
  arc_until_[e] = clock_ + walk(0, e);
  std::uint32_t id = head_[0][e];
  for (const HalfEdge q : walk_) {
    if (id == kNoCrossing || crossings_[id].q != q) {
      ++work_.arcs_changed;
      replace_crossings(e);
      return;
    }
    id = crossings_[id].next[0];
  }
  if (id == kNoCrossing) return;
  ++work_.arcs_changed;
  replace_crossings(e);
}

/// Puts the crossings along the arcs of Q that gained or lost some in order: each leaves the cell that the one before entered.
void Overlay::order_along_q() {
  const Polytope &p = poly(0), &q = poly(1);
  for (const std::uint32_t e : touched_q_) {
    is_touched_q_[e] = 0;
    std::uint32_t v = extreme_[1][q.face[2 * e]];
    for (std::uint32_t* link = &head_[1][e]; *link != kNoCrossing; link = &crossings_[*link].next[1]) {
      // The arc of an edge of P lies between the cells of its ends.
      std::uint32_t* found = link;
      const auto touches = [&](std::uint32_t id) { return p.origin[2 * crossings_[id].p] == v || p.target(2 * crossings_[id].p) == v; };
      while (*found != kNoCrossing && !touches(*found)) found = &crossings_[*found].next[1];
      if (*found == kNoCrossing) throw std::logic_error("Overlay: the crossings of an arc do not join");
      if (found != link) {
        const std::uint32_t id = *found;
        *found = crossings_[id].next[1];
        crossings_[id].next[1] = *link;
        *link = id;
      }
      const std::uint32_t edge = crossings_[*link].p;
      v = p.origin[2 * edge] == v ? p.target(2 * edge) : p.origin[2 * edge];
    }
    if (v != extreme_[1][q.face[2 * e + 1]]) throw std::logic_error("Overlay: the crossings of an arc do not lead to its end");
  }
  touched_q_.clear();
}

void Overlay::note_change(int op, std::uint32_t f) {
  changes_.faces[op].push_back(f);
  ++work_.vertex_errors;
  if (op == 1) return;
  // Both ends of an arc have to stay in their cells for its certificate to hold.
  const Polytope& p = poly(0);
  HalfEdge h = p.first[f];
  do {
    arc_until_[h / 2] = kNever;
    h = p.next[h];
  } while (h != p.first[f]);
}

/// Neighbouring faces have extreme vertices near by.
void Overlay::climb_from_neighbours(int op) {
  work_.vertex_checks += visits_[op].size();
  for (const Visit& visit : visits_[op])
    if (climb(op, visit.face, extreme_[op][visit.from])) note_change(op, visit.face);
}

void Overlay::restart() {
  work_ = {};
  changes_.faces[0].clear();
  changes_.faces[1].clear();
  changes_.crossings.clear();
}

void Overlay::build(const RelativeMap& map) {
  restart();
  const std::uint64_t exact_before = signs_.exact_signs();
  signs_.set(map);
  crossings_.clear();
  free_.clear();
  for (int op = 0; op < 2; ++op) {
    std::fill(head_[op].begin(), head_[op].end(), kNoCrossing);
    climb_from_neighbours(op);
  }
  for (std::uint32_t e = 0; e < poly(0).edge_count(); ++e) walk_arc(e);
  work_.arc_checks = poly(0).edge_count();
  order_along_q();
  work_.exact_signs = signs_.exact_signs() - exact_before;
}

void Overlay::update(const RelativeMap& map, bool use_margins) {
  restart();
  const std::uint64_t exact_before = signs_.exact_signs();
  const double angle = use_margins ? map.angle_from(signs_.map()) : 4;
  clock_ += angle;
  signs_.set(map);
  for (int op = 0; op < 2; ++op) {
    if (angle > kLeap * cell_[op]) {
      climb_from_neighbours(op);
      continue;
    }
    find_expired(vertex_until_[op], clock_, expired_);
    work_.vertex_checks += expired_.size();
    for (const std::uint32_t f : expired_)
      if (climb(op, f, extreme_[op][f])) note_change(op, f);
  }
  find_expired(arc_until_, clock_, expired_);
  work_.arc_checks += expired_.size();
  for (const std::uint32_t e : expired_)
    if (arc_until_[e] == kNever || angle > kLeap * cell_[0] || !holds(e)) walk_arc(e);
  order_along_q();
  work_.exact_signs = signs_.exact_signs() - exact_before;
}

bool operator==(const Overlay& a, const Overlay& b) {
  if (a.extreme_ != b.extreme_ || a.head_[0].size() != b.head_[0].size() || a.head_[1].size() != b.head_[1].size()) return false;
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t e = 0; e < a.head_[op].size(); ++e) {
      std::uint32_t i = a.head_[op][e], j = b.head_[op][e];
      while (i != kNoCrossing && j != kNoCrossing) {
        const Crossing &x = a.crossings_[i], &y = b.crossings_[j];
        if (x.p != y.p || x.q != y.q) return false;
        i = x.next[op];
        j = y.next[op];
      }
      if (i != j) return false;
    }
  return true;
}

}  // namespace dymsum::spatial
