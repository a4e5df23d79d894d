#include "spatial/convex/overlay.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace dymsum::spatial {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kNever = -kForever;

}  // namespace

Overlay::Overlay(const Polytope& p, const Polytope& q) : signs_(p, q) {
  for (int op = 0; op < 2; ++op) {
    extreme_[op].assign(poly(op).face_count(), 0);
    vertex_until_[op].assign(poly(op).face_count(), kNever);
    head_[op].assign(poly(op).edge_count(), kNoCrossing);
  }
  arc_until_.assign(p.edge_count(), kNever);
  is_touched_q_.assign(q.edge_count(), 0);
}

/// Walks from the vertex known so far to the extreme one: every step is along an edge that rises, so none is taken twice. True when it moved.
bool Overlay::climb(int op, std::uint32_t f) {
  const Polytope& other = poly(1 - op);
  const double error = signs_.error(op);
  const std::uint32_t before = extreme_[op][f];
  std::uint32_t v = before;
  for (;;) {
    double most = -kForever;
    HalfEdge best = 0;
    for (const HalfEdge h : other.leaving(v)) {
      const double value = signs_.value(op, f, h);
      if (value > most) {
        most = value;
        best = h;
      }
    }
    if (most >= -error && most <= error) {
      // Doubles cannot tell: any rising edge will do, and without one the vertex is extreme, for this very moment.
      bool rises = false;
      for (const HalfEdge h : other.leaving(v)) {
        if (signs_.value(op, f, h) < -error || signs_.sign(op, f, h) < 0) continue;
        best = h;
        rises = true;
        break;
      }
      if (!rises) {
        vertex_until_[op][f] = clock_;
        break;
      }
    } else if (most < 0) {
      vertex_until_[op][f] = clock_ + signs_.margin(op, most);
      break;
    }
    v = other.target(best);
    ++work_.steps;
  }
  extreme_[op][f] = v;
  return v != before;
}

/// The half-edges of the other operand that the arc of edge e crosses, from its left face to its right one, into walk_. Returns the margin of
/// all the signs that make it so.
///
/// The arc leaves the cell of a vertex v across the arc of the half-edge h from v whose left face lies on the left of e's circle and whose right
/// face lies on its right: the circle crosses the border of a convex cell once outwards.
double Overlay::walk(int op, std::uint32_t e) {
  const Polytope& other = poly(1 - op);
  const std::uint32_t left = poly(op).face[2 * e], right = poly(op).face[2 * e + 1];
  const std::uint32_t end = extreme_[op][right];
  double margin = kForever;
  walk_.clear();
  for (std::uint32_t v = extreme_[op][left]; v != end;) {
    const std::span<const HalfEdge> ring = other.leaving(v);
    // The face on the right of a half-edge is the face on the left of the one before it in the ring.
    bool right_is_left = signs_.sign(1 - op, other.face[ring.back()], 2 * e) > 0;
    HalfEdge exit = 0;
    bool found = false;
    for (const HalfEdge h : ring) {
      const bool left_is_left = signs_.sign(1 - op, other.face[h], 2 * e) > 0;
      if (left_is_left && !right_is_left) {
        exit = h;
        found = true;
        break;
      }
      right_is_left = left_is_left;
    }
    if (!found || walk_.size() > other.edge_count()) throw std::logic_error("Overlay::walk: an arc does not leave a cell that it enters");
    margin = std::min({margin, signs_.margin(1 - op, signs_.value(1 - op, other.face[exit], 2 * e)),
                       signs_.margin(1 - op, signs_.value(1 - op, other.face[twin(exit)], 2 * e)),
                       signs_.margin(op, signs_.value(op, left, exit)), signs_.margin(op, signs_.value(op, right, exit))});
    walk_.push_back(exit);
    v = other.target(exit);
    ++work_.steps;
  }
  return margin;
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
  crossings_[id] = {e, q, {kNoCrossing, kNoCrossing}};
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
  for (const std::uint32_t o : old_) {
    if (o == kNoCrossing) continue;
    touch_q(crossings_[o].q / 2);
    free_.push_back(o);
    ++work_.crossings_removed;
  }
}

/// Walks the arc of an edge of P and corrects its crossings.
void Overlay::walk_arc(std::uint32_t e) {
  ++work_.arc_checks;
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

/// The order of crossings along the arcs of Q that gained or lost some, by walking those arcs: this finds the same crossings from the other side.
void Overlay::order_along_q() {
  for (const std::uint32_t e : touched_q_) {
    is_touched_q_[e] = 0;
    walk(1, e);
    std::uint32_t* link = &head_[1][e];
    for (const HalfEdge p : walk_) {
      std::uint32_t id = head_[0][p / 2];
      while (id != kNoCrossing && crossings_[id].q / 2 != e) id = crossings_[id].next[0];
      if (id == kNoCrossing) throw std::logic_error("Overlay::order_along_q: the two walks disagree");
      *link = id;
      link = &crossings_[id].next[1];
    }
    *link = kNoCrossing;
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
    // Neighbouring faces have extreme vertices near by.
    const Polytope& p = poly(op);
    std::fill(vertex_until_[op].begin(), vertex_until_[op].end(), kNever);
    std::fill(head_[op].begin(), head_[op].end(), kNoCrossing);
    std::vector<std::uint32_t> queue{0};
    std::vector<std::uint8_t> seen(p.face_count(), 0);
    seen[0] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t f = queue[i];
      ++work_.vertex_checks;
      climb(op, f);
      HalfEdge h = p.first[f];
      do {
        const std::uint32_t g = p.face[twin(h)];
        if (!seen[g]) {
          seen[g] = 1;
          extreme_[op][g] = extreme_[op][f];
          queue.push_back(g);
        }
        h = p.next[h];
      } while (h != p.first[f]);
    }
  }
  for (std::uint32_t e = 0; e < poly(0).edge_count(); ++e) walk_arc(e);
  order_along_q();
  work_.exact_signs = signs_.exact_signs() - exact_before;
}

void Overlay::update(const RelativeMap& map, bool use_margins) {
  restart();
  const std::uint64_t exact_before = signs_.exact_signs();
  clock_ += use_margins ? map.angle_from(signs_.map()) : 4;
  signs_.set(map);
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < poly(op).face_count(); ++f) {
      if (vertex_until_[op][f] > clock_) continue;
      ++work_.vertex_checks;
      if (climb(op, f)) note_change(op, f);
    }
  for (std::uint32_t e = 0; e < poly(0).edge_count(); ++e)
    if (arc_until_[e] <= clock_) walk_arc(e);
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
