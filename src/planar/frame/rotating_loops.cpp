#include "planar/frame/rotating_loops.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

constexpr std::size_t kMostPairs = 1 << 16;  // trees of exact boxes are better beyond

}  // namespace

RotatingOverlap::Box RotatingOverlap::box_of(const std::vector<Point>& points) {
  Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const Point& p : points)
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  return box;
}

// Those that come into a box.
template <class VectorOf>
void RotatingOverlap::collect(const Operand& o, const std::vector<Point>& points, const VectorOf& vector_of,
                              const Box& box, std::vector<Edge>& edges) const {
  const double off = kOverlapPosition * forms_.span();
  edges.clear();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point a = points[i], b = points[o.next[i]], d = vector_of(i);
    const auto [x0, x1] = std::minmax(a.x, b.x);
    const auto [y0, y1] = std::minmax(a.y, b.y);
    const Edge e{a.x, a.y, b.x, b.y, d.x, d.y, x0 - off, y0 - off, x1 + off, y1 + off, i};
    if (e.x0 <= box.x1 && e.x1 >= box.x0 && e.y0 <= box.y1 && e.y1 >= box.y0) edges.push_back(e);
  }
}

void RotatingOverlap::collect_edges(const RotatingFrame& frame, Point z) {
  const Operand &fixed = forms_.operand(0), &turning = forms_.operand(1);
  turning_.resize(turning.size());
  for (std::uint32_t v = 0; v < turning_.size(); ++v) turning_[v] = {z.x - frame.turned(v).x, z.y - frame.turned(v).y};
  const auto reflected = [&](std::uint32_t e) {
    const Point d = frame.direction({1, e, 0});
    return Point{-d.x, -d.y};
  };
  collect(
      fixed, forms_.points(0), [&](std::uint32_t e) { return forms_.edge(0, e); }, box_of(turning_), of_fixed_);
  collect(turning, turning_, reflected, box_of(forms_.points(0)), of_turning_);
}

// The sides of a line on which the ends of an edge are: on one side of it provably (1), provably on both sides (-1), or
// undecided.
int RotatingOverlap::sides(const Edge& line, const Edge& e) const {
  const double bound = (std::abs(line.dx) + std::abs(line.dy)) * kOverlapSide * forms_.span();
  const double u = line.dx * (e.ay - line.ay) - line.dy * (e.ax - line.ax),
               v = line.dx * (e.by - line.ay) - line.dy * (e.bx - line.ax);
  if (!(std::abs(u) > bound) || !(std::abs(v) > bound)) return 0;
  return (u > 0) == (v > 0) ? 1 : -1;
}

RotatingOverlap::Result RotatingOverlap::right_of(const RotatingFrame& frame, const RotatingFrame::Step& s) {
  const std::optional<Point> z = frame.midpoint_of(s);
  if (!z) return {};
  collect_edges(frame, *z);
  if (of_fixed_.size() * of_turning_.size() > kMostPairs) return {};
  const WalkSegment& on = frame.window().segments[s.segment];
  const auto touches = [&](std::uint32_t e, std::uint32_t f) {
    if (on.side == 0) return e == on.edge && (f == on.vertex || f == forms_.operand(1).prev[on.vertex]);
    return f == on.edge && (e == on.vertex || e == forms_.operand(0).prev[on.vertex]);
  };
  Result result{Answer::free, 0, 0};
  near_.resize(of_turning_.size() + 1);
  for (const Edge& e : of_fixed_) {
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < of_turning_.size(); ++k) {
      const Edge& f = of_turning_[k];
      near_[n] = k;
      n += (e.x0 <= f.x1) & (e.x1 >= f.x0) & (e.y0 <= f.y1) & (e.y1 >= f.y0);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Edge& f = of_turning_[near_[k]];
      const int u = sides(e, f), v = sides(f, e);
      if (u > 0 || v > 0 || touches(e.index, f.index)) continue;
      if (u < 0 && v < 0) return {Answer::overlap, e.index, f.index};
      result.answer = Answer::unknown;
    }
  }
  return result;
}

namespace {

constexpr std::uint32_t kEnd = RotatingFrame::kEnd;
constexpr std::uint32_t kGone = 0xfffffffe;  // a segment that a new window does not have

constexpr std::uint32_t kMostLooks = 128;  // pairs of pieces

}  // namespace

/// Signs of trigonometric polynomials over a range of angles.
class RotatingLoops::AngleInterval {
 public:
  AngleInterval(const RotatingFrame& frame, double from, double to)
      : window_(frame.window()),
        forms_(window_.forms()),
        low_(std::min(from, to)),
        high_(std::max(from, to)),
        half_(0.5 * (high_ - low_) + kAngleDouble),
        heading_(Heading::of(window_.midpoint + 0.5 * (low_ + high_))) {}

  /// It exists all the time, or never.
  bool exists(std::uint32_t s) const { return span(s).from < low_ - kAngleSlack && span(s).to > high_ + kAngleSlack; }
  bool absent(std::uint32_t s) const { return span(s).from > high_ + kAngleSlack || span(s).to < low_ - kAngleSlack; }

  /// The sign of a side all the time, 0 where it may change.
  int side(std::uint32_t s, Pair v) const { return sign(forms_.side(walk(s), v), forms_.side_error(walk(s))); }
  /// Both ends of b lie on one side of a.
  bool beside(std::uint32_t a, std::uint32_t b) const {
    const int u = side(a, window_.segments[b].start());
    return u != 0 && side(a, window_.segments[b].end) == u;
  }
  bool across(std::uint32_t a, std::uint32_t b) const {
    const int u = side(a, window_.segments[b].start());
    return u != 0 && side(a, window_.segments[b].end) == -u;
  }
  /// They cross all the time.
  bool cross(std::uint32_t a, std::uint32_t b) const { return exists(a) && exists(b) && across(a, b) && across(b, a); }
  /// The sign of (place of b on the line of a) - (place of c on it), 0 where it may change.
  int order(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const int ab = turn(a, b), ac = turn(a, c);
    if (ab == 0 || ac == 0) return 0;
    const TrigForm2 form = forms_.concurrency(walk(a), walk(b), walk(c));
    if (!form.far_from_zero(heading_, half_, forms_.concurrency_error(walk(a), walk(b), walk(c)))) return 0;
    return (form.at(heading_) > 0 ? 1 : -1) * ab * ac;
  }

 private:
  const WalkSegment& walk(std::uint32_t s) const { return window_.segments[s]; }
  const RotationCatalog::Span& span(std::uint32_t s) const { return window_.segments[s].span; }
  int sign(const TrigForm& form, double error) const {
    return !form.far_from_zero(heading_, half_, error) ? 0 : form.at(heading_) > 0 ? 1 : -1;
  }
  int turn(std::uint32_t a, std::uint32_t b) const {
    return sign(forms_.cross(walk(a), walk(b)), kTurnedCross * forms_.length1(walk(a)) * forms_.length1(walk(b)));
  }

  const RotatingWindow& window_;
  const TurningForms& forms_;
  double low_, high_, half_;
  Heading heading_;
};

void RotatingLoops::renumber(const RotatingWindow& from, const RotatingWindow& to) {
  const auto index = [&](std::uint32_t s) {
    if (s == kEnd || s == kGone) return s;
    const std::uint32_t n = to.find(from.segments[s]);
    return n == kNone ? kGone : n;
  };
  for (Known& k : steps_) k = {index(k.segment), index(k.from), index(k.to), k.loop, kNone};
  last_delta_ += from.midpoint - to.midpoint;
  last_delta_ = std::remainder(last_delta_, kTurn);
}

void RotatingLoops::update(const RotatingFrame& frame, ExactFrame& exact, RingIdentities& identities, FrameWork& work,
                           FrameChanges& changes) {
  std::swap(old_, loops_);
  std::swap(old_steps_, steps_);
  loops_.clear();
  steps_.clear();
  head_.assign(frame.window().segments.size(), kNone);
  for (std::uint32_t k = 0; k < old_steps_.size(); ++k) {
    Known& s = old_steps_[k];
    if (s.segment == kGone) continue;
    s.next = head_[s.segment];
    head_[s.segment] = k;
  }
  decided_.clear();
  const bool comparable = known_ && std::abs(last_delta_) < frame.window().half;
  for (const RotatingFrame::Cycle& c : frame.cycles()) {
    Loop loop;
    loop.first = c.first;
    loop.last = c.last;
    loop.turning = c.turning;
    for (std::uint32_t k = c.first; k < c.last; ++k) loop.corners += !frame.steps()[k].straight;
    loops_.push_back(loop);
  }
  work.loops_traced += loops_.size();
  // The only counter-clockwise loop of a connected sum bounds it, whatever was before.
  const bool one_outer =
      connected_ && std::count_if(loops_.begin(), loops_.end(), [](const Loop& l) { return l.turning > 0; }) == 1;
  for (Loop& loop : loops_) {
    const bool outer = one_outer && loop.turning > 0;
    work.loops_kept += outer && comparable;
    decided_.push_back(comparable && !outer && inherit(frame, loop, work));
  }
  const auto for_each_end = [&](std::size_t i, auto&& f) {
    for (std::uint32_t k = loops_[i].first; k < loops_[i].last; ++k) {
      const RotatingFrame::Located v = frame.end_of(frame.steps()[k]);
      f(v.at.x, v.error);
    }
  };
  decide_loops(
      loops_, connected_, [&](std::size_t i) { return decided_[i] != 0; }, for_each_end,
      [&](Loop& loop) { return covered(frame, loop, exact, work); });
  for (std::uint32_t i = 0; i < loops_.size(); ++i)
    for (std::uint32_t k = loops_[i].first; k < loops_[i].last; ++k) {
      const RotatingFrame::Step& s = frame.steps()[k];
      steps_.push_back({s.segment, s.from, s.to, i, kNone});
    }
  if (known_) follow(frame, identities, changes);
  known_ = true;
  last_delta_ = frame.delta();
}

const RotatingLoops::Known* RotatingLoops::match(const RotatingFrame::Step& s) const {
  for (std::uint32_t k = head_[s.segment]; k != kNone; k = old_steps_[k].next)
    if (old_steps_[k].from == s.from && old_steps_[k].to == s.to) return &old_steps_[k];
  return nullptr;
}

// A cycle has the status of any cycle of the frame before with which it shares an undisturbed sub-edge (scaling-sum.md,
// "Frames": the proof needs continuous motion only); and its witness anyway, which is queried first. Where much has
// been looked at in vain, a collision test in doubles is cheaper.
bool RotatingLoops::inherit(const RotatingFrame& frame, Loop& loop, FrameWork& work) {
  const RotatingWindow& window = frame.window();
  const AngleInterval all(frame, last_delta_, frame.delta());
  std::uint32_t looked = 0;
  bool queried = false;
  for (std::uint32_t k = loop.first; k < loop.last && looked < kMostLooks; ++k) {
    const RotatingFrame::Step& s = frame.steps()[k];
    const Known* old = match(s);
    if (old == nullptr) continue;
    const Loop& before = old_[old->loop];
    if (!before.kept && !queried) {
      queried = true;
      loop.witness = before.witness;
      if (witnessed(frame, loop)) {
        ++work.witnessed;
        return true;
      }
    }
    if (connected_)
      looked += 1 + window.first_of[window.segments[s.segment].last_piece] -
                window.first_of[window.segments[s.segment].first_piece];
    if (!undisturbed(all, window, s)) continue;
    loop.kept = before.kept;
    ++work.loops_kept;
    return true;
  }
  return false;
}

// The pair of edges that covered the loop before is tried, then those that covered others recently.
bool RotatingLoops::witnessed(const RotatingFrame& frame, Loop& loop) {
  const RotatingFrame::Located z = frame.end_of(frame.steps()[loop.first]);
  if (loop.witness && covers(*loop.witness, frame, z)) return true;
  const std::optional<CrossingEdges> found =
      recent_.find([&](const CrossingEdges& edges) { return covers(edges, frame, z); });
  if (found) loop.witness = found;
  return found.has_value();
}

// Whether a sub-edge has existed with nothing between its ends at every angle since the last frame.
bool RotatingLoops::undisturbed(const AngleInterval& all, const RotatingWindow& window, const RotatingFrame::Step& s) {
  const std::uint32_t a = s.segment;
  if (!all.exists(a)) return false;
  for (const std::uint32_t end : {s.from, s.to})
    if (end != kEnd && !all.cross(a, end)) return false;
  if (s.from != kEnd && s.to != kEnd && all.order(a, s.from, s.to) >= 0) return false;
  const auto stays_away = [&](std::uint32_t b) {
    if (all.absent(b) || all.beside(a, b) || all.beside(b, a)) return true;
    return (s.from != kEnd && all.order(a, b, s.from) < 0) || (s.to != kEnd && all.order(a, b, s.to) > 0);
  };
  for (std::uint32_t p = window.segments[a].first_piece; p < window.segments[a].last_piece; ++p)
    for (std::uint32_t k = window.first_of[p]; k < window.first_of[p + 1]; ++k) {
      const RotationCandidate& m = window.candidates[window.of[k]];
      const std::uint32_t b = window.pieces[m.a == p ? m.b : m.a].segment;
      if (b != s.from && b != s.to && !stays_away(b)) return false;
    }
  return true;
}

Segment RotatingLoops::source_segment(std::uint32_t segment, const RotatingWindow& window) const {
  const WalkSegment& w = window.segments[segment];
  const Operand &o = forms_.operand(w.side), &other = forms_.operand(1 - w.side);
  Edge edge = o.edge(w.edge);
  if (swapped_) edge.op = 1 - edge.op;
  return {edge, other.source[w.vertex]};
}

// Doubles may know no lengths of sub-edges between nearly parallel lines.
const RotatingFrame::Step& RotatingLoops::longest_of(const RotatingFrame& frame, const Loop& loop) const {
  const RotatingFrame::Step* longest = &frame.steps()[loop.first];
  double best = -1;
  for (std::uint32_t k = loop.first; k < loop.last; ++k) {
    const RotatingFrame::Step& s = frame.steps()[k];
    const double l =
        (frame.to_fraction(s) - frame.from_fraction(s)) * forms_.length1(frame.window().segments[s.segment]);
    if (l > best) {
      best = l;
      longest = &s;
    }
  }
  return *longest;
}

bool RotatingLoops::covered(const RotatingFrame& frame, Loop& loop, ExactFrame& exact, FrameWork& work) {
  if (witnessed(frame, loop)) {
    ++work.witnessed;
    return true;
  }
  work.witnesses_lost += loop.witness.has_value();
  ++work.collision_tests;
  const RotatingFrame::Step& beside = longest_of(frame, loop);
  if (connected_) {
    const RotatingOverlap::Result decided = overlap_.right_of(frame, beside);
    if (decided.answer == RotatingOverlap::Answer::free) loop.witness.reset();
    if (decided.answer == RotatingOverlap::Answer::overlap) {
      loop.witness = {decided.fixed_edge, decided.turning_edge};
      if (swapped_) std::swap((*loop.witness)[0], (*loop.witness)[1]);
      recent_.remember(*loop.witness);
    }
    if (decided.answer != RotatingOverlap::Answer::unknown) return decided.answer == RotatingOverlap::Answer::overlap;
  }
  const auto by = [&](std::uint32_t s) {
    return s == kEnd ? std::nullopt : std::optional<Segment>(source_segment(s, frame.window()));
  };
  const bool inside =
      exact.inside_right_of(source_segment(beside.segment, frame.window()), by(beside.from), by(beside.to));
  loop.witness = exact.collision().crossing_edges();
  if (loop.witness) recent_.remember(*loop.witness);
  return inside;
}

// Doubles only: the edges of P and Q cross properly at a point of a loop, and so they do at a point just right of it.
bool RotatingLoops::covers(const CrossingEdges& edges, const RotatingFrame& frame,
                           const RotatingFrame::Located& z) const {
  const CrossingEdges edge = swapped_ ? std::array{edges[1], edges[0]} : edges;
  const Heading h = frame.heading();
  const auto crossed = [&](std::uint32_t side) {
    const Operand& other = forms_.operand(1 - side);
    const std::uint32_t e = edge[side], f = edge[1 - side];
    const WalkSegment s{side, e, f};
    const Point d = forms_.direction(s, h);
    // A turned edge vector is up to sqrt(2) times as long, by the sum of its coordinates, as it was.
    const double bound = (std::abs(d.x) + std::abs(d.y)) * z.error + forms_.side_error(s);
    const auto value = [&](std::uint32_t v) {
      const Point at = frame.position(side == 0 ? Pair{e, v} : Pair{v, e});
      return d.x * (z.at.y - at.y) - d.y * (z.at.x - at.x);
    };
    const double u = value(f), v = value(other.next[f]);
    return (u > bound && v < -bound) || (u < -bound && v > bound);
  };
  return crossed(0) && crossed(1);
}

// Identities: a ring takes that of the first ring with which it shares a vertex.
void RotatingLoops::follow(const RotatingFrame& frame, RingIdentities& identities, FrameChanges& changes) {
  claims_.begin_frame(old_.size());
  const auto vertex = [&](const RotatingFrame::Step& s, std::uint32_t next) -> const Known* {
    for (std::uint32_t k = head_[s.segment]; k != kNone; k = old_steps_[k].next) {
      const Known& old = old_steps_[k];
      const Loop& loop = old_[old.loop];
      if (old.to != s.to || !loop.kept) continue;
      const Known& after = old_steps_[k + 1 == loop.last ? loop.first : k + 1];
      if (after.segment == next) return &old;
    }
    return nullptr;
  };
  std::vector<LoopStatus*> kept;
  for (Loop& loop : loops_) {
    if (!loop.kept) continue;
    kept.push_back(&loop);
    claims_.begin(loop);
    for (std::uint32_t k = loop.first; k < loop.last; ++k) {
      if (frame.steps()[k].straight) continue;
      const Known* old = vertex(frame.steps()[k], frame.steps()[k + 1 == loop.last ? loop.first : k + 1].segment);
      if (old != nullptr) claims_.fractions(old->loop, old_[old->loop], 1);
    }
  }
  identities.follow(kept, false, changes);
  for (std::size_t i = 0; i < old_.size(); ++i)
    if (old_[i].kept && !claims_.claimed(i))
      changes.rings.push_back({RingChange::Kind::disappeared, old_[i].ring, 0, old_[i].corners});
}

}  // namespace dymsum::planar
