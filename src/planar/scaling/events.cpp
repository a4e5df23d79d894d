#include "planar/scaling/events.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

using exact::BigRational;

namespace {

class Collector {
 public:
  Collector(const Window& window, const ExactForms& forms, const BigRational& low, const BigRational& high,
            const std::function<void()>& again)
      : window_(window), forms_(forms), low_(low), high_(high), again_(again) {}

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
  // After so many pairs, some of which cost exact roots.
  void count(std::uint32_t pairs) {
    constexpr std::uint32_t kBetween = 1024;
    since_ += pairs;
    if (since_ < kBetween) return;
    since_ = 0;
    again_();
  }

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
    count(16);
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
    for (std::uint32_t k = first; k < last; ++k) {
      count(last - k);
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
  }

  const Window& window_;
  const ExactForms& forms_;
  const BigRational &low_, &high_;
  const std::function<void()>& again_;
  std::uint32_t since_ = 0;
  std::vector<EventValue> values_;
};

}  // namespace

std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const BigRational& low,
                                  const BigRational& high, const std::function<void()>& again) {
  return Collector(window, forms, low, high, again).run();
}

}  // namespace dymsum::planar
