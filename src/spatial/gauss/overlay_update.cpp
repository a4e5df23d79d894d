// A motion's errors in an overlay, found by certificates and repaired where they are.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "spatial/gauss/overlay.h"
#include "spatial/gauss/polytope.h"

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
  if (!expired_.empty() || !pairs_.all.empty()) follow_pairs(expired_);
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
  // No branch is taken: half-edges point in either direction as often.
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
  const Crossing& c = arcs_[id];
  return slack(across(w, c), signs_.mapped_edge(1 - w, edge_of(w, c))) != kBeforeAll;
}

/// Crossings whose certificates have ended: those that doubles do not prove any more break the arc that they lie on.
void Overlay::check_crossings() {
  const int w = walker_;
  find_expired(arcs_.until, clock_, expired_);
  work_.crossing_checks += expired_.size();
  for (const std::uint32_t id : expired_) {
    const std::uint32_t e = edge_of(w, arcs_[id]);
    arcs_.until[id] = later(slack(across(w, arcs_[id]), signs_.mapped_edge(1 - w, e)));
    if (arcs_.until[id] == kBeforeAll) break_arc(e, 1);
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
/// ends have changed, otherwise where crossings have failed. `last_` is the last crossing that is right, `v_` the cell
/// that it enters, `next_` what follows in the list.
class Overlay::ArcRepair {
 public:
  ArcRepair(Overlay& overlay, std::uint32_t e)
      : o_(overlay),
        w_(overlay.walker_),
        other_(overlay.poly(1 - w_)),
        e_(e),
        through_(overlay.breaks_[e] >= kEnds),
        failed_(overlay.breaks_[e] % kEnds),
        along_(overlay.signs_.mapped_edge(1 - w_, e)),
        next_(overlay.arcs_.head[w_][e]),
        v_(overlay.end_cell(w_, 2 * e)),
        end_(overlay.end_cell(w_, 2 * e + 1)) {
    overlay.breaks_[e] = 0;
  }

  void run() {
    if (!through_) pass_proved();
    while (v_ != end_) {
      const std::uint32_t ahead = known_exit();
      if (ahead == kNoCrossing) {
        walk();
        continue;
      }
      drop_until(ahead);
      pass(ahead, over_of(ahead));
      if (through_) continue;
      if (failed_ == 0) break;
      pass_proved();
    }
    if (v_ == end_) {
      drop_until(kNoCrossing);
      link(kNoCrossing);
    }
    for (const std::uint32_t id : o_.dropped_) o_.remove_crossing(id);
    o_.work_.arcs_changed += changed_ || !o_.dropped_.empty();
    o_.dropped_.clear();
    o_.work_.steps += walked_;
  }

 private:
  HalfEdge over_of(std::uint32_t id) const { return across(w_, o_.arcs_[id]); }
  bool fails(std::uint32_t id) const { return o_.arcs_.until[id] == kBeforeAll; }
  std::uint32_t& after(std::uint32_t id) const { return o_.arcs_[id].next[w_]; }
  void link(std::uint32_t id) { (last_ == kNoCrossing ? o_.arcs_.head[w_][e_] : after(last_)) = id; }
  void drop_until(std::uint32_t id) {
    while (next_ != id) {
      const std::uint32_t dropped = std::exchange(next_, after(next_));
      failed_ -= fails(dropped) ? 1 : 0;
      o_.arcs_.until[dropped] = kForever;
      o_.dropped_.push_back(dropped);
    }
  }
  void pass(std::uint32_t id, HalfEdge over) {
    link(id);
    last_ = id;
    next_ = after(id);
    v_ = other_.target(over);
  }
  void pass_proved() {
    while (next_ != kNoCrossing && !fails(next_)) last_ = std::exchange(next_, after(next_));
    if (last_ != kNoCrossing) v_ = other_.target(over_of(last_));
  }

  /// A crossing ahead that is known to leave the cell at hand is the next one, as a circle leaves a convex cell once.
  std::uint32_t known_exit() const {
    const auto leaves = [&](std::uint32_t id) { return other_.origin[over_of(id)] == v_; };
    std::uint32_t ahead = next_;
    while (ahead != kNoCrossing && fails(ahead)) ahead = after(ahead);
    if (ahead == kNoCrossing || leaves(ahead)) return ahead;
    ahead = after(ahead);  // perhaps the arc now begins after it
    return ahead != kNoCrossing && !fails(ahead) && leaves(ahead) ? ahead : kNoCrossing;
  }

  /// Elsewhere the cell says across which arc to leave it.
  void walk() {
    if (walked_++ > other_.edge_count()) throw std::logic_error("Overlay: an arc does not end");
    const HalfEdge over = o_.exit_now(2 * e_, v_, along_);
    std::uint32_t id = o_.arcs_.head[1 - w_][over / 2];
    while (id != kNoCrossing && edge_of(w_, o_.arcs_[id]) != e_) id = o_.arcs_[id].next[1 - w_];
    if (id == kNoCrossing) {
      id = o_.add_crossing(e_, over);
      after(id) = next_;
      changed_ = true;
    } else {
      take_again(id, over);
    }
    o_.arcs_.until[id] = std::max(o_.clock_, o_.later(o_.slack(over, along_)));
    pass(id, over);
  }
  /// A crossing of the same two edges keeps its number.
  void take_again(std::uint32_t id, HalfEdge over) {
    if (o_.arcs_.until[id] == kForever) {  // dropped too early
      std::erase(o_.dropped_, id);
      after(id) = next_;
    } else {
      drop_until(id);
      failed_ -= fails(id) ? 1 : 0;
    }
    if (over_of(id) == over) return;
    o_.arcs_[id].q = crossing_of(w_, e_, over).q;
    o_.arcs_.touch(1 - w_, over / 2);
    changed_ = true;
  }

  Overlay& o_;
  const int w_;
  const Polytope& other_;
  const std::uint32_t e_;
  const bool through_;
  std::uint32_t failed_;  // crossings ahead that have failed
  const Vec3 along_;
  std::uint32_t last_ = kNoCrossing, next_, v_, end_, walked_ = 0;
  bool changed_ = false;
};

/// Arcs that broke, and what follows from them.
void Overlay::repair_broken() {
  for (const std::uint32_t e : broken_) ArcRepair(*this, e).run();
  broken_.clear();
  settle_other_side();
}

/// Adds a crossing of edge e of the walker; it still has to be linked into the arc of e.
std::uint32_t Overlay::add_crossing(std::uint32_t e, HalfEdge over) {
  const std::uint32_t id = arcs_.add(1 - walker_, crossing_of(walker_, e, over));
  changes_.crossings.push_back(id);
  ++work_.crossings_added;
  return id;
}

/// One that is linked into the arc of the walker no more.
void Overlay::remove_crossing(std::uint32_t id) {
  arcs_.remove(1 - walker_, id);
  ++work_.crossings_removed;
}

/// The arcs of the other operand whose crossings changed, and the extreme vertices of its faces, which follow: a
/// crossed arc begins and ends in the cells that its first and last crossing leave and enter, an arc that is not
/// crossed lies in one cell. A face all of whose arcs were and are crossed by the same, or that is joined to such a
/// face by arcs that were not and are not crossed, has the vertex that it had.
void Overlay::settle_other_side() {
  const int op = 1 - walker_;
  const Polytope& other = poly(op);
  for (const std::uint32_t e : arcs_.touched) {
    arcs_.marked[op][e] = 0;
    if (arcs_.head[op][e] == kNoCrossing) {
      uncrossed_.push_back(e);
      continue;
    }
    const auto [begin, end] = arcs_.ends_along(op, poly(1 - op), e);
    set_vertex(op, other.face[2 * e], begin);
    set_vertex(op, other.face[2 * e + 1], end);
  }
  spread_vertex(op);
  // An arc that is crossed no more joins two faces one of which may still be wrong.
  for (const std::uint32_t e : uncrossed_) {
    if (end_cell(op, 2 * e) == end_cell(op, 2 * e + 1)) continue;
    for (const std::uint32_t f : {other.face[2 * e], other.face[2 * e + 1]}) {
      if (pairs_.parallel[op][f] != kNoFace) continue;
      ++work_.vertex_checks;
      if (!climb(op, f, extreme_[op][f], signs_.row_now(op, f))) continue;
      note_face(op, f);
      spreading_.push_back(f);
    }
    spread_vertex(op);
  }
  uncrossed_.clear();
  arcs_.touched.clear();
}

void Overlay::set_vertex(int op, std::uint32_t f, std::uint32_t v) {
  if (extreme_[op][f] == v || pairs_.parallel[op][f] != kNoFace) return;
  extreme_[op][f] = v;
  note_face(op, f);
  spreading_.push_back(f);
}

/// Spreads vertices from faces that have changed over arcs that are not crossed.
void Overlay::spread_vertex(int op) {
  const Polytope& mine = poly(op);
  while (!spreading_.empty()) {
    const std::uint32_t f = spreading_.back();
    spreading_.pop_back();
    HalfEdge h = mine.first[f];
    do {
      if (arcs_.head[op][h / 2] == kNoCrossing) set_vertex(op, mine.face[twin(h)], extreme_[op][f]);
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
}

}  // namespace dymsum::spatial
