#include "cspace/obstacle/event_plan.h"

#include <algorithm>
#include <optional>

#include "cspace/events/exact_position.h"

namespace dymsum::planar {
namespace {

/// Visible sub-edges along the common line, with those that shrink to a point between them, and where they start and
/// end on it.
struct Interval {
  std::vector<std::uint32_t> nodes;
  double from = 0, to = 0, error = 0;
};

class OverlapEdit {
 public:
  /// `side`: of b's start from a, after the event.
  OverlapEdit(const RotationEvent& event, const SweepScene& scene, const EventSigns& signs, int side)
      : forms_(scene.forms),
        graph_(scene.graph),
        signs_(signs),
        heading_(Heading::of(event.theta())),
        a_(event.a),
        b_(event.b),
        outer_(side < 0 ? event.b : event.a),
        inner_(side < 0 ? event.a : event.b),
        direction_(forms_.direction(a_, heading_)),
        length_(std::hypot(direction_.x, direction_.y)),
        turn_(turn_of(event)),
        unsure_(8 * position_error(turn_) * forms_.span()),
        start_(TurningForms::start(outer_)),
        end_(forms_.end(outer_)),
        low_(along(start_)),
        high_(along(end_)),
        before_(signs.joint(start_)),
        after_(signs.joint(end_)) {}

  Point at() const { return forms_.position(start_, heading_); }

  /// Nothing where more coincides.
  std::optional<BoundaryEdit> edit() const {
    if (before_.unsure || after_.unsure) return std::nullopt;
    BoundaryEdit edit;
    for (const Interval& s : joined(intervals())) {
      std::vector<WalkSegment> segments = segments_after(s);
      if (segments.empty()) return std::nullopt;
      if (is_same(s, segments)) continue;
      edit.runs.push_back({s.nodes.front(), s.nodes.back(), std::move(segments)});
      edit.gone.insert(edit.gone.end(), s.nodes.begin(), s.nodes.end());
    }
    return edit;
  }

 private:
  // The position along the common line, from a's start.
  double along(Pair v) const {
    const Point p = forms_.position(v, heading_), origin = forms_.position(TurningForms::start(a_), heading_);
    return (direction_.x * (p.x - origin.x) + direction_.y * (p.y - origin.y)) / length_;
  }

  std::vector<Interval> intervals() const {
    std::vector<Interval> found;
    for (const WalkSegment* s : {&a_, &b_}) {
      const Point e = forms_.direction(*s, heading_);
      const double base = along(TurningForms::start(*s)), own = std::hypot(e.x, e.y);
      for (std::uint32_t n = graph_.first_on(*s); n != kNobody; n = graph_[n].next_on_segment) {
        const Located first = position_on(forms_, *s, graph_[graph_[n].prev].segment, true, heading_, turn_),
                      last = position_on(forms_, *s, graph_[graph_[n].next].segment, false, heading_, turn_);
        found.push_back({{n}, base + own * first.t, base + own * last.t, own * (first.error + last.error)});
      }
    }
    return found;
  }

  // Put together where only a vanishing piece of a chain is between them.
  std::vector<Interval> joined(std::vector<Interval> found) const {
    for (bool joins = true; joins;) {
      joins = false;
      for (std::size_t k = 0; k < found.size() && !joins; ++k)
        for (std::size_t l = 0; l < found.size() && !joins; ++l) {
          if (k == l || !follows(found[k], found[l])) continue;
          found[k].nodes.push_back(graph_[found[k].nodes.back()].next);
          found[k].nodes.insert(found[k].nodes.end(), found[l].nodes.begin(), found[l].nodes.end());
          found[k].to = found[l].to;
          found[k].error += found[l].error;
          found.erase(found.begin() + static_cast<std::ptrdiff_t>(l));
          joins = true;
        }
    }
    return found;
  }

  bool follows(const Interval& s, const Interval& t) const {
    const std::uint32_t last = s.nodes.back(), first = t.nodes.front();
    return graph_[graph_[last].next].next == first && graph_[last].id != graph_[first].id;
  }

  // After the event the boundary runs along the outer segment where that reaches and along the inner one elsewhere.
  // From the inner to the outer one leads the segment before the outer one in its chain, back leads the one after it.
  // None where an interval ends otherwise at an end of the outer one.
  std::vector<WalkSegment> segments_after(const Interval& s) const {
    const bool from_start = forms_.end(graph_[graph_[s.nodes.front()].prev].segment) == start_;
    const bool to_end = TurningForms::start(graph_[graph_[s.nodes.back()].next].segment) == end_;
    // Its ends: 1 after an end of the outer segment, -1 before it.
    const int from_low = from_start ? 1 : beside(s, false, start_, low_), from_high = beside(s, false, end_, high_),
              to_low = beside(s, true, start_, low_), to_high = to_end ? -1 : beside(s, true, end_, high_);
    if (from_low == 0 || from_high == 0 || to_low == 0 || to_high == 0) return {};
    std::vector<WalkSegment> segments;
    if (from_low < 0) {
      segments.push_back(inner_);
      if (to_low > 0) {
        if (!before_.has_in) return {};
        segments.push_back(before_.in);
      }
    }
    if ((from_start || from_high < 0) && (to_end || to_low > 0)) segments.push_back(outer_);
    if (to_high > 0) {
      if (from_start || from_high < 0) {
        if (!after_.has_out) return {};
        segments.push_back(after_.out);
      }
      segments.push_back(inner_);
    }
    return segments;
  }

  int beside(const Interval& s, bool at_end, Pair v, double v_along) const {
    const double d = (at_end ? s.to : s.from) - v_along;
    if (std::abs(d) > unsure_ + s.error) return d > 0 ? 1 : -1;
    const SignsAt& signs = signs_.exact();
    const std::optional<Fraction> end =
        end_along(signs, a_, graph_.sub_edge(at_end ? s.nodes.back() : s.nodes.front()), at_end);
    return end ? signs.compare(*end, signs.along(a_, ExactPosition{{false, v, {}, {}}, {}})) : 0;
  }

  bool is_same(const Interval& s, const std::vector<WalkSegment>& segments) const {
    return std::equal(
        segments.begin(), segments.end(), s.nodes.begin(), s.nodes.end(),
        [&](const WalkSegment& segment, std::uint32_t n) { return graph_.segments().of(segment) == graph_[n].id; });
  }

  const TurningForms& forms_;
  const BoundaryGraph& graph_;
  const EventSigns& signs_;
  Heading heading_;
  const WalkSegment &a_, &b_, &outer_, &inner_;
  Point direction_;  // of a
  double length_;
  double turn_;        // what the event's angle errs by
  double unsure_;      // places along the line that are nearer are not distinguished: each errs by up to half of it
  Pair start_, end_;   // of the outer segment
  double low_, high_;  // these along the line
  RotationCatalog::Joint before_, after_;
};

}  // namespace

EventPlan plan_overlap(RotationEvent& event, const RotationRange& range, const SweepScene& scene) {
  if (scene.graph.first_on(event.a) == kNobody && scene.graph.first_on(event.b) == kNobody) return {};
  const EventSigns signs(event, scene.forms, scene.catalog, range);
  const EventPlan unsure{EventPlan::Verdict::unsure, {}, {}, {}};
  const auto exists = [&](const WalkSegment& s) { return signs.exists(s) == RotationCatalog::Existence::yes; };
  if (!event.root->changes_sign() || !exists(event.a) || !exists(event.b)) return unsure;
  const Pair start = TurningForms::start(event.b);
  const double slope = scene.forms.side(event.a, start).slope(Heading::of(event.theta()));
  const int side = std::abs(slope) > kSlopes * scene.forms.side_error(event.a)
                       ? (slope > 0 ? 1 : -1)
                       : signs.after(scene.forms.exact_side(event.a, start, range.chart));
  const OverlapEdit overlap(event, scene, signs, side);
  std::optional<BoundaryEdit> edit = overlap.edit();
  if (!edit) return unsure;
  if (edit->empty()) return {};
  return {EventPlan::Verdict::change, ObstacleEvent::Kind::vertex_on_segment, overlap.at(), std::move(*edit)};
}

namespace {

using Node = BoundaryGraph::Node;

/// The error of the difference of a position along two edges in line and a length is this times both lengths: each
/// length (1 for the coordinates, 2 for the root), a fraction of one, the sum with the other.
constexpr double kInLine = exact::rounding_bound(3 + 1 + 1 + 3, 16);

/// Visible sub-edges that follow each other along the common line of two aligned edges, and where they start and end
/// on it.
struct AlignedRun {
  std::uint32_t first = kNobody, last = kNobody;
  double from = 0, to = 0, error = 0;
};

class AlignmentEdit {
 public:
  AlignmentEdit(RotationEvent& event, const RotationRange& range, const SweepScene& scene)
      : forms_(scene.forms),
        catalog_(scene.catalog),
        graph_(scene.graph),
        signs_(event, scene.forms, scene.catalog, range),
        heading_(Heading::of(event.theta())),
        turn_(turn_of(event)),
        length_e_(length(1, event.e)),
        length_f_(length(0, event.f)) {
    const std::uint32_t e = event.e, f = event.f, e1 = forms_.operand(1).next[e], f1 = forms_.operand(0).next[f];
    before_ = {WalkSegment{1, e, f}, WalkSegment{0, f, e1}};
    after_ = {WalkSegment{0, f, e}, WalkSegment{1, e, f1}};
    midpoint_ = {f1, e};
  }

  /// Nothing where more coincides.
  std::optional<BoundaryEdit> edit() const {
    std::vector<AlignedRun> runs;
    add_runs(runs);
    join_over_vertex(runs);
    BoundaryEdit edit;
    for (const AlignedRun& run : runs) {
      std::vector<WalkSegment> segments = segments_after(run);
      if (segments.empty()) return std::nullopt;
      edit.runs.push_back({run.first, run.last, std::move(segments)});
      edit.gone.push_back(run.first);
      if (run.last != run.first) edit.gone.push_back(run.last);
    }
    return edit;
  }

 private:
  double length(std::uint32_t op, std::uint32_t edge) const {
    const Point d = forms_.edge(op, edge);
    return std::hypot(d.x, d.y);
  }

  void add_runs(std::vector<AlignedRun>& runs) const {
    for (const bool second : {false, true})
      for (std::uint32_t n = graph_.first_on(before_[second]); n != kNobody; n = graph_[n].next_on_segment) {
        const Node& node = graph_[n];
        const double length = second ? length_f_ : length_e_, base = second ? length_e_ : 0;
        const Located from = position_on(forms_, node.segment, graph_[node.prev].segment, true, heading_, turn_),
                      to = position_on(forms_, node.segment, graph_[node.next].segment, false, heading_, turn_);
        runs.push_back({n, n, base + length * from.t, base + length * to.t, length * (from.error + to.error)});
      }
  }

  // A run over the vertex between the two is one.
  void join_over_vertex(std::vector<AlignedRun>& runs) const {
    for (std::size_t k = 0; k < runs.size(); ++k)
      for (std::size_t l = 0; l < runs.size(); ++l) {
        if (k == l || graph_[runs[k].last].next != runs[l].first || graph_[runs[k].last].id == graph_[runs[l].first].id)
          continue;
        runs[k].last = runs[l].last;
        runs[k].to = runs[l].to;
        runs[k].error += runs[l].error;
        runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(l));
        return;
      }
  }

  // What was visible along the line stays so; the segments change, at the new middle vertex. A chain may end or start
  // there: where that vertex is reflex, the boundary turns at it. None where a run ends at that vertex otherwise.
  std::vector<WalkSegment> segments_after(const AlignedRun& run) const {
    const bool from_midpoint = forms_.end(graph_[graph_[run.first].prev].segment) == midpoint_;
    const bool to_midpoint = TurningForms::start(graph_[graph_[run.last].next].segment) == midpoint_;
    const int from = from_midpoint ? 1 : beside_midpoint(run, false),
              to = to_midpoint ? -1 : beside_midpoint(run, true);
    if (from == 0 || to == 0) return {};
    std::vector<WalkSegment> segments;
    if (from < 0) segments.push_back(after_[0]);
    if (to > 0) segments.push_back(after_[1]);
    for (const WalkSegment& s : segments)
      if (!catalog_.may_exist(s)) return {};
    return segments;
  }

  // Whether an end of a run comes after the new middle vertex (1), before it (-1), or is there.
  int beside_midpoint(const AlignedRun& run, bool at_end) const {
    const double d = (at_end ? run.to : run.from) - length_f_;
    if (std::abs(d) > kInLine * (length_e_ + length_f_) + run.error) return d > 0 ? 1 : -1;
    const SignsAt& signs = signs_.exact();
    const std::optional<Fraction> end =
        end_along(signs, before_[0], graph_.sub_edge(at_end ? run.last : run.first), at_end);
    return end ? signs.compare(*end, signs.along(before_[0], ExactPosition{{false, midpoint_, {}, {}}, {}})) : 0;
  }

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const BoundaryGraph& graph_;
  EventSigns signs_;
  Heading heading_;
  double turn_;  // what its angle errs by
  double length_e_, length_f_;
  std::array<WalkSegment, 2> before_, after_;  // along the line, in order
  Pair midpoint_;                              // between the two after the event
};

}  // namespace

EventPlan plan_alignment(RotationEvent& event, const RotationRange& range, const SweepScene& scene) {
  const WalkSegment first{1, event.e, event.f}, second{0, event.f, scene.forms.operand(1).next[event.e]};
  if (scene.graph.first_on(first) == kNobody && scene.graph.first_on(second) == kNobody) return {};
  exact_root(event, scene.forms, range);
  std::optional<BoundaryEdit> edit = AlignmentEdit(event, range, scene).edit();
  if (!edit) return {EventPlan::Verdict::unsure, {}, {}, {}};
  const Point at = position_of(event, scene.forms, Heading::of(event.theta())).at;
  return {EventPlan::Verdict::change, ObstacleEvent::Kind::alignment, at, std::move(*edit)};
}

namespace {

/// Angles of events err by less, or their positions are not computed.
constexpr double kAngle = 0x1p-30;
/// Positions of lines at a smaller sine are not used. They err by less than kCrossing / sine, times the span.
constexpr double kPlacedLeast = 0x1p-10, kCrossing = 0x1p-40;
static_assert(kTurnedSide + kTurnedCross + kTurnedPosition <= kCrossing && kCrossing / kPlacedLeast <= kAngle);

/// A disc that provably holds the position of an event, or the interval along which it changes the boundary; infinite
/// for alignments and where doubles do not decide.
struct EventDisc {
  Point at;
  double radius = INFINITY;
  bool apart_from(const EventDisc& o) const { return std::hypot(at.x - o.at.x, at.y - o.at.y) > radius + o.radius; }
};

EventDisc around_common_interval(const RotationEvent& event, const TurningForms& forms, Heading h) {
  const Point d = forms.direction(event.a, h), e = forms.direction(event.b, h);
  const Point s = forms.position(TurningForms::start(event.a), h), t = forms.position(TurningForms::start(event.b), h);
  const double length = std::hypot(d.x, d.y), from = (d.x * (t.x - s.x) + d.y * (t.y - s.y)) / length;
  const double first = std::max(0.0, from), last = std::min(length, from + std::hypot(e.x, e.y)),
               midpoint = (first + last) / (2 * length);
  return {{s.x + midpoint * d.x, s.y + midpoint * d.y}, std::max(0.0, last - first) / 2 + 4 * kAngle * forms.span()};
}

// The position start + (side / cross) d of a crossing moves by at most span (1 + 4 / sin) for every radian, the sine
// being that of the angle between the segments, and errs by less than 2^-40 span / sin.
EventDisc disc_of(const RotationEvent& event, const TurningForms& forms, Heading h) {
  EventDisc disc;
  if (event.high - event.low > kAngle) return disc;
  if (event.kind == RotationEvent::Kind::vertex_on_segment)
    return {forms.position(event.v, h), 2 * kAngle * forms.span()};
  if (event.kind == RotationEvent::Kind::overlap) return around_common_interval(event, forms, h);
  if (event.kind != RotationEvent::Kind::three_segments) return disc;
  const EventPosition position = position_of(event, forms, h);
  if (position.sine > kPlacedLeast) disc = {position.at, 8 * kAngle * forms.span() / position.sine};
  return disc;
}

bool may_exist_near(const RotationCatalog& catalog, const WalkSegment& s, const RotationEvent& event) {
  if (!catalog.may_exist(s)) return false;
  const RotationCatalog::Span span = catalog.span(s, event.theta());
  const double slack = kAngleSlack + (event.high - event.low);
  return span.from <= slack && span.to >= -slack;
}

}  // namespace

std::vector<std::uint32_t> segments_of(const RotationEvent& event, const SweepScene& scene) {
  const TurningForms& forms = scene.forms;
  std::vector<std::uint32_t> found;
  const auto add = [&](const WalkSegment& s) { found.push_back(scene.graph.segments().of(s)); };
  const auto add_at = [&](Pair v) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t own = side == 0 ? v.p : v.q, other = side == 0 ? v.q : v.p;
      for (const WalkSegment& s : {WalkSegment{side, own, other}, {side, forms.operand(side).prev[own], other}})
        if (may_exist_near(scene.catalog, s, event)) add(s);
    }
  };
  switch (event.kind) {
    case RotationEvent::Kind::three_segments:
      for (const WalkSegment& s : {event.a, event.b, event.c}) add(s);
      break;
    case RotationEvent::Kind::vertex_on_segment:
      add(event.a);
      add_at(event.v);
      break;
    case RotationEvent::Kind::overlap:
      for (const WalkSegment& s : {event.a, event.b}) {
        add(s);
        add_at(TurningForms::start(s));
        add_at(forms.end(s));
      }
      break;
    case RotationEvent::Kind::alignment: {
      const std::uint32_t e1 = forms.operand(1).next[event.e], f1 = forms.operand(0).next[event.f];
      for (const WalkSegment& s : {WalkSegment{1, event.e, event.f}, WalkSegment{0, event.f, e1},
                                   WalkSegment{0, event.f, event.e}, WalkSegment{1, event.e, f1}})
        add(s);
      break;
    }
  }
  return found;
}

std::vector<EventGroup> clusters(const EventGroup& group, const SweepScene& scene) {
  if (group.size() == 1) return {group};
  std::vector<EventDisc> discs;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  // id, event
  for (std::uint32_t k = 0; k < group.size(); ++k) {
    discs.push_back(disc_of(*group[k], scene.forms, Heading::of(group[k]->theta())));
    for (const std::uint32_t s : segments_of(*group[k], scene)) segments.emplace_back(s, k);
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  Partition together(group.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size() && segments[j].first == segments[i].first; ++j)
      if (!discs[segments[i].second].apart_from(discs[segments[j].second]))
        together.join(segments[i].second, segments[j].second);
  std::vector<EventGroup> parts(group.size());
  for (std::uint32_t k = 0; k < group.size(); ++k) parts[together.find(k)].push_back(group[k]);
  std::erase_if(parts, [](const EventGroup& part) { return part.empty(); });
  return parts;
}

}  // namespace dymsum::planar
