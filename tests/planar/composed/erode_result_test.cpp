// Erosions of results and by results, openings and closings, against the same in integers, and their laws.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/scaled_result.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kSeed = 20261201;

int times(int usual) {
  const char* queried = std::getenv("DYMSUM_FUZZ_OPERANDS");
  return queried != nullptr ? std::atoi(queried) : usual;
}

Region made(const RegionData& data) {
  Result<Region> region = Region::create(data);
  if (!region.ok()) throw std::runtime_error(region.error().to_string() + "\n" + to_wkt(data));
  return *std::move(region);
}

SumOptions with(Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  return options;
}

bool is_thin(const PlanarSum& sum) { return !sum.segments.empty() || !sum.points.empty(); }
bool is_empty(const PlanarSum& sum) { return sum.parts.empty() && !is_thin(sum); }

/// Calls check(P, Q, R) for random parts, and names the first triple that fails.
template <class Check>
void for_triples(int count, const Check& check) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (int k = 0; k < count; ++k) {
    Random random(kSeed + static_cast<std::uint64_t>(k));
    const RegionData p = random_parts(random, 6), q = random_parts(random, 3),
                     r{{{random_polygon(random, 2, 4), {}}}, {}, {}};
    SCOPED_TRACE("triple " + std::to_string(k) + "\n" + to_wkt(p) + "\n" + to_wkt(q) + "\n" + to_wkt(r));
    check(made(p), made(q), made(r));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ErodeResult, equals_the_erosion_of_the_same_region_in_integers) {
  std::size_t compared = 0, room = 0, tight = 0;
  for_triples(times(300), [&](const Region& p, const Region& q, const Region& r) {
    const PlanarSum m = minkowski_sum(p, q, with(Semantics::regular)).value();
    const BigInt factor = denominator_of(m);
    const std::optional<RegionData> whole = times_integer(m, factor);
    if (!whole) return;
    const double f = factor.convert_to<double>();
    const Region in_integers = made(*whole), part = made(mapped(r.data(), f, 0, 0, f));
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      const PlanarSum fit = erode(m, r, with(semantics)).value();
      const PlanarSum expected = erode(in_integers, part, with(semantics)).value();
      EXPECT_TRUE(times_integer(canonical_shape(fit), factor) == canonical_shape(expected));
      room += !fit.parts.empty();
      tight += fit.tight_points.size() + fit.tight_segments.size();
    }
    EXPECT_EQ(check_erode(in_integers, part, erode(in_integers, part).value()), "");
    const PlanarSum by = erode(made(mapped(p.data(), 4, 0, 0, 4)), m).value();
    EXPECT_TRUE(times_integer(canonical_shape(by), factor) ==
                canonical_shape(erode(made(mapped(p.data(), 4 * f, 0, 0, 4 * f)), in_integers).value()));
    ++compared;
  });
  EXPECT_GT(compared, 100u);
  EXPECT_GT(room, 100u);
  EXPECT_GT(tight, 20u);
}

// A cup with a hole, and a lid that touches it at two corners: outlines of what is left out touch, and the parts are
// two.
TEST(ErodeResult, parts_that_touch_at_corners_are_parts) {
  const Region cup =
      Region::create(
          {{{{{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {{{1, 0.5}, {1, 1}, {2, 1}, {2, 0.5}}}},
            {{{2, 4}, {4, 4}, {4, 6}, {2, 6}}, {}}},
           {},
           {}})
          .value();
  const Region point = Region::create({{}, {}, {Point{0, 0}}}).value(), square = shapes::rectangle(0, 0, 0.25, 0.25);
  const PlanarSum itself = minkowski_sum(cup, point).value(), grown = minkowski_sum(cup, square).value();
  EXPECT_EQ(itself.parts.size(), 2u);
  EXPECT_EQ(erode(PlanarOperand(cup), PlanarOperand(point)).value(), itself);
  EXPECT_EQ(opening(cup, point).value(), itself);
  EXPECT_EQ(closing(cup, point).value(), itself);
  EXPECT_EQ(opening(PlanarOperand(grown), square).value(), grown);
}

TEST(ErodeResult, by_one_set_after_the_other_is_the_erosion_by_their_sum) {
  std::size_t room = 0;
  for_triples(times(300), [&](const Region& p, const Region& q, const Region& r) {
    const Region large = made(mapped(p.data(), 3, 0, 0, 3));
    const PlanarSum fit = erode(large, q).value();
    if (is_thin(fit)) return;
    const PlanarSum left = erode(fit, r).value(), right = erode(large, minkowski_sum(q, r).value()).value();
    EXPECT_TRUE(same_set(left, right));
    room += !left.parts.empty();
  });
  EXPECT_GT(room, 50u);
}

TEST(ErodeResult, opened_and_closed_again_nothing_changes) {
  std::size_t opened = 0, closed = 0;
  for_triples(times(200), [&](const Region& p, const Region& q, const Region&) {
    const Region large = made(mapped(p.data(), 2, 0, 0, 2));
    const PlanarSum once = opening(large, q).value();
    const SumOptions regular = with(Semantics::regular);
    EXPECT_TRUE(difference(once, large, regular).value().parts.empty()) << "an opening lies inside";
    EXPECT_TRUE(is_empty(once) || same_set(opening(once, q).value(), once));
    opened += once.vertex_count();
    const PlanarSum filled = closing(large, q, regular).value();
    EXPECT_TRUE(difference(large, filled, regular).value().parts.empty()) << "a closing lies around";
    EXPECT_TRUE(closing(filled, q, regular).value() == filled);
    closed += filled.vertex_count();
  });
  EXPECT_GT(opened, 500u);
  EXPECT_GT(closed, 500u);
}

TEST(ErodeResult, sums_distribute_over_unions) {
  for_triples(times(200), [&](const Region& p, const Region& q, const Region& r) {
    const SumOptions regular = with(Semantics::regular);
    const PlanarSum pr = minkowski_sum(p, r, regular).value(), qr = minkowski_sum(q, r, regular).value();
    const PlanarSum both = united(p, q, regular).value();
    EXPECT_TRUE(minkowski_sum(both, r, regular).value() == united(pr, qr, regular).value());
    const PlanarSum common = intersection(pr, qr, regular).value();
    EXPECT_TRUE(difference(minkowski_sum(intersection(p, q, regular).value(), r, regular).value(), common, regular)
                    .value()
                    .parts.empty());
    EXPECT_TRUE(united(common, symmetric_difference(pr, qr, regular).value(), regular).value() ==
                united(pr, qr, regular).value());
  });
}

TEST(ErodeResult, of_every_kind_of_coordinates_follows_the_laws) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::size_t room = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int k = 0; k < times(10); ++k) {
      Random random(kSeed + 7 * static_cast<std::uint64_t>(k));
      std::mt19937_64 noise(kSeed);
      const auto drawn = [&](int size) { return Region::create(of_kind(random_parts(random, size), kind, noise)); };
      const Result<Region> p = drawn(12), q = drawn(3), r = drawn(2);
      if (!p || !q || !r) continue;  // rounding has spoilt a shape that touched itself
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(k));
      const SumOptions regular = with(Semantics::regular);
      const PlanarSum fit = erode(*p, *q, regular).value();
      EXPECT_TRUE(erode(fit, *r, regular).value() == erode(*p, minkowski_sum(*q, *r).value(), regular).value());
      const PlanarSum once = opening(*p, *q, regular).value();
      EXPECT_TRUE(opening(once, *q, regular).value() == once);
      room += !once.parts.empty();
      if (::testing::Test::HasFailure()) return;
    }
  EXPECT_GT(room, 10u);
}

TEST(ErodeResult, names_what_it_cannot_erode) {
  const Region square = shapes::rectangle(0, 0, 2, 2), line = made({{}, {{{0, 0}, {1, 0}}}, {}}), empty;
  const PlanarSum none = minkowski_sum(square, empty).value(), thin = erode(square, square).value();
  ASSERT_EQ(thin.points.size(), 1u);
  EXPECT_EQ(erode(thin, line).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(erode(square, none).error().code, ErrorCode::unsupported_operand);
  EXPECT_TRUE(is_empty(erode(none, square).value()));
  EXPECT_TRUE(opening(square, square).value() == minkowski_sum(square, made({{}, {}, {{0, 0}}})).value())
      << "an exact fit counts";
  EXPECT_TRUE(is_empty(opening(square, square, with(Semantics::regular)).value()));
}

}  // namespace
}  // namespace dymsum::oracles
