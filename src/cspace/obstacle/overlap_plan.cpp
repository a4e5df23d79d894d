#include <algorithm>
#include <optional>

#include "cspace/events/event_signs.h"
#include "cspace/obstacle/event_plan.h"

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

}  // namespace dymsum::planar
