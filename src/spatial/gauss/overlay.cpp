#include "spatial/gauss/overlay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "spatial/gauss/polytope.h"

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

namespace {

/// The number of a face's edges from which on the next faces round it are climbed for from one another.
constexpr std::uint32_t kManyEdges = 8;

}  // namespace

FaceVisits::FaceVisits(const Polytope& solid) {
  std::vector<std::uint8_t> seen(solid.face_count(), 0);
  seen[0] = 1;
  all.push_back({0, 0, 0, 0});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t f = all[i].face;
    HalfEdge h = solid.first[f];
    std::uint32_t near = f, edges = 0;
    do {
      const std::uint32_t g = solid.face[twin(h)];
      if (!seen[g]) all.push_back({g, f, h, near});
      seen[g] = 1;
      if (++edges >= kManyEdges) near = g;
      h = solid.next[h];
    } while (h != solid.first[f]);
  }
}

ArcPlan::ArcPlan(const Polytope& solid, const FaceVisits& visits) {
  std::vector<bool> visited(solid.edge_count(), false);
  std::vector<std::uint32_t> level(visits.all.size(), 0);
  levels.push_back(0);
  for (std::uint32_t i = 1; i < visits.all.size(); ++i) {
    const FaceVisits::Visit& visit = visits.all[i];
    visited[visit.via / 2] = true;
    level[visit.face] = level[visit.from] + 1;
    if (level[visit.face] == levels.size()) levels.push_back(i);
  }
  levels.push_back(static_cast<std::uint32_t>(visits.all.size()));
  for (std::uint32_t e = 0; e < visited.size(); ++e)
    if (!visited[e]) chords.push_back(e);
}

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

// Overlays written down and taken up again.

void Overlay::capture(std::vector<std::uint32_t>& words) const {
  words.assign(extreme_[0].begin(), extreme_[0].end());
  words.insert(words.end(), extreme_[1].begin(), extreme_[1].end());
  const std::size_t faces = words.size();
  words.resize(faces + 2 * arcs_.all.size(), kNoCrossing);
  for (const std::uint32_t head : arcs_.head[0])
    for (std::uint32_t id = head; id != kNoCrossing; id = arcs_[id].next[0]) {
      words[faces + 2 * id] = arcs_[id].p;
      words[faces + 2 * id + 1] = arcs_[id].q;
    }
}

void Overlay::restore(const RelativeMap& map, std::span<const std::uint32_t> words) {
  const std::size_t p = extreme_[0].size(), faces = p + extreme_[1].size();
  if (words.size() < faces || (words.size() - faces) % 2 != 0)
    throw std::logic_error("Overlay::restore: not the words of this pair");
  restart();
  signs_.set(map);
  arcs_.clear();
  extreme_[0].assign(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(p));
  const auto midpoint = words.begin() + static_cast<std::ptrdiff_t>(p);
  extreme_[1].assign(midpoint, words.begin() + static_cast<std::ptrdiff_t>(faces));
  // Only build may follow, and looks at all faces.
  std::fill(vertex_until_[0].begin(), vertex_until_[0].end(), clock_);
  find_pairs();
  for (std::size_t k = faces; k < words.size(); k += 2) {
    if (words[k] == kNoCrossing) continue;
    const auto id = static_cast<std::uint32_t>(arcs_.all.size());
    std::uint32_t &of_p = arcs_.head[0][words[k]], &of_q = arcs_.head[1][words[k + 1] / 2];
    arcs_.all.push_back({words[k], words[k + 1], {of_p, of_q}});
    arcs_.until.push_back(clock_);
    of_p = of_q = id;
  }
}

std::size_t Overlay::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  return sizeof(*this) - sizeof(signs_) + signs_.bytes() + leap_.bytes() +
         of(extreme_[0], extreme_[1], vertex_until_[0], vertex_until_[1], arcs_.all, arcs_.until, arcs_.free,
            arcs_.head[0], arcs_.head[1], arcs_.touched, arcs_.marked[0], arcs_.marked[1], pairs_.all, pairs_.parted,
            pairs_.parallel[0], pairs_.parallel[1], pairs_.start[0], pairs_.start[1], visits_[0].all, visits_[1].all,
            plan_.levels, plan_.chords, dropped_, uncrossed_, expired_, broken_, breaks_, spreading_, changes_.faces[0],
            changes_.faces[1], changes_.crossings);
}

// The brute force of thesis section 5.2, kept as reference and baseline.

namespace {

/// All edges of the vertex fall in the direction of the face.
bool compatible(const Signs& signs, int op, std::uint32_t f, std::uint32_t v) {
  for (const HalfEdge h : signs.poly(1 - op).leaving(v))
    if (signs.sign(op, f, h) > 0) return false;
  return true;
}

/// The arcs cross: the ends of each lie on different sides of the other's circle, and on the same half of the sphere.
/// Returns the half-edge of Q that the arc of p crosses outwards, or nothing as -1.
std::int64_t crossing_half_edge(const Signs& signs, std::uint32_t p, std::uint32_t q) {
  const Polytope &a = signs.poly(0), &b = signs.poly(1);
  const int f_left = signs.sign(0, a.face[2 * p], 2 * q), f_right = signs.sign(0, a.face[2 * p + 1], 2 * q);
  if (f_left == f_right) return -1;
  const int g_left = signs.sign(1, b.face[2 * q], 2 * p), g_right = signs.sign(1, b.face[2 * q + 1], 2 * p);
  if (g_left == g_right || f_right != g_left) return -1;
  return f_right > 0 ? 2 * q : 2 * q + 1;
}

}  // namespace

void Overlay::build_brute(const RelativeMap& map) {
  restart();
  const std::uint64_t exact_before = signs_.signs().exact();
  signs_.set(map);
  arcs_.clear();
  for (int op = 0; op < 2; ++op) {
    std::fill(vertex_until_[op].begin(), vertex_until_[op].end(), clock_);
    for (std::uint32_t f = 0; f < poly(op).face_count(); ++f) {
      ++work_.vertex_checks;
      std::uint32_t found = 0;
      for (std::uint32_t v = 0; v < poly(1 - op).vertex_count(); ++v) {
        if (!compatible(signs_, op, f, v)) continue;
        ++found;
        extreme_[op][f] = v;
      }
      if (found != 1) throw std::logic_error("Overlay::build_brute: a face has to have one extreme vertex");
    }
  }
  find_pairs();
  // Arcs that begin or end in the same direction do not count as crossing: see overlay_parallel.cpp.
  const auto share_an_end = [this](std::uint32_t p, std::uint32_t q) {
    for (const std::uint32_t f : {poly(0).face[2 * p], poly(0).face[2 * p + 1]})
      for (const std::uint32_t g : {poly(1).face[2 * q], poly(1).face[2 * q + 1]})
        if (pairs_.parallel[0][f] == g) return true;
    return false;
  };
  std::vector<HalfEdge> crossed;
  for (std::uint32_t p = 0; p < poly(0).edge_count(); ++p) {
    crossed.clear();
    for (std::uint32_t q = 0; q < poly(1).edge_count(); ++q)
      if (const std::int64_t h = crossing_half_edge(signs_, p, q); h >= 0 && !share_an_end(p, q))
        crossed.push_back(static_cast<HalfEdge>(h));
    // The crossings are in order: each leaves the vertex that the one before it led to.
    std::uint32_t v = end_cell(0, 2 * p), last = kNoCrossing;
    for (auto from = crossed.begin(); from != crossed.end(); ++from) {
      const auto it = std::find_if(from, crossed.end(), [&](HalfEdge h) { return poly(1).origin[h] == v; });
      if (it == crossed.end()) throw std::logic_error("Overlay::build_brute: crossings do not join");
      std::iter_swap(from, it);
      v = poly(1).target(*from);
      last = append_crossing(p, *from, clock_, last);
    }
  }
  finish_crossings();
  work_.exact_signs = signs_.signs().exact() - exact_before;
}

}  // namespace dymsum::spatial
