#include "cspace/obstacle/obstacle_sweep.h"

#include <algorithm>
#include <stdexcept>

#include "cspace/obstacle/tight_curves.h"
#include "planar/turning/slice.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {

using exact::AlgebraicRoot;
using exact::BigRational;

ObstacleSweep::ObstacleSweep(const TurningForms& forms, const TurnCatalog& catalog,
                             std::shared_ptr<const OperandPair> base, bool reference)
    : forms_(forms), catalog_(catalog), base_(std::move(base)), reference_(reference), connected_(base_->connected) {
  first_.assign(std::size_t{2} * forms.size(0) * forms.size(1), kNobody);
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    walk_vertex_[op].assign(o.numbered_vertex.size(), kNobody);
    walk_edge_[op].assign(o.numbered_edge.size(), kNobody);
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      walk_vertex_[op][o.vertex_number[i]] = i;
      walk_edge_[op][o.edge_number[i]] = i;
    }
  }
}

std::uint32_t ObstacleSweep::angle(const TurnRange& range, TurnEvent& event) {
  if (now_ != kNobody) return now_;
  angles.push_back({range.chart, exact_root(event, forms_, range)});
  theta_now_ = event.theta();
  return static_cast<std::uint32_t>(angles.size() - 1);
}

// Of a point in the forms' doubles.
Point ObstacleSweep::position(Heading h, Point at) const {
  const Point c = forms_.centre();
  const Lattice& l = *base_->lattice;
  // The forms' doubles leave out the turned centre and the offsets.
  const Point turned{l.points[1]->offset.x + c.x * l.unit, l.points[1]->offset.y + c.y * l.unit};
  return {at.x * l.unit + l.points[0]->offset.x + h.c * turned.x - h.s * turned.y,
          at.y * l.unit + l.points[0]->offset.y + h.s * turned.x + h.c * turned.y};
}

void ObstacleSweep::note(Heading h, ObstacleEvent::Kind kind, Point at) {
  events.push_back({kind, now_, position(h, at)});
}

// Between two angles of one chart; in doubles where these are far enough apart.
Orientation ObstacleSweep::Behind::sample(const TurningForms& forms) const {
  const AlgebraicRoot low = from != nullptr ? exact_root(*from, forms, *range) : AlgebraicRoot::of(range->t_low);
  const AlgebraicRoot high = to != nullptr ? exact_root(*to, forms, *range) : AlgebraicRoot::of(range->t_high);
  return orientation_at(range->chart, exact::between(low, high));
}

TurnEvent* ObstacleSweep::first_event(const TurnRange& range, std::vector<TurnEvent>& events,
                                      const TurningForms& forms) {
  // The intervals of events may overlap.
  TurnEvent* first = nullptr;
  for (TurnEvent& event : events) {
    if (first != nullptr && event.low > first->high) break;
    if (first == nullptr || exact::compare(exact_root(event, forms, range), exact_root(*first, forms, range)) < 0)
      first = &event;
  }
  return first;
}

void ObstacleSweep::start(const TurnRange& range, TurnEvents& found, const OverlapFilter& filter) {
  begin_ = Behind{&range, nullptr, first_event(range, found.events, forms_)}.sample(forms_);
  take_slice(placed_at(*base_, begin_));
  always_ = found.always_concurrent;
  always_concurrent = !always_.empty();
  curves_ = begin_curves_ = tight_curves(begin_, filter);
  if (!connected_) join_faces(begin_);
  begin_keys_.resize(nodes_.size());
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    begin_nodes_.push_back(n);
    begin_keys_[n] = {nodes_[n].left, nodes_[n].right};
  }
}

void ObstacleSweep::slice(const TurnRange& range, const Group& group, const std::function<Orientation()>& behind) {
  TurnEvent& event = *group[0];
  ++work.slices;
  now_ = angle(range, event);
  const Heading h = Heading::of(event.theta());
  note(h,
       event.kind == TurnEvent::Kind::alignment        ? ObstacleEvent::Kind::alignment
       : event.kind == TurnEvent::Kind::three_segments ? ObstacleEvent::Kind::three_segments
                                                       : ObstacleEvent::Kind::vertex_on_segment,
       place_of(event, forms_, h).at);
  take_slice(placed_at(*base_, behind()));
  doubtful_ = group;
  sliced_ = true;
}

// Nodes with the same segment and neighbours stay; the others end and begin here.
void ObstacleSweep::take_slice(SumState state) {
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<SumState> computed = compute_boundary(std::move(state), options);
  if (!computed) throw std::logic_error("ObstacleSweep: a slice failed");
  const RawBoundary& raw = computed->boundary;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> old;
  std::vector<std::uint32_t> before;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].alive) {
      old[{nodes_[n].id, nodes_[n].left, nodes_[n].right}] = n;
      before.push_back(n);
    }
  std::vector<std::vector<std::array<std::uint32_t, 3>>> keys;
  for (const SumRing& ring : raw.rings) {
    const std::vector<WalkSegment> segments = segments_of(ring);
    const std::size_t n = segments.size();
    auto& ring_keys = keys.emplace_back();
    for (std::size_t k = 0; k < n; ++k)
      ring_keys.push_back({id(segments[k]), id(segments[(k + n - 1) % n]), id(segments[(k + 1) % n])});
  }
  const Lines lines_before = lines_of(before);
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<std::uint32_t> all;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;  // walls of a shut passage, before and behind
  for (const auto& ring_keys : keys) {
    std::vector<std::uint32_t>& loop = loops.emplace_back();
    for (const auto& key : ring_keys) {
      const auto it = old.find(key);
      if (it != old.end() && !shut_now({it->second}, lines_before)) {
        loop.push_back(it->second);
        old.erase(it);
        continue;
      }
      const std::uint32_t m = add_node(segment_of(key[0]), kNobody);
      if (it != old.end()) touching.emplace_back(it->second, m);
      nodes_[m].left = key[1];
      nodes_[m].right = key[2];
      loop.push_back(m);
    }
    all.insert(all.end(), loop.begin(), loop.end());
  }
  std::vector<std::uint32_t> lost, ended, fresh;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> claims;
  for (const auto& [key, n] : old) {
    lost.push_back(nodes_[n].cell);
    ended.push_back(n);
  }
  for (const std::uint32_t m : all)
    if (nodes_[m].begin == now_) fresh.push_back(m);
  // What goes on along the same line at the event's angle belongs together, unless a passage is shut there.
  for (const auto& [n, m] : continued_stretches(ended, fresh)) {
    if (shut_now({n, m}, lines_before)) {
      touching.emplace_back(n, m);
      continue;
    }
    join(shell_, n, m);
    claims.emplace_back(m, nodes_[n].cell);
  }
  for (const auto& [key, n] : old) end_node(n);
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t k = 0; k < loops[l].size(); ++k) link(loops[l][k], loops[l][k + 1 == loops[l].size() ? 0 : k + 1]);
  if (cells_.empty()) {
    for (std::size_t l = 0; l < loops.size(); ++l) {
      const std::uint32_t cell = new_cell(connected_ && raw.outer[l] != 0);
      for (const std::uint32_t n : loops[l]) nodes_[n].cell = nodes_[n].born_cell = cell;
    }
    return;
  }
  std::sort(lost.begin(), lost.end());
  lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
  relabel(all, lost, claims);
  for (const auto& [n, m] : touching) touching_cells_.emplace_back(nodes_[n].cell, nodes_[m].cell);
}

WalkSegment ObstacleSweep::segment_of(std::uint32_t id) const {
  const std::uint32_t n0 = forms_.size(0), n1 = forms_.size(1);
  return id < n0 * n1 ? WalkSegment{0, id / n1, id % n1} : WalkSegment{1, (id - n0 * n1) / n0, (id - n0 * n1) % n0};
}

const SignsAt& ObstacleSweep::signs_now() const {
  if (!signs_) signs_.emplace(forms_, angles[now_]);
  return *signs_;
}

std::vector<std::uint32_t> ObstacleSweep::segments_of(const TurnEvent& event, bool& unsure) const {
  if (event.kind == TurnEvent::Kind::three_segments) return {id(event.a), id(event.b), id(event.c)};
  if (event.kind == TurnEvent::Kind::vertex_on_segment) {
    std::vector<std::uint32_t> all{id(event.a)};
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t own = side == 0 ? event.v.p : event.v.q, other = side == 0 ? event.v.q : event.v.p;
      all.push_back(id({side, own, other}));
      all.push_back(id({side, forms_.operand(side).prev[own], other}));
    }
    unsure |= catalog_.joint(event.v, event.theta()).unsure;
    return all;
  }
  if (event.kind == TurnEvent::Kind::overlap) {
    std::vector<std::uint32_t> all{id(event.a), id(event.b)};
    for (const WalkSegment* s : {&event.a, &event.b})
      for (const Pair v : {TurningForms::start(*s), forms_.end(*s)}) {
        const TurnCatalog::Joint joint = catalog_.joint(v, event.theta());
        unsure |= joint.unsure;
        const bool starts = v == TurningForms::start(*s);
        if (starts && joint.has_in) all.push_back(id(joint.in));
        if (!starts && joint.has_out) all.push_back(id(joint.out));
      }
    return all;
  }
  const std::uint32_t e1 = forms_.operand(1).next[event.e], f1 = forms_.operand(0).next[event.f];
  return {id({1, event.e, event.f}), id({0, event.f, e1}), id({0, event.f, event.e}), id({1, event.e, f1})};
}

void ObstacleSweep::pass_group(const Group& group, const TurnRange& range, const std::function<Orientation()>& behind,
                               OverlapFilter& filter) {
  now_ = kNobody;
  signs_.reset();
  theta_now_ = group[0]->theta();
  born_ = 0;
  changed_ = sliced_ = false;
  ended_.clear();
  relinked_.clear();
  doubtful_.clear();
  const std::uint64_t slices = work.slices;
  change(group, range, behind, filter);
  std::vector<AlwaysConcurrent> curves = turned_ ? begin_curves_ : std::vector<AlwaysConcurrent>{};
  if (!turned_ && !always_.empty()) curves = tight_curves(behind(), filter);
  if (doubtful_.empty() && !other_curves(curves_, curves).empty()) doubtful_ = group;
  if (!doubtful_.empty()) examine(range, filter, curves);
  curves_ = std::move(curves);
  // Loops of one face keep to one component of free space: splits and joins hand it on, and a face that is born has one
  // loop unless more are born with it. Whole slices may leave a loop without a claim.
  if (!connected_ && (born_ > 1 || (born_ > 0 && work.slices > slices))) join_faces(behind());
}

void ObstacleSweep::change(const Group& group, const TurnRange& range, const std::function<Orientation()>& behind,
                           OverlapFilter& filter) {
  if (reference_ || crowded_ != nullptr) return slice(range, group, behind);
  Group alone;
  for (const Group& cluster : clusters(group)) {
    if (cluster.size() == 1) alone.push_back(cluster[0]);
    else if (matters(cluster, filter)) return slice(range, group, behind);
  }
  // What one of several changes is not undone where another one takes a whole slice, as where opposite segments come to
  // lie along each other with events at both ends: so all are tried first.
  trying_ = alone.size() > 1;
  bool settled = true;
  for (TurnEvent* event : alone) settled = settled && (!trying_ || local_update(*event, range, behind, filter));
  trying_ = false;
  for (TurnEvent* event : alone) settled = settled && local_update(*event, range, behind, filter);
  if (!settled) slice(range, group, behind);
}

void ObstacleSweep::pass_pending(const std::function<Orientation()>& behind, OverlapFilter& filter) {
  if (pending_.empty()) return;
  Group group;
  for (TurnEvent& event : pending_) group.push_back(&event);
  pass_group(group, pending_range_, behind, filter);
  pending_.clear();
  crowded_ = nullptr;
}

void ObstacleSweep::pass(const TurnRange& range, TurnEvents found, OverlapFilter& filter,
                         const CrowdedQuarter* at_end) {
  std::vector<TurnEvent>& events = found.events;
  always_ = std::move(found.always_concurrent);
  always_concurrent |= !always_.empty();
  if (!pending_.empty())
    pass_pending([&] { return Behind{&range, nullptr, first_event(range, events, forms_)}.sample(forms_); }, filter);
  const double theta_end = range.theta(range.t_high) - 0x1p-40;
  const auto compare = [&](TurnEvent* a, TurnEvent* b) {
    return exact::compare(exact_root(*a, forms_, range), exact_root(*b, forms_, range));
  };
  const auto sort = [&](Group& run) {
    std::stable_sort(run.begin(), run.end(), [&](TurnEvent* a, TurnEvent* b) { return compare(a, b) < 0; });
  };
  // Runs of events whose intervals overlap.
  std::vector<Group> runs;
  double high = -INFINITY;
  for (TurnEvent& event : events) {
    if (event.low > high) runs.emplace_back();
    runs.back().push_back(&event);
    high = std::max(high, event.high);
  }
  // A group at one angle; what follows it is the rest of its run or the next one.
  const auto pass_run = [&](const Group& group, TurnEvent* next, Group* following) {
    if (group[0]->high >= theta_end &&
        exact::compare(exact_root(*group[0], forms_, range), AlgebraicRoot::of(range.t_high)) == 0) {
      for (TurnEvent* event : group) pending_.push_back(*event);
      pending_range_ = range;
      return;
    }
    const auto behind = [&] {
      if (next == nullptr && following != nullptr)
        next = *std::min_element(following->begin(), following->end(),
                                 [&](TurnEvent* a, TurnEvent* b) { return compare(a, b) < 0; });
      return Behind{&range, group[0], next}.sample(forms_);
    };
    pass_group(group, range, behind, filter);
  };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Group& run = runs[r];
    Group* following = r + 1 < runs.size() ? &runs[r + 1] : nullptr;
    if (run.size() > 1) {
      if (run.back()->high < theta_end && !matters(run, filter)) continue;
      sort(run);
    }
    for (std::size_t k = 0; k < run.size();) {
      std::size_t l = k + 1;
      while (l < run.size() && compare(run[k], run[l]) == 0) ++l;
      pass_run(Group(run.begin() + static_cast<std::ptrdiff_t>(k), run.begin() + static_cast<std::ptrdiff_t>(l)),
               l < run.size() ? run[l] : nullptr, following);
      k = l;
    }
  }
  if (at_end == nullptr) return;
  TurnEvent event;
  event.e = at_end->pair.e;
  event.f = at_end->pair.f;
  event.root = AlgebraicRoot::of(range.t_high);
  event.low = event.high = range.theta(range.t_high);
  pending_ = {std::move(event)};
  pending_range_ = range;
  crowded_ = at_end;
}

// Whether a segment of these events is visible, or a place of theirs is not certainly covered: else nothing can change,
// in whatever order they come.
bool ObstacleSweep::matters(const Group& run, const OverlapFilter& filter) const {
  bool unsure = reference_;
  for (const TurnEvent* event : run) {
    for (const std::uint32_t s : segments_of(*event, unsure))
      if (first_[s] != kNobody) return true;
    const bool point =
        event->kind == TurnEvent::Kind::vertex_on_segment || event->kind == TurnEvent::Kind::three_segments;
    if (reference_ || (point && !certainly_covered(*event, forms_, filter))) return true;
  }
  return false;
}

void ObstacleSweep::close(OverlapFilter& filter) {
  turned_ = true;
  pass_pending([this] { return begin_; }, filter);
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> last;
  std::size_t alive = 0;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].alive) {
      last[{nodes_[n].id, nodes_[n].left, nodes_[n].right}] = n;
      ++alive;
    }
  closed_ = alive == begin_nodes_.size() && last.size() == alive;
  continued_.resize(nodes_.size());
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) continued_[n] = n;
  for (const std::uint32_t n : begin_nodes_) {
    const auto it = last.find({nodes_[n].id, begin_keys_[n][0], begin_keys_[n][1]});
    if (it == last.end()) {
      closed_ = false;
      continue;
    }
    join(shell_, n, it->second);
    continued_[it->second] = n;
  }
}

}  // namespace dymsum::planar
