#include "planar/arrangement/arrangement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace dymsum::planar {

Arrangement::Arrangement(const Soup& soup, Meetings meetings, const Chain& chain,
                         const Array<CoveredMark>& covered_marks, const Poll* poll)
    : soup_(soup),
      chain_(chain),
      meetings_(std::move(meetings)),
      first_event_(soup.memory),
      events_(soup.memory),
      sub_after_(soup.memory),
      flags_(soup.memory),
      linked_subs_(soup.memory),
      links_(soup.memory),
      nodes_(soup.memory),
      covered_subs_(soup.memory),
      cut_segments_(soup.memory),
      suspects_(soup.memory) {
  build_events(poll);
  sort_events(poll);
  flags_.assign(sub_count(), 0);
  mark_covered(covered_marks);
  find_degenerate_nodes(poll);
}

void Arrangement::build_events(const Poll* poll) {
  const std::size_t n = soup_.size();
  first_event_.assign(n + 1, 0);
  if (meetings_.crossings.empty() && meetings_.touches.empty()) return;
  for (const Crossing& c : meetings_.crossings) {
    ++first_event_[c.a + 1];
    ++first_event_[c.b + 1];
  }
  for (const Touch& t : meetings_.touches) ++first_event_[t.segment + 1];
  cut_segments_.resize(n);
  std::uint32_t* cut = cut_segments_.data();
  std::uint32_t* const first = first_event_.data();
  // Twice as many events as crossings, and sub-edges of all segments besides.
  if (2 * meetings_.crossings.size() + meetings_.touches.size() + n >= kNone)
    throw std::length_error("more than 2^32 pieces of segments");
  if (poll != nullptr) (*poll)(0);
  std::uint32_t total = 0;
  for (std::uint32_t s = 0; s < n; ++s) {
    const std::uint32_t count = first[s + 1];
    total += count;
    first[s + 1] = total;
    *cut = s;
    cut += count != 0;
  }
  cut_segments_.resize(static_cast<std::size_t>(cut - cut_segments_.data()));
  events_.resize(total);
  Array<std::uint32_t> at(first_event_.begin(), first_event_.end() - 1, soup_.memory);
  if (poll != nullptr) (*poll)(0);
  for (std::uint32_t c = 0; c < meetings_.crossings.size(); ++c) {
    const Crossing& x = meetings_.crossings[c];
    events_[at[x.a]++] = c;
    events_[at[x.b]++] = c;
  }
  for (std::uint32_t k = 0; k < meetings_.touches.size(); ++k)
    events_[at[meetings_.touches[k].segment]++] = k | kTouchBit;
  sub_after_.resize(meetings_.crossings.size());
}

Cut Arrangement::event_cut(std::uint32_t s, std::uint32_t event) const {
  Cut cut;
  if (event & kTouchBit) {
    cut.pair = soup_.exact(meetings_.touches[event & ~kTouchBit].pair);
  } else {
    cut.kind = Cut::Kind::crossing;
    cut.by = soup_.exact(other(s, event));
  }
  return cut;
}

// The parameter of an event on s, where the soup's integers have 64 bits: 0 at its start, 1 at its end, and d > 0.
struct Arrangement::CutRatio {
  std::int64_t n, d;
};

Arrangement::CutRatio Arrangement::cut_ratio(std::uint32_t s, std::uint32_t event) const {
  const SoupBox& b = soup_.boxes[s];
  CutRatio r;
  if (event & kTouchBit) {
    const WalkPair v = meetings_.touches[event & ~kTouchBit].pair;
    const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
    if (b.dx != 0) r = {soup_.integer(p.x[v.p] + q.x[v.q] - b.ax), soup_.integer(b.dx)};
    else r = {soup_.integer(p.y[v.p] + q.y[v.q] - b.ay), soup_.integer(b.dy)};
  } else {
    const std::uint32_t t = other(s, event);
    r = {soup_.side_value(t, b.ax, b.ay), soup_.cross_value(s, t)};
  }
  return r.d < 0 ? CutRatio{-r.n, -r.d} : r;
}

int Arrangement::compare_events(std::uint32_t s, std::uint32_t a, std::uint32_t b) const {
  if (a == b) return 0;
  const double gap = parameter(s, a) - parameter(s, b), error = parameter_error(s, a) + parameter_error(s, b);
  if (gap > error) return 1;
  if (gap < -error) return -1;
  ++exact_orders_;
  if (soup_.integral()) {
    const CutRatio u = cut_ratio(s, a), v = cut_ratio(s, b);
    const exact::i128 left = exact::i128{u.n} * v.d, right = exact::i128{v.n} * u.d;
    return (left > right) - (left < right);
  }
  return soup_.lattice.compare(soup_.exact(s), event_cut(s, a), event_cut(s, b));
}

namespace {

constexpr std::uint32_t kInsertion = 24;  // up to so many are sorted by insertion

}  // namespace

/// The parameters of the events of one segment, in order.
struct Arrangement::EventTimes {
  struct Timed {
    double t;
    std::uint32_t event;
  };
  explicit EventTimes(Scratch* memory) : times(kInsertion, memory), buffer(memory) {}
  Array<double> times;
  Array<Timed> buffer;  // of many
};

// Returns the bits of all events together.
inline std::uint32_t Arrangement::sort_by_parameter(std::uint32_t s, std::span<std::uint32_t> events,
                                                    EventTimes& to) const {
  const auto n = static_cast<std::uint32_t>(events.size());
  std::uint32_t* const first = events.data();
  Array<double>& times = to.times;
  std::uint32_t kinds = 0;
  if (n <= kInsertion) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t e = first[i];
      const double t = parameter(s, e);
      kinds |= e;
      std::uint32_t j = i;
      for (; j > 0 && t < times[j - 1]; --j) {
        times[j] = times[j - 1];
        first[j] = first[j - 1];
      }
      times[j] = t;
      first[j] = e;
    }
    return kinds;
  }
  to.buffer.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) to.buffer[i] = {parameter(s, first[i]), first[i]};
  std::sort(to.buffer.begin(), to.buffer.end(), [](const EventTimes::Timed& a, const EventTimes::Timed& b) {
    return a.t != b.t ? a.t < b.t : a.event < b.event;
  });
  if (times.size() < n) times.resize(2 * n);
  for (std::uint32_t i = 0; i < n; ++i) {
    times[i] = to.buffer[i].t;
    kinds |= first[i] = to.buffer[i].event;
  }
  return kinds;
}

// Whether some neighbours are closer than their errors. With `fine` those farther apart than kApart need no closer
// look.
inline bool Arrangement::too_close(std::uint32_t s, std::span<const std::uint32_t> events, const EventTimes& at,
                                   bool fine) const {
  bool close = false;
  for (std::size_t i = 1; i < events.size(); ++i) {
    const double gap = at.times[i] - at.times[i - 1];
    if (gap > Meetings::kApart && fine) continue;
    close |= !(gap > parameter_error(s, events[i - 1]) + parameter_error(s, events[i]));
  }
  return close;
}

// Parameters order events. Neighbours that are closer than their errors are compared exactly, and remembered.
void Arrangement::sort_events(const Poll* poll) {
  if (events_.empty()) return;
  const auto sort_exactly = [this](std::uint32_t s, std::span<std::uint32_t> events) {
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return compare_events(s, a, b) < 0; };
    // Events at one position stay in the order in which they come, which insertion keeps and std::sort has to be told.
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      if (const int order = compare_events(s, a, b); order != 0) return order < 0;
      const double t = parameter(s, a), u = parameter(s, b);
      return t != u ? t < u : a < b;
    };
    if (events.size() > kInsertion) return std::sort(events.begin(), events.end(), before);
    for (std::size_t i = 1; i < events.size(); ++i) {
      const std::uint32_t e = events[i];
      std::size_t j = i;
      for (; j > 0 && less(e, events[j - 1]); --j) events[j] = events[j - 1];
      events[j] = e;
    }
  };
  EventTimes times(soup_.memory);
  const bool fine = !meetings_.rough && meetings_.touches.empty();
  const Crossing* const crossings = meetings_.crossings.data();
  for (const std::uint32_t s : cut_segments_) {
    if (poll != nullptr) poll->at(s, soup_.size());
    const std::uint32_t begin = first_event_[s];
    const std::span<std::uint32_t> events(events_.data() + begin, first_event_[s + 1] - begin);
    std::uint32_t kinds = events[0];
    bool close = false;
    if (events.size() > 1) {
      kinds = sort_by_parameter(s, events, times);
      close = too_close(s, events, times, fine);
      if (close) sort_exactly(s, events);
    }
    if (close || (kinds & kTouchBit)) suspects_.push_back(s);
    std::uint32_t sub = begin + s + 1;
    for (const std::uint32_t e : events) {
      if (!(e & kTouchBit) && crossings[e].a == s) sub_after_[e] = sub;
      ++sub;
    }
  }
}

// A mark near an event may fall on either side of it: both sub-edges are no boundary then, so either answer is right.
void Arrangement::mark_covered(const Array<CoveredMark>& marks) {
  for (const CoveredMark& m : marks) {
    const std::uint32_t* first = events_.data() + first_event_[m.segment];
    const std::uint32_t* last = first + event_count(m.segment);
    const auto before = [&](std::uint32_t e) { return parameter(m.segment, e) < m.t; };
    const auto k = std::partition_point(first, last, before) - first;
    flags_[first_sub(m.segment) + k] |= kNoBoundary;
  }
}

SegmentPosition Arrangement::event_position(std::uint32_t s, std::uint32_t event) const {
  return position_of_cut(s, event_cut(s, event), parameter(s, event), parameter_error(s, event));
}

SegmentPosition Arrangement::position_of(const Node& node) const {
  const std::uint32_t s = node.segment, k = node.sub_after - first_sub(s);
  if (k > 0 && k <= event_count(s)) return event_position(s, event(s, k - 1));
  Cut cut;
  cut.pair = soup_.exact(node.end.at);
  return position_of_cut(s, cut, k == 0 ? 0 : 1, 0);
}

SegmentPosition Arrangement::start_position(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  return k == 0 ? position_of_cut(s, start_cut(at), 0, 0) : event_position(s, event(s, k - 1));
}

SegmentPosition Arrangement::end_position(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  return k == event_count(s) ? position_of_cut(s, end_cut(at), 1, 0) : event_position(s, event(s, k));
}

Cut Arrangement::start_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k > 0) return event_cut(at.segment, event(at.segment, k - 1));
  Cut cut;
  cut.pair = soup_.exact(soup_.start(at.segment));
  return cut;
}

Cut Arrangement::end_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k < event_count(at.segment)) return event_cut(at.segment, event(at.segment, k));
  Cut cut;
  cut.pair = soup_.exact(soup_.end(at.segment));
  return cut;
}

SegmentPosition Arrangement::position_of_cut(std::uint32_t s, const Cut& cut, double t, double t_error) const {
  SegmentPosition p;
  p.on = soup_.exact(s);
  p.first = cut;
  const SoupBox& b = soup_.boxes[s];
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  p.x = t == 1 ? b.bx : b.ax + t * dx;
  p.y = t == 1 ? b.by : b.ay + t * dy;
  p.error = t == 0 || t == 1 ? soup_.point_error : soup_.step_error(t_error, dx, dy);
  return p;
}

// The denominators below err by these fractions of themselves: a component of a scaled vector; a cross product of two
// of them, times (|u| + |v|) / |u - v|, and the factor with its product.
constexpr double kLengthFraction = exact::rounding_bound(3, 8), kCrossFraction = exact::rounding_bound(8 + 2, 16);

// |denominator| of a cut's parameter as the lattice takes it, for the mediant.
double Arrangement::denominator(std::uint32_t s, const Cut& cut, double& relative_error) const {
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  if (cut.kind == Cut::Kind::pair) {
    const double length = dx != 0 ? std::abs(dx) : std::abs(dy);
    relative_error = length > exact::kUnderflow ? kLengthFraction : 1.0;
    return length;
  }
  const Point b = soup_.lattice.vector(cut.by.edge);
  const double u = dx * b.y, v = dy * b.x, d = std::abs(u - v);
  relative_error = d > 0 ? std::min(1.0, (kCrossFraction * (std::abs(u) + std::abs(v)) + exact::kUnderflow) / d) : 1.0;
  // The denominator is in the integers of the exact layer, against which the other kind of cut is measured once less.
  return soup_.lattice.in_integers(d);
}

std::optional<double> Arrangement::inner_parameter(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  const double t0 = start_parameter(at), t1 = end_parameter(at);
  const double e0 = k > 0 ? parameter_error(s, event(s, k - 1)) : 0;
  const double e1 = k < event_count(s) ? parameter_error(s, event(s, k)) : 0;
  const double midpoint = 0.5 * (t0 + t1);
  if (!(midpoint - t0 > e0 + kFractionRoundings && t1 - midpoint > e1 + kFractionRoundings)) return std::nullopt;
  return midpoint;
}

SegmentPosition Arrangement::sample(Step at) const {
  const Cut from = start_cut(at), to = end_cut(at);
  double error_from = 0, error_to = 0;
  const double d0 = denominator(at.segment, from, error_from), d1 = denominator(at.segment, to, error_to);
  const double t0 = start_parameter(at), t1 = end_parameter(at);
  double weight = d0 + d1 > 0 ? d1 / (d0 + d1) : 0.5;
  if (!(weight >= 0 && weight <= 1)) {
    weight = 0.5;
    error_from = 1;  // beyond the doubles: anywhere on the sub-edge
  }
  const std::uint32_t k = at.sub - first_sub(at.segment);
  const std::uint32_t* first = events_.data() + first_event_[at.segment];
  const double e0 = k > 0 ? parameter_error(at.segment, first[k - 1]) : 0.0;
  const double e1 = k < event_count(at.segment) ? parameter_error(at.segment, first[k]) : 0.0;
  const double t = t0 + weight * (t1 - t0);
  const double error = e0 + e1 + std::abs(t1 - t0) * kMediantFractions * (error_from + error_to) + kFractionRoundings;
  SegmentPosition p =
      position_of_cut(at.segment, from, t == 0 || t == 1 ? 0.5 : t, error + (t == 0 || t == 1 ? 0.5 : 0));
  p.second = to;
  p.between = true;
  return p;
}

}  // namespace dymsum::planar
