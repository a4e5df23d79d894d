// Moves so long that hardly anything stays: all arcs of the walker are walked, without a look at what was, and the
// walks find the faces' vertices too. Many arcs are walked side by side, a cell each at a time: where an arc ends
// cannot be guessed, so nothing here branches on it. Pairs of faces that face the same way and still do are known
// beforehand; those that come to do so are repaired afterwards.
#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {
namespace {

/// What follows the last crossing in lists of those found. The next numbers are those of the walker's edges, each for
/// what comes before the first crossing along its arc; those of crossings follow.
constexpr std::uint32_t kEnd = 0;
constexpr std::uint32_t before_first(std::uint32_t e) { return e + 1; }

/// Chooses without a branch, which compilers would put here.
constexpr std::uint32_t chosen(bool first, std::uint32_t a, std::uint32_t b) {
  return b ^ ((a ^ b) & (0 - static_cast<std::uint32_t>(first)));
}

}  // namespace

class Overlay::Leap {
 public:
  explicit Leap(Overlay& overlay)
      : o_(overlay), s_(overlay.leap_), w_(overlay.walker_), mine_(overlay.poly(w_)), other_(overlay.poly(1 - w_)) {}
  void run();

 private:
  void walk_to_faces(std::size_t begin, std::size_t end);
  void walk_chords();
  void step_to_faces(float error);
  void step_chords(float error);
  HalfEdge exit_of(const LeapScratch::Walk& walk, float error) const;
  void list_found_across();
  void keep_numbers();
  void write_found();
  void follow_found();

  Overlay& o_;
  LeapScratch& s_;
  const int w_;
  const Polytope &mine_, &other_;
};

/// Every face but the first is reached along an arc from a neighbour whose vertex is known; the other arcs join faces
/// whose vertices are known then.
void Overlay::Leap::run() {
  s_.found.assign(before_first(mine_.edge_count()), {kNoCrossing, 0, kEnd, kEnd, kNoCrossing});
  o_.keep_pairs();
  const std::uint32_t first = o_.visits_[w_].all[0].face;
  if (o_.pairs_.parallel[w_][first] == kNoFace &&
      o_.climb(w_, first, o_.extreme_[w_][first], o_.signs_.row_now(w_, first)))
    o_.note_face(w_, first);
  for (std::size_t k = 1; k + 1 < o_.plan_.levels.size(); ++k)
    walk_to_faces(o_.plan_.levels[k], o_.plan_.levels[k + 1]);
  walk_chords();
  std::fill(o_.vertex_until_[w_].begin(), o_.vertex_until_[w_].end(), o_.clock_);
  o_.work_.steps += s_.found.size() - before_first(mine_.edge_count());
  o_.work_.vertex_checks += mine_.face_count();
  o_.work_.arc_checks = mine_.edge_count();
  list_found_across();
  keep_numbers();
  write_found();
  follow_found();
}

/// The faces of these visits, from those before.
void Overlay::Leap::walk_to_faces(std::size_t begin, std::size_t end) {
  s_.walks.resize(std::max(s_.walks.size(), end - begin));
  s_.walking.clear();
  for (std::size_t i = begin; i < end; ++i) {
    const FaceVisits::Visit& visit = o_.visits_[w_].all[i];
    if (o_.pairs_.parallel[w_][visit.face] != kNoFace) {  // its cells are known
      s_.walks[i - begin].goal = visit.face;
      s_.walks[i - begin].v = o_.extreme_[w_][visit.face];
      s_.also_chords.push_back(visit.via / 2);
      continue;
    }
    const Vec3 edge = o_.signs_.mapped_edge(1 - w_, visit.via / 2);
    const double direction = 1 - 2 * static_cast<double>(visit.via & 1);
    s_.walks[i - begin] = {o_.signs_.row_now(w_, visit.face),
                           in_floats(direction * edge),
                           visit.via,
                           o_.end_cell(w_, visit.via),
                           visit.face,
                           before_first(visit.via / 2)};
    s_.walking.push_back(static_cast<std::uint32_t>(i - begin));
  }
  const float error = o_.signs_.float_error(1 - w_);
  for (std::uint32_t rounds = 0; !s_.walking.empty(); ++rounds) {
    if (rounds > other_.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    step_to_faces(error);
  }
  std::vector<std::uint32_t>& changed = o_.changes_.faces[w_];
  std::size_t n = changed.size();
  changed.resize(n + (end - begin));
  for (std::size_t i = 0; i < end - begin; ++i) {
    std::uint32_t& vertex = o_.extreme_[w_][s_.walks[i].goal];
    changed[n] = s_.walks[i].goal;
    n += vertex != s_.walks[i].v;
    vertex = s_.walks[i].v;
  }
  o_.work_.vertex_errors += n - (changed.size() - (end - begin));
  changed.resize(n);
}

/// The half-edge of the other operand across whose arc a walk leaves the cell at hand, if it does.
inline HalfEdge Overlay::Leap::exit_of(const LeapScratch::Walk& walk, float error) const {
  const int op = 1 - w_;
  const HalfEdge over = leaving_edge(o_.poly(op).eight[walk.v], walk.along, error);
  if (over != kNoEdge) return over;
  const Vec3 edge = o_.signs_.mapped_edge(op, walk.h / 2);
  return o_.exit_in_doubt(walk.h, walk.v, (walk.h & 1) ? -edge : edge);
}

/// One cell each. An arc is shorter than half a circle, so the face lies in the cell at hand unless it lies beyond the
/// arc across which the circle leaves that cell.
void Overlay::Leap::step_to_faces(float float_error) {
  const double error = o_.signs_.error(w_);
  std::size_t n = s_.found.size(), left = 0;
  s_.found.resize(n + s_.walking.size());
  LeapScratch::Found* const found = s_.found.data();
  for (const std::uint32_t i : s_.walking) {
    LeapScratch::Walk& walk = s_.walks[i];
    const HalfEdge over = exit_of(walk, float_error);
    const double beyond = dot(walk.row, other_.direction[over / 2]) * (1 - 2 * static_cast<double>(over & 1));
    bool crosses = beyond > 0;
    if (!(std::abs(beyond) > error)) {
      crosses = o_.signs_.sign_now(w_, walk.goal, over) > 0;
      s_.on_arcs.push_back(walk.goal);
    }
    const std::uint32_t back = walk.h & 1, id = static_cast<std::uint32_t>(n);
    std::uint32_t& before = found[walk.after].next;
    found[n] = {walk.h / 2, over ^ back, before, kEnd, kNoCrossing};
    before = chosen(crosses, id, before);
    walk.after = chosen(crosses & (back == 0), id, walk.after);
    walk.v = chosen(crosses, other_.target(over), walk.v);
    s_.walking[left] = i;
    left += crosses;
    n += crosses;
  }
  s_.walking.resize(left);
  s_.found.resize(n);
}

/// The arcs of edges the cells of both of whose ends are known.
void Overlay::Leap::walk_chords() {
  s_.walks.resize(std::max(s_.walks.size(), o_.plan_.chords.size() + s_.also_chords.size()));
  std::size_t n = 0;
  for (const std::vector<std::uint32_t>* edges : {&o_.plan_.chords, &s_.also_chords})
    for (const std::uint32_t e : *edges) {
      const std::uint32_t begin = o_.end_cell(w_, 2 * e), end = o_.end_cell(w_, 2 * e + 1);
      s_.walks[n] = {{}, in_floats(o_.signs_.mapped_edge(1 - w_, e)), 2 * e, begin, end, before_first(e)};
      n += begin != end;
    }
  s_.also_chords.clear();
  s_.walking.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) s_.walking[i] = i;
  const float error = o_.signs_.float_error(1 - w_);
  for (std::uint32_t rounds = 0; !s_.walking.empty(); ++rounds) {
    if (rounds > other_.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    step_chords(error);
  }
}

void Overlay::Leap::step_chords(float error) {
  std::size_t n = s_.found.size(), left = 0;
  s_.found.resize(n + s_.walking.size());
  for (const std::uint32_t i : s_.walking) {
    LeapScratch::Walk& walk = s_.walks[i];
    const HalfEdge over = exit_of(walk, error);
    s_.found[n] = {walk.h / 2, over, kEnd, kEnd, kNoCrossing};
    walk.after = s_.found[walk.after].next = static_cast<std::uint32_t>(n++);
    walk.v = other_.target(over);
    s_.walking[left] = i;
    left += walk.v != walk.goal;
  }
  s_.walking.resize(left);
}

/// Lists the crossings found at the arcs of the other operand too, and those arcs that have several. A crossing seen
/// from there: the walker's half-edge across it leads from one cell to the next.
void Overlay::Leap::list_found_across() {
  s_.across.assign(other_.edge_count(), {kEnd, 0, 0, 0});
  s_.joining.resize(s_.found.size());
  std::size_t several = 0;
  for (std::uint32_t k = before_first(mine_.edge_count()); k < s_.found.size(); ++k) {
    LeapScratch::Found& found = s_.found[k];
    LeapScratch::Across& across = s_.across[found.over / 2];
    const HalfEdge h = 2 * found.e + (1 - (found.over & 1));
    found.next_across = across.first;
    s_.joining[several] = found.over / 2;
    several += across.count == 1;
    across = {k, across.count + 1, mine_.origin[h], mine_.target(h)};
  }
  s_.joining.resize(several);
}

/// A crossing of the same two edges keeps its number. The numbers of the others are free.
void Overlay::Leap::keep_numbers() {
  const int op = 1 - w_;
  s_.altered.assign(mine_.edge_count(), 0);
  o_.arcs_.free.resize(o_.arcs_.all.size());
  std::size_t freed = 0;
  for (std::uint32_t id = 0; id < o_.arcs_.all.size(); ++id) {
    const std::uint32_t e = edge_of(w_, o_.arcs_[id]);
    const bool was = o_.arcs_.until[id] != kForever;
    std::uint32_t k = s_.across[edge_of(op, o_.arcs_[id])].first;
    while (s_.found[k].e != e && s_.found[k].next_across != kEnd) k = s_.found[k].next_across;
    const bool stays = was && s_.found[k].e == e;
    k = stays ? k : kEnd;
    s_.found[k].id = stays ? id : kNoCrossing;
    s_.altered[e] |= was && (!stays || s_.found[k].over != across(w_, o_.arcs_[id]));
    o_.arcs_.free[freed] = id;
    freed += !stays;
    o_.work_.crossings_removed += was && !stays;
    o_.arcs_.until[id] = kForever;
  }
  o_.arcs_.free.resize(freed);
}

/// Makes what was found the crossings.
void Overlay::Leap::write_found() {
  const int op = 1 - w_;
  const std::uint32_t begin = before_first(mine_.edge_count());
  const std::size_t count = s_.found.size() - begin;
  // Numbers in use do not count twice: as many as are found, all told.
  for (auto id = static_cast<std::uint32_t>(o_.arcs_.all.size()); o_.arcs_.all.size() < count; ++id) {
    o_.arcs_.all.emplace_back();
    o_.arcs_.until.push_back(0);
    o_.arcs_.free.push_back(id);
  }
  std::size_t left = o_.arcs_.free.size(), added = 0;
  o_.changes_.crossings.resize(count);
  for (std::uint32_t k = begin; k < s_.found.size(); ++k) {
    const bool is_new = s_.found[k].id == kNoCrossing;
    left -= is_new;
    const std::uint32_t id = is_new ? o_.arcs_.free[left] : s_.found[k].id;
    s_.found[k].id = o_.changes_.crossings[added] = id;
    added += is_new;
    s_.altered[s_.found[k].e] |= is_new;
    o_.arcs_.until[id] = o_.clock_;  // not looked at
  }
  o_.arcs_.free.resize(left);
  o_.changes_.crossings.resize(added);
  o_.work_.crossings_added += added;
  for (const std::uint8_t altered : s_.altered) o_.work_.arcs_changed += altered;
  for (std::uint32_t k = begin; k < s_.found.size(); ++k) {
    const LeapScratch::Found& found = s_.found[k];
    Crossing& c = o_.arcs_[found.id];
    c = crossing_of(w_, found.e, found.over);
    c.next[w_] = s_.found[found.next].id;
    c.next[op] = s_.found[found.next_across].id;
  }
  for (std::uint32_t e = 0; e < o_.arcs_.head[w_].size(); ++e)
    o_.arcs_.head[w_][e] = s_.found[s_.found[before_first(e)].next].id;
  for (std::uint32_t e = 0; e < o_.arcs_.head[op].size(); ++e) o_.arcs_.head[op][e] = s_.found[s_.across[e].first].id;
}

/// The other operand's faces, from neighbour to neighbour: across an arc that is crossed by the cell in which it begins
/// or ends.
void Overlay::Leap::follow_found() {
  const int op = 1 - w_;
  for (const std::uint32_t e : s_.joining)
    std::tie(s_.across[e].begin, s_.across[e].end) = o_.arcs_.ends_along(op, mine_, e);
  const std::uint32_t first = o_.visits_[op].all[0].face;
  if (o_.pairs_.parallel[op][first] == kNoFace &&
      o_.climb(op, first, o_.extreme_[op][first], o_.signs_.row_now(op, first)))
    o_.note_face(op, first);
  std::vector<std::uint32_t>& changed = o_.changes_.faces[op];
  std::size_t n = changed.size();
  changed.resize(n + o_.visits_[op].all.size());
  for (std::size_t i = 1; i < o_.visits_[op].all.size(); ++i) {
    const FaceVisits::Visit& visit = o_.visits_[op].all[i];
    if (o_.pairs_.parallel[op][visit.face] != kNoFace) continue;  // climbed for
    const LeapScratch::Across& across = s_.across[visit.via / 2];
    const std::uint32_t end = (visit.via & 1) ? across.begin : across.end;
    const std::uint32_t v = across.count > 0 ? end : o_.end_cell(op, visit.via);
    std::uint32_t& vertex = o_.extreme_[op][visit.face];
    changed[n] = visit.face;
    n += vertex != v;
    vertex = v;
  }
  o_.work_.vertex_errors += n - (changed.size() - o_.visits_[op].all.size());
  changed.resize(n);
}

void Overlay::leap() { Leap(*this).run(); }

}  // namespace dymsum::spatial
