#include "planar/scaling/events.h"

#include <algorithm>
#include <cmath>

#include "planar/scaling/scaling_state.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

class Collector {
 public:
  Collector(const Window& window, const ExactForms& forms, const BigRational& low, const BigRational& high)
      : window_(window), forms_(forms), low_(low), high_(high) {}

  std::vector<EventValue> run() {
    for (const Candidate& c : window_.candidates) ends(window_.pieces[c.a].segment, window_.pieces[c.b].segment, c);
    for (const auto& [i, j] : window_.touching) ends_of(i, j);
    for (const auto& [i, j] : window_.folds) ends_of(i, j);
    for (std::uint32_t i = 0; i < window_.pieces.size(); ++i) orders(i);
    std::sort(values_.begin(), values_.end(),
              [](const EventValue& a, const EventValue& b) { return a.s < b.s || (a.s == b.s && a.kind < b.kind); });
    values_.erase(std::unique(values_.begin(), values_.end(),
                              [](const EventValue& a, const EventValue& b) { return a.s == b.s; }),
                  values_.end());
    return std::move(values_);
  }

 private:
  bool within(const BigRational& s) const { return s >= low_ && s <= high_; }

  // v is on the line of s at this scale: is it on the closed segment?
  bool on(const Segment& s, Pair v, const BigRational& at) const {
    const Segment back{{s.edge.op, s.edge.to, s.edge.from}, s.vertex};
    return forms_.along(s, v).sign_at(at) >= 0 && forms_.along(back, v).sign_at(at) >= 0;
  }

  // Scales at which an end of one segment comes onto the other.
  void ends(std::uint32_t i, std::uint32_t j, const Candidate& c) {
    const double tau0 = window_.frame().tau0, tau1 = window_.frame().tau1;
    // Crossing throughout the window: no end comes near.
    if (c.in_low <= tau0 && c.in_high >= tau1) return;
    ends_of(i, j);
  }

  void ends_of(std::uint32_t i, std::uint32_t j) {
    const Segment a = window_.exact(i), b = window_.exact(j);
    const auto test = [&](const Segment& s, Pair v) {
      const std::optional<BigRational> root = forms_.side(s, v).root();
      if (root && within(*root) && on(s, v, *root)) values_.push_back({*root, ScaleEvent::Kind::vertex_on_segment});
    };
    for (const Pair v : {start_of(b), end_of(b)}) test(a, v);
    for (const Pair v : {start_of(a), end_of(a)}) test(b, v);
    // A vertex that stays on the other's line reaches its ends: then two vertices meet.
    const auto meet = [&](Pair v, const Segment& along) {
      const std::optional<BigRational> root = forms_.along(along, v).root();
      if (root && within(*root)) values_.push_back({*root, ScaleEvent::Kind::vertex_on_segment});
    };
    for (const auto& [s, other] : {std::pair{a, b}, std::pair{b, a}})
      for (const Pair v : {start_of(other), end_of(other)})
        if (forms_.side(s, v).always_zero()) {
          meet(v, s);
          meet(v, {{s.edge.op, s.edge.to, s.edge.from}, s.vertex});
        }
  }

  // Two segments that are not parallel have a point in common at this scale.
  bool touch(std::uint32_t i, std::uint32_t j, const BigRational& at) const {
    const Segment a = window_.exact(i), b = window_.exact(j);
    return forms_.side(a, start_of(b)).sign_at(at) * forms_.side(a, end_of(b)).sign_at(at) <= 0 &&
           forms_.side(b, start_of(a)).sign_at(at) * forms_.side(b, end_of(a)).sign_at(at) <= 0;
  }

  // Scales at which two crossings on a piece change places.
  void orders(std::uint32_t i) {
    const std::uint32_t first = window_.first_of[i], last = window_.first_of[i + 1];
    const auto line = [&](const Candidate& c) { return c.a == i ? c.ta : c.tb; };
    const auto error = [&](const Candidate& c) { return c.a == i ? c.error_a : c.error_b; };
    for (std::uint32_t k = first; k < last; ++k)
      for (std::uint32_t l = k + 1; l < last; ++l) {
        const Candidate &x = window_.candidates[window_.of[k]], &y = window_.candidates[window_.of[l]];
        if (x.sign == 0 || y.sign == 0) continue;
        const double u = std::max({x.out_low, y.out_low, window_.frame().tau0}),
                     v = std::min({x.out_high, y.out_high, window_.frame().tau1});
        if (!(u <= v)) continue;
        const double gap_u = line(x).at(u) - line(y).at(u), gap_v = line(x).at(v) - line(y).at(v),
                     slack = error(x) + error(y);
        if ((gap_u > slack && gap_v > slack) || (gap_u < -slack && gap_v < -slack)) continue;
        const std::uint32_t s = window_.pieces[i].segment, a = window_.pieces[x.a == i ? x.b : x.a].segment,
                            b = window_.pieces[y.a == i ? y.b : y.a].segment;
        if (a == b) continue;
        const std::optional<BigRational> root =
            forms_.concurrent(window_.exact(s), window_.exact(a), window_.exact(b)).root();
        if (root && within(*root) && touch(s, a, *root) && touch(s, b, *root) && touch(a, b, *root))
          values_.push_back({*root, ScaleEvent::Kind::three_segments});
      }
  }

  const Window& window_;
  const ExactForms& forms_;
  const BigRational &low_, &high_;
  std::vector<EventValue> values_;
};

}  // namespace

std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const BigRational& low,
                                  const BigRational& high) {
  return Collector(window, forms, low, high).run();
}

}  // namespace dymsum::planar

namespace dymsum {

using namespace planar;
using exact::BigRational;

namespace {

/// What makes two sums topologically different.
struct Topology {
  std::size_t parts = 0, holes = 0, tight_points = 0, tight_segments = 0, segments = 0, points = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};

Topology topology_of(const PlanarSum& s) {
  return {s.parts.size(),          s.hole_count(),    s.tight_points.size(),
          s.tight_segments.size(), s.segments.size(), s.points.size()};
}

struct Snapshot {
  std::uint64_t hash = 0;
  Topology topology;
};

/// Walks upwards through the events, window by window, looking at the sum between them and at them.
class EventWalk {
 public:
  EventWalk(const planar::ScalingState& state, planar::ScalingState& probe) : state_(state), probe_(probe) {}

  /// Calls f(event) for the events in [from, to] in order until it returns false. Errors: cancelled, and those of
  /// frames.
  template <class F>
  std::optional<Error> run(const BigRational& from, const BigRational& to, const Progress& progress, F&& f) {
    // Neighbours just outside decide what lies before the first and behind the last.
    BigRational low = from * BigRational(1023, 1024);
    const BigRational end = to * BigRational(1025, 1024);
    const double all = std::log(exact::round_to_double(BigRational(end / low)));
    std::optional<BigRational> last;
    std::optional<Snapshot> before;
    while (low < end) {
      if (progress && !progress("events", 1 - std::log(exact::round_to_double(BigRational(end / low))) / all))
        return Error{ErrorCode::cancelled, "stopped on request", {}};
      const BigRational high = std::min<BigRational>(BigRational(low * kRatio), end);
      const std::unique_ptr<Window> window = probe_.windows.between(low, high);
      std::vector<EventValue> values = events_of(*window, state_.forms(), low, high);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const EventValue& e = values[i];
        if (last && e.s == *last) continue;  // on the border of two windows
        const BigRational previous = last ? *last : BigRational(low * BigRational(1023, 1024));
        const bool wanted = e.s >= from && e.s <= to;
        const bool next_wanted = e.s <= to;
        if (wanted) {
          const BigRational next = i + 1 < values.size() ? values[i + 1].s
                                                         : (high < end ? next_after(high, end)
                                                                       : BigRational(high * BigRational(1025, 1024)));
          if (!before) {
            Result<Snapshot> at = look(simple_between(previous, e.s));
            if (!at) return at.error();
            before = *at;
          }
          const Result<Snapshot> here = look(e.s), after = look(simple_between(e.s, next));
          if (!here) return here.error();
          if (!after) return after.error();
          ScaleEvent event;
          event.s = exact::to_rational(e.s);
          event.approx = exact::round_to_double(e.s);
          event.kind = e.kind;
          event.topology = !(before->topology == after->topology) || !(here->topology == before->topology);
          event.visible = event.topology || before->hash != after->hash;
          if (!f(event)) return std::nullopt;
          before = *after;
        }
        last = e.s;
        if (!next_wanted) return std::nullopt;
      }
      low = high;
    }
    return std::nullopt;
  }

 private:
  static inline const BigRational kRatio{17, 16};

  BigRational next_after(const BigRational& low, const BigRational& end) {
    BigRational from = low;
    while (from < end) {
      const BigRational to = std::min<BigRational>(BigRational(from * kRatio), end);
      const std::unique_ptr<Window> window = probe_.windows.between(from, to);
      for (const EventValue& e : events_of(*window, state_.forms(), from, to))
        if (e.s > low) return e.s;
      from = to;
    }
    return BigRational(end * BigRational(1025, 1024));
  }

  Result<Snapshot> look(const BigRational& s) {
    const Result<Scale> scale = Scale::of(exact::to_rational(s));
    if (!scale) return scale.error();
    const Result<FrameChanges> moved = probe_.move_to(*scale, *scale);
    if (!moved) return moved.error();
    return Snapshot{probe_.hash(lines_), topology_of(probe_.sum)};
  }

  const planar::ScalingState& state_;
  planar::ScalingState& probe_;
  LineHashes lines_;
};

std::optional<Error> not_regular(const OperandPair& base) {
  if (base.regular) return std::nullopt;
  return Error{ErrorCode::unsupported_operand, "events are defined for operands without polylines and points", {}};
}

}  // namespace

Result<std::vector<ScaleEvent>> ScalingSum::events(const Scale& a, const Scale& b, const Progress& progress) const {
  if (std::optional<Error> error = not_regular(*state_->base)) return *std::move(error);
  const BigRational low = rational(scale_value(a)), high = rational(scale_value(b));
  if (low > high)
    return Error{ErrorCode::bad_scale,
                 "the range of scales is empty: " + a.exact().to_string() + " > " + b.exact().to_string(),
                 {}};
  MovingOptions options = state_->options;
  options.mode = FrameMode::window;
  options.window = 1.0 / 16;
  options.progress = {};
  State probe(state_->base, options);
  std::vector<ScaleEvent> events;
  EventWalk walk(*state_, probe);
  if (std::optional<Error> error = walk.run(low, high, progress, [&](const ScaleEvent& e) {
        events.push_back(e);
        return true;
      }))
    return *std::move(error);
  return events;
}

Result<std::optional<ScaleEvent>> ScalingSum::next_event(const Scale& s, const Scale& limit, EventChange change,
                                                         const Progress& progress) const {
  if (std::optional<Error> error = not_regular(*state_->base)) return *std::move(error);
  const BigRational low = rational(scale_value(s)), high = rational(scale_value(limit));
  std::optional<ScaleEvent> found;
  if (low >= high) return found;
  MovingOptions options = state_->options;
  options.mode = FrameMode::window;
  options.window = 1.0 / 16;
  options.progress = {};
  State probe(state_->base, options);
  EventWalk walk(*state_, probe);
  if (std::optional<Error> error = walk.run(low, high, progress, [&](const ScaleEvent& e) {
        if (exact::exact_value(e.s) > low && (change == EventChange::topology ? e.topology : e.visible)) found = e;
        return !found;
      }))
    return *std::move(error);
  return found;
}

}  // namespace dymsum
