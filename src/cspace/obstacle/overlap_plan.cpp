#include <algorithm>
#include <optional>

#include "cspace/obstacle/event_plan.h"

namespace dymsum::planar {
namespace {

/// Visible sub-edges along the common line, with those that shrink to a point between them, and where they start and
/// end on it.
struct Stretch {
  std::vector<std::uint32_t> nodes;
  double from = 0, to = 0, error = 0;
};

class OverlapEdit {
 public:
  /// `slope`: of the side of b's start from a.
  OverlapEdit(const TurnEvent& event, const SweepScene& scene, double slope)
      : forms_(scene.forms),
        graph_(scene.graph),
        heading_(Heading::of(event.theta())),
        a_(event.a),
        b_(event.b),
        outer_(slope < 0 ? event.b : event.a),
        inner_(slope < 0 ? event.a : event.b),
        direction_(forms_.direction(a_, heading_)),
        length_(std::hypot(direction_.x, direction_.y)),
        turn_(turn_of(event)),
        unsure_(8 * place_error(turn_) * forms_.span()),
        start_(TurningForms::start(outer_)),
        end_(forms_.end(outer_)),
        low_(along(start_)),
        high_(along(end_)),
        before_(scene.catalog.joint(start_, event.theta())),
        behind_(scene.catalog.joint(end_, event.theta())) {}

  Point at() const { return forms_.place(start_, heading_); }

  /// Nothing where doubles do not tell.
  std::optional<BoundaryEdit> edit() const {
    if (before_.unsure || behind_.unsure) return std::nullopt;
    BoundaryEdit edit;
    for (const Stretch& s : joined(stretches())) {
      std::vector<WalkSegment> segments = segments_behind(s);
      if (segments.empty()) return std::nullopt;
      if (is_same(s, segments)) continue;
      edit.runs.push_back({s.nodes.front(), s.nodes.back(), std::move(segments)});
      edit.gone.insert(edit.gone.end(), s.nodes.begin(), s.nodes.end());
    }
    return edit;
  }

 private:
  // Along the common line, from a's start.
  double along(Pair v) const {
    const Point p = forms_.place(v, heading_), origin = forms_.place(TurningForms::start(a_), heading_);
    return (direction_.x * (p.x - origin.x) + direction_.y * (p.y - origin.y)) / length_;
  }

  std::vector<Stretch> stretches() const {
    std::vector<Stretch> found;
    for (const WalkSegment* s : {&a_, &b_}) {
      const Point e = forms_.direction(*s, heading_);
      const double base = along(TurningForms::start(*s)), own = std::hypot(e.x, e.y);
      for (std::uint32_t n = graph_.first_on(*s); n != kNobody; n = graph_[n].next_on_segment) {
        const Located first = place_on(forms_, *s, graph_[graph_[n].prev].segment, true, heading_, turn_),
                      last = place_on(forms_, *s, graph_[graph_[n].next].segment, false, heading_, turn_);
        found.push_back({{n}, base + own * first.t, base + own * last.t, own * (first.error + last.error)});
      }
    }
    return found;
  }

  // Put together where only a vanishing piece of a chain is between them.
  std::vector<Stretch> joined(std::vector<Stretch> found) const {
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

  bool follows(const Stretch& s, const Stretch& t) const {
    const std::uint32_t last = s.nodes.back(), first = t.nodes.front();
    return graph_[graph_[last].next].next == first && graph_[last].id != graph_[first].id;
  }

  // Behind the event the boundary runs along the outer segment where that reaches and along the inner one elsewhere.
  // From the inner to the outer one leads the segment before the outer one in its chain, back leads the one behind it.
  // None where doubles do not tell.
  std::vector<WalkSegment> segments_behind(const Stretch& s) const {
    const bool from_start = forms_.end(graph_[graph_[s.nodes.front()].prev].segment) == start_;
    const bool to_end = TurningForms::start(graph_[graph_[s.nodes.back()].next].segment) == end_;
    const double near = unsure_ + s.error;
    for (const double v : {low_, high_})
      if ((!(from_start && v == low_) && !(std::abs(s.from - v) > near)) ||
          (!(to_end && v == high_) && !(std::abs(s.to - v) > near)))
        return {};
    std::vector<WalkSegment> segments;
    if (!from_start && s.from < low_) {
      segments.push_back(inner_);
      if (s.to > low_) {
        if (!before_.has_in) return {};
        segments.push_back(before_.in);
      }
    }
    if ((from_start || s.from < high_) && (to_end || s.to > low_)) segments.push_back(outer_);
    if (!to_end && s.to > high_) {
      if (from_start || s.from < high_) {
        if (!behind_.has_out) return {};
        segments.push_back(behind_.out);
      }
      segments.push_back(inner_);
    }
    return segments;
  }

  bool is_same(const Stretch& s, const std::vector<WalkSegment>& segments) const {
    return std::equal(
        segments.begin(), segments.end(), s.nodes.begin(), s.nodes.end(),
        [&](const WalkSegment& segment, std::uint32_t n) { return graph_.segments().of(segment) == graph_[n].id; });
  }

  const TurningForms& forms_;
  const BoundaryGraph& graph_;
  Heading heading_;
  const WalkSegment &a_, &b_, &outer_, &inner_;
  Point direction_;  // of a
  double length_;
  double turn_;        // what the event's angle errs by
  double unsure_;      // places along the line that are nearer are not told apart: each errs by up to half of it
  Pair start_, end_;   // of the outer segment
  double low_, high_;  // these along the line
  TurnCatalog::Joint before_, behind_;
};

}  // namespace

EventPlan plan_overlap(const TurnEvent& event, const SweepScene& scene) {
  if (scene.graph.first_on(event.a) == kNobody && scene.graph.first_on(event.b) == kNobody) return {};
  const double theta = event.theta();
  const EventPlan unsure{EventPlan::Verdict::unsure, {}, {}, {}};
  const auto exists = [&](const WalkSegment& s) {
    return scene.catalog.exists(s, theta) == TurnCatalog::Existence::yes;
  };
  if (turn_of(event) > kPlannedTurn || !event.root->changes_sign() || !exists(event.a) || !exists(event.b))
    return unsure;
  const double slope = scene.forms.side(event.a, TurningForms::start(event.b)).slope(Heading::of(theta));
  if (std::abs(slope) <= kSlopes * scene.forms.side_error(event.a)) return unsure;
  const OverlapEdit overlap(event, scene, slope);
  std::optional<BoundaryEdit> edit = overlap.edit();
  if (!edit) return unsure;
  if (edit->empty()) return {};
  return {EventPlan::Verdict::change, ObstacleEvent::Kind::vertex_on_segment, overlap.at(), std::move(*edit)};
}

}  // namespace dymsum::planar
