// Moves so long that hardly anything stays: all arcs of the walker are walked, without a look at what was, and the
// walks find the faces' vertices too. Many arcs are walked side by side, a cell each at a time: where an arc ends
// cannot be guessed, so nothing here branches on it. Pairs of faces that face the same way and still do are known
// beforehand; those that come to do so are repaired afterwards.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {
namespace {

/// In lists of crossings found, what follows the last one. The next numbers are those of the walker's edges, each for
/// what comes before the first crossing along its arc; those of crossings follow.
constexpr std::uint32_t kEnd = 0;
constexpr std::uint32_t before_first(std::uint32_t e) { return e + 1; }

/// Without a branch, which compilers would put here.
constexpr std::uint32_t chosen(bool first, std::uint32_t a, std::uint32_t b) {
  return b ^ ((a ^ b) & (0 - static_cast<std::uint32_t>(first)));
}

}  // namespace

/// Every face but the first is reached along an arc from a neighbour whose vertex is known; the other arcs join faces
/// whose vertices are known then.
void Overlay::leap() {
  const int w = walker_;
  const Polytope& mine = poly(w);
  found_.assign(before_first(mine.edge_count()), {kNoCrossing, 0, kEnd, kEnd, kNoCrossing});
  keep_pairs();
  const std::uint32_t first = visits_[w][0].face;
  if (parallel_[w][first] == kNoFace && climb(w, first, extreme_[w][first], signs_.row_now(w, first)))
    note_face(w, first);
  for (std::size_t k = 1; k + 1 < levels_.size(); ++k) walk_to_faces(levels_[k], levels_[k + 1]);
  walk_chords();
  std::fill(vertex_until_[w].begin(), vertex_until_[w].end(), clock_);
  work_.steps += found_.size() - before_first(mine.edge_count());
  work_.vertex_checks += mine.face_count();
  work_.arc_checks = mine.edge_count();
  list_found_across();
  keep_numbers();
  write_found();
  follow_found();
}

/// The faces of these visits, from those before.
void Overlay::walk_to_faces(std::size_t begin, std::size_t end) {
  const int w = walker_;
  walks_.resize(std::max(walks_.size(), end - begin));
  walking_.clear();
  for (std::size_t i = begin; i < end; ++i) {
    const Visit& visit = visits_[w][i];
    if (parallel_[w][visit.face] != kNoFace) {  // its cells are known
      walks_[i - begin].goal = visit.face;
      walks_[i - begin].v = extreme_[w][visit.face];
      also_chords_.push_back(visit.via / 2);
      continue;
    }
    const Vec3 edge = signs_.mapped_edge(1 - w, visit.via / 2);
    const double direction = 1 - 2 * static_cast<double>(visit.via & 1);
    walks_[i - begin] = {
        signs_.row_now(w, visit.face), in_floats(direction * edge), visit.via, end_cell(w, visit.via), visit.face,
        before_first(visit.via / 2)};
    walking_.push_back(static_cast<std::uint32_t>(i - begin));
  }
  const float error = signs_.float_error(1 - w);
  for (std::uint32_t rounds = 0; !walking_.empty(); ++rounds) {
    if (rounds > poly(1 - w).edge_count()) throw std::logic_error("Overlay: an arc does not end");
    step_to_faces(error);
  }
  std::vector<std::uint32_t>& changed = changes_.faces[w];
  std::size_t n = changed.size();
  changed.resize(n + (end - begin));
  for (std::size_t i = 0; i < end - begin; ++i) {
    std::uint32_t& vertex = extreme_[w][walks_[i].goal];
    changed[n] = walks_[i].goal;
    n += vertex != walks_[i].v;
    vertex = walks_[i].v;
  }
  work_.vertex_errors += n - (changed.size() - (end - begin));
  changed.resize(n);
}

/// The half-edge of the other operand across whose arc a walk leaves the cell at hand, if it does.
inline HalfEdge Overlay::exit_of(const Walk& walk, float error) const {
  const int op = 1 - walker_;
  const HalfEdge over = leaving_edge(poly(op).eight[walk.v], walk.along, error);
  if (over != kNoEdge) return over;
  const Vec3 edge = signs_.mapped_edge(op, walk.h / 2);
  return exit_in_doubt(walk.h, walk.v, (walk.h & 1) ? -edge : edge);
}

/// One cell each. An arc is shorter than half a circle, so the face lies in the cell at hand unless it lies beyond the
/// arc across which the circle leaves that cell.
void Overlay::step_to_faces(float float_error) {
  const int w = walker_;
  const Polytope& other = poly(1 - w);
  const double error = signs_.error(w);
  std::size_t n = found_.size(), left = 0;
  found_.resize(n + walking_.size());
  Found* const found = found_.data();
  for (const std::uint32_t i : walking_) {
    Walk& walk = walks_[i];
    const HalfEdge over = exit_of(walk, float_error);
    const double beyond = dot(walk.row, other.direction[over / 2]) * (1 - 2 * static_cast<double>(over & 1));
    bool crosses = beyond > 0;
    if (!(std::abs(beyond) > error)) {
      crosses = signs_.sign_now(w, walk.goal, over) > 0;
      on_arcs_.push_back(walk.goal);
    }
    const std::uint32_t back = walk.h & 1, id = static_cast<std::uint32_t>(n);
    std::uint32_t& before = found[walk.after].next;
    found[n] = {walk.h / 2, over ^ back, before, kEnd, kNoCrossing};
    before = chosen(crosses, id, before);
    walk.after = chosen(crosses & (back == 0), id, walk.after);
    walk.v = chosen(crosses, other.target(over), walk.v);
    walking_[left] = i;
    left += crosses;
    n += crosses;
  }
  walking_.resize(left);
  found_.resize(n);
}

/// The arcs of edges the cells of both of whose ends are known.
void Overlay::walk_chords() {
  const int w = walker_;
  walks_.resize(std::max(walks_.size(), chords_.size() + also_chords_.size()));
  std::size_t n = 0;
  for (const std::vector<std::uint32_t>* edges : {&chords_, &also_chords_})
    for (const std::uint32_t e : *edges) {
      const std::uint32_t begin = end_cell(w, 2 * e), end = end_cell(w, 2 * e + 1);
      walks_[n] = {{}, in_floats(signs_.mapped_edge(1 - w, e)), 2 * e, begin, end, before_first(e)};
      n += begin != end;
    }
  also_chords_.clear();
  walking_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) walking_[i] = i;
  const float error = signs_.float_error(1 - w);
  for (std::uint32_t rounds = 0; !walking_.empty(); ++rounds) {
    if (rounds > poly(1 - w).edge_count()) throw std::logic_error("Overlay: an arc does not end");
    step_chords(error);
  }
}

void Overlay::step_chords(float error) {
  const Polytope& other = poly(1 - walker_);
  std::size_t n = found_.size(), left = 0;
  found_.resize(n + walking_.size());
  for (const std::uint32_t i : walking_) {
    Walk& walk = walks_[i];
    const HalfEdge over = exit_of(walk, error);
    found_[n] = {walk.h / 2, over, kEnd, kEnd, kNoCrossing};
    walk.after = found_[walk.after].next = static_cast<std::uint32_t>(n++);
    walk.v = other.target(over);
    walking_[left] = i;
    left += walk.v != walk.goal;
  }
  walking_.resize(left);
}

/// Lists the crossings found at the arcs of the other operand too, and those arcs that have several. A crossing seen
/// from there: the walker's half-edge across it leads from one cell to the next.
void Overlay::list_found_across() {
  const Polytope& mine = poly(walker_);
  across_.assign(poly(1 - walker_).edge_count(), {kEnd, 0, 0, 0});
  joining_.resize(found_.size());
  std::size_t several = 0;
  for (std::uint32_t k = before_first(mine.edge_count()); k < found_.size(); ++k) {
    Found& found = found_[k];
    Across& across = across_[found.over / 2];
    const HalfEdge h = 2 * found.e + (1 - (found.over & 1));
    found.next_across = across.first;
    joining_[several] = found.over / 2;
    several += across.count == 1;
    across = {k, across.count + 1, mine.origin[h], mine.target(h)};
  }
  joining_.resize(several);
}

/// A crossing of the same two edges keeps its number. The numbers of the others are free.
void Overlay::keep_numbers() {
  const int w = walker_, op = 1 - w;
  altered_.assign(poly(w).edge_count(), 0);
  free_.resize(crossings_.size());
  std::size_t freed = 0;
  for (std::uint32_t id = 0; id < crossings_.size(); ++id) {
    const std::uint32_t e = edge_of(w, crossings_[id]);
    const bool was = crossing_until_[id] != std::numeric_limits<double>::infinity();
    std::uint32_t k = across_[edge_of(op, crossings_[id])].first;
    while (found_[k].e != e && found_[k].next_across != kEnd) k = found_[k].next_across;
    const bool stays = was && found_[k].e == e;
    k = stays ? k : kEnd;
    found_[k].id = stays ? id : kNoCrossing;
    altered_[e] |= was && (!stays || found_[k].over != across(w, crossings_[id]));
    free_[freed] = id;
    freed += !stays;
    work_.crossings_removed += was && !stays;
    crossing_until_[id] = std::numeric_limits<double>::infinity();
  }
  free_.resize(freed);
}

/// Makes what was found the crossings.
void Overlay::write_found() {
  const int w = walker_, op = 1 - w;
  const std::uint32_t begin = before_first(poly(w).edge_count());
  const std::size_t count = found_.size() - begin;
  // Numbers in use do not count twice: as many as are found, all told.
  for (auto id = static_cast<std::uint32_t>(crossings_.size()); crossings_.size() < count; ++id) {
    crossings_.emplace_back();
    crossing_until_.push_back(0);
    free_.push_back(id);
  }
  std::size_t left = free_.size(), added = 0;
  changes_.crossings.resize(count);
  for (std::uint32_t k = begin; k < found_.size(); ++k) {
    const bool is_new = found_[k].id == kNoCrossing;
    left -= is_new;
    const std::uint32_t id = is_new ? free_[left] : found_[k].id;
    found_[k].id = changes_.crossings[added] = id;
    added += is_new;
    altered_[found_[k].e] |= is_new;
    crossing_until_[id] = clock_;  // not looked at
  }
  free_.resize(left);
  changes_.crossings.resize(added);
  work_.crossings_added += added;
  for (const std::uint8_t altered : altered_) work_.arcs_changed += altered;
  for (std::uint32_t k = begin; k < found_.size(); ++k) {
    const Found& found = found_[k];
    Crossing& c = crossings_[found.id];
    c = crossing_of(w, found.e, found.over);
    c.next[w] = found_[found.next].id;
    c.next[op] = found_[found.next_across].id;
  }
  for (std::uint32_t e = 0; e < head_[w].size(); ++e) head_[w][e] = found_[found_[before_first(e)].next].id;
  for (std::uint32_t e = 0; e < head_[op].size(); ++e) head_[op][e] = found_[across_[e].first].id;
}

/// The other operand's faces, from neighbour to neighbour: across an arc that is crossed by the cell in which it begins
/// or ends.
void Overlay::follow_found() {
  const int op = 1 - walker_;
  for (const std::uint32_t e : joining_) std::tie(across_[e].begin, across_[e].end) = cells_of_ends(op, e);
  const std::uint32_t first = visits_[op][0].face;
  if (parallel_[op][first] == kNoFace && climb(op, first, extreme_[op][first], signs_.row_now(op, first)))
    note_face(op, first);
  std::vector<std::uint32_t>& changed = changes_.faces[op];
  std::size_t n = changed.size();
  changed.resize(n + visits_[op].size());
  for (std::size_t i = 1; i < visits_[op].size(); ++i) {
    const Visit& visit = visits_[op][i];
    if (parallel_[op][visit.face] != kNoFace) continue;  // climbed for
    const Across& across = across_[visit.via / 2];
    const std::uint32_t end = (visit.via & 1) ? across.begin : across.end;
    const std::uint32_t v = across.count > 0 ? end : end_cell(op, visit.via);
    std::uint32_t& vertex = extreme_[op][visit.face];
    changed[n] = visit.face;
    n += vertex != v;
    vertex = v;
  }
  work_.vertex_errors += n - (changed.size() - visits_[op].size());
  changed.resize(n);
}

}  // namespace dymsum::spatial
