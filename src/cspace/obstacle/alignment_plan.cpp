#include <algorithm>
#include <optional>

#include "cspace/events/event_signs.h"
#include "cspace/obstacle/event_plan.h"

namespace dymsum::planar {
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

}  // namespace dymsum::planar
