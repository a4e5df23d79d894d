#include "cspace/obstacle/meeting_plan.h"

#include <algorithm>
#include <cmath>

#include "cspace/events/exact_position.h"
#include "cspace/events/rotation_events.h"
#include "cspace/obstacle/event_plan.h"

namespace dymsum::planar {

bool LocalArrangement::any() const {
  for (int k = 0; k < size; ++k)
    if (members[k].in != kNobody || members[k].out != kNobody) return true;
  return !vanish.empty();
}

// The kill rule, lemma 4: where b passes from right to left of a, what comes before on a is inside; where it passes
// from left to right, what follows.
bool LocalArrangement::ends_visible(Piece p) const {
  const Member& m = members[p.member];
  if (p.index == m.count) return !m.closes;
  const Vertex& v = m.vertices[p.index];
  return v.chain ? v.other >= 0 : cross[p.member][v.other] < 0;
}

bool LocalArrangement::starts_visible(Piece p) const {
  const Member& m = members[p.member];
  if (p.index == 0) return !m.opens;
  const Vertex& v = m.vertices[p.index - 1];
  return v.chain ? v.other >= 0 : cross[p.member][v.other] > 0;
}

bool LocalArrangement::visible(Piece p) const { return starts_visible(p) && ends_visible(p); }

LocalArrangement::Piece LocalArrangement::successor(Piece p) const {
  const Vertex& v = members[p.member].vertices[p.index];
  const Member& to = members[v.other];
  for (int k = 0; k < to.count; ++k)
    if (to.vertices[k].other == p.member && to.vertices[k].chain == v.chain) return {v.other, k + 1};
  return {};
}

LocalArrangement::Routes LocalArrangement::routes() const {
  Seen seen{};
  Routes found;
  found.paths = paths(seen);
  if (found.paths) found.cycles = cycles(seen);
  return found;
}

std::optional<std::vector<LocalArrangement::Path>> LocalArrangement::paths(Seen& seen) const {
  std::vector<Path> found;
  std::size_t outs = 0;
  for (int s = 0; s < size; ++s) {
    outs += members[s].out != kNobody;
    if (members[s].in == kNobody) continue;
    Path path;
    path.in = members[s].in;
    Piece at{s, 0};
    for (;;) {
      if (seen[at.member][at.index] || !visible(at)) return std::nullopt;
      seen[at.member][at.index] = true;
      path.members.push_back(at.member);
      if (at.index == members[at.member].count) break;
      at = successor(at);
      if (at.member < 0) return std::nullopt;
    }
    path.out = members[at.member].out;
    if (path.out == kNobody) return std::nullopt;
    found.push_back(std::move(path));
  }
  if (outs != found.size()) return std::nullopt;
  return found;
}

// The cycles of visible pieces that no path takes.
std::vector<std::vector<int>> LocalArrangement::cycles(Seen& seen) const {
  std::vector<std::vector<int>> found;
  for (int s = 0; s < size; ++s)
    for (int piece = 1; piece < members[s].count; ++piece) {
      std::vector<int> cycle;
      Piece at{s, piece};
      while (at.member >= 0 && at.index > 0 && at.index < members[at.member].count && !seen[at.member][at.index] &&
             visible(at)) {
        seen[at.member][at.index] = true;
        cycle.push_back(at.member);
        at = successor(at);
      }
      if (at.member == s && at.index == piece && cycle.size() > 1) found.push_back(std::move(cycle));
    }
  return found;
}

namespace {

int sign_of(double v, double error) { return v > error ? 1 : v < -error ? -1 : 0; }

enum class Fill : std::uint8_t {
  nothing,  ///< the segments do not meet there
  unsure,   ///< more coincides
  done,
};

/// The arrangement after an event, from doubles at the event and, where these do not decide, from exact signs.
class Meeting {
 public:
  Meeting(RotationEvent& event, const RotationRange& range, const SweepScene& scene)
      : event_(event),
        forms_(scene.forms),
        graph_(scene.graph),
        signs_(event, scene.forms, scene.catalog, range),
        heading_(Heading::of(event.theta())),
        turn_(turn_of(event)) {}

  Fill fill() { return event_.kind == RotationEvent::Kind::three_segments ? fill_triple() : fill_vertex(); }
  /// The visible sub-edges that come to the position: those bounded by another segment of it, and those that pass.
  /// False where more coincides. Requires Fill::done.
  bool find_nodes();
  const LocalArrangement& local() const { return local_; }
  Point at() const { return at_; }

 private:
  Fill fill_triple();
  Fill order_along();
  bool find_position();
  Fill within(const WalkSegment& s, Located t) const;
  Fill fill_vertex();
  void add_chain(int in, int out, int side);
  bool find_signs();
  bool find_nodes(LocalArrangement::Member& member);
  std::optional<bool> passes(const WalkSegment& s, const BoundaryGraph::Node& node) const;
  bool takes_part(std::uint32_t n) const;
  Point start(const WalkSegment& s) const { return forms_.position(TurningForms::start(s), heading_); }
  double along(const WalkSegment& s) const {
    const Point from = start(s), d = forms_.direction(s, heading_);
    return (d.x * (at_.x - from.x) + d.y * (at_.y - from.y)) / (d.x * d.x + d.y * d.y);
  }

  const RotationEvent& event_;
  const TurningForms& forms_;
  const BoundaryGraph& graph_;
  EventSigns signs_;
  Heading heading_;
  double turn_;  // what its angle errs by
  LocalArrangement local_;
  ExactPosition position_;
  Point at_;
  double at_error_ = 0;
};

bool Meeting::find_signs() {
  for (int i = 0; i < local_.size; ++i)
    for (int j = i + 1; j < local_.size; ++j) {
      const WalkSegment &s = local_.members[i].segment, &t = local_.members[j].segment;
      int sign = sign_of(forms_.cross(s, t).at(heading_), kParallel * forms_.length1(s) * forms_.length1(t));
      if (sign == 0) sign = signs_.exact().cross(s, t);
      if (sign == 0) return false;
      local_.cross[i][j] = sign;
      local_.cross[j][i] = -sign;
    }
  return true;
}

Fill Meeting::fill_triple() {
  local_.size = 3;
  const std::array<WalkSegment, 3> s{event_.a, event_.b, event_.c};
  for (int k = 0; k < 3; ++k) {
    local_.members[k].segment = s[k];
    const RotationCatalog::Existence exists = signs_.exists(s[k]);
    if (exists != RotationCatalog::Existence::yes)
      return exists == RotationCatalog::Existence::no ? Fill::nothing : Fill::unsure;
  }
  if (!find_signs() || !event_.root->changes_sign()) return Fill::unsure;
  if (!find_position()) return Fill::nothing;
  for (int k = 0; k < 3; ++k) {
    const Located t = position_on(forms_, s[k], s[(k + 1) % 3], false, heading_, turn_),
                  u = position_on(forms_, s[k], s[(k + 2) % 3], false, heading_, turn_);
    if (const Fill inside = within(s[k], t.error < u.error ? t : u); inside != Fill::done) return inside;
  }
  return order_along();
}

// The position lies strictly between the ends of a segment, or not on it, or is an end. `t`: where it is in doubles.
Fill Meeting::within(const WalkSegment& s, Located t) const {
  if (t.t < -t.error || t.t > 1 + t.error) return Fill::nothing;
  if (t.t > t.error && t.t < 1 - t.error) return Fill::done;
  const SignsAt& signs = signs_.exact();
  const Fraction at = signs.along(s, position_);
  const int from = signs.sign(at), to = signs.compare(signs.length(s), at);
  if (from < 0 || to < 0) return Fill::nothing;
  return from > 0 && to > 0 ? Fill::done : Fill::unsure;
}

// After the event the crossings with b and c on a are in the order sign(G) sign(a x b) sign(a x c), G being the
// concurrency.
Fill Meeting::order_along() {
  const TrigForm2 g = forms_.concurrency(event_.a, event_.b, event_.c);
  int after = sign_of(g.slope(heading_), kSlopes * forms_.concurrency_error(event_.a, event_.b, event_.c));
  if (after == 0) after = signs_.after(forms_.exact_concurrency(event_.a, event_.b, event_.c, signs_.exact().chart()));
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const bool i_last = after * local_.cross[k][i] * local_.cross[k][j] > 0;
    local_.members[k].add({i_last ? j : i, false});
    local_.members[k].add({i_last ? i : j, false});
  }
  return Fill::done;
}

// The crossing of the two that are least parallel; from exact signs where doubles do not know it well. False where that
// is clearly off a segment.
bool Meeting::find_position() {
  at_error_ = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const WalkSegment& s = local_.members[k].segment;
    const Located t = position_on(forms_, s, local_.members[(k + 1) % 3].segment, false, heading_, turn_);
    const Point from = start(s), d = forms_.direction(s, heading_);
    const double error = t.error * forms_.length1(s) + position_error(turn_) * forms_.span();
    if (!(error < at_error_)) continue;
    at_error_ = error;
    position_ = {{true, {}, s, local_.members[(k + 1) % 3].segment}, {}};
    at_ = {from.x + t.t * d.x, from.y + t.t * d.y};
  }
  const double known = SignsAt::kCrossingNear * forms_.span();
  if (at_error_ <= known) return true;
  if (at_error_ == INFINITY) position_ = {{true, {}, local_.members[0].segment, local_.members[1].segment}, {}};
  const std::optional<Point> at = signs_.exact().near(position_);
  at_ = at.value_or(at_);
  at_error_ = known;
  return at.has_value();
}

// The vertex goes to one side of a; the segments that end and start there cross a or not.
Fill Meeting::fill_vertex() {
  const RotationCatalog::Joint joint = signs_.joint(event_.v);
  const RotationCatalog::Existence exists = signs_.exists(event_.a);
  if (exists == RotationCatalog::Existence::no) return Fill::nothing;
  if (joint.unsure || exists == RotationCatalog::Existence::unsure) return Fill::unsure;
  position_ = {{false, event_.v, {}, {}}, {}};
  at_ = forms_.position(event_.v, heading_);
  at_error_ = position_error(turn_) * forms_.span();
  const Fill inside = within(event_.a, {along(event_.a), 4 * at_error_ / forms_.length1(event_.a)});
  if (inside != Fill::done) return inside;
  const auto add = [&](const WalkSegment& s) {
    local_.members[local_.size].segment = s;
    return local_.size++;
  };
  add(event_.a);
  const int in = joint.has_in ? add(joint.in) : -1, out = joint.has_out ? add(joint.out) : -1;
  if (in >= 0) local_.members[in].closes = true;
  if (out >= 0) local_.members[out].opens = true;
  if (!find_signs() || !event_.root->changes_sign()) return Fill::unsure;
  int side = sign_of(forms_.side(event_.a, event_.v).slope(heading_), kSlopes * forms_.side_error(event_.a));
  if (side == 0) side = signs_.after(forms_.exact_side(event_.a, event_.v, signs_.exact().chart()));
  add_chain(in, out, side);
  return Fill::done;
}

// `side`: of a, on which the vertex lies after the event.
void Meeting::add_chain(int in, int out, int side) {
  auto& members = local_.members;
  const auto& cross = local_.cross;
  const bool in_crosses = in >= 0 && side == cross[0][in], out_crosses = out >= 0 && side == -cross[0][out];
  if (in >= 0) {
    if (in_crosses) members[in].add({0, false});
    members[in].add({out, true});
  }
  if (out >= 0) {
    members[out].add({in, true});
    if (out_crosses) members[out].add({0, false});
  }
  if (in_crosses && out_crosses) {
    const bool in_first = -side * cross[in][out] * cross[0][in] * cross[0][out] < 0;
    members[0].add({in_first ? in : out, false});
    members[0].add({in_first ? out : in, false});
  } else if (in_crosses || out_crosses) {
    members[0].add({in_crosses ? in : out, false});
  }
}

bool Meeting::takes_part(std::uint32_t n) const {
  for (int k = 0; k < local_.size; ++k)
    if (graph_.segments().of(local_.members[k].segment) == graph_[n].id) return true;
  return false;
}

bool Meeting::find_nodes() {
  for (int k = 0; k < local_.size; ++k)
    if (!find_nodes(local_.members[k])) return false;
  return true;
}

bool Meeting::find_nodes(LocalArrangement::Member& member) {
  for (std::uint32_t n = graph_.first_on(member.segment); n != kNobody; n = graph_[n].next_on_segment) {
    const BoundaryGraph::Node& node = graph_[n];
    const bool starts = takes_part(node.prev), ends = takes_part(node.next);
    if (starts && ends) {
      local_.vanish.push_back(n);
      continue;
    }
    bool passing = false;
    if (!starts && !ends) {
      if (member.opens || member.closes) continue;
      const std::optional<bool> known = passes(member.segment, node);
      if (!known) return false;
      passing = *known;
    }
    if (ends || passing) {
      if (member.in != kNobody) return false;
      member.in = n;
    }
    if (starts || passing) {
      if (member.out != kNobody) return false;
      member.out = n;
    }
  }
  return !(member.opens && member.in != kNobody) && !(member.closes && member.out != kNobody);
}

// Whether the position lies between the ends of a sub-edge; nothing where it is one of them.
std::optional<bool> Meeting::passes(const WalkSegment& s, const BoundaryGraph::Node& node) const {
  const double t = along(s), error = 4 * at_error_ / forms_.length1(s);
  const Located u = position_on(forms_, s, graph_[node.prev].segment, true, heading_, turn_),
                v = position_on(forms_, s, graph_[node.next].segment, false, heading_, turn_);
  if (std::abs(t - u.t) > error + u.error && std::abs(t - v.t) > error + v.error) return t > u.t && t < v.t;
  const SignsAt& signs = signs_.exact();
  const SubEdge edge{s, graph_[node.prev].segment, graph_[node.next].segment};
  const std::optional<Fraction> from = end_along(signs, s, edge, false), to = end_along(signs, s, edge, true);
  if (!from || !to) return std::nullopt;
  const Fraction at = signs.along(s, position_);
  const int after_start = signs.compare(at, *from), before_end = signs.compare(*to, at);
  if (after_start == 0 || before_end == 0) return std::nullopt;
  return after_start > 0 && before_end > 0;
}

// What goes on along the same node changes nothing.
BoundaryEdit edit_of(const LocalArrangement& local, const LocalArrangement::Routes& routes) {
  const auto segments = [&](const std::vector<int>& members) {
    std::vector<WalkSegment> all;
    for (const int k : members) all.push_back(local.members[static_cast<std::size_t>(k)].segment);
    return all;
  };
  BoundaryEdit edit;
  for (const LocalArrangement::Path& path : *routes.paths) {
    if (path.members.size() == 1 && path.in == path.out) continue;
    edit.runs.push_back({path.in, path.out, segments(path.members)});
    edit.gone.push_back(path.in);
    edit.gone.push_back(path.out);
  }
  std::sort(edit.gone.begin(), edit.gone.end());
  edit.gone.erase(std::unique(edit.gone.begin(), edit.gone.end()), edit.gone.end());
  edit.gone.insert(edit.gone.end(), local.vanish.begin(), local.vanish.end());
  for (const std::vector<int>& cycle : routes.cycles) edit.births.push_back(segments(cycle));
  edit.loops_may_change = routes.paths->size() > 1 || (!local.vanish.empty() && routes.paths->empty());
  return edit;
}

}  // namespace

EventPlan plan_meeting(RotationEvent& event, const RotationRange& range, const SweepScene& scene,
                       const OverlapFilter& filter) {
  EventPlan plan;
  plan.kind = event.kind == RotationEvent::Kind::three_segments ? ObstacleEvent::Kind::three_segments
                                                                : ObstacleEvent::Kind::vertex_on_segment;
  const auto with = [&](EventPlan::Verdict verdict) {
    plan.verdict = verdict;
    return plan;
  };
  Meeting meeting(event, range, scene);
  const Fill filled = meeting.fill();
  if (filled == Fill::nothing) return plan;
  // Not generic: of no interest where everything is covered.
  if (filled == Fill::unsure)
    return with(provably_covered(event, scene.forms, filter) ? EventPlan::Verdict::nothing
                                                             : EventPlan::Verdict::unsure);
  if (!meeting.find_nodes()) return with(EventPlan::Verdict::unsure);
  plan.at = meeting.at();
  const LocalArrangement::Routes routes = meeting.local().routes();
  if (!meeting.local().any()) {
    if (routes.cycles.empty()) return with(EventPlan::Verdict::doubtful);
    if (filter.inside(plan.at, Heading::of(event.theta()))) return plan;
  }
  if (!routes.paths) return with(EventPlan::Verdict::unsure);
  plan.edit = edit_of(meeting.local(), routes);
  if (!plan.edit.empty()) plan.verdict = EventPlan::Verdict::change;
  return plan;
}

EventPlan plan_event(RotationEvent& event, const RotationRange& range, const SweepScene& scene,
                     const OverlapFilter& filter) {
  if (event.root && turn_of(event) > kPlannedTurn) narrow_angles(event, range);
  switch (event.kind) {
    case RotationEvent::Kind::alignment:
      return plan_alignment(event, range, scene);
    case RotationEvent::Kind::overlap:
      return plan_overlap(event, range, scene);
    default:
      return plan_meeting(event, range, scene, filter);
  }
}

}  // namespace dymsum::planar
