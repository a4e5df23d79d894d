#include "spatial/gauss/overlay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "spatial/gauss/leaving_slot.h"
#include "spatial/gauss/most_rise.h"

namespace dymsum::spatial {
Overlay::Overlay(const Polytope& p, const Polytope& q)
    : signs_(p, q),
      arcs_(p, q),
      pairs_(p, q),
      visits_{FaceVisits(p), FaceVisits(q)},
      walker_(q.face_count() < p.face_count() ? 1 : 0),
      plan_(poly(walker_), visits_[walker_]),
      cell_(2 / std::sqrt(static_cast<double>(poly(1 - walker_).vertex_count()))) {  // 4 pi = n pi r^2
  for (int op = 0; op < 2; ++op) {
    extreme_[op].assign(poly(op).face_count(), 0);
    vertex_until_[op].assign(poly(op).face_count(), kBeforeAll);
  }
  breaks_.assign(poly(walker_).edge_count(), 0);
}

/// Doubles cannot determine whether an edge rises: any that does will do. The vertex it leads to, or v itself, which is
/// then extreme.
std::uint32_t Overlay::step_near_zero(int op, std::uint32_t f, std::uint32_t v) {
  const Polytope& other = poly(1 - op);
  std::uint32_t to = v;
  look_above(other, v, signs_.row_now(op, f), -signs_.error(op), [&](std::uint32_t k) {
    const HalfEdge h = other.leaving(v)[k];
    if (to == v && signs_.sign_now(op, f, h) > 0) to = other.target(h);
  });
  return to;
}

/// The steepest edge of a vertex of many edges: its product with `row`, and its position in the rings. Where all fall
/// something at least as large, see RingBounds.
Overlay::Steepest Overlay::steepest_of_many(int op, std::uint32_t v, Vec3 row) const {
  const Polytope& other = poly(1 - op);
  const RingBounds& bounds = other.direction_bounds[v];
  const std::uint32_t begin = other.ring_start[v];
  const auto value = [&](std::uint32_t k) { return dot(row, other.ring_direction[begin + k]); };
  const double above = bounds.above_all(row, value);
  if (above < -signs_.error(op)) return {above, begin};
  const std::uint32_t k = bounds.largest(row, value);
  return {value(k), begin + k};
}

/// Walks from `start` to the extreme vertex of face f, whose row is given: every step is along an edge that rises, so
/// none is taken twice. True when it is another one than before.
bool Overlay::climb(int op, std::uint32_t f, std::uint32_t start, Vec3 row) {
  const Polytope& other = poly(1 - op);
  const double error = signs_.error(op);
  const std::uint32_t before = extreme_[op][f];
  for (std::uint32_t v = start;; ++work_.steps) {
    const std::uint32_t begin = other.ring_start[v], end = other.ring_start[v + 1];
    const auto value = [&](std::uint32_t i) { return dot(row, other.ring_direction[i]); };
    double most;
    std::uint32_t k = begin;
    if (other.bounds(other.direction_bounds, v) != nullptr) {
      const Steepest steepest = steepest_of_many(op, v, row);
      most = steepest.most;
      k = steepest.at;
    } else {
      // Two, so that comparisons need not wait for each other; rings have three or more.
      double also = value(begin + 1);
      most = value(begin);
      for (k = begin + 2; k + 1 < end; k += 2) {
        const double a = value(k), b = value(k + 1);
        most = a > most ? a : most;
        also = b > also ? b : also;
      }
      if (k < end) also = std::max(also, value(k));
      most = std::max(most, also);
      k = begin;
    }
    if (most < -error) {
      vertex_until_[op][f] = later(signs_.margin(op, most));
      extreme_[op][f] = v;
      return v != before;
    }
    if (most > error) {
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

/// Finds the crossings of the arc of edge e of P, which has none yet, from its left face to its right one.
void Overlay::walk(std::uint32_t e) {
  const Polytope &p = poly(0), &q = poly(1);
  const std::uint32_t left = p.face[2 * e], right = p.face[2 * e + 1];
  const Vec3 f_left = signs_.row(0, left), f_right = signs_.row(0, right), along = p.direction[e];
  const auto value = [&](std::uint32_t k) { return dot(signs_.row(1, q.ring_face[k]), along); };
  const auto sign = [&](std::uint32_t k) { return signs_.sign(1, q.ring_face[k], 2 * e); };
  const std::uint32_t end = end_cell(0, 2 * e + 1);
  const Vec3 mapped = q.normal_bounds.empty() ? Vec3{} : signs_.mapped_edge(1, e);
  std::uint32_t last = kNoCrossing, walked = 0;
  for (std::uint32_t v = end_cell(0, 2 * e); v != end; ++walked) {
    const HalfEdge exit = q.ring[leaving_slot(q, v, mapped, signs_.error(1), value, sign)];
    if (walked > q.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    // The signs that updates rely on: see overlay_update.cpp.
    const Vec3 d = q.direction[exit / 2];
    const double left_side = walker_ == 0 ? dot(signs_.row(1, q.face[exit]), along) : dot(f_left, d);
    const double right_side = walker_ == 0 ? dot(signs_.row(1, q.face[twin(exit)]), along) : dot(f_right, d);
    const double least = std::min(std::abs(left_side), std::abs(right_side));
    last = append_crossing(e, exit, later(signs_.margin(1 - walker_, least)), last);
    v = q.target(exit);
  }
  work_.steps += walked;
  work_.arcs_changed += walked > 0;
}

/// While crossings are found from nothing: a crossing of edge e of P after the one before it, if any.
std::uint32_t Overlay::append_crossing(std::uint32_t e, HalfEdge q, double until, std::uint32_t before) {
  if (arcs_.all.size() >= most_crossings_) throw TooManyCrossings{};
  return arcs_.append(e, q, until, before);
}

/// When all crossings are found from nothing.
void Overlay::finish_crossings() {
  changes_.crossings.resize(arcs_.all.size());
  std::iota(changes_.crossings.begin(), changes_.crossings.end(), 0);
  work_.crossings_added = arcs_.all.size();
  order_along_q();
}

/// All arcs of Q that are crossed: their ends are known, so this compares the walks along P's arcs with the climbs from
/// Q's faces.
void Overlay::order_along_q() {
  for (const std::uint32_t e : arcs_.touched) {
    arcs_.marked[1][e] = 0;
    if (arcs_.order_along(1, poly(0), e, end_cell(1, 2 * e)) != end_cell(1, 2 * e + 1))
      throw std::logic_error("Overlay: the crossings of an arc do not lead to its end");
  }
  arcs_.touched.clear();
}

void Overlay::note_face(int op, std::uint32_t f) {
  changes_.faces[op].push_back(f);
  ++work_.vertex_errors;
}

void Overlay::forget_changes() {
  changes_.faces[0].clear();
  changes_.faces[1].clear();
  changes_.crossings.clear();
}

void Overlay::restart() {
  work_ = {};
  forget_changes();
}

void Overlay::build(const RelativeMap& map) {
  restart();
  const std::uint64_t exact_before = signs_.signs().exact();
  signs_.set(map);
  arcs_.clear();
  // Neighbouring faces have extreme vertices near by.
  for (int op = 0; op < 2; ++op) {
    work_.vertex_checks += visits_[op].all.size();
    for (const FaceVisits::Visit& visit : visits_[op].all)
      if (climb(op, visit.face, extreme_[op][visit.near], signs_.row(op, visit.face))) note_face(op, visit.face);
  }
  find_pairs();
  for (std::uint32_t e = 0; e < poly(0).edge_count(); ++e) walk(e);
  work_.arc_checks = poly(0).edge_count();
  finish_crossings();
  work_.exact_signs = signs_.signs().exact() - exact_before;
}

bool operator==(const Overlay& a, const Overlay& b) {
  if (a.extreme_ != b.extreme_) return false;
  if (a.arcs_.head[0].size() != b.arcs_.head[0].size() || a.arcs_.head[1].size() != b.arcs_.head[1].size())
    return false;
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t e = 0; e < a.arcs_.head[op].size(); ++e) {
      std::uint32_t i = a.arcs_.head[op][e], j = b.arcs_.head[op][e];
      while (i != kNoCrossing && j != kNoCrossing) {
        const Crossing &x = a.arcs_[i], &y = b.arcs_[j];
        if (x.p != y.p || x.q != y.q) return false;
        i = x.next[op];
        j = y.next[op];
      }
      if (i != j) return false;
    }
  return true;
}

}  // namespace dymsum::spatial
