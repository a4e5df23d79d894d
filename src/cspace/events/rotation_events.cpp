#include "cspace/events/rotation_events.h"

#include <algorithm>
#include <bitset>
#include <numeric>

#include "cspace/events/crossing_orders.h"
#include "cspace/events/exact_position.h"
#include "cspace/events/near_events.h"

namespace dymsum::planar {

using exact::AlgebraicRoot;

namespace {

/// Where doubles look for events they look a little farther, relative to lengths and in radians.
constexpr double kNear = 0x1p-18;
/// The error of an interval that two segments share is this times the span: two positions (16 each) and a product with
/// a direction (19 + 2).
constexpr double kInterval = exact::rounding_bound(2 * 16 + 19 + 2, 8192);
/// A vertex whose root doubles know worse, or whose slope there is less than this fraction of what it can be, is looked
/// at exactly.
constexpr double kSteep = 0x1p-20;
/// Roots that three lines have in doubles are not used where they are known worse.
constexpr double kKnownRoot = 0x1p-30;

class Collector {
 public:
  Collector(const EventWindow& window, const TurningForms& forms, const RotationCatalog& catalog,
            const OverlapFilter* filter, const QuarterEnds& ends, const std::function<void()>& again)
      : w_(window),
        forms_(forms),
        catalog_(catalog),
        filter_(filter),
        ends_(window, ends),
        near_(ends.around),
        orders_(window, forms, ends_),
        again_(again) {}

  RotationEvents run(const std::vector<Alignment>& all) {
    add_alignments(all);
    if (near_ != nullptr) {
      look_near();
      return sorted();
    }
    find_crossings();
    find_vertices();
    number_headings();
    sketch_meetings();
    for (std::uint32_t a = 0; a < w_.segments.size(); ++a) {
      again_();
      triples_of(a);
    }
    return sorted();
  }

 private:
  // Stable: results are the same whatever the library's sort does with events at one angle.
  RotationEvents sorted() {
    std::stable_sort(out_.events.begin(), out_.events.end(),
                     [](const RotationEvent& a, const RotationEvent& b) { return a.low < b.low; });
    return std::move(out_);
  }

  // Looks around an angle at which much is nearly aligned.
  void look_near() {
    for (const EventWindow::SegmentPair& m : w_.pairs) {
      if (forms_.parallel(w_.segments[m.a], w_.segments[m.b])) overlaps(w_.segments[m.a], w_.segments[m.b]);
      else ++out_.pairs;
    }
    const NearEvents found = near_events(w_, forms_, *near_, *filter_, ends_.leaves_out_high(), again_);
    out_.triples += found.looked_at;
    for (const NearEvents::Vertex& v : found.vertices) {
      again_();
      if (!belongs_to_alignment(w_.segments[v.segment], v.at)) add_vertex(w_.segments[v.segment], v.at, &v.where);
    }
    for (const NearEvents::Triple& triple : found.triples) {
      again_();
      const auto [a, b, c] = triple.segments;
      if (!same_direction(forms_, w_.segments[b], w_.segments[c]))
        add_triple(w_.segments[a], w_.segments[b], w_.segments[c], &triple.where);
    }
  }
  // Roots of a polynomial, of those that are near to some where these are known.
  std::vector<AlgebraicRoot> roots(const exact::Polynomial& p, const std::vector<NearRoot>* where) const {
    std::vector<AlgebraicRoot> all = ends_.roots(p);
    if (where != nullptr)
      std::erase_if(all, [&](const AlgebraicRoot& root) {
        const std::array<double, 2> range = near_->range({w_.range.chart, root.low(), root.high()});
        return std::none_of(where->begin(), where->end(),
                            [&](const NearRoot& near) { return near.low <= range[1] && range[0] <= near.high; });
      });
    return all;
  }

  void add_alignments(const std::vector<Alignment>& all) {
    const double slack = 2 * kAngleSlack;
    auto at = std::lower_bound(all.begin(), all.end(), w_.low - slack,
                               [](const Alignment& a, double t) { return a.theta < t; });
    for (; at != all.end() && at->theta <= w_.high + slack; ++at) {
      RotationEvent event;
      event.e = at->e;
      event.f = at->f;
      event.low = at->theta - kAngleSlack;
      event.high = at->theta + kAngleSlack;
      const bool near_end = event.low < w_.low + slack || event.high > w_.high - slack;
      if (near_end && !falls_inside(event)) continue;
      out_.events.push_back(std::move(event));
    }
  }
  bool falls_inside(RotationEvent& event) const {
    if (ends_.high() != nullptr && ends_.high()->aligned(event.e, event.f)) return false;
    const exact::Polynomial p = forms_.exact_alignment(event.e, event.f, w_.range.chart);
    if (forms_.alignment_chart(event.e, event.f) != w_.range.chart) return false;
    return !ends_.roots(p).empty();
  }

  // The parameter of b's line along a: N / D. Around its value t at the midpoint, (N - t D) / D is small.
  LineCrossing crossing(std::uint32_t i, std::uint32_t j) const {
    const WalkSegment &a = w_.segments[i], &b = w_.segments[j];
    const TrigForm n = forms_.side(b, TurningForms::start(a)), d = forms_.cross(a, b);
    const double at = d.at(w_.heading), least = std::abs(at) - std::abs(d.slope(w_.heading)) * w_.half -
                                                0.5 * d.swing() * w_.half * w_.half -
                                                kTurnedCross * forms_.length1(a) * forms_.length1(b);
    if (!(least > 0)) return {j, -INFINITY, INFINITY, 0};
    const double t = n.at(w_.heading) / at;
    const TrigForm k = n - d.times(t);
    const double error = forms_.side_error(b) * (1 + std::abs(t));
    const double radius =
        (std::abs(k.slope(w_.heading)) * w_.half + 0.5 * k.swing() * w_.half * w_.half + error) / least * kWider;
    return {j, t - radius, t + radius, 0};
  }

  void find_crossings() {
    crossings_.resize(w_.segments.size());
    for (const EventWindow::SegmentPair& m : w_.pairs) {
      if (forms_.parallel(w_.segments[m.a], w_.segments[m.b])) {
        overlaps(w_.segments[m.a], w_.segments[m.b]);
        continue;
      }
      ++out_.pairs;
      for (const auto& [i, j] : {std::pair{m.a, m.b}, std::pair{m.b, m.a}}) {
        const LineCrossing c = crossing(i, j);
        if (c.high >= -kNear && c.low <= 1 + kNear) crossings_[i].push_back(c);
      }
    }
    for (auto& list : crossings_)
      std::sort(list.begin(), list.end(), [](const LineCrossing& a, const LineCrossing& b) {
        return a.low != b.low ? a.low < b.low : a.other < b.other;
      });
  }

  // Whether the interval that two segments share is longer than nothing, which have the same direction and lie on one
  // line at the angle of an event. Lines that coincide but for a rounding have ends that do, and share what doubles do
  // not see.
  bool share_interval(const WalkSegment& a, const WalkSegment& b, const RotationEvent& event) const {
    const Heading h = Heading::of(event.theta());
    const Point d = forms_.direction(a, h), e = forms_.direction(b, h), s = forms_.position(TurningForms::start(a), h),
                t = forms_.position(TurningForms::start(b), h);
    if (d.x * e.x + d.y * e.y <= 0) return false;
    const double length = std::hypot(d.x, d.y), other = std::hypot(e.x, e.y),
                 from = (d.x * (t.x - s.x) + d.y * (t.y - s.y)) / length,
                 shared = std::min(length, from + other) - std::max(0.0, from),
                 unsure = (kInterval + 2 * (event.high - event.low)) * forms_.span();
    if (std::abs(shared) > unsure) return shared > 0;
    const auto ahead = [&](Pair u, Pair v) {
      return sign_at(*event.root, forms_.exact_along(a, u, v, w_.range.chart)) > 0;
    };
    return ahead(TurningForms::start(b), forms_.end(a)) && ahead(TurningForms::start(a), forms_.end(b));
  }
  bool overlap_at(const WalkSegment& a, const WalkSegment& b, const RotationEvent& event) const {
    return may_exist(a, event.theta()) && may_exist(b, event.theta()) && share_interval(a, b, event);
  }
  bool beside_at_crowded_end(const TrigForm& f, const WalkSegment& s, Pair v) const {
    return ends_.at_end(f, forms_.side_error(s), [&](const QuarterTurn& end) { return end.on_line(s, v); }) ||
           ends_.sign_beside(s, v) != 0;
  }
  void overlaps(const WalkSegment& a, const WalkSegment& b) {
    // One edge at both ends of another one: on one line only where the two edges are aligned.
    const Operand& other = forms_.operand(1 - a.side);
    if (a.edge == b.edge && (other.next[a.vertex] == b.vertex || other.prev[a.vertex] == b.vertex)) return;
    if (a.vertex == b.vertex) return;  // they do not move against each other
    const TrigForm f = forms_.side(a, TurningForms::start(b));
    if (f.far_from_zero(w_.heading, w_.half, forms_.side_error(a)) ||
        beside_at_crowded_end(f, a, TurningForms::start(b)))
      return;
    const exact::Polynomial poly = forms_.exact_side(a, TurningForms::start(b), w_.range.chart);
    if (poly.is_zero()) return;
    for (AlgebraicRoot& root : ends_.roots(poly)) {
      RotationEvent event = at(std::move(root), RotationEvent::Kind::overlap);
      if (!overlap_at(a, b, event)) continue;
      event.a = a;
      event.b = b;
      out_.events.push_back(std::move(event));
    }
  }
  // The vertex is an end of a segment that comes to lie along a: part of an overlap.
  bool belongs_to_overlap(const WalkSegment& a, Pair v, const RotationEvent& event) const {
    const RotationCatalog::Joint joint = catalog_.joint(v, event.theta());
    if (joint.unsure) return false;
    return (joint.has_in && forms_.parallel(a, joint.in) && overlap_at(a, joint.in, event)) ||
           (joint.has_out && forms_.parallel(a, joint.out) && overlap_at(a, joint.out, event));
  }

  // Ends of the edge a and of an edge at its vertex: the side of such a pair is zero where the two edges are aligned.
  bool belongs_to_alignment(const WalkSegment& a, Pair v) const {
    const Operand &o = forms_.operand(a.side), &other = forms_.operand(1 - a.side);
    const std::uint32_t x = a.side == 0 ? v.p : v.q, y = a.side == 0 ? v.q : v.p;
    const bool at_end = x == a.edge || x == o.next[a.edge];
    return at_end && (y == a.vertex || y == other.next[a.vertex] || y == other.prev[a.vertex]);
  }

  void find_vertices() {
    std::vector<std::array<std::uint32_t, 3>> seen;
    for (const EventWindow::SegmentPair& m : w_.pairs)
      for (const auto& [i, j] : {std::pair{m.a, m.b}, std::pair{m.b, m.a}})
        for (const Pair v : {TurningForms::start(w_.segments[j]), forms_.end(w_.segments[j])}) {
          const WalkSegment& a = w_.segments[i];
          if (a.vertex == (a.side == 0 ? v.q : v.p)) continue;  // v does not move against a
          const TrigForm f = forms_.side(a, v);
          if (!f.far_from_zero(w_.heading, w_.half, forms_.side_error(a)) && !beside_at_crowded_end(f, a, v))
            seen.push_back({i, v.p, v.q});
        }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const auto& [i, p, q] : seen) {
      again_();
      vertex_on(i, {p, q});
    }
  }

  void vertex_on(std::uint32_t i, Pair v) {
    const WalkSegment& a = w_.segments[i];
    if (belongs_to_alignment(a, v)) return;
    const TrigForm f = forms_.side(a, v);
    const double error = forms_.side_error(a);
    if (f.far_from_zero(w_.heading, w_.half, error)) return;
    // a + r cos(theta - phase); where it only just reaches zero both roots are at the phase.
    const double r = std::hypot(f.b, f.g), phase = std::atan2(f.g, f.b),
                 back = r > 0 ? std::acos(std::clamp(-f.a / r, -1.0, 1.0)) : 0;
    bool near = r <= error;
    for (const double root : {phase - back, phase + back}) {
      const double theta = w_.midpoint + std::remainder(root - w_.midpoint, kTurn);
      if (!(std::abs(theta - w_.midpoint) <= w_.half + 2 * kNear) || !on(a, v, theta)) continue;
      // Where the slope is steep the root is where doubles say.
      const Heading h = Heading::of(theta);
      RotationEvent event;
      event.kind = RotationEvent::Kind::vertex_on_segment;
      event.v = v;
      const double off = 2 * (std::abs(f.at(h)) + error) / (std::abs(f.slope(h)) - kSteep * f.swing());
      event.low = theta - off;
      event.high = theta + off;
      near |= !(off >= 0 && off < kSteep) || !covered(event);
    }
    if (near) add_vertex(a, v);
  }
  void add_vertex(const WalkSegment& a, Pair v, const std::vector<NearRoot>* where = nullptr) {
    const exact::Polynomial poly = forms_.exact_side(a, v, w_.range.chart);
    for (AlgebraicRoot& root : roots(poly, where)) {
      RotationEvent event = at(std::move(root), RotationEvent::Kind::vertex_on_segment);
      if (!on(a, v, event.theta()) || !may_exist(a, event.theta()) || belongs_to_overlap(a, v, event)) continue;
      event.a = a;
      event.v = v;
      if (!covered(event)) out_.events.push_back(std::move(event));
    }
  }
  bool may_exist(const WalkSegment& s, double theta) const {
    return catalog_.exists(s, theta) != RotationCatalog::Existence::no;
  }
  bool may_exist_near(const WalkSegment& s, double theta, double error) const {
    if (!catalog_.may_exist(s)) return false;
    const RotationCatalog::Span span = catalog_.span(s, theta);
    return span.from <= error + kAngleSlack && span.to >= -error - kAngleSlack;
  }

  bool on(const WalkSegment& a, Pair v, double theta) const {
    const Heading h = Heading::of(theta);
    const Point d = forms_.direction(a, h), from = forms_.position(TurningForms::start(a), h),
                x = forms_.position(v, h);
    const double along = d.x * (x.x - from.x) + d.y * (x.y - from.y), length = d.x * d.x + d.y * d.y;
    const double slack = kNear * (length + forms_.length1(a) * forms_.span());
    return along >= -slack && along <= length + slack;
  }

  // Segments of one number have the same direction at every angle.
  void number_headings() {
    std::array<std::vector<std::uint32_t>, 2> number;
    std::uint32_t count = 0;
    for (std::uint32_t side = 0; side < 2; ++side) {
      std::vector<std::uint32_t> order(forms_.size(side));
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](std::uint32_t e, std::uint32_t f) {
        const double at = catalog_.edge_angle(side, e), other = catalog_.edge_angle(side, f);
        return at != other ? at < other : e < f;
      });
      number[side].resize(order.size());
      for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || !same_direction(forms_, {side, order[k - 1], 0}, {side, order[k], 0})) ++count;
        number[side][order[k]] = count;
      }
    }
    heading_of_.reserve(w_.segments.size());
    for (const WalkSegment& s : w_.segments) heading_of_.push_back(number[s.side][s.edge]);
  }

  // Whether w_.meet(j, k) may hold, by a bit out of a cache line: most triples of crowded windows stop here.
  static std::size_t bit_of(std::uint32_t k) { return (k * 2654435761u) >> 23; }
  void sketch_meetings() {
    sketches_.resize(w_.segments.size());
    for (const EventWindow::SegmentPair& m : w_.pairs) sketches_[m.a].set(bit_of(m.b));
  }
  bool may_meet(std::uint32_t j, std::uint32_t k) const { return sketches_[j].test(bit_of(k)); }

  // Every triple is found from its smallest member; with two that are parallel at every angle, from the third one, the
  // only one that crosses both.
  void triples_of(std::uint32_t a) {
    std::vector<LineCrossing>& list = crossings_[a];
    orders_.find(a, list);
    for (std::size_t k = 0; k < list.size(); ++k)
      for (std::size_t l = k + 1; l < list.size() && list[l].low <= list[k].high; ++l) {
        if ((list[k].order == list[l].order && list[k].order != 0) ||
            heading_of_[list[k].other] == heading_of_[list[l].other])
          continue;
        const std::uint32_t b = std::min(list[k].other, list[l].other), c = std::max(list[k].other, list[l].other);
        if (a < b || forms_.parallel(w_.segments[b], w_.segments[c])) triple(a, b, c);
      }
  }

  struct Root {
    double theta = 0, error = 0;
  };
  // The root of a form that is monotone around `midpoint`, within at most kKnownRoot; nothing where doubles do not find
  // one.
  std::optional<Root> only_root(const TrigForm2& g, double error, double midpoint, double half) const {
    const double least = std::abs(g.slope(Heading::of(midpoint))) - 3 * g.bend() * half;
    if (!(least > 0)) return std::nullopt;
    double theta = midpoint;
    for (int k = 0; k < 4; ++k) {
      const Heading h = Heading::of(theta);
      theta -= g.at(h) / g.slope(h);
      if (!(std::abs(theta - midpoint) <= 2 * half)) return std::nullopt;
    }
    // The slope is at least `least` up to twice `half` from the midpoint.
    const double off = (std::abs(g.at(Heading::of(theta))) + error) / least;
    return off < kKnownRoot ? std::optional<Root>({theta, off}) : std::nullopt;
  }

  // Whether doubles leave a root in the window at which the three may meet at a position that is not covered. By parts
  // of the window, in which most forms are monotone.
  bool may_matter(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c, const TrigForm2& g,
                  double error) const {
    constexpr int kParts = 4;
    const double half = w_.half / kParts * kWider;
    for (int k = 0; k < kParts; ++k) {
      const double midpoint = w_.midpoint + w_.half * (2 * k + 1 - kParts) / kParts;
      if (g.far_from_zero(Heading::of(midpoint), half, error)) continue;
      const std::optional<Root> root = only_root(g, error, midpoint, half);
      if (!root) return true;
      if (!all_cross(a, b, c, root->theta, root->error)) continue;
      RotationEvent event;
      event.kind = RotationEvent::Kind::three_segments;
      event.low = root->theta - root->error;
      event.high = root->theta + root->error;
      event.a = a;
      event.b = b;
      event.c = c;
      if (!covered(event)) return true;
    }
    return false;
  }

  void triple(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    ++out_.triples;
    if (!may_meet(j, k) || !w_.meet(j, k)) return;
    const WalkSegment &a = w_.segments[i], &b = w_.segments[j], &c = w_.segments[k];
    if (same_direction(forms_, b, c)) return;  // overlaps() sees to it
    const TrigForm2 g = forms_.concurrency(a, b, c);
    const double error = forms_.concurrency_error(a, b, c);
    if (g.far_from_zero(w_.heading, w_.half, error)) return;
    if (ends_.at_end(g, error, [&](const QuarterTurn& end) { return end.concurrent(a, b, c); })) return;
    if (ends_.sign_beside(a, b, c) != 0) return;
    if (may_matter(a, b, c, g, error)) add_triple(a, b, c);
  }
  void add_triple(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c,
                  const std::vector<NearRoot>* where = nullptr) {
    const exact::Polynomial poly = forms_.exact_concurrency(a, b, c, w_.range.chart);
    if (poly.is_zero()) {
      out_.always_concurrent.push_back({a, b, c});
      return;
    }
    for (AlgebraicRoot& root : roots(poly, where)) {
      RotationEvent event = at(std::move(root), RotationEvent::Kind::three_segments);
      if (!all_cross(a, b, c, event.theta(), (event.high - event.low) / 2)) continue;
      event.a = a;
      event.b = b;
      event.c = c;
      if (!covered(event)) out_.events.push_back(std::move(event));
    }
  }
  // False where, within `error` of theta, not all three exist or one of them does not hold its crossing with another.
  bool all_cross(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c, double theta, double error) const {
    for (const WalkSegment* s : {&a, &b, &c})
      if (!may_exist_near(*s, theta, error)) return false;
    const Heading h = Heading::of(theta);
    const std::array<const WalkSegment*, 3> s{&a, &b, &c};
    for (int x = 0; x < 3; ++x)
      for (const int y : {(x + 1) % 3, (x + 2) % 3})
        if (crosses_elsewhere(*s[x], *s[y], h, error)) return false;
    return true;
  }
  // The parameter n / d of b's line along a is clearly off a: by more than what n and d err by, and what the angle
  // moves them by, over a d that is known by half.
  bool crosses_elsewhere(const WalkSegment& a, const WalkSegment& b, Heading h, double error) const {
    const TrigForm side = forms_.side(b, TurningForms::start(a)), cross = forms_.cross(a, b);
    const double n = side.at(h), d = cross.at(h), t = n / d, lengths = forms_.length1(a) * forms_.length1(b),
                 n_error = forms_.side_error(b) + error * side.swing(),
                 d_error = kTurnedCross * lengths + error * cross.swing();
    if (!(std::abs(d) > kNear * lengths && std::abs(d) > 2 * d_error)) return false;
    const double slack = kNear + 2 * (n_error + std::abs(t) * d_error) / std::abs(d);
    return t < -slack || t > 1 + slack;
  }

  bool covered(const RotationEvent& event) const {
    return filter_ != nullptr && provably_covered(event, forms_, *filter_);
  }

  RotationEvent at(AlgebraicRoot root, RotationEvent::Kind kind) const {
    RotationEvent event;
    event.kind = kind;
    event.root = std::move(root);
    set_angles(event, w_.range);
    return event;
  }

  const EventWindow& w_;
  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const OverlapFilter* filter_;
  WindowEnds ends_;
  const NearAngle* near_;
  CrossingOrders orders_;
  const std::function<void()>& again_;
  std::vector<std::vector<LineCrossing>> crossings_;
  std::vector<std::uint32_t> heading_of_;   // of segments
  std::vector<std::bitset<512>> sketches_;  // of the meetings of segments with later ones
  RotationEvents out_;
};

}  // namespace

RotationEvents events_in(const EventWindow& window, const TurningForms& forms, const RotationCatalog& catalog,
                         const std::vector<Alignment>& all, const OverlapFilter* filter, const QuarterEnds& ends,
                         const std::function<void()>& again) {
  return Collector(window, forms, catalog, filter, ends, again).run(all);
}

// All pairs of edges by the angle at which they point in the same direction, and that angle exactly.

const exact::AlgebraicRoot& exact_root(RotationEvent& event, const TurningForms& forms, const RotationRange& range) {
  if (!event.root) {
    // Edges are parallel twice a turn, once in each chart.
    std::vector<exact::AlgebraicRoot> roots =
        roots_in(forms.exact_alignment(event.e, event.f, range.chart), range.t_low, range.t_high);
    event.root = std::move(roots.at(0));
    set_angles(event, range);
  }
  return *event.root;
}

std::vector<Alignment> alignments(const TurningForms& forms, const RotationCatalog& catalog) {
  std::vector<Alignment> all;
  const Operand &fixed = forms.operand(0), &turning = forms.operand(1);
  for (std::uint32_t e = 0; e < turning.size(); ++e)
    for (std::uint32_t f = 0; f < fixed.size() && !forms.is_point(1, e); ++f) {
      if (forms.is_point(0, f)) continue;
      const bool any = catalog.may_exist({1, e, f}) || catalog.may_exist({1, e, fixed.next[f]}) ||
                       catalog.may_exist({0, f, e}) || catalog.may_exist({0, f, turning.next[e]});
      if (!any) continue;
      const double theta = positive_angle(catalog.edge_angle(0, f) - catalog.edge_angle(1, e));
      // The first window begins at -pi / 2 and does not hold it; what doubles leave open there is tried in both.
      const double end = 1.5 * std::numbers::pi;
      if (theta <= end + 2 * kAngleSlack) all.push_back({theta, e, f});
      if (theta >= end - 2 * kAngleSlack) all.push_back({theta - kTurn, e, f});
    }
  std::stable_sort(all.begin(), all.end(), [](const Alignment& a, const Alignment& b) { return a.theta < b.theta; });
  return all;
}

}  // namespace dymsum::planar
