#include "cspace/obstacle/obstacle_sweep.h"

#include <algorithm>
#include <stdexcept>

#include "cspace/boundary/limit_boundary.h"
#include "cspace/obstacle/event_plan.h"
#include "cspace/obstacle/slice_reader.h"
#include "cspace/obstacle/tight_events.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {

using exact::AlgebraicRoot;

ObstacleSweep::ObstacleSweep(const TurningForms& forms, const RotationCatalog& catalog,
                             std::shared_ptr<const OperandPair> base, bool reference,
                             const std::function<void()>& again)
    : forms_(forms),
      catalog_(catalog),
      again_(again),
      reader_(forms, std::move(base)),
      reference_(reference),
      swept_(SegmentIndex(forms.size(0), forms.size(1))),
      now_(forms) {}

void ObstacleSweep::start(const RotationRange& range, RotationEvents& found, const OverlapFilter& filter) {
  begin_ = sample(range, nullptr, first_event(range, found.events));
  swept_.graph.apply(edit_to(reader_.loops(begin_)));
  always_ = found.always_concurrent;
  swept_.always_concurrent = !always_.empty();
  curves_ = begin_curves_ = tight_curves(scene(), always_, begin_, filter);
  if (!reader_.base().connected) join_faces(begin_);
}

void ObstacleSweep::pass(const RotationRange& range, RotationEvents found, const OverlapFilter& filter,
                         const std::optional<CrowdedEnd>& at_end) {
  base::CountedArray<RotationEvent>& events = found.events;
  always_ = std::move(found.always_concurrent);
  swept_.always_concurrent |= !always_.empty();
  pass_pending([&](double) { return sample(range, nullptr, first_event(range, events)); }, filter);
  // Runs of events whose intervals overlap. Where events were compared above, exact roots have made intervals narrower.
  std::stable_sort(events.begin(), events.end(),
                   [](const RotationEvent& a, const RotationEvent& b) { return a.low < b.low; });
  std::vector<Group> runs;
  double high = -INFINITY;
  for (RotationEvent& event : events) {
    if (event.low > high) runs.emplace_back();
    runs.back().push_back(&event);
    high = std::max(high, event.high);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    again_();
    pass_run(runs[r], r + 1 < runs.size() ? &runs[r + 1] : nullptr, range, filter);
  }
  if (!at_end) return;
  RotationEvent event;
  event.e = at_end->pair.e;
  event.f = at_end->pair.f;
  event.root = AlgebraicRoot::of(range.t_high);
  event.low = event.high = range.theta(range.t_high);
  pending_ = {std::move(event)};
  pending_range_ = range;
  crowded_ = at_end;
}

void ObstacleSweep::close(const OverlapFilter& filter) {
  turned_ = true;
  pass_pending([this](double) { return begin_; }, filter);
  if (!swept_.graph.close()) throw std::logic_error("ObstacleSweep: a full turn does not lead back to its start");
}

// Doubles decide where the angles are far enough apart.
Orientation ObstacleSweep::sample(const RotationRange& range, RotationEvent* from, RotationEvent* to,
                                  double within) const {
  const AlgebraicRoot low = from != nullptr ? exact_root(*from, forms_, range) : AlgebraicRoot::of(range.t_low);
  AlgebraicRoot high = to != nullptr ? exact_root(*to, forms_, range) : AlgebraicRoot::of(range.t_high);
  if (std::isfinite(within)) {
    // The angle changes by at most twice as much as its tangent.
    exact::RootBracket bracket = low.bracket();
    bracket.refine_to(96);
    const AlgebraicRoot most = AlgebraicRoot::rational(bracket.high().value() + exact::exact_value(within / 4));
    if (exact::compare(most, high) < 0) high = most;
  }
  return orientation_at(range.chart, exact::between(low, high));
}

int ObstacleSweep::compare(RotationEvent& a, RotationEvent& b, const RotationRange& range) const {
  return exact::compare(exact_root(a, forms_, range), exact_root(b, forms_, range));
}

// The intervals of events may overlap.
RotationEvent* ObstacleSweep::first_event(const RotationRange& range, base::CountedArray<RotationEvent>& events) const {
  RotationEvent* first = nullptr;
  for (RotationEvent& event : events) {
    if (first != nullptr && event.low > first->high) break;
    if (first == nullptr || compare(event, *first, range) < 0) first = &event;
  }
  return first;
}

bool ObstacleSweep::at_end_of(const RotationRange& range, RotationEvent& event) const {
  return event.high >= range.theta(range.t_high) - kAngleDouble &&
         exact::compare(exact_root(event, forms_, range), AlgebraicRoot::of(range.t_high)) == 0;
}

// Groups at one angle, in order; what follows one of them is the rest of the run or the next one.
void ObstacleSweep::pass_run(Group& run, Group* following, const RotationRange& range, const OverlapFilter& filter) {
  const auto before = [&](RotationEvent* a, RotationEvent* b) { return compare(*a, *b, range) < 0; };
  if (run.size() > 1) {
    if (run.back()->high < range.theta(range.t_high) - kAngleDouble && !matters(run, filter)) return;
    std::stable_sort(run.begin(), run.end(), before);
  }
  for (auto first = run.begin(); first != run.end();) {
    auto last = first + 1;
    while (last != run.end() && compare(**first, **last, range) == 0) ++last;
    const Group group(first, last);
    first = last;
    again_();
    // That waits for the next window.
    if (at_end_of(range, *group[0])) {
      for (RotationEvent* event : group) pending_.push_back(*event);
      pending_range_ = range;
      continue;
    }
    RotationEvent* next = last != run.end() ? *last : nullptr;
    const auto after = [&](double within) {
      if (next == nullptr && following != nullptr)
        next = *std::min_element(following->begin(), following->end(), before);
      return sample(range, group[0], next, within);
    };
    pass_group(group, range, after, filter);
  }
}

void ObstacleSweep::pass_pending(const After& after, const OverlapFilter& filter) {
  if (pending_.empty()) return;
  Group group;
  for (RotationEvent& event : pending_) group.push_back(&event);
  pass_group(group, pending_range_, after, filter);
  pending_.clear();
  crowded_.reset();
}

void ObstacleSweep::pass_group(const Group& group, const RotationRange& range, const After& after,
                               const OverlapFilter& filter) {
  swept_.graph.begin_angle();
  now_.begin(group[0]->theta(), crowded_ ? crowded_->turn : nullptr);
  sliced_ = false;
  near_nodes_.clear();
  first_node_ = static_cast<std::uint32_t>(swept_.graph.nodes().size());
  doubtful_.clear();
  change(group, range, after, filter);
  std::vector<AlwaysConcurrent> curves = turned_ ? begin_curves_ : std::vector<AlwaysConcurrent>{};
  if (!turned_ && !always_.empty()) curves = tight_curves(scene(), always_, after(INFINITY), filter);
  if (doubtful_.empty() && !other_curves(curves_, curves).empty()) doubtful_ = group;
  if (!doubtful_.empty()) examine(range, filter, curves);
  curves_ = std::move(curves);
  // Loops of one face keep to one component of free space: splits and joins hand it on, and a face that is born has one
  // loop unless more are born with it. Whole slices may leave a loop without a claim.
  if (!reader_.base().connected && swept_.graph.loops_born() > (sliced_ ? 0U : 1U)) join_faces(after(INFINITY));
}

void ObstacleSweep::change(const Group& group, const RotationRange& range, const After& after,
                           const OverlapFilter& filter) {
  if (reference_ || crowded_) return take_slice(group, range, after);
  // What one of several changes is not undone where another one takes a slice, as where opposite segments come to lie
  // along each other with events at both ends: so all are planned before the first one is applied.
  if (group.size() == 1) {
    EventPlan plan = plan_event(*group[0], range, scene(), filter);
    if (plan.verdict != EventPlan::Verdict::unsure) return settle(*group[0], std::move(plan), range, after);
  }
  Group alone;
  std::vector<Group> due;
  for (Group& cluster : clusters(group, scene())) {
    if (cluster.size() > 1 ? matters(cluster, filter)
                           : plan_event(*cluster[0], range, scene(), filter).verdict == EventPlan::Verdict::unsure)
      due.push_back(std::move(cluster));
    else if (cluster.size() == 1) alone.push_back(cluster[0]);
  }
  if (!due.empty() && !take_near_slices(std::move(due), alone, group, range, after))
    return take_slice(group, range, after);
  for (RotationEvent* event : alone) {
    EventPlan plan = plan_event(*event, range, scene(), filter);
    if (plan.verdict == EventPlan::Verdict::unsure) return take_slice(group, range, after);
    settle(*event, std::move(plan), range, after);
  }
}

// Slices after the angle that are cut to boxes around the parts that are due. All are made before the first one is
// applied. False where a whole one has to be taken.
bool ObstacleSweep::take_near_slices(std::vector<Group> due, Group& alone, const Group& group,
                                     const RotationRange& range, const After& after) {
  const double unit = reader_.base().lattice->unit;
  // Positions are turned into a frame, by a heading within 8 roundings, and back: as many roundings once more.
  if (!near_slices_ || !pending_.empty() || 2 * position_error() > kCutNear * forms_.span() * unit) return false;
  now_.set_exact({range.chart, exact_root(*group[0], forms_, range)}, group[0]->theta());
  std::optional<NearChanges> changes = boxes_of(std::move(due), alone, scene(), now_.signs());
  if (!changes) return false;
  const BoxFrame& frame = changes->frame;
  double turn = kNearTurn;
  for (const NearChange& change : changes->all) turn = std::min(turn, change.turn);
  const Orientation at = after(turn);
  const Heading h = Heading::of(at.radians());
  const Point o = position(h, {}), o_in_frame = frame.of(o);
  const auto in_sum = [&](Point p) { return Point{p.x * unit + o_in_frame.x, p.y * unit + o_in_frame.y}; };
  const auto in_forms = [&](Point in_frame) {
    const Point p = frame.back(in_frame);
    return Point{(p.x - o.x) / unit, (p.y - o.y) / unit};
  };
  for (NearChange& change : changes->all) {
    std::optional<std::vector<BoundaryChain>> chains =
        near_slices_->in({in_sum(change.box.low), in_sum(change.box.high)}, frame.turn, at);
    if (!chains) return false;
    change.chains = std::move(*chains);
    for (BoundaryChain& chain : change.chains) {
      chain.from = in_forms(chain.from);
      chain.to = in_forms(chain.to);
    }
    if (!edit_near(scene(), now_, h, frame, change)) return false;
  }
  for (const NearChange& change : changes->all) {
    const std::optional<SliceEdit> edit = edit_near(scene(), now_, h, frame, change);
    if (!edit) return false;
    doubtful_.insert(doubtful_.end(), change.events.begin(), change.events.end());
    sliced_ = true;
    near_nodes_.insert(near_nodes_.end(), edit->ended.begin(), edit->ended.end());
    for (const SliceEdit::Loop& loop : edit->loops)
      for (const SliceEdit::Position& position : loop.positions)
        if (position.stays != kNobody) near_nodes_.push_back(position.stays);
    if (edit->empty()) continue;
    list_angle(range, *group[0]);
    note_first(change.events);
    ++swept_.work.local_updates;
    swept_.graph.apply(*edit);
  }
  return true;
}

// Whether a segment of these events is visible, or a position of theirs is not provably covered: else nothing can
// change, in whatever order they come.
bool ObstacleSweep::matters(const Group& run, const OverlapFilter& filter) const {
  if (reference_) return true;
  for (const RotationEvent* event : run) {
    for (const std::uint32_t s : segments_of(*event, scene()))
      if (swept_.graph.first_on(s) != kNobody) return true;
    const bool point =
        event->kind == RotationEvent::Kind::vertex_on_segment || event->kind == RotationEvent::Kind::three_segments;
    if (point && !provably_covered(*event, forms_, filter)) return true;
  }
  return false;
}

// Applies what a single event changes, unless that is unsure.
void ObstacleSweep::settle(RotationEvent& event, EventPlan plan, const RotationRange& range, const After& after) {
  if (plan.verdict == EventPlan::Verdict::doubtful) doubtful_.push_back(&event);
  if (plan.verdict != EventPlan::Verdict::change) return;
  swept_.work.collision_tests += plan.edit.births.size();
  std::erase_if(plan.edit.births,
                [&](const std::vector<WalkSegment>& loop) { return !reader_.is_free(loop, after(INFINITY)); });
  if (plan.edit.empty()) return;
  list_angle(range, event);
  note(Heading::of(event.theta()), plan.kind, plan.at);
  ++swept_.work.local_updates;
  swept_.graph.apply(plan.edit);
}

// Takes the slice at a rational angle between this event and the next one.
void ObstacleSweep::take_slice(const Group& group, const RotationRange& range, const After& after) {
  ++swept_.work.slices;
  list_angle(range, *group[0]);
  note_first(group);
  swept_.graph.apply(edit_to(reader_.loops(after(INFINITY))));
  near_nodes_.clear();
  doubtful_ = group;
  sliced_ = true;
}

// What goes on along the same line at the event's angle belongs together, unless a passage is shut there.
SliceEdit ObstacleSweep::edit_to(const std::vector<SliceLoop>& loops) const {
  const BoundaryGraph& graph = swept_.graph;
  std::vector<SubEdge> before;
  for (const std::uint32_t n : graph.alive()) before.push_back(graph.sub_edge(n));
  const SharedLines lines(forms_, now_, std::move(before));
  SliceEdit edit =
      slice_difference(graph, loops, [&](std::uint32_t n) { return lines.shut(std::array{graph.sub_edge(n)}); });
  match_along_lines(graph, lines, edit);
  return edit;
}

void ObstacleSweep::join_faces(const Orientation& at) {
  const SliceReader::Faces faces = reader_.faces(at, swept_.graph);
  for (const auto& [a, b] : faces.same) swept_.graph.join_components(a, b);
  for (const std::uint32_t cell : faces.unbounded) swept_.graph.set_unbounded(cell);
}

// What happens at the angle only: what is tight, and where the boundary touches itself. Where neither is found and no
// sub-edge began or ended, nothing happens, and the angle is not listed.
void ObstacleSweep::examine(const RotationRange& range, const OverlapFilter& filter,
                            const std::vector<AlwaysConcurrent>& curves_after) {
  BoundaryGraph& graph = swept_.graph;
  const bool listed = graph.angle() != kNobody;
  list_angle(range, *doubtful_[0]);
  const ExactAngle& angle = swept_.angles.back();
  const auto rational = exact::rational_value(angle.t);
  const TightCurves curves{curves_, curves_after};
  // A crowded quarter turn has no events.
  const TightFindings found =
      listed && rational ? tight_in_slice(orientation_at(angle.chart, *rational), curves, scene(), now_, reader_)
                         : tight_at_events(doubtful_, curves, scene(), now_, filter);
  const std::size_t tight_before = swept_.tight.size();
  for (const auto& [from, to] : found.held) swept_.tight.push_back(tight_feature(from, to));
  std::optional<Point> touch;
  const Heading h = now_.signs().heading();
  for (const Point at : found.events) note(h, ObstacleEvent::Kind::tight, at);
  if (sliced_ || found.looked) touch = look_at_limits();
  if (!found.events.empty() || graph.changed() || (listed && reference_)) return;
  if (listed) swept_.events.pop_back();
  if (touch) return note(h, ObstacleEvent::Kind::vertex_on_segment, *touch);
  unlist_angle(tight_before);
}

std::optional<Point> ObstacleSweep::look_at_limits() {
  const LimitsOfAngle limits = limits_of_angle(now_.signs(), swept_.graph, nodes_near());
  swept_.limit_halves.insert(swept_.limit_halves.end(), limits.halves.begin(), limits.halves.end());
  for (const auto& [n, m] : limits.together) swept_.graph.join_shells(n, m);
  swept_.limit_angles.push_back(swept_.graph.angle());
  return limits.touch;
}

// What is in the boxes of slices near events, and beside it all that single events change; none where a whole slice was
// taken.
std::vector<std::uint32_t> ObstacleSweep::nodes_near() const {
  if (near_nodes_.empty()) return {};
  const BoundaryGraph& graph = swept_.graph;
  std::vector<std::uint32_t> all = near_nodes_;
  all.insert(all.end(), graph.ended().begin(), graph.ended().end());
  for (auto n = first_node_; n < graph.nodes().size(); ++n) all.push_back(n);
  for (std::size_t k = all.size(); k-- > 0;)
    for (const std::uint32_t n : {graph[all[k]].prev, graph[all[k]].next}) all.push_back(n);
  for (const auto& [n, next] : graph.relinked()) {
    all.push_back(n);
    all.push_back(next);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::erase(all, kNobody);
  return all;
}

void ObstacleSweep::list_angle(const RotationRange& range, RotationEvent& event) {
  if (swept_.graph.angle() != kNobody) return;
  swept_.angles.push_back({range.chart, exact_root(event, forms_, range)});
  now_.set_exact(swept_.angles.back(), event.theta());
  swept_.graph.set_angle(static_cast<std::uint32_t>(swept_.angles.size() - 1));
}

void ObstacleSweep::unlist_angle(std::size_t tight_before) {
  swept_.tight.resize(tight_before);
  if (!swept_.limit_angles.empty() && swept_.limit_angles.back() == swept_.graph.angle())
    swept_.limit_angles.pop_back();
  swept_.angles.pop_back();
  swept_.graph.set_angle(kNobody);
}

void ObstacleSweep::note(Heading h, ObstacleEvent::Kind kind, Point at) {
  swept_.events.push_back({kind, swept_.graph.angle(), position(h, at)});
}

void ObstacleSweep::note_first(const Group& group) {
  const RotationEvent& event = *group[0];
  const Heading h = Heading::of(event.theta());
  note(h,
       event.kind == RotationEvent::Kind::alignment        ? ObstacleEvent::Kind::alignment
       : event.kind == RotationEvent::Kind::three_segments ? ObstacleEvent::Kind::three_segments
                                                           : ObstacleEvent::Kind::vertex_on_segment,
       position_of(event, forms_, h).at);
}

// What turns places into positions rounds each of four terms, of which one is turned by a heading (16).
TightFeature ObstacleSweep::tight_feature(const TightCandidate& from, const TightCandidate& to) const {
  const Lattice& l = *reader_.base().lattice;
  const Heading h = now_.signs().heading();
  TightFeature feature{swept_.graph.angle(), position(h, from.near), position(h, to.near), 0};
  const double fraction =
      from.position.first.crossing || to.position.first.crossing ? SignsAt::kCrossingNear : SignsAt::kCornerNear;
  feature.error = fraction * forms_.span() * l.unit + position_error();
  return feature;
}

double ObstacleSweep::position_error() const {
  const Lattice& l = *reader_.base().lattice;
  const double offsets = std::hypot(l.points[0]->offset.x, l.points[0]->offset.y) +
                         std::hypot(l.points[1]->offset.x, l.points[1]->offset.y);
  constexpr double kPosition = exact::rounding_bound(16 + 2 * 4, 64);
  return kPosition * (forms_.span() * l.unit + offsets);
}

// The position of a point in the forms' doubles, which leave out the turned centre and the offsets.
Point ObstacleSweep::position(Heading h, Point at) const {
  const Point c = forms_.centre();
  const Lattice& l = *reader_.base().lattice;
  const Point turned{l.points[1]->offset.x + c.x * l.unit, l.points[1]->offset.y + c.y * l.unit};
  return {at.x * l.unit + l.points[0]->offset.x + h.c * turned.x - h.s * turned.y,
          at.y * l.unit + l.points[0]->offset.y + h.s * turned.x + h.c * turned.y};
}

}  // namespace dymsum::planar
