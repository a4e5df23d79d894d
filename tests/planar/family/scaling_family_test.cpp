// Families of scales: any sum of one equals that from scratch, in every cell, at every event and right beside it.
#include "dymsum/scaling_family.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <tuple>

#include "dymsum/planar_boolean.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "planar/operand/scale_value.h"

namespace dymsum::oracles {
namespace {

using exact::BigRational;

constexpr std::uint64_t kFamilySeed = 20261130;

int family_rounds(int usual) {
  const char* queried = std::getenv("DYMSUM_FUZZ_FAMILIES");
  return queried != nullptr ? std::atoi(queried) : usual;
}

Scale scale_at(const BigRational& value) { return Scale::of(exact::to_rational(value)).value(); }
Scale ratio_of(int n, int d) { return scale_at(BigRational(n, d)); }
BigRational value_of(const ScaleEvent& event) { return exact::exact_value(event.parameter); }

/// A family with the sums from scratch that it has to equal.
class Compared {
 public:
  Compared(const Region& p, const Region& q, const Scale& low, const Scale& high, const Scale& ratio = {},
           const FamilyOptions& options = {})
      : ratio_(ratio), family_(ScalingFamily::create(p, q, low, high, ratio, options).value()) {
    MovingOptions moving;
    moving.moving = options.moving;
    moving.reflect_q = options.reflect_q;
    moving.semantics = options.semantics;
    moving.mode = FrameMode::rebuild;
    fresh_.emplace(ScalingSum::create(p, q, moving).value());
  }
  const ScalingFamily& family() const { return family_; }
  const PlanarSum& fresh(const Scale& s) {
    const Scale y = scale_at(exact::exact_value(s.exact()) * exact::exact_value(ratio_.exact()));
    EXPECT_TRUE(fresh_->set(s, y).ok());
    return fresh_->sum();
  }
  void check(const BigRational& s) {
    if (s < exact::exact_value(family_.low().exact()) || s > exact::exact_value(family_.high().exact())) return;
    const Scale scale = scale_at(s);
    const PlanarSum sum = family_.at(scale).value();
    ++compared;
    vertices += sum.vertex_count();
    EXPECT_TRUE(sum == fresh(scale)) << "at " << s;
    double worst = 0;
    for (const SumPart& part : sum.parts)
      for (const SumVertex& v : part.outer.vertices) {
        const RationalPoint at = sum.exact(v);
        worst = std::max({worst, std::abs(at.x.to_double() - v.at.x), std::abs(at.y.to_double() - v.at.y)});
      }
    EXPECT_LE(worst, sum.at_error * (1 + 0x1p-40)) << "at " << s;
  }
  /// In every cell, at every event, and beside it.
  void check_all() {
    const BigRational beside(1, exact::BigInteger(1) << 200);
    BigRational last = exact::exact_value(family_.low().exact());
    for (const ScaleEvent& event : family_.events()) {
      const BigRational s = value_of(event);
      if (s > last) check((s + last) / 2);
      check(s);
      check(s - beside);
      check(s + beside);
      if (::testing::Test::HasFailure()) return;
      last = s;
    }
    check((last + exact::exact_value(family_.high().exact())) / 2);
  }
  std::size_t compared = 0, vertices = 0;

 private:
  Scale ratio_;
  ScalingFamily family_;
  std::optional<ScalingSum> fresh_;
};

TEST(ScalingFamily, of_tiny_parts_equals_sums_from_scratch_everywhere) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kFamilySeed));
  std::size_t compared = 0, events = 0;
  for (int k = 0; k < family_rounds(100); ++k) {
    Random random(kFamilySeed + static_cast<std::uint64_t>(k));
    const RegionData p = random_parts(random, 7), q = random_parts(random, 5);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q));
    FamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    options.reflect_q = k % 3 == 0;
    options.semantics = k % 5 == 0 ? Semantics::open : k % 5 == 1 ? Semantics::regular : Semantics::closed;
    const Scale ratio = k % 4 == 3 ? ratio_of(3, 2) : k % 4 == 2 ? ratio_of(5, 7) : Scale();
    Compared pair(Region::create(p).value(), Region::create(q).value(), ratio_of(1, 4), ratio_of(4, 1), ratio, options);
    pair.check_all();
    compared += pair.compared;
    events += pair.family().events().size();
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(compared, 1000u);
  EXPECT_GT(events, 200u);
}

/// Polylines and points on a tiny grid, with a part or without.
std::optional<Region> random_thin(Random& random, int grid) {
  const auto point = [&] { return Point{random.below(grid + 1) * 1.0, random.below(grid + 1) * 1.0}; };
  RegionData data;
  for (int k = random.below(3); k > 0; --k) {
    Polyline& line = data.polylines.emplace_back();
    for (int v = 2 + random.below(3); v > 0; --v) line.push_back(point());
  }
  for (int k = random.below(3) + (data.polylines.empty() ? 1 : 0); k > 0; --k) data.points.push_back(point());
  if (random.chance(20)) data.parts = moved(random_parts(random, 2), grid + 1, random.below(3)).parts;
  Result<Region> made = Region::create(std::move(data));
  return made ? std::optional(*std::move(made)) : std::nullopt;
}

struct ThinCounts {
  std::size_t pairs = 0, compared = 0, events = 0, segments = 0, points = 0, areas = 0;
};

/// A family in every cell, at every event, beside it and at scales of a grid: where an event was missed, a cell is
/// wrong.
void check_thin(const Region& p, const Region& q, int k, ThinCounts& counts) {
  SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p.data()) + "\n" + to_wkt(q.data()));
  FamilyOptions options;
  options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
  options.reflect_q = k % 3 == 0;
  options.semantics = k % 5 == 0 ? Semantics::open : k % 5 == 1 ? Semantics::regular : Semantics::closed;
  const Scale ratio = k % 4 == 3 ? ratio_of(3, 2) : k % 4 == 2 ? ratio_of(5, 7) : Scale();
  Compared pair(p, q, ratio_of(1, 3), ratio_of(3, 1), ratio, options);
  pair.check_all();
  for (int i = 8; i <= 72; i += 3) pair.check(BigRational(i, 24) + BigRational(1, 97));
  const PlanarSum sum = pair.family().at(ratio_of(7, 5)).value();
  ++counts.pairs;
  counts.compared += pair.compared;
  counts.events += pair.family().events().size();
  counts.segments += sum.segments.size();
  counts.points += sum.points.size();
  counts.areas += sum.parts.size();
}

// Pieces, parallelograms and sums of points change at scales of their own.
TEST(ScalingFamily, of_polylines_and_points_equals_sums_from_scratch_everywhere) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kFamilySeed));
  ThinCounts one, both;
  for (int k = 0; k < family_rounds(60); ++k) {
    Random random(kFamilySeed + 3000 + static_cast<std::uint64_t>(k));
    const std::optional<Region> p = random_thin(random, 4), q = random_thin(random, 3);
    const Region parts = Region::create(random_parts(random, 5)).value();
    if (p && q) check_thin(*p, *q, k, both);
    if (q) check_thin(parts, *q, k, one);
    if (p) check_thin(*p, parts, k, one);
    if (::testing::Test::HasFailure()) return;
  }
  for (const ThinCounts* c : {&one, &both})
    std::printf("%zu pairs, %zu events, %zu sums, %zu segments, %zu points, %zu parts\n", c->pairs, c->events,
                c->compared, c->segments, c->points, c->areas);
  EXPECT_GT(one.pairs, 60u);
  EXPECT_GT(both.pairs, 40u);
  EXPECT_GT(one.events, 200u);
  EXPECT_GT(both.events, 200u);
  EXPECT_GT(both.segments, 20u);
  EXPECT_GT(both.points, 20u);
  EXPECT_GT(both.areas, 20u);
}

TEST(ScalingFamily, of_points_changes_where_two_sums_are_one) {
  const Region p = Region::create({{}, {}, {{0, 0}, {4, 0}}}).value(),
               q = Region::create({{}, {}, {{0, 0}, {1, 0}}}).value();
  Compared pair(p, q, ratio_of(1, 8), ratio_of(1, 1));
  ASSERT_EQ(pair.family().events().size(), 1u);
  EXPECT_EQ(pair.family().events()[0].parameter.to_string(), "1/4");
  EXPECT_TRUE(pair.family().events()[0].topology);
  EXPECT_EQ(pair.family().at(ratio_of(1, 4)).value().points.size(), 3u);
  EXPECT_EQ(pair.family().at(ratio_of(1, 2)).value().points.size(), 4u);
  pair.check_all();
}

TEST(ScalingFamily, of_polylines_lies_between_inner_and_outer) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kFamilySeed));
  std::size_t rounds = 0, with_area = 0, pieces = 0;
  for (int k = 0; k < family_rounds(40); ++k) {
    Random random(kFamilySeed + 5000 + static_cast<std::uint64_t>(k));
    const std::optional<Region> thin = random_thin(random, 3), other = random_thin(random, 3);
    if (!thin || !other) continue;
    const Region p = translated(*thin, k % 3 - 1.0, k % 2 - 2.0).value(),
                 q = k % 3 == 0 ? Region::create(random_parts(random, 3)).value() : *other;
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p.data()) + "\n" + to_wkt(q.data()));
    FamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    const ScalingFamily family = ScalingFamily::create(p, q, ratio_of(3, 4), ratio_of(3, 2), options).value();
    const Scale a = ratio_of(4, 5), b = ratio_of(4, 3);
    const PlanarSum outer = family.outer(a, b).value(), inner = family.inner(a, b).value();
    SumOptions regular;
    regular.semantics = Semantics::regular;
    PlanarSum all = family.at(a).value();
    const PlanarSum same = united(outer, outer).value();
    for (int i = 0; i <= 6; ++i) {
      const PlanarSum sum = family.at(scale_at(BigRational(4, 5) + BigRational(i, 6) * BigRational(8, 15))).value();
      EXPECT_TRUE(difference(inner, sum, regular).value().parts.empty()) << "inner lies in every sum, " << i;
      EXPECT_TRUE(united(sum, outer).value() == same) << "outer holds every sum, " << i;
      all = united(all, sum).value();
      pieces += sum.segments.size() + sum.points.size();
    }
    EXPECT_LE(all.area(), outer.area());
    with_area += !outer.parts.empty();
    ++rounds;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(rounds, 20u);
  EXPECT_GT(with_area, 10u);
  EXPECT_GT(pieces, 30u);
  // A point sweeps a segment, a line through the origin a longer one.
  const ScalingFamily swept =
      ScalingFamily::create(Region::create({{}, {{{1, 0}, {2, 0}}}, {{0, 1}}}).value(),
                            Region::create({{}, {}, {{0, 0}}}).value(), ratio_of(1, 1), ratio_of(3, 1))
          .value();
  const PlanarSum outer = swept.outer(ratio_of(1, 1), ratio_of(3, 1)).value();
  ASSERT_EQ(outer.segments.size(), 2u);
  const auto at = [&](const SumVertex& v) { return std::pair{v.at.x, v.at.y}; };
  EXPECT_EQ(at(outer.segments[0].from), std::pair(0.0, 1.0));
  EXPECT_EQ(at(outer.segments[0].to), std::pair(0.0, 3.0));
  EXPECT_EQ(at(outer.segments[1].from), std::pair(1.0, 0.0));
  EXPECT_EQ(at(outer.segments[1].to), std::pair(6.0, 0.0));
}

TEST(ScalingFamily, of_every_kind_of_coordinates_equals_sums_from_scratch) {
  std::size_t compared = 0, cells = 0;
  for (const CoordinateKind kind : kCoordinateKinds) {
    std::mt19937_64 noise(kFamilySeed);
    const auto of = [&](const Region& r) { return Region::create(of_kind(r.data(), kind, noise)); };
    const Region wire =
        Region::create({{}, {{{0, 0}, {1.5, 0.25}, {1, 1.25}}, {{-1, -0.5}, {-0.75, 1}}}, {{2, 2}}}).value();
    const Result<Region> p = of(shapes::noisy_star(40, 0.8, 5)), q = of(shapes::gear(6, 0.25, 0.375, 0.03125)),
                         r = of(shapes::grate(3, 2, 1, 4)), t = of(shapes::rectangle(0, 0, 0.75, 0.5)), w = of(wire);
    for (const auto& [a, b] : {std::pair(p, q), std::pair(r, t), std::pair(r, w), std::pair(w, w)}) {
      if (!a || !b) continue;
      SCOPED_TRACE(name_of(kind));
      Compared pair(*a, *b, ratio_of(9, 10), ratio_of(5, 4));
      pair.check_all();
      compared += pair.compared;
      cells += pair.family().work().cells;
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(compared, 300u);
  EXPECT_GT(cells, 100u);
}

TEST(ScalingFamily, lists_what_changes_and_what_lives_how_long) {
  // A 4 x 4 plate with a 2 x 1 hole; the peg is 1 x 1/2 at scale 1, and fits exactly at 2.
  const Region plate =
      Region::create({{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}}}}, {}, {}}).value();
  FamilyOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;
  const ScalingFamily family =
      ScalingFamily::create(plate, shapes::rectangle(0, 0, 1, 0.5), ratio_of(1, 1), ratio_of(4, 1), options).value();
  const auto topology = family.changes(family.low(), family.high(), EventChange::topology);
  ASSERT_EQ(topology.size(), 1u);
  EXPECT_EQ(topology[0].parameter.to_string(), "2/1");
  EXPECT_EQ(family.next(ratio_of(1, 1), EventChange::topology)->parameter.to_string(), "2/1");
  EXPECT_FALSE(family.next(ratio_of(2, 1), EventChange::topology).has_value());
  EXPECT_EQ(family.at(ratio_of(2, 1)).value().tight_points.size(), 1u);
  const auto [at, event] = family.locate(ratio_of(2, 1));
  EXPECT_TRUE(event);
  std::size_t holes = 0, edges = 0;
  for (const Lifetime& life : family.lifetimes().value()) {
    EXPECT_LE(life.first_cell, life.last_cell);
    EXPECT_LT(life.last_cell, family.work().cells);
    edges += life.feature == FamilyFeature::edge;
    if (life.feature != FamilyFeature::hole) continue;
    ++holes;
    EXPECT_EQ(life.first_cell, 0u);
    EXPECT_EQ(life.last_cell, at);
  }
  EXPECT_EQ(holes, 1u);
  EXPECT_GE(edges, 8u);
}

TEST(ScalingFamily, lifetimes_are_as_long_as_they_can_be_and_cover_every_sum) {
  const ScalingFamily family =
      ScalingFamily::create(shapes::noisy_star(24, 0.6, 5), shapes::gear(5, 0.25, 0.375, 0.03125), ratio_of(3, 4),
                            ratio_of(3, 2))
          .value();
  const std::vector<Lifetime> lives = family.lifetimes().value();
  ASSERT_GT(family.work().cells, 20u);
  std::size_t long_ones = 0;
  std::map<std::tuple<FamilyFeature, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint64_t,
                      std::uint32_t, std::uint32_t>,
           std::uint32_t>
      last;
  for (const Lifetime& life : lives) {
    const auto both = [](const Contact& c) { return std::pair{c.p * 2 + (c.kind == Contact::Kind::edge_of_p), c.q}; };
    const std::tuple feature{life.feature,          both(life.in).first, both(life.in).second, both(life.out).first,
                             both(life.out).second, life.hole,           life.corner_p,        life.corner_q};
    if (const auto before = last.find(feature); before != last.end()) {
      EXPECT_GT(life.first_cell, before->second + 1) << "it was gone in between";
    }
    last[feature] = life.last_cell;
    long_ones += life.last_cell > life.first_cell + 5;
  }
  EXPECT_GT(long_ones, 20u);
  for (std::uint32_t cell = 1; cell + 1 < family.work().cells; ++cell) {
    const BigRational s = (value_of(family.events()[cell - 1]) + value_of(family.events()[cell])) / 2;
    const PlanarSum sum = family.at(scale_at(s)).value();
    std::size_t vertices = 0, holes = 0;
    for (const Lifetime& life : lives) {
      const bool here = life.first_cell <= cell && cell <= life.last_cell;
      vertices += here && life.feature == FamilyFeature::vertex;
      holes += here && life.feature == FamilyFeature::hole;
    }
    EXPECT_EQ(vertices, sum.vertex_count()) << cell;
    EXPECT_EQ(holes, sum.hole_count()) << cell;
  }
}

/// The holes of a family's lifetimes that are there in a cell, and those of the rings of its sum at s.
void expect_holes_of_lifetimes(const ScalingFamily& family, const std::vector<Lifetime>& lives, std::uint32_t cell,
                               const Scale& s) {
  std::vector<std::uint64_t> living, named;
  for (const Lifetime& life : lives)
    if (life.feature == FamilyFeature::hole && life.first_cell <= cell && cell <= life.last_cell)
      living.push_back(life.hole);
  const std::vector<std::uint64_t> ids = family.ring_ids(s).value();
  const PlanarSum sum = family.at(s).value();
  std::size_t ring = 0;
  for (const SumPart& part : sum.parts) {
    EXPECT_NE(ids.at(ring++), 0u) << "an outer ring in cell " << cell;
    for (std::size_t k = 0; k < part.holes.size(); ++k) named.push_back(ids.at(ring++));
  }
  EXPECT_EQ(ring, ids.size());
  std::sort(living.begin(), living.end());
  std::sort(named.begin(), named.end());
  EXPECT_EQ(living, named) << "in cell " << cell;
}

struct RingCounts {
  std::size_t holes = 0, at_events = 0;
};

void check_ring_names(const ScalingFamily& family, RingCounts& counts) {
  const std::vector<Lifetime> lives = family.lifetimes().value();
  BigRational last = exact::exact_value(family.low().exact());
  for (std::uint32_t cell = 0; cell < family.work().cells; ++cell) {
    const bool has_end = cell < family.events().size();
    const BigRational next = has_end ? value_of(family.events()[cell]) : exact::exact_value(family.high().exact());
    if (next == last) continue;  // an event at an end of the interval
    expect_holes_of_lifetimes(family, lives, cell, scale_at((last + next) / 2));
    last = next;
    if (!has_end) continue;
    // At an event most rings have vertices of before.
    const std::vector<std::uint64_t> ids = family.ring_ids(scale_at(next)).value();
    const PlanarSum sum = family.at(scale_at(next)).value();
    EXPECT_EQ(ids.size(), sum.parts.size() + sum.hole_count());
    counts.at_events +=
        static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [](auto id) { return id != 0; }));
  }
  for (const Lifetime& life : lives) counts.holes += life.feature == FamilyFeature::hole;
}

TEST(ScalingFamily, names_the_rings_of_every_sum_as_lifetimes_do) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kFamilySeed));
  RingCounts counts;
  for (int k = 0; k < family_rounds(60); ++k) {
    Random random(kFamilySeed + 900 + static_cast<std::uint64_t>(k));
    const RegionData p = random_parts(random, 7), q = random_parts(random, 4);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q));
    check_ring_names(
        ScalingFamily::create(Region::create(p).value(), Region::create(q).value(), ratio_of(1, 4), ratio_of(4, 1))
            .value(),
        counts);
    if (::testing::Test::HasFailure()) return;
  }
  // Pockets that close one after the other while a peg grows.
  FamilyOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;
  for (const int pockets : {5, 9})
    check_ring_names(ScalingFamily::create(shapes::pockets(pockets, 4), shapes::rectangle(0, 0, 1, 1), ratio_of(1, 4),
                                           ratio_of(4, 1), options)
                         .value(),
                     counts);
  EXPECT_GT(counts.holes, 14u);
  EXPECT_GT(counts.at_events, 100u);
  EXPECT_EQ(ScalingFamily::create(shapes::star(5, 1, 2), shapes::star(4, 1, 2), ratio_of(1, 1), ratio_of(2, 1))
                .value()
                .ring_ids(ratio_of(3, 1))
                .error()
                .code,
            ErrorCode::bad_scale);
}

TEST(ScalingFamily, inner_and_outer_are_what_holds_for_all_scales_and_for_some) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kFamilySeed));
  SumOptions regular;
  regular.semantics = Semantics::regular;
  std::size_t inner_vertices = 0, touched = 0;
  for (int k = 0; k < family_rounds(16); ++k) {
    Random random(kFamilySeed + 500 + static_cast<std::uint64_t>(k));
    const RegionData p = moved(random_parts(random, 5), k % 3 - 1.0, k % 2 - 3.0), q = random_parts(random, 3);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q));
    FamilyOptions options;
    options.moving = k % 2 == 0 ? MovingOperand::p : MovingOperand::q;
    options.reflect_q = k % 3 == 0;
    const Scale ratio = k % 4 == 3 ? ratio_of(3, 2) : Scale();
    const ScalingFamily family = ScalingFamily::create(Region::create(p).value(), Region::create(q).value(),
                                                       ratio_of(3, 4), ratio_of(3, 2), ratio, options)
                                     .value();
    const Scale a = ratio_of(4, 5), b = ratio_of(4, 3);
    const PlanarSum outer = family.outer(a, b).value(), inner = family.inner(a, b).value();
    PlanarSum common = family.at(a).value(), all = common;
    for (int i = 0; i <= 12; ++i) {
      const Scale s = scale_at(BigRational(4, 5) + BigRational(i, 12) * BigRational(8, 15));
      const PlanarSum sum = family.at(s).value();
      EXPECT_TRUE(difference(inner, sum, regular).value().parts.empty()) << "inner lies in every sum, " << i;
      EXPECT_TRUE(difference(sum, outer, regular).value().parts.empty()) << "outer holds every sum, " << i;
      common = intersection(common, sum, regular).value();
      all = united(all, sum, regular).value();
    }
    // What many scales have in common is not much more than what all have, and the other way round.
    EXPECT_LE(inner.area(), common.area());
    EXPECT_GE(outer.area(), all.area());
    EXPECT_LE(common.area() - inner.area(), 0.1 * all.area());
    EXPECT_LE(outer.area() - all.area(), 0.1 * all.area());
    touched += outer.area() > all.area();
    inner_vertices += inner.vertex_count();
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(inner_vertices, 60u);
  EXPECT_GT(touched, 4u);
}

TEST(ScalingFamily, refuses_what_it_cannot_answer) {
  const Region square = shapes::rectangle(0, 0, 1, 1);
  EXPECT_EQ(ScalingFamily::create(square, square, ratio_of(2, 1), ratio_of(1, 1)).error().code, ErrorCode::bad_scale);
  FamilyOptions options;
  options.structure_bytes = 1;
  const ScalingFamily family =
      ScalingFamily::create(shapes::star(5, 1, 2), shapes::star(4, 1, 2), ratio_of(1, 2), ratio_of(2, 1), options)
          .value();
  EXPECT_LT(family.work().kept, family.work().cells);
  EXPECT_EQ(family.at(ratio_of(3, 1)).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(family.lifetimes().error().code, ErrorCode::out_of_memory);
  EXPECT_EQ(family.inner(ratio_of(1, 1), ratio_of(2, 1)).error().code, ErrorCode::out_of_memory);
  EXPECT_EQ(family.at(ratio_of(7, 5)).value(),
            ScalingFamily::create(shapes::star(5, 1, 2), shapes::star(4, 1, 2), ratio_of(1, 1), ratio_of(3, 2))
                .value()
                .at(ratio_of(7, 5))
                .value());
  options.progress = [](std::string_view, double fraction) { return fraction < 0.5; };
  EXPECT_EQ(ScalingFamily::create(shapes::star(5, 1, 2), shapes::star(4, 1, 2), ratio_of(1, 2), ratio_of(2, 1), options)
                .error()
                .code,
            ErrorCode::cancelled);
  // Without an event in the interval there is one cell.
  const ScalingFamily still = ScalingFamily::create(square, square, ratio_of(1, 3), ratio_of(1, 3)).value();
  EXPECT_EQ(still.work().cells, 1u);
  EXPECT_EQ(still.at(ratio_of(1, 3)).value().area_exact().to_string(), "16/9");
}

}  // namespace
}  // namespace dymsum::oracles
