// Translates of one edge that cover each other: what lies beneath an edge, spans, and sums by them.
#include "planar/arrangement/covered_translates.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/pair_text.h"
#include "oracles/sanitized.h"
#include "planar/operand/operand.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"
#include "planar/sum/reduced.h"

namespace dymsum::planar {
namespace {

using Exact = oracles::Membership<oracles::Big>;

bool overlaps(const Exact& sum, Point at) {
  return sum.overlaps({oracles::from_double<oracles::Big>(at.x), oracles::from_double<oracles::Big>(at.y)});
}

Region region(std::string_view text) { return *Region::create(oracles::parse_wkt(text)); }

/// Acute, right, obtuse and reflex ends; edges with little beneath them; edges of holes.
std::vector<Region> various() {
  return {snapped_shapes::disc(12, 0.3),
          region("POLYGON((0 0,1 0,0.3 0.7,0 0))"),
          region("POLYGON((0 0,4 0,4 1,1 1,1 4,0 4,0 0))"),
          region("POLYGON((0 0,6 0,6 6,0 6,0 0),(2 2,2 4,4 4,4 2,2 2))"),
          region("POLYGON((0 0,8 0,5 1,8 8,0 5,0 0))"),
          snapped_shapes::star(5, 0.3, 1),
          snapped_shapes::gear(6, 0.7, 1)};
}

TEST(CoveredTranslates, what_lies_beneath_an_edge_is_interior) {
  const Region origin = region("POINT(0 0)");
  int found = 0;
  for (const Region& shape : various()) {
    const auto point = prepared_operand(origin, 0), kept = prepared_operand(shape, 1);
    const auto lattice = make_lattice(point->points, kept->points, 0);
    const auto o = placed_on(*lattice, kept);
    const Exact sum(origin.data(), shape.data());
    for (std::uint32_t e = 0; e < o->boxes.size(); ++e) {
      const Beneath b = beneath(*o, e, 0x1p-40 * lattice->span);
      if (b.depth == 0) continue;
      ++found;
      const EdgeBox& box = o->boxes[e];
      const double length = std::hypot(box.dx, box.dy), ux = box.dx / length, uy = box.dy / length;
      for (const double fraction : {1e-6, 0.25, 0.75, 1 - 1e-6})
        for (const double between : {1e-6, 0.5, 1 - 1e-6}) {
          const double depth = fraction * std::min(b.depth, 2 * length);
          const double from = b.from_start * depth, to = length - b.from_end * depth;
          if (from >= to) continue;
          const double along = from + between * (to - from);
          const Point at = lattice->to_input(box.ax + ux * along - uy * depth, box.ay + uy * along + ux * depth);
          ASSERT_TRUE(overlaps(sum, at)) << oracles::to_text(origin.data(), shape.data()) << " edge " << e << " depth "
                                         << depth << " at " << along;
        }
    }
  }
  EXPECT_GT(found, 30);
}

TEST(CoveredTranslates, spans_hold_every_point_outside_the_open_sum) {
  const int n = 150;  // fewer translates of an edge are not looked at
  for (const Region& q : various()) {
    const Region p = shapes::noisy_star(n, 0.02, 5);
    const auto kept_p = prepared_operand(p, 0), kept_q = prepared_operand(q, 1);
    const auto lattice = make_lattice(kept_p->points, kept_q->points, 0);
    const auto op = placed_on(*lattice, kept_p), oq = placed_on(*lattice, kept_q);
    const ReducedConvolution convolution(*lattice, *op, *oq);
    Soup soup(*lattice, *op, *oq);
    add_all(convolution, soup);
    const Progress never;
    const Array<Span> spans = uncovered_spans(soup, 0x1p-28 * lattice->span, 1, Poll(never));
    ASSERT_FALSE(spans.empty());
    const Exact sum(p.data(), q.data());
    int covered = 0;
    for (std::uint32_t s = 0; s < soup.size(); ++s) {
      const Span span = spans[s];
      const SoupBox& b = soup.boxes[s];
      const auto check = [&](double t) {
        ++covered;
        ASSERT_TRUE(overlaps(sum, lattice->to_input(b.ax + t * b.dx, b.ay + t * b.dy)))
            << oracles::to_text({}, q.data()) << " segment " << s << " at " << t;
      };
      const bool none = span.low > span.high;
      const double low = none ? 1 : span.low, high = none ? 1 : span.high;
      for (const double t : {0.0, 0.5 * low, low})
        if (low > 0) check(t);
      for (const double t : {high, 0.5 * (1 + high), 1.0})
        if (high < 1) check(t);
    }
    EXPECT_GT(covered, 20) << oracles::to_text({}, q.data());
  }
}

TEST(CoveredTranslates, sums_are_the_same_as_without) {
  SumOptions brute;
  brute.engine = Engine::brute;
  for (const double jitter : {1e-4, 1e-2, 0.2})
    for (const Region& q : various()) {
      const Region p = shapes::noisy_star(oracles::kSanitized ? 80 : 250, jitter, 3);
      Result<SumState> state = compute_boundary(prepared_operand(p, 0), prepared_operand(q, 1), {}, Refine::always);
      ASSERT_TRUE(state.ok());
      ASSERT_TRUE(finish_sum(std::move(state).value(), {}) == *minkowski_sum(p, q, brute))
          << oracles::to_text(p.data(), q.data());
    }
}

// Without it some 60 crossings for every vertex of the result.
TEST(CoveredTranslates, a_jittered_circle_and_a_polygon_have_few_crossings) {
  for (const double jitter : {1e-5, 1e-4, 1e-3}) {
    const Result<PlanarSum> sum = minkowski_sum(shapes::noisy_star(100000, jitter, 7), snapped_shapes::disc(64, 0.1));
    ASSERT_TRUE(sum.ok());
    EXPECT_LT(sum->stats.crossings, sum->vertex_count()) << "jitter " << jitter;
  }
}

}  // namespace
}  // namespace dymsum::planar
