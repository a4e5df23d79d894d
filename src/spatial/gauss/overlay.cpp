#include "spatial/gauss/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "spatial/gauss/leaving_slot.h"
#include "spatial/gauss/most_rise.h"

namespace dymsum::spatial {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
/// Of a face, from which on the next faces round it are climbed for from one another.
constexpr std::uint32_t kManyEdges = 8;

}  // namespace

Overlay::Overlay(const Polytope& p, const Polytope& q) : signs_(p, q) {
  for (int op = 0; op < 2; ++op) {
    extreme_[op].assign(poly(op).face_count(), 0);
    vertex_until_[op].assign(poly(op).face_count(), kNever);
    head_[op].assign(poly(op).edge_count(), kNoCrossing);
    parallel_[op].assign(poly(op).face_count(), kNoFace);
    start_[op].assign(2 * poly(op).edge_count(), 0);
    has_flat_edges_ |= poly(op).has_flat_edges;
  }
  for (int op = 0; op < 2; ++op) {
    const Polytope& mine = poly(op);
    std::vector<std::uint8_t> seen(mine.face_count(), 0);
    seen[0] = 1;
    visits_[op].push_back({0, 0, 0, 0});
    for (std::size_t i = 0; i < visits_[op].size(); ++i) {
      const std::uint32_t f = visits_[op][i].face;
      HalfEdge h = mine.first[f];
      std::uint32_t near = f, edges = 0;
      do {
        const std::uint32_t g = mine.face[twin(h)];
        if (!seen[g]) visits_[op].push_back({g, f, h, near});
        seen[g] = 1;
        if (++edges >= kManyEdges) near = g;
        h = mine.next[h];
      } while (h != mine.first[f]);
    }
    is_touched_[op].assign(mine.edge_count(), 0);
  }
  walker_ = q.face_count() < p.face_count() ? 1 : 0;
  cell_ = 2 / std::sqrt(static_cast<double>(poly(1 - walker_).vertex_count()));  // 4 pi = n pi r^2
  breaks_.assign(poly(walker_).edge_count(), 0);
  std::vector<bool> visited(poly(walker_).edge_count(), false);
  for (std::size_t i = 1; i < visits_[walker_].size(); ++i) visited[visits_[walker_][i].via / 2] = true;
  for (std::uint32_t e = 0; e < visited.size(); ++e)
    if (!visited[e]) chords_.push_back(e);
  make_levels();
}

/// Visits are sorted by their distance from the first face.
void Overlay::make_levels() {
  const std::vector<Visit>& visits = visits_[walker_];
  std::vector<std::uint32_t> level(visits.size(), 0);
  levels_.push_back(0);
  for (std::uint32_t i = 0; i < visits.size(); ++i) {
    if (i > 0) level[visits[i].face] = level[visits[i].from] + 1;
    if (level[visits[i].face] == levels_.size()) levels_.push_back(i);
  }
  levels_.push_back(static_cast<std::uint32_t>(visits.size()));
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

/// Of a vertex of many edges: the product of the steepest one with `row`, and its position in the rings. Where all fall
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

void Overlay::touch(int op, std::uint32_t e) {
  if (is_touched_[op][e]) return;
  is_touched_[op][e] = 1;
  touched_.push_back(e);
}

/// While crossings are found from nothing: a crossing of edge e of P after the one before it, if any.
std::uint32_t Overlay::append_crossing(std::uint32_t e, HalfEdge q, double until, std::uint32_t before) {
  if (crossings_.size() >= most_crossings_) throw TooManyCrossings{};
  const auto id = static_cast<std::uint32_t>(crossings_.size());
  std::uint32_t& head = head_[1][q / 2];
  crossings_.push_back({e, q, {kNoCrossing, head}});
  head = id;
  crossing_until_.push_back(until);
  (before == kNoCrossing ? head_[0][e] : crossings_[before].next[0]) = id;
  touch(1, q / 2);
  return id;
}

/// When all crossings are found from nothing.
void Overlay::finish_crossings() {
  changes_.crossings.resize(crossings_.size());
  std::iota(changes_.crossings.begin(), changes_.crossings.end(), 0);
  work_.crossings_added = crossings_.size();
  order_along_q();
}

/// Puts the crossings along the arc of edge e of operand op, which begins in the cell of vertex v of the other one, in
/// order: each leaves the cell that the one before entered. The vertex in whose cell the arc ends.
std::uint32_t Overlay::order_along(int op, std::uint32_t e, std::uint32_t v) {
  const Polytope& other = poly(1 - op);
  for (std::uint32_t* link = &head_[op][e]; *link != kNoCrossing; link = &crossings_[*link].next[op]) {
    std::uint32_t* found = link;
    while (*found != kNoCrossing && other.origin[across(op, crossings_[*found])] != v)
      found = &crossings_[*found].next[op];
    if (*found == kNoCrossing) throw std::logic_error("Overlay: the crossings of an arc do not join");
    if (found != link) {
      const std::uint32_t id = *found;
      *found = crossings_[id].next[op];
      crossings_[id].next[op] = *link;
      *link = id;
    }
    v = other.target(across(op, crossings_[*link]));
  }
  return v;
}

/// All arcs of Q that are crossed: their ends are known, so this compares the walks along P's arcs with the climbs from
/// Q's faces.
void Overlay::order_along_q() {
  for (const std::uint32_t e : touched_) {
    is_touched_[1][e] = 0;
    if (order_along(1, e, end_cell(1, 2 * e)) != end_cell(1, 2 * e + 1))
      throw std::logic_error("Overlay: the crossings of an arc do not lead to its end");
  }
  touched_.clear();
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

void Overlay::clear_crossings() {
  crossings_.clear();
  crossing_until_.clear();
  free_.clear();
  for (std::vector<std::uint32_t>& heads : head_) std::fill(heads.begin(), heads.end(), kNoCrossing);
}

void Overlay::build(const RelativeMap& map) {
  restart();
  const std::uint64_t exact_before = signs_.signs().exact();
  signs_.set(map);
  clear_crossings();
  // Neighbouring faces have extreme vertices near by.
  for (int op = 0; op < 2; ++op) {
    work_.vertex_checks += visits_[op].size();
    for (const Visit& visit : visits_[op])
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
  if (a.head_[0].size() != b.head_[0].size() || a.head_[1].size() != b.head_[1].size()) return false;
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
