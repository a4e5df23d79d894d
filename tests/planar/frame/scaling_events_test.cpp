// Events: exact values, the sum at them and right beside them, and nothing visible in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/convolution/convolution.h"
#include "planar/frame/parallel_shapes.h"
#include "planar/frame/scaling_same.h"
#include "planar/frame/scaling_sum.h"
#include "planar/motion/operand_pair.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

exact::BigRational value(const ScaleEvent& e) { return exact::exact_value(e.parameter); }
Scale scale_at(const exact::BigRational& v) { return Scale::of(exact::to_rational(v)).value(); }

/// What the static engine says at any rational scale a / b of P, as long as a P and b Q are doubles.
void expect_static(const ScalingSum& sum, const Region& p, const Region& q, const exact::BigRational& s) {
  const double a = static_cast<double>(numerator(s)), b = static_cast<double>(denominator(s));
  if (a > 0x1p40 || b > 0x1p40) return;
  EXPECT_EQ(described(sum.sum(), exact::BigRational(denominator(s))),
            static_answer(p, q, a, b, false, Semantics::closed))
      << s;
}

TEST(ScaleEvents, a_peg_in_a_slot_fits_exactly_at_one_scale) {
  // A 4 x 4 plate with a 2 x 1 hole; the peg is 1 x 1/2 at scale 1.
  RegionData plate;
  plate.parts.push_back({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}}});
  const Region p = Region::create(plate).value(), peg = shapes::rectangle(0, 0, 1, 0.5);
  MovingOptions options;
  options.moving = MovingOperand::q;
  ScalingSum sum = ScalingSum::create(p, negated(peg), options).value();
  const auto next = sum.next_event(Scale(), scale_of(3, 1), EventChange::topology).value();
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->parameter.to_string(), "2/1");
  EXPECT_TRUE(next->topology);
  ASSERT_TRUE(sum.set(2.0).ok());
  EXPECT_EQ(sum.sum().hole_count(), 0u);
  ASSERT_EQ(sum.sum().tight_points.size(), 1u);
  EXPECT_EQ(sum.sum().exact(sum.sum().tight_points[0]), (RationalPoint{*Rational::of(1, 1), *Rational::of(1, 1)}));
  for (const int k : {1, 10, 40}) {
    ASSERT_TRUE(sum.set(2 - std::ldexp(1.0, -k)).ok());
    EXPECT_EQ(sum.sum().hole_count(), 1u) << k;
    EXPECT_TRUE(sum.sum().tight_points.empty());
    ASSERT_TRUE(sum.set(2 + std::ldexp(1.0, -k)).ok());
    EXPECT_EQ(sum.sum().hole_count(), 0u) << k;
    EXPECT_TRUE(sum.sum().tight_points.empty());
  }
}

TEST(ScaleEvents, sums_at_and_beside_events_are_exact_and_nothing_visible_lies_between) {
  int visible = 0, invisible = 0, triples = 0;
  for (int round = 0; round < 12; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 100);
    const auto seed = static_cast<std::uint64_t>(round);
    const bool tiny = round < 8;
    const Region p = tiny ? Region::create(oracles::random_parts(random, 7)).value()
                          : on_integers(shapes::random_polygon(24, 2, seed), 8000);
    const Region q = tiny ? Region::create(oracles::random_parts(random, 4)).value()
                          : on_integers(shapes::noisy_star(9, 0.6, seed), 2000);
    ScalingSum sum = ScalingSum::create(p, q).value();
    const Scale low = tiny ? scale_of(1, 3) : scale_of(9, 10), high = tiny ? scale_of(3, 1) : scale_of(11, 10);
    const std::vector<ScaleEvent> events = sum.events(low, high).value();
    for (std::size_t i = 0; i < events.size(); ++i) {
      const exact::BigRational s = value(events[i]);
      EXPECT_TRUE(s >= exact::exact_value(low.exact()) && s <= exact::exact_value(high.exact()));
      if (i > 0) {
        EXPECT_LT(value(events[i - 1]), s);
      }
      visible += events[i].visible;
      invisible += !events[i].visible;
      triples += events[i].kind == ScaleEvent::Kind::three_segments;
      ASSERT_TRUE(sum.set(scale_at(s)).ok());
      expect_static(sum, p, q, s);
      for (const int k : {20, 30}) {
        const exact::BigRational d(1, exact::BigInteger(1) << k);
        for (const exact::BigRational& t : {exact::BigRational(s - d), exact::BigRational(s + d)}) {
          ASSERT_TRUE(sum.set(scale_at(t)).ok());
          expect_static(sum, p, q, t);
        }
      }
    }
    // Between two events that follow each other the hash is constant.
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      const exact::BigRational a = value(events[i]), b = value(events[i + 1]);
      std::vector<std::uint64_t> hashes;
      for (const int k : {1, 5, 9}) {
        ASSERT_TRUE(sum.set(scale_at(exact::BigRational(a + (b - a) * k / 10))).ok());
        hashes.push_back(sum.combinatorial_hash());
      }
      EXPECT_EQ(hashes[0], hashes[1]) << "round " << round << " between " << a << " and " << b;
      EXPECT_EQ(hashes[1], hashes[2]) << "round " << round << " between " << a << " and " << b;
    }
  }
  EXPECT_GT(visible, 20);
  EXPECT_GT(invisible, 0);  // what is provably inside is not listed
  EXPECT_GT(triples, 5);
}

/// Turned by 30 degrees in doubles: what was parallel is so to 1e-16.
Region turned_30(const Region& region) {
  constexpr double c = 0.8660254037844387, s = 0.49999999999999994;
  RegionData data = region.data();
  for (Part& part : data.parts) {
    for (Point& v : part.outer) v = {c * v.x - s * v.y, s * v.x + c * v.y};
    for (Ring& hole : part.holes)
      for (Point& v : hole) v = {c * v.x - s * v.y, s * v.x + c * v.y};
  }
  return Region::create(std::move(data)).value();
}

/// Every scale in [low, high] at which an end of a segment of the convolution comes onto the line of another one, or
/// along it to the other's end, or the lines of three meet in a point: of all pairs and threes, without any window.
std::vector<exact::BigRational> coincidences(const Region& p, const Region& q, const exact::BigRational& low,
                                             const exact::BigRational& high) {
  const auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  const planar::ReducedConvolution convolution(*base->lattice, base->operands[0], base->operands[1],
                                               planar::never_filled);
  std::vector<planar::Segment> all;
  convolution.for_each([&](const planar::WalkSegment& w) {
    all.push_back({base->operands[w.side].edge(w.edge), base->operands[1 - w.side].source[w.vertex]});
  });
  const planar::ExactForms forms(*base);
  std::vector<exact::BigRational> scales;
  const auto add = [&](const planar::ExactForm& form) {
    if (const auto root = form.root(); root && *root >= low && *root <= high) scales.push_back(*root);
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) {
      for (const planar::Pair v : {planar::start_of(all[j]), planar::end_of(all[j])}) {
        add(forms.side(all[i], v));
        if (forms.side(all[i], v).always_zero()) add(forms.along(all[i], v));
      }
      for (std::size_t k = i + 1; i < j && k < j; ++k) add(forms.concurrent(all[i], all[k], all[j]));
    }
  std::sort(scales.begin(), scales.end());
  scales.erase(std::unique(scales.begin(), scales.end()), scales.end());
  return scales;
}

std::vector<std::size_t> counts_of(const PlanarSum& sum) {
  return {sum.parts.size(), sum.hole_count(), sum.tight_points.size(), sum.tight_segments.size()};
}

TEST(ScaleEvents, every_scale_at_which_the_sum_changes_is_listed_and_no_other_one_is_visible) {
  std::size_t visible = 0, tight = 0;
  const exact::BigRational low(4, 5), high(5, 4);
  for (unsigned round = 0; round < 12; ++round) {
    std::mt19937 engine(round);
    const bool combs = round % 2 == 1;
    Region p = combs ? comb({0, 3}, 2 + round % 3, false) : on_integers(shapes::random_polygon(8, 0, round + 1), 30),
           q = combs ? comb({0}, 1, round % 4 == 1) : on_integers(shapes::random_polygon(6, 0, round + 20), 20);
    if (round >= 4) p = turned_30(p), q = turned_30(q);
    MovingOptions fresh;
    fresh.mode = FrameMode::rebuild;
    ScalingSum sum = ScalingSum::create(p, q, fresh).value();
    const auto at = [&](const exact::BigRational& s) {
      EXPECT_TRUE(sum.set(scale_at(s)).ok());
      return std::pair{sum.combinatorial_hash(), counts_of(sum.sum())};
    };
    std::vector<exact::BigRational> expected;
    const exact::BigRational first(797, 1009), last(1277, 1013);
    const std::vector<exact::BigRational> all = coincidences(p, q, first, last);
    if (all.empty()) continue;
    auto before = at(planar::simple_between(first, all[0]));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const exact::BigRational next = i + 1 < all.size() ? all[i + 1] : last;
      const auto here = at(all[i]), after = at(planar::simple_between(all[i], next));
      const bool changes = before != after || here.second != before.second;
      if (changes && all[i] >= low && all[i] <= high) expected.push_back(all[i]);
      tight += here.second[2] + here.second[3] > 0;
      before = after;
    }
    std::vector<exact::BigRational> found;
    for (const ScaleEvent& e : ScalingSum::create(p, q).value().events(scale_at(low), scale_at(high)).value())
      if (e.visible) found.push_back(value(e));
    EXPECT_EQ(found, expected) << "round " << round;
    visible += expected.size();
  }
  EXPECT_GT(visible, 20u);
  EXPECT_GT(tight, 0u);
}

// What is listed is a statement about the sum: windows and their masks leave nothing of it out.
TEST(ScaleEvents, the_events_of_a_range_are_those_of_its_parts) {
  std::size_t all = 0, invisible = 0;
  for (unsigned round = 0; round < 6; ++round) {
    Region p = shapes::noisy_star(40, 0.7, round + 1), q = shapes::noisy_star(30, 0.7, round + 9);
    if (round % 2 == 1) p = turned_30(comb({0, 3, 7, 11}, 3, false)), q = turned_30(comb({0, 4}, round, false));
    const ScalingSum sum = ScalingSum::create(p, q).value();
    const auto in = [&](long a, long b) {
      std::vector<std::tuple<std::string, bool, bool>> list;
      for (const ScaleEvent& e : sum.events(scale_of(a, 40), scale_of(b, 40)).value())
        list.emplace_back(e.parameter.to_string(), e.visible, e.topology);
      return list;
    };
    auto parts = in(36, 38);
    for (const auto& [from, to] : {std::pair{38, 40}, std::pair{40, 45}})
      for (auto& e : in(from, to))
        if (parts.empty() || parts.back() != e) parts.push_back(e);
    EXPECT_EQ(in(36, 45), parts) << "round " << round;
    all += parts.size();
    for (const auto& e : parts) invisible += !std::get<1>(e);
  }
  EXPECT_GT(all, 60u);
  EXPECT_LT(4 * invisible, all);
}

// One window and no event: what makes the window asks.
TEST(ScaleEvents, progress_is_asked_while_a_window_is_made) {
  const ScalingSum sum = ScalingSum::create(shapes::noisy_star(120, 0.8, 1), shapes::noisy_star(110, 0.8, 2)).value();
  const Scale a = Scale::of(1).value(), b = Scale::of(1 + 0x1p-40).value();
  std::size_t queried = 0;
  const Progress count = [&](std::string_view, double) { return ++queried > 0; };
  const std::size_t events = sum.events(a, b, count).value().size();
  EXPECT_GT(queried, 20 + 2 * events);
  for (std::size_t most = 1; most < queried; most += 1 + queried / 7) {
    std::size_t left = most;
    const Progress stop = [&](std::string_view, double) { return --left > 0; };
    EXPECT_EQ(sum.events(a, b, stop).error().code, ErrorCode::cancelled) << most;
    EXPECT_EQ(left, 0u);
  }
}

// Their crossings were left to exact signs at every scale, and any two of them on one piece to exact roots.
TEST(ScaleEvents, nearly_parallel_segments_are_candidates_only_where_their_lines_are_close) {
  const Region p = turned_30(comb({0, 3, 6, 9}, 3, false)), q = turned_30(comb({0, 2, 5}, 2, false));
  const auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = 0}).value();
  planar::ScalingState state(base, {});
  const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(9, 8));
  std::size_t close = 0;
  for (const planar::Candidate& c : window->candidates) {
    if (c.error_a < 0x1p-8 && c.error_b < 0x1p-8) continue;
    close += std::min(c.out_high, window->frame().tau1) - std::max(c.out_low, window->frame().tau0) < 1e-9;
  }
  EXPECT_GT(close, 20u);
}

TEST(ScaleEvents, of_a_rod_and_a_slot_is_the_scale_at_which_it_fits_no_longer) {
  // A slot of width 2 in a frame, and a rod of length 1 that grows.
  const Region slot =
      Region::create({{{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{{2, 1}, {2, 5}, {4, 5}, {4, 1}}}}}, {}, {}}).value();
  const Region rod = Region::create({{}, {{{0, 0}, {1, 0}}}, {}}).value();
  MovingOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;
  const ScalingSum sum = ScalingSum::create(slot, rod, options).value();
  const std::vector<ScaleEvent> events = sum.events(scale_of(1, 2), scale_of(5, 1)).value();
  std::vector<std::string> topological;
  for (const ScaleEvent& e : events)
    if (e.topology) topological.push_back(e.parameter.to_string());
  EXPECT_EQ(topological, std::vector<std::string>{"2/1"});
  EXPECT_EQ(sum.next_event(scale_of(1, 2), scale_of(5, 1), EventChange::topology).value()->parameter.to_string(),
            "2/1");
}

TEST(ScaleEvents, of_an_empty_range_is_an_error) {
  const Region p = shapes::rectangle(0, 0, 1, 1);
  EXPECT_EQ(ScalingSum::create(p, p).value().events(scale_of(2, 1), Scale()).error().code, ErrorCode::bad_scale);
}

/// Ends of the intervals in which two segments of the convolution cross, by testing every pair at every candidate
/// scale.
// Windows of many segments take seconds.
TEST(ScaleEvents, progress_is_asked_at_every_event) {
  const ScalingSum sum = ScalingSum::create(shapes::random_polygon(40, 0, 1), shapes::random_polygon(30, 1, 2)).value();
  const Scale a = Scale::of(1).value(), b = Scale::of(2).value();
  std::vector<double> fractions;
  const Progress count = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  const std::size_t events = sum.events(a, b, count).value().size();
  EXPECT_GT(events, 10u);
  EXPECT_GT(fractions.size(), 2 * events);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()) && fractions.front() >= 0 && fractions.back() <= 1);
  for (std::size_t queried = 1; queried < fractions.size(); queried += 1 + fractions.size() / 9) {
    std::size_t left = queried;
    const Progress stop = [&](std::string_view, double) { return --left > 0; };
    EXPECT_EQ(sum.events(a, b, stop).error().code, ErrorCode::cancelled) << queried;
    EXPECT_EQ(left, 0u);
  }
}

/// Over a wide range holes become filled and open again, so that the convolution is made anew between windows.
TEST(ScaleEvents, a_plate_whose_holes_fill_one_after_the_other) {
  RegionData plate;
  plate.parts.push_back({{{0, 0}, {40, 0}, {40, 20}, {0, 20}}, {}});
  for (int k = 1; k <= 4; ++k) {
    const double x = 8.0 * k, r = k;
    plate.parts[0].holes.push_back({{x - r, 10}, {x, 10 + r}, {x + r, 10}, {x, 10 - r}});
  }
  const Region p = Region::create(plate).value(), q = snapped_shapes::star(5, 1, 2);
  const Region tool = multiplied(q, 1, 1);
  ScalingSum sum = ScalingSum::create(p, tool).value();
  const std::vector<ScaleEvent> events = sum.events(scale_of(1, 4), scale_of(4, 1)).value();
  ASSERT_GE(events.size(), 4u);  // one hole after the other
  std::size_t most = 0, least = 99;
  for (const ScaleEvent& e : events) {
    ASSERT_TRUE(sum.set(Scale::of(e.parameter).value()).ok());
    const PlanarSum& updated = sum.sum();
    most = std::max(most, updated.hole_count());
    least = std::min(least, updated.hole_count());
    ScalingSum fresh = ScalingSum::create(p, tool).value();
    ASSERT_TRUE(fresh.set(Scale::of(e.parameter).value()).ok());
    EXPECT_EQ(described(updated, 1), described(fresh.sum(), 1)) << e.parameter.to_string();
  }
  EXPECT_GT(most, least + 1) << most << " " << least;
}

}  // namespace
}  // namespace dymsum
