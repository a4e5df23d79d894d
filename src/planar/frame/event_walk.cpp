// Events of a scaling pair: those of its windows, less what changes nothing in the sum between them and at them.
#include "planar/frame/event_walk.h"

#include <algorithm>
#include <cmath>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "planar/frame/frame_rings.h"
#include "planar/frame/scaling_events.h"

namespace dymsum::planar {

LineHashes::LineHashes(std::shared_ptr<const OperandPair> base)
    : base_(std::move(base)),
      forms_(*base_),
      edges_{FirstIndices(base_->operands[0].edge_index), FirstIndices(base_->operands[1].edge_index)},
      vertices_{FirstIndices(base_->operands[0].vertex_index), FirstIndices(base_->operands[1].vertex_index)} {}

Segment LineHashes::segment(const Contact& c) const {
  const bool of_p = c.kind == Contact::Kind::edge_of_p;
  const std::size_t op = of_p ? 0 : 1;
  const Operand &o = base_->operands[op], &other = base_->operands[1 - op];
  return Segment{o.edge(edges_[op][of_p ? c.p : c.q]), other.source[vertices_[1 - op][of_p ? c.q : c.p]]};
}

std::uint64_t LineHashes::line(const Contact& c) {
  const auto [it, fresh] = lines_.try_emplace(key(c), 0);
  if (fresh) it->second = forms_.line_hash(segment(c));
  return it->second;
}

// Lines instead of contacts: where segments coincide at every scale, any of them may be named.
std::uint64_t LineHashes::of(const PlanarSum& sum) {
  std::uint64_t total = sum.parts.size();
  for (const SumRing* ring : rings_of(sum)) {
    std::uint64_t h = ring->vertices.size();
    for (const SumVertex& v : ring->vertices) h += mixed(line(v.in), line(v.out));
    total += mixed(h, 1);
  }
  for (const SumSegment& s : sum.tight_segments) total += mixed(line(s.from.in), 2);
  const auto end = [&](const SumVertex& v) {
    if (v.corner_p != SumVertex::kNone) return mixed(v.corner_p, v.corner_q);
    return mixed(line(v.in), line(v.out));
  };
  for (const SumSegment& s : sum.segments) total += mixed(mixed(end(s.from), end(s.to)), 3);
  for (const SumVertex& v : sum.points) total += mixed(end(v), 4);
  total += 3 * sum.tight_points.size() + 5 * sum.segments.size() + 7 * sum.points.size();
  return total;
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
  EventWalk(ScalingState& probe, const ScalingPath& path, const Progress& progress)
      : probe_(probe), path_(path), windows_(path.swept), lines_(path.swept), poll_(progress) {
    poll_.stage("events");
    const auto& [p, q] = path.swept->operands;
    windows_.edges_prove =
        probe.options.semantics != Semantics::open || !has_component_without_area(p) || !has_component_without_area(q);
  }

  /// Visits the events in [from, to] in order until the visitor ends it. Errors: those of frames. Throws Cancelled.
  Result<void> run(const BigRational& from, const BigRational& to, EventVisitor& visitor) {
    // What lies just outside decides what comes before the first and after the last.
    BigRational low = from * BigRational(1023, 1024);
    const BigRational end = to * BigRational(1025, 1024);
    low_ = std::log(exact::round_to_double(low));
    end_ = std::log(exact::round_to_double(end));
    BigRational last = low;
    std::optional<Snapshot> before;
    while (low < end) {
      const BigRational high = std::min<BigRational>(window_end(low), end);
      const std::vector<EventValue> values = values_between(low, high);
      for (std::size_t i = 0; i < values.size() && values[i].s <= to; ++i) {
        const EventValue& e = values[i];
        if (e.s == last) continue;  // where two windows meet
        if (e.s >= from) {
          const BigRational next = i + 1 < values.size() ? values[i + 1].s : e.s < high ? high : next_after(high, end);
          if (!before) {
            Result<Snapshot> at = look(simple_between(last, e.s));
            if (!at) return at.error();
            before = *at;
            visitor.before_events(probe_);
          }
          const Result<Snapshot> here = look(e.s), after = look(simple_between(e.s, next));
          if (!here) return here.error();
          if (!after) return after.error();
          ScaleEvent event;
          event.parameter = exact::to_rational(e.s);
          event.approx = exact::round_to_double(e.s);
          event.kind = e.kind;
          event.topology = !(before->topology == after->topology) || !(here->topology == before->topology);
          event.visible = event.topology || before->hash != after->hash;
          if (!visitor.passes(event, probe_)) return {};
          before = *after;
        }
        last = e.s;
      }
      if (high > to) return {};
      low = high;
    }
    return {};
  }

 private:
  /// Windows are as wide as their masks prove much of the sum covered, and have short ends.
  BigRational window_end(const BigRational& low) {
    constexpr double kLeast = 0x1p-12, kMost = 1.0 / 16;
    const double at = exact::round_to_double(low);
    windows_.convolution_for(at, at);
    const double width = std::clamp(windows_.widest(at), kLeast, kMost), unit = std::ldexp(1, std::ilogb(at) - 20);
    return exact::exact_value(std::ceil(at * std::exp(width) / unit) * unit);
  }

  /// Queries whether to go on, s being reached.
  void query(double s) {
    fraction_ = std::max(fraction_, std::clamp((std::log(s) - low_) / (end_ - low_), 0.0, 1.0));
    poll_(fraction_);
  }

  std::vector<EventValue> values_between(const BigRational& low, const BigRational& high) {
    query(exact::round_to_double(low));
    const auto again = [this] { poll_(fraction_); };
    const std::unique_ptr<Window> window = windows_.between(low, high, true, again);
    std::vector<EventValue> values = events_of(*window, lines_.forms(), low, high, again);
    std::erase_if(values, [&](const EventValue& e) {
      again();
      ExactFrame frame(path_.swept, scale_value(e.s));
      return is_covered(e, frame);
    });
    return values;
  }

  BigRational next_after(const BigRational& low, const BigRational& end) {
    BigRational from = low;
    while (from < end) {
      const BigRational to = std::min<BigRational>(window_end(from), end);
      for (const EventValue& e : values_between(from, to))
        if (e.s > low) return e.s;
      from = to;
    }
    return end;
  }

  Result<Snapshot> look(const BigRational& s) {
    query(exact::round_to_double(s));
    const auto times = [&](const ScaleValue& factor) {
      return Scale::of(exact::to_rational(BigRational(s * rational(factor))));
    };
    const Result<Scale> x = times(path_.factors.x), y = times(path_.factors.y);
    if (!x) return x.error();
    if (!y) return y.error();
    const Result<FrameChanges> moved = probe_.move_to(*x, *y);
    if (!moved) return moved.error();
    return Snapshot{lines_.of(probe_.sum), topology_of(probe_.sum)};
  }

  ScalingState& probe_;
  const ScalingPath& path_;
  WindowBuilder windows_;
  LineHashes lines_;
  Poll poll_;
  double low_ = 0, end_ = 1,
         fraction_ = 0;  ///< logarithms of the first and the last scale; the fraction that was told last
};

MovingOptions probe_options(MovingOptions options) {
  options.mode = FrameMode::window;
  options.window = 1.0 / 16;
  options.progress = {};
  options.kept_window_bytes = 0;  // scales ascend
  options.memory = 0;             // within that of the sum that is asked
  return options;
}

/// Calls f(event) for the events until it returns false.
template <class F>
class VisitEach final : public EventVisitor {
 public:
  explicit VisitEach(F f) : f_(std::move(f)) {}
  bool passes(const ScaleEvent& event, const ScalingState&) override { return f_(event); }

 private:
  F f_;
};

/// The events of a sum in [low, high], of which f(event) is called until it returns false.
template <class F>
Result<void> walk(const ScalingState& state, const BigRational& low, const BigRational& high, const Progress& progress,
                  F f) {
  return base::within_memory(state.budget(), "the search for events", [&] {
    VisitEach<F> visitor(std::move(f));
    return walk_events({state.base, state.base, {}}, state.options, low, high, progress, visitor);
  });
}

}  // namespace

Result<void> planar::walk_events(const ScalingPath& path, const MovingOptions& options, const BigRational& low,
                                 const BigRational& high, const Progress& progress, EventVisitor& visitor) {
  ScalingState probe(path.given, probe_options(options));
  try {
    return EventWalk(probe, path, progress).run(low, high, visitor);
  } catch (const Cancelled&) {
    return cancelled();
  }
}

Result<std::vector<ScaleEvent>> ScalingSum::events(const Scale& a, const Scale& b, const Progress& progress) const {
  const BigRational low = rational(scale_value(a)), high = rational(scale_value(b));
  if (low > high)
    return Error{ErrorCode::bad_scale,
                 "the range of scales is empty: " + a.exact().to_string() + " > " + b.exact().to_string(),
                 {}};
  std::vector<ScaleEvent> events;
  const Result<void> done = walk(*state_, low, high, progress, [&](const ScaleEvent& e) {
    events.push_back(e);
    return true;
  });
  if (!done) return done.error();
  return events;
}

Result<std::optional<ScaleEvent>> ScalingSum::next_event(const Scale& s, const Scale& limit, EventChange change,
                                                         const Progress& progress) const {
  const BigRational low = rational(scale_value(s)), high = rational(scale_value(limit));
  std::optional<ScaleEvent> found;
  if (low >= high) return found;
  const Result<void> done = walk(*state_, low, high, progress, [&](const ScaleEvent& e) {
    if (exact::exact_value(e.parameter) > low && (change == EventChange::topology ? e.topology : e.visible)) found = e;
    return !found;
  });
  if (!done) return done.error();
  return found;
}

}  // namespace dymsum
