#include "cspace/obstacle/near_slice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cspace/obstacle/slice_reader.h"

namespace dymsum::planar {
namespace {

/// Boxes are larger than what they are made for by this fraction of the span: what happens there is inside, at all
/// angles within kNearTurn.
constexpr double kBeside = 0x1p-18;
/// Lines at a smaller one are taken as nearly parallel.
constexpr double kLeastSine = 0x1p-20;
static_assert(64 * kNearTurn < kBeside && 64 * kCutNear < kBeside);

class Splice {
 public:
  Splice(const SweepScene& scene, const AngleNow& now, Heading h, const BoxFrame& frame, const NearChange& change)
      : forms_(scene.forms),
        graph_(scene.graph),
        now_(now),
        h_(h),
        frame_(frame),
        box_(change.box),
        chains_(change.chains) {}

  std::optional<SliceEdit> run(std::vector<std::uint32_t> segments) {
    if (!find_stubs() || !walk_chains() || !find_loops(std::move(segments))) return std::nullopt;
    return make_edit();
  }

 private:
  // The node on a segment that passes a side of the box at a point: of those that end after it the nearest one, or of
  // those that begin before it. Outside the box nothing changes, so there is one.
  std::optional<std::uint32_t> stub(std::uint32_t segment, Point at, bool comes_in) const {
    const std::uint32_t first = graph_.first_on(segment);
    const WalkSegment s = graph_.segments().segment(segment);
    const Point from = forms_.position(TurningForms::start(s), h_), d = forms_.direction(s, h_);
    const double length2 = d.x * d.x + d.y * d.y, here = (d.x * (at.x - from.x) + d.y * (at.y - from.y)) / length2,
                 near = kCutNear * forms_.span() / std::sqrt(length2);
    std::optional<std::uint32_t> best;
    double best_at = 0;
    const auto fraction = [&](Pair v) {
      const Point p = forms_.position(v, h_);
      return (d.x * (p.x - from.x) + d.y * (p.y - from.y)) / length2;
    };
    for (std::uint32_t n = first; n != kNobody; n = graph_[n].next_on_segment) {
      const WalkSegment by = graph_.segments().segment(comes_in ? graph_[n].left : graph_[n].right);
      Located end = position_on(forms_, s, by, comes_in, h_);
      if (std::isinf(end.error) && n == first && graph_[n].next_on_segment == kNobody) return n;
      // It ends on its neighbour, wherever the lines of both cross.
      const double u = fraction(TurningForms::start(by)), v = fraction(forms_.end(by));
      if (!(end.error < std::abs(v - u) / 2)) end = {(u + v) / 2, std::abs(v - u) / 2};
      const double beyond = comes_in ? here - end.t : end.t - here;
      if (!(std::abs(beyond) > end.error + near)) return std::nullopt;
      if (beyond < 0 || (best && beyond > best_at)) continue;
      best = n;
      best_at = beyond;
    }
    return best;
  }

  bool find_stubs() {
    for (const BoundaryChain& chain : chains_) {
      ins_.push_back(kNobody);
      outs_.push_back(kNobody);
      if (chain.closed) continue;
      const auto in = stub(chain.segments.front(), chain.from, true),
                 out = stub(chain.segments.back(), chain.to, false);
      if (!in || !out) return false;
      ins_.back() = *in;
      outs_.back() = *out;
      if (!chain_of_out_.emplace(*out, outs_.size() - 1).second) return false;
    }
    return true;
  }

  // Walks along the boundary before the angle, from each node that comes in to the first one that leaves.
  bool walk_chains() {
    std::vector<std::uint8_t> left(chains_.size());
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (chains_[c].closed) continue;
      std::uint32_t n = ins_[c];
      for (;; n = graph_[n].next) {
        if (!inside_.emplace(n, true).second) return false;
        old_.push_back(n);
        if (chain_of_out_.contains(n)) break;
      }
      const std::size_t to = chain_of_out_.at(n);
      if (left[to]) return false;
      left[to] = 1;
      pairs_change_ |= to != c;
    }
    return true;
  }

  // Loops that lie in the box as wholes: a loop that passes its sides is on the chains wherever it is inside.
  bool find_loops(std::vector<std::uint32_t> segments) {
    for (const BoundaryChain& chain : chains_)
      if (chain.closed) segments.insert(segments.end(), chain.segments.begin(), chain.segments.end());
    std::sort(segments.begin(), segments.end());
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
    for (const std::uint32_t s : segments)
      for (std::uint32_t first = graph_.first_on(s); first != kNobody; first = graph_[first].next_on_segment) {
        if (inside_.contains(first)) continue;
        const std::optional<bool> in = lies_inside(first);
        if (!in) return false;
        if (!*in) continue;
        for (std::uint32_t n = first; inside_.emplace(n, true).second; n = graph_[n].next) {
          old_.push_back(n);
          loops_.push_back(n);
        }
      }
    return true;
  }

  // Whether the loop of a node that is on no chain lies in the box, by one of its vertices that doubles know.
  std::optional<bool> lies_inside(std::uint32_t first) const {
    std::uint32_t n = first;
    do {
      const WalkSegment s = graph_[n].segment;
      const Located end = position_on(forms_, s, graph_.segments().segment(graph_[n].right), false, h_);
      const Point d = forms_.direction(s, h_), from = forms_.position(TurningForms::start(s), h_);
      const double near = kCutNear * forms_.span();
      if (end.error * std::hypot(d.x, d.y) < near) {
        const Point p = frame_.of({from.x + end.t * d.x, from.y + end.t * d.y});
        const double x = std::min(p.x - box_.low.x, box_.high.x - p.x),
                     y = std::min(p.y - box_.low.y, box_.high.y - p.y), depth = std::min(x, y);
        if (std::abs(depth) > 2 * near) return depth > 0;
      }
      n = graph_[n].next;
    } while (n != first);
    return std::nullopt;
  }

  std::optional<SliceEdit> make_edit() {
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
    std::vector<SubEdge> before;
    for (const std::uint32_t n : old_) {
      known[{graph_[n].id, graph_[n].left, graph_[n].right}] = n;
      before.push_back(graph_.sub_edge(n));
    }
    const SharedLines lines(forms_, now_, std::move(before));
    SliceEdit edit;
    std::vector<std::uint32_t> first_position;
    std::uint32_t index = 0;
    bool cycles_change = false;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      const BoundaryChain& chain = chains_[c];
      const std::size_t n = chain.segments.size();
      SliceEdit::Loop& to = edit.loops.emplace_back();
      to.open = !chain.closed;
      if (to.open) to.cell = graph_[ins_[c]].cell;
      first_position.push_back(index);
      for (std::size_t k = 0; k < n; ++k, ++index) {
        SliceEdit::Position position{chain.segments[k], chain.segments[(k + n - 1) % n], chain.segments[(k + 1) % n],
                                     kNobody};
        if (to.open && k == 0) position.left = graph_[ins_[c]].left;
        if (to.open && k + 1 == n) position.right = graph_[outs_[c]].right;
        const auto it = known.find({position.segment, position.left, position.right});
        if (it != known.end() && lines.shut(std::array{graph_.sub_edge(it->second)})) {
          edit.touching.emplace_back(it->second, index);
        } else if (it != known.end()) {
          position.stays = it->second;
          known.erase(it);
        }
        cycles_change |= chain.closed && position.stays == kNobody;
        to.positions.push_back(position);
      }
    }
    first_position.push_back(index);
    for (const auto& [key, n] : known) edit.ended.push_back(n);
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (chains_[c].closed) continue;
      SliceEdit::Loop& loop = edit.loops[c];
      const std::uint32_t before = graph_[ins_[c]].prev, after = graph_[outs_[c]].next;
      loop.before.node = before;
      loop.after.node = after;
      if (const auto out = chain_of_out_.find(before); out != chain_of_out_.end())
        loop.before.position = first_position[out->second + 1] - 1;
      else if (inside_.contains(before)) return std::nullopt;
      if (const auto in = std::find(ins_.begin(), ins_.end(), after); in != ins_.end())
        loop.after.position = first_position[static_cast<std::size_t>(in - ins_.begin())];
      else if (inside_.contains(after)) return std::nullopt;
    }
    edit.loops_may_change =
        pairs_change_ || cycles_change || std::any_of(loops_.begin(), loops_.end(), [&](std::uint32_t n) {
          return std::find(edit.ended.begin(), edit.ended.end(), n) != edit.ended.end();
        });
    match_along_lines(graph_, lines, edit);
    return edit;
  }

  const TurningForms& forms_;
  const BoundaryGraph& graph_;
  const AngleNow& now_;
  Heading h_;
  const BoxFrame& frame_;
  const FormsBox& box_;
  const std::vector<BoundaryChain>& chains_;
  std::vector<std::uint32_t> ins_, outs_;              // of chains: nodes
  std::map<std::uint32_t, std::size_t> chain_of_out_;  // of nodes
  std::map<std::uint32_t, bool> inside_;               // nodes of chains and loops before
  std::vector<std::uint32_t> old_, loops_;
  bool pairs_change_ = false;
};

}  // namespace

std::optional<std::vector<BoundaryChain>> NearSlices::in(const PlanarBox& box, const Orientation& frame,
                                                         const Orientation& at) {
  // The sum of O with -R(theta), which is R turned by half a turn more.
  const Result<PlanarLocalPart> cut = sum_.in(box, {frame, {}}, {Orientation::half_turn() * frame * at, {}});
  if (!cut) return std::nullopt;
  const std::vector<PlanarLocalPart::Edge>& edges = cut->edges;
  std::vector<std::uint32_t> in(cut->vertices.size(), kNobody), out(cut->vertices.size(), kNobody);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (out[edges[e].from] != kNobody || in[edges[e].to] != kNobody) return std::nullopt;
    out[edges[e].from] = e;
    in[edges[e].to] = e;
  }
  std::vector<BoundaryChain> chains;
  std::vector<std::uint8_t> seen(edges.size());
  const auto follow = [&](std::uint32_t first) {
    BoundaryChain& chain = chains.emplace_back();
    chain.from = cut->vertices[edges[first].from];
    for (std::uint32_t e = first; e != kNobody && !seen[e]; e = out[edges[e].to]) {
      seen[e] = 1;
      chain.segments.push_back(reader_.index(edges[e].contact));
      chain.to = cut->vertices[edges[e].to];
      chain.closed = out[edges[e].to] == first;
    }
  };
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (in[edges[e].from] == kNobody) follow(e);
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (!seen[e]) follow(e);
  return chains;
}

namespace {

// What an event may change at its angle, but for rounding, lies between points; within `turn` after it that is so in a
// box around them with a rim. `along`: the longest of what lies on one line.
struct EventExtent {
  std::vector<Point> points;
  double turn = kNearTurn;
  Point along;
  void add_interval(Point a, Point b) {
    points.insert(points.end(), {a, b});
    const Point d{b.x - a.x, b.y - a.y};
    if (std::hypot(d.x, d.y) > std::hypot(along.x, along.y)) along = d;
  }
};

// The crossing of two lines moves by at most span (1 + 4 / sine) for every radian, while the sine keeps half of itself;
// where they are nearly parallel it may be anywhere on what the segments share of their line, unless one lies beside
// the line of the other, farther than anything moves: then they do not meet. Nothing where no doubles are known of its
// position.
std::optional<EventExtent> extent_of(const RotationEvent& event, const SweepScene& scene, const SignsAt& signs) {
  const TurningForms& forms = scene.forms;
  const Heading h = signs.heading();
  EventExtent to;
  const auto sine = [&](const WalkSegment& s, const WalkSegment& t) {
    return std::abs(forms.cross(s, t).at(h)) / (forms.length1(s) * forms.length1(t));
  };
  if (event.kind == RotationEvent::Kind::vertex_on_segment) to.points.push_back(forms.position(event.v, h));
  if (event.kind == RotationEvent::Kind::alignment) {
    const std::uint32_t e1 = forms.operand(1).next[event.e], f1 = forms.operand(0).next[event.f];
    const auto at = [&](std::uint32_t p, std::uint32_t q) { return forms.position({p, q}, h); };
    to.add_interval(at(event.f, event.e), at(f1, e1));
    to.add_interval(at(f1, event.e), at(event.f, e1));
  }
  if (event.kind == RotationEvent::Kind::three_segments)
    for (const auto& [s, t] : {std::pair{&event.a, &event.b}, {&event.b, &event.c}, {&event.c, &event.a}}) {
      if (sine(*s, *t) < kLeastSine) continue;
      const std::optional<Point> at = signs.near(ExactPosition{{true, {}, *s, *t}, {}});
      if (!at) return std::nullopt;
      to.points.push_back(*at);
      break;
    }
  const std::vector<std::uint32_t> all = segments_of(event, scene);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t l = k + 1; l < all.size(); ++l) {
      const WalkSegment s = scene.graph.segments().segment(all[k]), t = scene.graph.segments().segment(all[l]);
      if (all[k] == all[l]) continue;
      if (const double at = sine(s, t); at >= kLeastSine) {
        to.turn = std::min(to.turn, kNearTurn * at);
        continue;
      }
      const Point d = forms.direction(s, h);
      std::array<Point, 4> ends{forms.position(TurningForms::start(s), h), forms.position(forms.end(s), h),
                                forms.position(TurningForms::start(t), h), forms.position(forms.end(t), h)};
      const auto beside = [&](Point p) {
        return (d.x * (p.y - ends[0].y) - d.y * (p.x - ends[0].x)) / std::hypot(d.x, d.y);
      };
      const double b0 = beside(ends[2]), b1 = beside(ends[3]), apart = kBeside * forms.span();
      if (std::min(b0, b1) > apart || std::max(b0, b1) < -apart) continue;
      std::sort(ends.begin(), ends.end(),
                [&](Point a, Point b) { return d.x * a.x + d.y * a.y < d.x * b.x + d.y * b.y; });
      to.add_interval(ends[1], ends[2]);
    }
  return to;
}

// The frame lies along the longest interval, to within what it is short of a box's rim.
BoxFrame frame_along(Point along) {
  constexpr double kAlong = 0x1p-22;
  static_assert(4 * kAlong < kBeside);
  if (along.x == 0 && along.y == 0) return {};
  BoxFrame frame;
  if (const Result<Orientation> turn = Orientation::nearest(-std::atan2(along.y, along.x), kAlong))
    frame = {*turn, Heading::of(turn->radians())};
  return frame;
}

}  // namespace

std::optional<NearChanges> boxes_of(std::vector<EventGroup> due, EventGroup& alone, const SweepScene& scene,
                                    const SignsAt& signs) {
  const std::size_t first_alone = due.size();
  for (RotationEvent* event : alone) due.push_back({event});
  alone.clear();
  std::vector<EventExtent> extents;
  EventExtent longest;
  for (const EventGroup& events : due) {
    EventExtent& whole = extents.emplace_back();
    for (const RotationEvent* event : events) {
      const std::optional<EventExtent> one = extent_of(*event, scene, signs);
      if (!one) return std::nullopt;
      whole.points.insert(whole.points.end(), one->points.begin(), one->points.end());
      whole.turn = std::min(whole.turn, one->turn);
      if (extents.size() <= first_alone) longest.add_interval({}, one->along);
    }
  }
  NearChanges apart{frame_along(longest.along), {}};
  std::vector<NearChange> all;
  for (std::size_t k = 0; k < due.size(); ++k) {
    NearChange& change = all.emplace_back();
    for (const Point p : extents[k].points) change.box.add(apart.frame.of(p));
    change.box.grow(kBeside * scene.forms.span());
    change.turn = extents[k].turn;
    change.events = std::move(due[k]);
  }
  std::vector<std::uint8_t> taken(all.size());
  for (std::size_t first = 0; first < first_alone; ++first) {
    if (taken[first]) continue;
    taken[first] = 1;
    NearChange change = std::move(all[first]);
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (taken[k] || !change.box.meets(all[k].box)) continue;
        taken[k] = grown = true;
        change.box.add(all[k].box);
        change.turn = std::min(change.turn, all[k].turn);
        change.events.insert(change.events.end(), all[k].events.begin(), all[k].events.end());
      }
    }
    apart.all.push_back(std::move(change));
  }
  for (std::size_t k = first_alone; k < all.size(); ++k)
    if (!taken[k]) alone.push_back(all[k].events[0]);
  return apart;
}

std::optional<SliceEdit> edit_near(const SweepScene& scene, const AngleNow& now, Heading h, const BoxFrame& frame,
                                   const NearChange& change) {
  std::vector<std::uint32_t> segments;
  for (const RotationEvent* event : change.events) {
    const std::vector<std::uint32_t> of = segments_of(*event, scene);
    segments.insert(segments.end(), of.begin(), of.end());
  }
  return Splice(scene, now, h, frame, change).run(std::move(segments));
}

}  // namespace dymsum::planar
