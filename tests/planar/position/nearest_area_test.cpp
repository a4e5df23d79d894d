// Areas and nearest points from some thirty digits: they are those of the exact positions, and these are not requested.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "dymsum/area_text.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"
#include "planar/position/area.h"
#include "planar/position/exact_source.h"
#include "planar/sum/listed_source.h"

namespace dymsum {
namespace {

using Q = exact::BigRational;

/// Hands on another source's answers and counts the exact positions.
class CountingSource : public ExactSource {
 public:
  explicit CountingSource(std::shared_ptr<const ExactSource> own) : own_(std::move(own)) {}
  Position position(const SumVertex& v) const override {
    ++queried;
    return own_->position(v);
  }
  Homogeneous homogeneous(const SumVertex& v) const override {
    ++queried;
    return own_->homogeneous(v);
  }
  std::optional<NearFrame> near_frame() const override { return own_->near_frame(); }
  NearPosition near(const SumVertex& v) const override { return own_->near(v); }
  std::optional<Point> rounded_once(const SumVertex& v) const override { return own_->rounded_once(v); }
  mutable std::size_t queried = 0;

 private:
  std::shared_ptr<const ExactSource> own_;
};

std::vector<SumVertex> vertices_of(const PlanarSum& sum) {
  std::vector<SumVertex> all;
  for (const SumPart& part : sum.parts) {
    all.insert(all.end(), part.outer.vertices.begin(), part.outer.vertices.end());
    for (const SumRing& hole : part.holes) all.insert(all.end(), hole.vertices.begin(), hole.vertices.end());
  }
  return all;
}

/// near() keeps its error, areas and nearest points are the exact ones.
void expect_near(const PlanarSum& sum, const std::string& what) {
  SCOPED_TRACE(what);
  ASSERT_FALSE(sum.parts.empty());
  const auto frame = exact_source(sum)->near_frame();
  ASSERT_TRUE(frame);
  const planar::NearestPoint nearest(*exact_source(sum));
  for (const SumVertex& v : vertices_of(sum)) {
    const ExactSource::Position p = exact_source(sum)->position(v);
    const ExactSource::NearPosition n = exact_source(sum)->near(v);
    const auto off = [&](const base::DoublePair& at, const Q& origin, const Q& exact) -> Q {
      return abs(frame->unit * (exact::exact_value(at.high) + exact::exact_value(at.low)) + origin - exact);
    };
    const Q error = frame->unit * exact::exact_value(n.error);
    ASSERT_LE(off(n.x, frame->x, p.x), error);
    ASSERT_LE(off(n.y, frame->y, p.y), error);
    ASSERT_EQ(nearest(v), (Point{exact::round_to_double(p.x), exact::round_to_double(p.y)}));
  }
  const Rational area = sum.area_exact();
  EXPECT_EQ(sum.area(), area.to_double());
  auto counting = std::make_shared<CountingSource>(exact_source(sum));
  PlanarSum counted = sum;
  exact_source(counted) = counting;
  EXPECT_EQ(counted.area(), area.to_double());
  EXPECT_EQ(counting->queried, 0u);
}

TEST(NearestArea, EqualsTheFractionForEveryTierAndMotion) {
  const Region p = shapes::random_polygon(40, 2, 3), q = shapes::noisy_star(17, 0.6, 5);
  for (const int tier : {29, 61, 512, 1000}) {
    SumOptions options;
    planar::SumInternals::min_tier_bits(options) = tier;
    expect_near(minkowski_sum(p, q, options).value(), "tier " + std::to_string(tier));
  }
  expect_near(minkowski_sum(shapes::grate(5, 2, 1, 9), snapped_shapes::gear(7, 0.25, 0.5)).value(), "grate and gear");
  ScalingSum scaling = ScalingSum::create(p, q).value();
  for (const double s : {0.3, 1.0, 1.75}) {
    ASSERT_TRUE(scaling.set(s));
    expect_near(scaling.sum(), "scale " + std::to_string(s));
  }
  RotatingSum rotating = RotatingSum::create(p, q).value();
  for (const double theta : {0.0, 0.5, 2.0}) {
    ASSERT_TRUE(rotating.set(Orientation::nearest(theta, 1e-6).value()));
    expect_near(rotating.sum(), "angle " + std::to_string(theta));
  }
}

TEST(NearestArea, RoundedRegionsOfSumsInGeneralPositionAskForNoExactPosition) {
  const Region p = shapes::noisy_star(300, 0.5, 1), q = snapped_shapes::disc(7, 0.004);
  PlanarSum sum = minkowski_sum(p, q).value();
  ASSERT_GT(sum.stats.crossings, 50u);
  auto counting = std::make_shared<CountingSource>(exact_source(sum));
  exact_source(sum) = counting;
  ASSERT_TRUE(sum.rounded().ok());
  EXPECT_LE(counting->queried, 4u);  // coordinates near zero
}

/// A rectangle of width 1 and the given height.
PlanarSum column(const Q& height) {
  auto source = std::make_shared<ListedSource>();
  PlanarSum sum;
  exact_source(sum) = source;
  const Q third(1, 3);
  sum.parts.push_back({source->ring({{third, 0}, {1 + third, 0}, {1 + third, height}, {third, height}}), {}});
  return sum;
}

TEST(NearestArea, TiesAndWhatIsAHairFromThem) {
  const Q tie = power_of_two(53) + 1;
  for (const int exponent : {-10, -200, -1500, -4000}) {
    const Q hair = power_of_two(exponent);
    EXPECT_EQ(column(tie).area(), 0x1p53);
    EXPECT_EQ(column(tie - hair).area(), 0x1p53);
    EXPECT_EQ(column(tie + hair).area(), 0x1p53 + 2);
    EXPECT_EQ(column(tie + hair / 3).area(), 0x1p53 + 2);
  }
}

TEST(NearestArea, FractionsAreGivenWhileTheyAreShort) {
  EXPECT_EQ(PlanarSum().area_exact_within(0), Rational());
  // Powers of two count for nothing.
  const PlanarSum square = minkowski_sum(shapes::rectangle(0, 0, 0.125, 3), shapes::rectangle(0, 0, 1, 1)).value();
  EXPECT_EQ(square.area_exact_within(0), square.area_exact());
  const PlanarSum crossing = minkowski_sum(shapes::noisy_star(300, 0.5, 1), snapped_shapes::disc(7, 0.004)).value();
  EXPECT_EQ(crossing.area_exact_within(1000), std::nullopt);
  EXPECT_EQ(crossing.area_exact_within(10000000), crossing.area_exact());
}

TEST(NearestArea, PowersOfTwoInDenominatorsAreTakenTogether) {
  // 4000 corners on a fine grid: as one fraction each has a power of two of its own, and these used to be multiplied.
  const PlanarSum sum = minkowski_sum(snapped_shapes::disc(4000, 1), shapes::rectangle(0, 0, 1, 1)).value();
  const Rational area = sum.area_exact();
  EXPECT_LT(area.denominator().size(), 100u);
  EXPECT_EQ(sum.area(), area.to_double());
}

TEST(AreaText, AreasOutsideTheRangeOfDoubles) {
  const auto square = [](double side) { return shapes::rectangle(0, 0, side, side); };
  EXPECT_EQ(area_text(minkowski_sum(square(0x1p600), square(0x1p600)).value()), "6.8873917825543002e+361");  // 2^1202
  EXPECT_EQ(area_text(minkowski_sum(square(0x1p-600), square(0x1p-600)).value()), "2.3230855024870013e-361");
  EXPECT_EQ(area_text(square(0x1p600)), "1.7218479456385751e+361");
  EXPECT_EQ(area_text(square(3)), "9.0000000000000000e+00");
  EXPECT_EQ(area_text(Region()), "0");
  EXPECT_EQ(area_text(PlanarSum()), "0");
}

}  // namespace
}  // namespace dymsum
