// Windows of angles against all segments and all pairs of them at angles inside, and the bounds they are made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {
namespace {

struct TurnedPair {
  std::shared_ptr<const OperandPair> base;
  std::unique_ptr<TurningForms> forms;
  std::unique_ptr<RotationCatalog> catalog;
};

TurnedPair turned(const Region& p, const Region& q) {
  TurnedPair t;
  t.base = pair_of_regions(p, q, PairOptions{.moved = 1}).value();
  t.forms = std::make_unique<TurningForms>(*t.base);
  t.catalog = std::make_unique<RotationCatalog>(*t.forms);
  return t;
}

/// The segments that provably exist at an angle, without the lists of the catalog.
std::vector<WalkSegment> existing(const TurnedPair& t, double theta) {
  std::vector<WalkSegment> found;
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < t.forms->size(side); ++e)
      for (std::uint32_t v = 0; v < t.forms->size(1 - side); ++v)
        if (const WalkSegment s{side, e, v}; t.catalog->exists(s, theta) == RotationCatalog::Existence::yes)
          found.push_back(s);
  return found;
}

struct Drawn {
  Point a, b;
};

Drawn drawn(const TurningForms& forms, const WalkSegment& s, Heading h) {
  return {forms.position(TurningForms::start(s), h), forms.position(forms.end(s), h)};
}

double side(const Drawn& line, Point p) {
  return (line.b.x - line.a.x) * (p.y - line.a.y) - (line.b.y - line.a.y) * (p.x - line.a.x);
}

// Far beyond what doubles err by.
bool provably_cross(const Drawn& s, const Drawn& t, double span) {
  const double least = 1e-12 * span * span;
  const double a = side(s, t.a), b = side(s, t.b), c = side(t, s.a), d = side(t, s.b);
  return std::min({std::abs(a), std::abs(b), std::abs(c), std::abs(d)}) > least && a * b < 0 && c * d < 0;
}

void expect_all_crossings(const TurnedPair& t, double midpoint, double half, std::size_t& crossings) {
  const RotationGrid grid(*t.forms, 24);
  const RotatingWindow window(grid, *t.catalog, midpoint, half, false);
  std::set<std::pair<std::uint32_t, std::uint32_t>> candidates;
  for (const RotationCandidate& c : window.candidates)
    candidates.insert(std::minmax(window.segment_of(c.a), window.segment_of(c.b)));
  for (const double fraction : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
    const double theta = midpoint + fraction * half;
    const Heading h = Heading::of(theta);
    const std::vector<WalkSegment> segments = existing(t, theta);
    std::vector<std::uint32_t> index;
    std::vector<Drawn> lines;
    for (const WalkSegment& s : segments) {
      index.push_back(window.find(s));
      ASSERT_NE(index.back(), kNone) << "a segment that exists at " << theta;
      lines.push_back(drawn(*t.forms, s, h));
    }
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        if (!provably_cross(lines[i], lines[j], t.forms->span())) continue;
        ++crossings;
        ASSERT_TRUE(candidates.contains(std::minmax(index[i], index[j]))) << "segments that cross at " << theta;
      }
  }
}

TEST(RotatingWindow, knows_every_segment_and_every_crossing_inside_it) {
  const std::vector<std::pair<Region, Region>> pairs{
      {shapes::noisy_star(24, 0.5, 1), shapes::noisy_star(18, 0.7, 2)},
      {shapes::random_polygon(40, 2, 3), snapped_shapes::gear(6, 1, 1.3)},
      {shapes::comb(7, 2, 1, 5), shapes::letter_l(4, 3, 0.5)}};
  std::size_t crossings = 0;
  for (const auto& [p, q] : pairs) {
    const TurnedPair t = turned(p, q);
    for (const double midpoint : {0.1, 1.3, -2.9})
      for (const double half : {0.002, 0.03, 0.15, 0.6})
        ASSERT_NO_FATAL_FAILURE(expect_all_crossings(t, midpoint, half, crossings)) << midpoint << ", " << half;
  }
  EXPECT_GT(crossings, 10000u);
}

TEST(RotatingWindow, is_given_up_where_too_many_boxes_meet) {
  const TurnedPair t = turned(shapes::noisy_star(40, 0.5, 1), shapes::noisy_star(30, 0.7, 2));
  const RotationGrid grid(*t.forms, 24);
  const RotatingWindow whole(grid, *t.catalog, 0.3, 0.05, true);
  EXPECT_TRUE(whole.complete);
  EXPECT_TRUE(RotatingWindow(grid, *t.catalog, 0.3, 0.05, true, whole.pair_tests).complete);
  EXPECT_FALSE(RotatingWindow(grid, *t.catalog, 0.3, 0.05, true, whole.pair_tests / 2).complete);
}

TEST(RotationGrid, a_vertex_moves_no_farther_than_it_is_said_to) {
  oracles::Random random(11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random.below(1u << 20)) / (1 << 20);
  };
  double tightest = 1;
  for (int k = 0; k < 20000; ++k) {
    const Point p{between(-3, 3), between(-3, 3)};
    const double half = std::exp2(between(-20, 0)), delta = between(-half, half);
    const Heading h = Heading::of(delta);
    const Point to{h.c * p.x - h.s * p.y, h.s * p.x + h.c * p.y}, most = moved_by(p, half);
    EXPECT_LE(std::abs(to.x - p.x), most.x + 1e-15);
    EXPECT_LE(std::abs(to.y - p.y), most.y + 1e-15);
    tightest = std::min(tightest, 1 - std::abs(to.x - p.x) / most.x);
  }
  EXPECT_LT(tightest, 0.01) << "no more than needed";
}

}  // namespace
}  // namespace dymsum::planar
