#include "planar/frame/scaling_events.h"

#include <algorithm>
#include <cmath>

#include "planar/operand/lattice.h"
#include "planar/window/scaling_pairs.h"

namespace dymsum::planar {

using exact::BigInteger;
using exact::BigRational;

namespace {

/// A range of tau, closed. Nothing where low > high.
struct Taus {
  double low, high;
  bool empty() const { return !(low <= high); }
};

/// The parameters in a range at which a + b tau, known up to `error`, may vanish.
Taus zeros_of(const Linear& g, double error, const Taus& in) {
  const double at_low = g.at(in.low), at_high = g.at(in.high);
  if ((at_low > error && at_high > error) || (at_low < -error && at_high < -error)) return {1, 0};
  if (g.b == 0 || (std::abs(at_low) <= error && std::abs(at_high) <= error)) return in;
  const double root = -g.a / g.b, wide = root_error(root, g.b, error, in.high);
  return {std::max(in.low, root - wide), std::min(in.high, root + wide)};
}

class Collector {
 public:
  Collector(const Window& window, const ExactForms& forms, const BigRational& low, const BigRational& high,
            const std::function<void()>& again)
      : window_(window),
        forms_(forms),
        low_(low),
        high_(high),
        again_(again),
        search_(window),
        point_error_(kWindowPoint * window.span()),
        scale_moves_(window.frame().moving == window.base().moved),
        all_{window.frame().tau0, window.frame().tau1} {}

  std::vector<EventValue> run() {
    for (const Candidate& c : window_.candidates) ends(window_.pieces[c.a].segment, window_.pieces[c.b].segment, c);
    for (const auto& [i, j] : window_.touching) ends_of(i, j);
    for (const auto& [i, j] : window_.folds) ends_of(i, j);
    for (std::uint32_t i = 0; i < window_.pieces.size(); ++i) orders(i);
    if (!window_.points.empty()) points();
    // Nearest doubles tell all but nearly equal ones.
    const auto order = [](const Value& a, const Value& b) {
      if (a.near != b.near) return a.near < b.near ? -1 : 1;
      const BigInteger gap = numerator(a.s) * denominator(b.s) - numerator(b.s) * denominator(a.s);
      return gap.sign();
    };
    std::sort(values_.begin(), values_.end(), [&](const Value& a, const Value& b) {
      const int o = order(a, b);
      return o < 0 || (o == 0 && a.kind < b.kind);
    });
    std::vector<EventValue> events;
    const Value* last = nullptr;
    for (Value& v : values_) {
      if (last != nullptr && order(*last, v) == 0) {
        events.back().at.push_back(v.at);
        continue;
      }
      events.push_back({v.s, v.kind, {v.at}});
      last = &v;
    }
    return events;
  }

 private:
  // Progress is reported after so many pairs, some of which cost exact roots.
  void count(std::uint32_t pairs) {
    constexpr std::uint32_t kBetween = 1024;
    since_ += pairs;
    if (since_ < kBetween) return;
    since_ = 0;
    again_();
  }

  struct Value {
    BigRational s;
    double near;  // the nearest double
    ScaleEvent::Kind kind;
    SegmentPosition at;
  };
  // `position(tau)`: the position in the window, known up to `error`.
  template <class At>
  void add(const ExactForm& form, ScaleEvent::Kind kind, const Segment& on, const Cut& cut, At position, double error) {
    held_.add(kBesideValue);
    Value v{*form.root(), 0, kind, {on, cut, {}, false, 0, 0, 0}};
    v.near = exact::round_to_double(v.s);
    const double tau = scale_moves_ ? v.near : exact::round_to_double(BigRational(1 / v.s)),
                 grow = scale_moves_ ? 1 : v.near;
    const auto [x, y] = position(tau);
    v.at.x = grow * x;
    v.at.y = grow * y;
    v.at.error = grow * (error + kWindowPoint * window_.span()) * exact::kOutwards;
    values_.push_back(std::move(v));
  }

  // Whether a form has its root in the range of scales, and as far as doubles decide at one of these tau: the quotient
  // of its rounded coefficients errs by four roundings. It is not brought into lowest terms for that.
  bool has_root(const ExactForm& form, const Taus& at) const {
    constexpr double kWider = 1 + 0x1p-50;
    if (form.a.sign() * form.b.sign() >= 0) return false;
    const double a = form.a.convert_to<double>(), b = form.b.convert_to<double>(), s = -a / b,
                 tau = scale_moves_ ? s : 1 / s;
    if (std::isfinite(a) && std::isfinite(b) && (tau * kWider < at.low || tau > at.high * kWider)) return false;
    return form.sign_at(low_) * form.sign_at(high_) <= 0;
  }
  // The sign of a form at the root of another one.
  static int sign_at_root(const ExactForm& form, const ExactForm& of) {
    return BigInteger(form.a * of.b - form.b * of.a).sign() * of.b.sign();
  }

  // v is on the line of s where a form vanishes: is it on the closed segment?
  bool on(const Segment& s, Pair v, const ExactForm& zero) const {
    return sign_at_root(forms_.along(s, v), zero) >= 0 && sign_at_root(forms_.along(reversed(s), v), zero) >= 0;
  }

  // An end of a live segment, exactly and in doubles.
  struct End {
    Pair exact;
    Linear x, y;
  };
  std::array<End, 2> ends_of_segment(std::uint32_t i) const {
    const LiveSegment& s = window_.segments[i];
    const auto plus = [&](const Linear& from, double d) {
      return s.moving ? Linear{from.a, from.b + d} : Linear{from.a + d, from.b};
    };
    return {End{window_.exact(s.start), s.x, s.y}, End{window_.exact(s.end), plus(s.x, s.dx), plus(s.y, s.dy)}};
  }

  // What moves in a straight line lies in the open sum at all of these scales. What meets there does not change the
  // boundary: the open sum is open in space and scale together.
  template <class At>
  bool covered(At position, double error, const Taus& at) {
    if (!window_.edges_prove) return false;
    const auto position_at = [&](double tau) {
      const auto [x, y] = position(tau);
      return EdgeSearch::Position{x, y, error, tau};
    };
    return search_.find_or_spare(position_at(at.low), position_at(at.high)).has_value();
  }

  // Scales at which an end of one segment comes onto the other.
  void ends(std::uint32_t i, std::uint32_t j, const Candidate& c) {
    // Crossing throughout the window: no end comes near.
    if (c.in_low <= all_.low && c.in_high >= all_.high) return;
    ends_of(i, j);
  }

  void ends_of(std::uint32_t i, std::uint32_t j) {
    count(16);
    const std::array<End, 2> of_i = ends_of_segment(i), of_j = ends_of_segment(j);
    for (const End& v : of_j) comes_onto(i, of_i, v);
    for (const End& v : of_i) comes_onto(j, of_j, v);
  }

  // Scales at which v comes onto a segment.
  void comes_onto(std::uint32_t segment, const std::array<End, 2>& of, const End& v) {
    const LiveSegment& s = window_.segments[segment];
    const double error = kWindowSide * window_.span() * (std::abs(s.dx) + std::abs(s.dy));
    const auto from = [&](const End& end) {
      return std::array{Linear{v.x.a - end.x.a, v.x.b - end.x.b}, Linear{v.y.a - end.y.a, v.y.b - end.y.b}};
    };
    const auto [wx, wy] = from(of[0]);
    const Taus at = zeros_of({s.dx * wy.a - s.dy * wx.a, s.dx * wy.b - s.dy * wx.b}, error, all_);
    if (at.empty()) return;
    // The vertex is beyond an end at all of them.
    const auto ahead = [&](const Linear& x, const Linear& y, double tau) {
      return s.dx * x.at(tau) + s.dy * y.at(tau);
    };
    const auto [ux, uy] = from(of[1]);
    if (ahead(wx, wy, at.low) < -error && ahead(wx, wy, at.high) < -error) return;
    if (ahead(ux, uy, at.low) > error && ahead(ux, uy, at.high) > error) return;
    const auto position = [&](double tau) { return std::pair{v.x.at(tau), v.y.at(tau)}; };
    if (covered(position, point_error_, at)) return;
    const Segment exact = window_.exact(segment);
    const ExactForm side = forms_.side(exact, v.exact);
    const auto add_vertex = [&](const ExactForm& form) {
      add(form, ScaleEvent::Kind::vertex_on_segment, exact, {Cut::Kind::pair, v.exact, {}}, position, point_error_);
    };
    if (side.always_zero()) {
      // A vertex that stays on the line reaches an end: then two vertices meet.
      for (const Segment& along : {exact, reversed(exact)})
        if (const ExactForm form = forms_.along(along, v.exact); has_root(form, at)) add_vertex(form);
      return;
    }
    if (has_root(side, at) && on(exact, v.exact, side)) add_vertex(side);
  }

  /// A sum of two points, and what it sweeps in the window.
  struct Spot {
    WalkPair walk;
    End at;
    double x0, y0, x1, y1;
  };
  Spot spot(WalkPair v) const {
    const MovingPoint at = window_.position(v);
    const auto [x0, x1] = std::minmax({at.x.at(all_.low), at.x.at(all_.high)});
    const auto [y0, y1] = std::minmax({at.y.at(all_.low), at.y.at(all_.high)});
    return {
        v, {window_.exact(v), at.x, at.y}, x0 - point_error_, y0 - point_error_, x1 + point_error_, y1 + point_error_};
  }

  // Scales at which a sum of two points comes onto a segment, or onto another such sum.
  void points() {
    std::vector<Spot> spots;
    for (const WalkPair& v : window_.points) spots.push_back(spot(v));
    for (std::uint32_t i = 0; i < window_.segments.size(); ++i) {
      const std::array<End, 2> of = ends_of_segment(i);
      for (const Spot& s : spots) {
        count(1);
        comes_onto(i, of, s.at);
      }
    }
    std::sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.x0 < b.x0; });
    for (std::size_t i = 0; i < spots.size(); ++i)
      for (std::size_t j = i + 1; j < spots.size() && spots[j].x0 <= spots[i].x1; ++j) {
        count(1);
        if (spots[j].y0 <= spots[i].y1 && spots[i].y0 <= spots[j].y1) meet(spots[i], spots[j]);
      }
  }

  // The scale at which two sums of points are one, unless they are so at all: on a line through the points of one
  // operand, on which the sums stay, one passes the other.
  void meet(const Spot& a, const Spot& b) {
    const Pair u = a.at.exact, v = b.at.exact;
    const auto input = [&](std::uint32_t op, std::uint32_t k) { return window_.base().lattice->points[op]->input[k]; };
    const bool by_p = !(input(0, u.p) == input(0, v.p));
    const Segment line = by_p ? Segment{{0, u.p, v.p}, u.q} : Segment{{1, u.q, v.q}, u.p};
    if (!forms_.side(line, v).always_zero()) return;
    const auto position = [&](double tau) { return std::pair{a.at.x.at(tau), a.at.y.at(tau)}; };
    if (const ExactForm form = forms_.along(line, v); has_root(form, all_))
      add(form, ScaleEvent::Kind::vertex_on_segment, line, {Cut::Kind::pair, v, {}}, position, point_error_);
  }

  // Two segments that are not parallel have a point in common where a form vanishes.
  bool touch(std::uint32_t i, std::uint32_t j, const ExactForm& zero) const {
    const Segment a = window_.exact(i), b = window_.exact(j);
    const auto apart = [&](const Segment& line, Pair u, Pair v) {
      return sign_at_root(forms_.side(line, u), zero) * sign_at_root(forms_.side(line, v), zero) > 0;
    };
    return !apart(a, start_of(b), end_of(b)) && !apart(b, start_of(a), end_of(a));
  }

  // Scales at which two crossings on a piece change places.
  void orders(std::uint32_t i) {
    const std::uint32_t first = window_.first_of[i], last = window_.first_of[i + 1];
    for (std::uint32_t k = first; k < last; ++k) {
      count(last - k);
      for (std::uint32_t l = k + 1; l < last; ++l)
        change_positions(i, window_.candidates[window_.of[k]], window_.candidates[window_.of[l]]);
    }
  }

  void change_positions(std::uint32_t i, const Candidate& x, const Candidate& y) {
    if (x.sign == 0 || y.sign == 0) return;
    const Taus both{std::max({x.out_low, y.out_low, all_.low}), std::min({x.out_high, y.out_high, all_.high})};
    if (both.empty()) return;
    const auto line = [&](const Candidate& c) { return c.a == i ? c.ta : c.tb; };
    const auto error = [&](const Candidate& c) { return c.a == i ? c.error_a : c.error_b; };
    const Linear tx = line(x), ty = line(y);
    const double slack = error(x) + error(y);
    const Taus at = slack < INFINITY ? zeros_of({tx.a - ty.a, tx.b - ty.b}, slack, both) : both;
    if (at.empty()) return;
    const std::uint32_t s = window_.pieces[i].segment, a = window_.pieces[x.a == i ? x.b : x.a].segment,
                        b = window_.pieces[y.a == i ? y.b : y.a].segment;
    if (a == b) return;
    // Where the line that is known better crosses.
    const bool first = error(x) <= error(y);
    const Linear& t = first ? tx : ty;
    const LiveSegment& on = window_.segments[s];
    const auto position = [&](double tau) {
      const double along = t.at(tau);
      return std::pair{on.x.at(tau) + along * on.dx, on.y.at(tau) + along * on.dy};
    };
    const double t_error = std::min(error(x), error(y)) + kFraction * std::max(1.0, at.high),
                 position_error = t_error * std::max(std::abs(on.dx), std::abs(on.dy)) + point_error_;
    if (std::isfinite(position_error) && covered(position, position_error, at)) return;
    const ExactForm form = forms_.concurrent(window_.exact(s), window_.exact(a), window_.exact(b));
    if (has_root(form, at) && touch(s, a, form) && touch(s, b, form) && touch(a, b, form))
      add(form, ScaleEvent::Kind::three_segments, window_.exact(s),
          {Cut::Kind::crossing, {}, window_.exact(first ? a : b)}, position, position_error);
  }

  const Window& window_;
  const ExactForms& forms_;
  const BigRational &low_, &high_;
  const std::function<void()>& again_;
  EdgeSearch search_;
  double point_error_;
  bool scale_moves_;  ///< tau is the scale, not one over it
  Taus all_;
  std::uint32_t since_ = 0;
  // What a value has in memory beside itself: the digits of its scale, and its place in the list of the result.
  static constexpr std::size_t kBesideValue = sizeof(EventValue) + 2 * sizeof(SegmentPosition);
  base::CountedArray<Value> values_;
  base::HeldMemory held_;
};

}  // namespace

bool is_covered(const EventValue& event, ExactFrame& frame) {
  return std::all_of(event.at.begin(), event.at.end(), [&](const SegmentPosition& position) {
    if (std::isfinite(position.error)) return frame.collision().overlaps(position);
    SegmentPosition near = position;  // nearly parallel lines, of which the doubles know nothing
    round_position(frame.lattice(), near);
    return frame.collision().overlaps(near);
  });
}

std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const BigRational& low,
                                  const BigRational& high, const std::function<void()>& again) {
  return Collector(window, forms, low, high, again).run();
}

}  // namespace dymsum::planar
