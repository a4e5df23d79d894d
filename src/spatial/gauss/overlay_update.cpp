// A motion's errors in an overlay, found by certificates and repaired where they are.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "spatial/gauss/leaving_slot.h"
#include "spatial/gauss/most_rise.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {
namespace {

/// Moves by more than this many cells start from neighbouring faces instead of from the vertices before: measured, see
/// docs/design/convex-motion.md.
constexpr double kLeap = 0.6;

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

void Overlay::update(const RelativeMap& map, bool use_margins) {
  restart();
  if (use_margins && map == signs_.map()) return;
  const std::uint64_t exact_before = signs_.signs().exact();
  const double angle = use_margins ? map.angle_from(signs_.map()) : 4;
  clock_ = (clock_ + angle) * exact::kUp;
  signs_.move(map);
  if (angle > kLeap * cell_) {
    leap();
    repair_new_pairs();
  } else {
    correct_vertices();
    check_crossings();
    work_.arc_checks = broken_.size();
    repair_broken();
  }
  work_.exact_signs = signs_.signs().exact() - exact_before;
}

/// Arcs that broke, and what follows from them.
void Overlay::repair_broken() {
  for (const std::uint32_t e : broken_) repair_arc(e);
  broken_.clear();
  settle_other_side();
}

/// The walker's faces. Where a face's vertex changes, its edges' arcs begin or end elsewhere.
void Overlay::correct_vertices() {
  const int w = walker_;
  const Polytope& mine = poly(w);
  find_expired(vertex_until_[w], clock_, expired_);
  work_.vertex_checks += expired_.size();
  // Which ones fail cannot be guessed: they are distinguished without branches, and corrected afterwards.
  const double error = signs_.error(w);
  std::size_t failed = 0;
  for (const std::uint32_t f : expired_) {
    const double most = most_rise(poly(1 - w), extreme_[w][f], signs_.row_now(w, f));
    vertex_until_[w][f] = later(signs_.margin(w, most));
    expired_[failed] = f;
    failed += !(most < -error);
  }
  expired_.resize(failed);
  for (const std::uint32_t f : expired_) {
    if (!climb(w, f, extreme_[w][f], signs_.row_now(w, f))) continue;
    note_face(w, f);
    HalfEdge h = mine.first[f];
    do {
      break_arc(h / 2, kEnds);
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
  if (!expired_.empty() || !pairs_.empty()) follow_pairs(expired_);
}

/// Its ends have changed (`by` = kEnds), or one of its crossings may be none any more (1).
void Overlay::break_arc(std::uint32_t e, std::uint32_t by) {
  if (breaks_[e] == 0) broken_.push_back(e);
  if (by != kEnds || breaks_[e] < kEnds) breaks_[e] += by;
}

/// The angle by which directions have to move at least before the circle of the walker's edge that is mapped to `along`
/// can leave the cell of the origin of `over` elsewhere than across its arc; kBeforeAll where doubles do not prove that
/// it leaves it there.
inline double Overlay::slack(HalfEdge over, Vec3 along) const {
  const int op = 1 - walker_;
  const std::array<double, 6>& n = poly(op).sides[over / 2];
  std::array<double, 2> side;
  for (std::size_t k = 0; k < 2; ++k) side[k] = n[k] * along.x + n[2 + k] * along.y + n[4 + k] * along.z;
  // Without a branch: half-edges point either way as often.
  const double forward = 1 - 2 * static_cast<double>(over & 1);
  const double least = std::min(forward * side[0], -forward * side[1]);
  return least > signs_.error(op) ? signs_.margin(op, least) : kBeforeAll;
}

bool Overlay::fall_in_doubles(std::uint32_t f) const {
  const int w = walker_;
  return most_rise(poly(1 - w), extreme_[w][f], signs_.row_now(w, f)) < -signs_.error(w);
}

bool Overlay::passes_in_doubles(std::uint32_t id) const {
  const int w = walker_;
  const Crossing& c = crossings_[id];
  return slack(across(w, c), signs_.mapped_edge(1 - w, edge_of(w, c))) != kBeforeAll;
}

/// Crossings whose certificates have ended: those that doubles do not prove any more break the arc that they lie on.
void Overlay::check_crossings() {
  const int w = walker_;
  find_expired(crossing_until_, clock_, expired_);
  work_.crossing_checks += expired_.size();
  for (const std::uint32_t id : expired_) {
    const std::uint32_t e = edge_of(w, crossings_[id]);
    crossing_until_[id] = later(slack(across(w, crossings_[id]), signs_.mapped_edge(1 - w, e)));
    if (crossing_until_[id] == kBeforeAll) break_arc(e, 1);
  }
}

/// The half-edge of the other operand across whose arc the arc of the walker's half-edge h, mapped to `along`, leaves
/// the cell of v.
HalfEdge Overlay::exit_now(HalfEdge h, std::uint32_t v, Vec3 along) const {
  const int op = 1 - walker_;
  const Polytope& other = poly(op);
  const HalfEdge over = leaving_edge(other.eight[v], in_floats(along), signs_.float_error(op));
  return over != kNoEdge ? over : exit_in_doubt(h, v, along);
}

/// The same where floats cannot decide.
HalfEdge Overlay::exit_in_doubt(HalfEdge h, std::uint32_t v, Vec3 along) const {
  const int op = 1 - walker_;
  const Polytope& other = poly(op);
  const auto value = [&](std::uint32_t k) { return dot(other.ring_normal[k], along); };
  const auto sign = [&](std::uint32_t k) { return signs_.sign_now(op, other.ring_face[k], h); };
  return other.ring[leaving_slot(other, v, along, signs_.error(op), value, sign)];
}

/// Corrects the crossings of an arc of the walker in place, from its left face to its right one: all of them when its
/// ends have changed, otherwise where crossings have failed. `last` is the last crossing that is right, v the cell that
/// it enters, `next` what follows in the list. Where a crossing ahead is known to leave v, it is the next one, as a
/// circle leaves a convex cell once; elsewhere the cell says across which arc to leave it.
void Overlay::repair_arc(std::uint32_t e) {
  const int w = walker_;
  const Polytope& other = poly(1 - w);
  const bool through = breaks_[e] >= kEnds;
  std::uint32_t failed = breaks_[e] % kEnds;
  breaks_[e] = 0;
  const Vec3 along = signs_.mapped_edge(1 - w, e);
  const std::uint32_t end = end_cell(w, 2 * e + 1);
  const auto over_of = [&](std::uint32_t id) { return across(w, crossings_[id]); };
  const auto fails = [&](std::uint32_t id) { return crossing_until_[id] == kBeforeAll; };
  std::uint32_t last = kNoCrossing, next = head_[w][e], v = end_cell(w, 2 * e), walked = 0;
  bool changed = false;
  const auto link = [&](std::uint32_t id) { (last == kNoCrossing ? head_[w][e] : crossings_[last].next[w]) = id; };
  const auto drop_until = [&](std::uint32_t id) {
    while (next != id) {
      const std::uint32_t dropped = std::exchange(next, crossings_[next].next[w]);
      failed -= fails(dropped) ? 1 : 0;
      crossing_until_[dropped] = kForever;
      dropped_.push_back(dropped);
    }
  };
  const auto pass = [&](std::uint32_t id, HalfEdge over) {
    link(id);
    last = id;
    next = crossings_[id].next[w];
    v = other.target(over);
  };
  const auto pass_proved = [&] {
    while (next != kNoCrossing && !fails(next)) last = std::exchange(next, crossings_[next].next[w]);
    if (last != kNoCrossing) v = other.target(over_of(last));
  };
  if (!through) pass_proved();
  while (v != end) {
    std::uint32_t ahead = next;
    while (ahead != kNoCrossing && fails(ahead)) ahead = crossings_[ahead].next[w];
    if (ahead != kNoCrossing && other.origin[over_of(ahead)] != v) {  // perhaps the arc now begins after it
      ahead = crossings_[ahead].next[w];
      if (ahead != kNoCrossing && (fails(ahead) || other.origin[over_of(ahead)] != v)) ahead = kNoCrossing;
    }
    if (ahead != kNoCrossing) {
      drop_until(ahead);
      pass(ahead, over_of(ahead));
      if (through) continue;
      if (failed == 0) break;
      pass_proved();
      continue;
    }
    if (walked++ > other.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    const HalfEdge over = exit_now(2 * e, v, along);
    std::uint32_t id = head_[1 - w][over / 2];
    while (id != kNoCrossing && edge_of(w, crossings_[id]) != e) id = crossings_[id].next[1 - w];
    if (id == kNoCrossing) {
      id = add_crossing(e, over);
      crossings_[id].next[w] = next;
      changed = true;
    } else {                                  // of the same two edges: it keeps its number
      if (crossing_until_[id] == kForever) {  // dropped too early
        std::erase(dropped_, id);
        crossings_[id].next[w] = next;
      } else {
        drop_until(id);
        failed -= fails(id) ? 1 : 0;
      }
      if (over_of(id) != over) {
        crossings_[id].q = crossing_of(w, e, over).q;
        touch(1 - w, over / 2);
        changed = true;
      }
    }
    crossing_until_[id] = std::max(clock_, later(slack(over, along)));
    pass(id, over);
  }
  if (v == end) {
    drop_until(kNoCrossing);
    link(kNoCrossing);
  }
  for (const std::uint32_t id : dropped_) remove_crossing(id);
  work_.arcs_changed += changed || !dropped_.empty();
  dropped_.clear();
  work_.steps += walked;
}

/// Of edge e of the walker; it still has to be linked into the arc of e.
std::uint32_t Overlay::add_crossing(std::uint32_t e, HalfEdge over) {
  const int op = 1 - walker_;
  std::uint32_t id;
  if (free_.empty()) {
    id = static_cast<std::uint32_t>(crossings_.size());
    crossings_.emplace_back();
    crossing_until_.push_back(kBeforeAll);
  } else {
    id = free_.back();
    free_.pop_back();
  }
  Crossing& c = crossings_[id];
  c = crossing_of(walker_, e, over);
  c.next[op] = head_[op][over / 2];
  head_[op][over / 2] = id;
  changes_.crossings.push_back(id);
  ++work_.crossings_added;
  touch(op, over / 2);
  return id;
}

/// One that is linked into the arc of the walker no more.
void Overlay::remove_crossing(std::uint32_t id) {
  const int op = 1 - walker_;
  const std::uint32_t e = edge_of(op, crossings_[id]);
  std::uint32_t* link = &head_[op][e];
  while (*link != id) link = &crossings_[*link].next[op];
  *link = crossings_[id].next[op];
  touch(op, e);
  free_crossing(id);
}

void Overlay::free_crossing(std::uint32_t id) {
  crossing_until_[id] = kForever;
  free_.push_back(id);
  ++work_.crossings_removed;
}

/// The vertices in whose cells the crossed arc of edge e of operand op begins and ends. Puts its crossings in order:
/// each leaves the cell that the one before entered.
std::pair<std::uint32_t, std::uint32_t> Overlay::cells_of_ends(int op, std::uint32_t e) {
  const Polytope& other = poly(1 - op);
  const std::uint32_t first = head_[op][e];
  const HalfEdge over = across(op, crossings_[first]);
  std::uint32_t begin = other.origin[over], end = other.target(over);
  // Crossings that follow are joined at either end, those that do not fit yet are tried again.
  std::uint32_t rest = crossings_[first].next[op], last = first, waiting = kNoCrossing;
  crossings_[last].next[op] = kNoCrossing;
  bool joined = false;
  while (rest != kNoCrossing) {
    const std::uint32_t id = std::exchange(rest, crossings_[rest].next[op]);
    const HalfEdge next_over = across(op, crossings_[id]);
    std::uint32_t& next = crossings_[id].next[op];
    if (other.origin[next_over] == end) {
      end = other.target(next_over);
      next = kNoCrossing;
      last = crossings_[last].next[op] = id;
      joined = true;
    } else if (other.target(next_over) == begin) {
      begin = other.origin[next_over];
      next = std::exchange(head_[op][e], id);
      joined = true;
    } else {
      next = std::exchange(waiting, id);
    }
    if (rest != kNoCrossing || waiting == kNoCrossing) continue;
    if (!std::exchange(joined, false)) throw std::logic_error("Overlay: the crossings of an arc do not join");
    rest = std::exchange(waiting, kNoCrossing);
  }
  return {begin, end};
}

/// The arcs of the other operand whose crossings changed, and the extreme vertices of its faces, which follow: a
/// crossed arc begins and ends in the cells that its first and last crossing leave and enter, an arc that is not
/// crossed lies in one cell. A face all of whose arcs were and are crossed by the same, or that is joined to such a
/// face by arcs that were not and are not crossed, has the vertex that it had.
void Overlay::settle_other_side() {
  const int op = 1 - walker_;
  const Polytope& other = poly(op);
  for (const std::uint32_t e : touched_) {
    is_touched_[op][e] = 0;
    if (head_[op][e] == kNoCrossing) {
      uncrossed_.push_back(e);
      continue;
    }
    const auto [begin, end] = cells_of_ends(op, e);
    set_vertex(op, other.face[2 * e], begin);
    set_vertex(op, other.face[2 * e + 1], end);
  }
  spread_vertex(op);
  // An arc that is crossed no more joins two faces one of which may still be wrong.
  for (const std::uint32_t e : uncrossed_) {
    if (end_cell(op, 2 * e) == end_cell(op, 2 * e + 1)) continue;
    for (const std::uint32_t f : {other.face[2 * e], other.face[2 * e + 1]}) {
      if (parallel_[op][f] != kNoFace) continue;
      ++work_.vertex_checks;
      if (!climb(op, f, extreme_[op][f], signs_.row_now(op, f))) continue;
      note_face(op, f);
      spreading_.push_back(f);
    }
    spread_vertex(op);
  }
  uncrossed_.clear();
  touched_.clear();
}

void Overlay::set_vertex(int op, std::uint32_t f, std::uint32_t v) {
  if (extreme_[op][f] == v || parallel_[op][f] != kNoFace) return;
  extreme_[op][f] = v;
  note_face(op, f);
  spreading_.push_back(f);
}

/// From faces that have changed over arcs that are not crossed.
void Overlay::spread_vertex(int op) {
  const Polytope& mine = poly(op);
  while (!spreading_.empty()) {
    const std::uint32_t f = spreading_.back();
    spreading_.pop_back();
    HalfEdge h = mine.first[f];
    do {
      if (head_[op][h / 2] == kNoCrossing) set_vertex(op, mine.face[twin(h)], extreme_[op][f]);
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
}

}  // namespace dymsum::spatial
