// The winding engine: winding numbers against membership, the graph of segments, and the same sums as the other
// engines.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "dymsum/planar_sum.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/pair_text.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/collision.h"
#include "planar/boundary/winding_boundary.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

constexpr std::uint64_t kSeed = 141421;

Result<PlanarSum> sum_by(Engine engine, const Region& p, const Region& q, Semantics semantics = Semantics::closed) {
  SumOptions options;
  options.engine = engine;
  options.semantics = semantics;
  return minkowski_sum(p, q, options);
}

struct Operands {
  Operands(const Region& a, const Region& b) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    p = *placed_on(*lattice, kept_p);
    q = *placed_on(*lattice, kept_q);
  }
  std::shared_ptr<const Lattice> lattice;
  Operand p, q;
};

Tracing kinetic_tracing(const Operands& o) {
  Tracing tracing(*o.lattice, o.p, o.q);
  for (const KineticSegment& s : kinetic_convolution(*o.lattice, o.p, o.q)) tracing.add(s.walk, s.sign);
  return tracing;
}

/// The winding number at a position given in lattice units. Operands on small integers only: these doubles are exact.
int winding_at(const Tracing& tracing, double x, double y) {
  int winding = 0;
  for (std::uint32_t s = 0; s < tracing.soup.size(); ++s) {
    const SoupBox& b = tracing.soup.boxes[s];
    if ((b.ay > y) == (b.by > y)) continue;
    const double side = (b.bx - b.ax) * (y - b.ay) - (b.by - b.ay) * (x - b.ax);
    if (b.by > b.ay && side > 0) winding += tracing.signs[s];
    if (b.by < b.ay && side < 0) winding -= tracing.signs[s];
  }
  return winding;
}

SegmentGraph graph_of(const Tracing& tracing) {
  Meetings meetings;
  CrossingFinder(tracing.soup, meetings).all_pairs();
  return SegmentGraph(tracing.soup, std::move(meetings));
}

template <class Check>
void for_tiny_pairs(int count, const Check& check) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (int k = 0; k < count; ++k) {
    oracles::Random random(kSeed + static_cast<std::uint64_t>(k));
    const auto [p, q] = oracles::random_pair(random, 2 + random.below(5));
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + oracles::to_text(p, q));
    check(Region::create(p).value(), Region::create(q).value(), random);
    if (::testing::Test::HasFailure()) return;
  }
}

// Off every line through two grid points of these sizes: an irrational-looking offset.
TEST(KineticWinding, is_positive_exactly_in_the_open_sum) {
  int inside = 0, outside = 0, several = 0;
  for_tiny_pairs(400, [&](const Region& p, const Region& q, oracles::Random& random) {
    const Operands o(p, q);
    const Tracing tracing = kinetic_tracing(o);
    const double unit = o.lattice->unit;
    const auto a = bounds(p), b = bounds(q);
    for (int i = 0; i < 12; ++i) {
      const double gx = random.below(static_cast<int>(a[2] + b[2] - a[0] - b[0]) + 1) + 419.0 / 1024;
      const double gy = random.below(static_cast<int>(a[3] + b[3] - a[1] - b[1]) + 1) + 31.0 / 8192;
      const int winding = winding_at(tracing, gx / unit, gy / unit);
      const Point z = {o.lattice->points[0]->offset.x + o.lattice->points[1]->offset.x + gx,
                       o.lattice->points[0]->offset.y + o.lattice->points[1]->offset.y + gy};
      ASSERT_EQ(winding > 0, contains(p, q, z, Semantics::open))
          << "winding number " << winding << " at " << z.x << " " << z.y;
      ASSERT_GE(winding, 0);
      inside += winding > 0;
      several += winding > 1;
      outside += winding == 0;
    }
  });
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 200);
  EXPECT_GT(several, 20);
}

// Without the hole filter the Euler characteristic vanishes where one operand covers a hole of the other.
TEST(KineticWinding, is_one_where_a_square_covers_the_hole_of_a_frame) {
  const Region frame =
      Region::create({{{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{{3, 3}, {3, 5}, {5, 5}, {5, 3}}}}}, {}, {}}).value();
  const Operands o(frame, shapes::rectangle(-2, -2, 2, 2));
  EXPECT_EQ(winding_at(kinetic_tracing(o), 6.25, 6.125), 1);  // (4.25, 4.125) in the plane: the square covers the hole
  EXPECT_EQ(winding_at(kinetic_tracing(o), -1, 6.125), 0);
}

TEST(SegmentGraph, cuts_at_every_meeting_and_merges_what_coincides) {
  const Operands o(shapes::rectangle(0, 0, 2, 2), shapes::rectangle(0, 0, 1, 1));
  const Tracing tracing = kinetic_tracing(o);
  const SegmentGraph graph = graph_of(tracing);
  EXPECT_EQ(graph.nodes().size(), 8u);  // four corners, and where two parallel edges follow each other
  EXPECT_EQ(graph.edges().size(), 8u);
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(graph.rays(v).size(), 2u);
}

// Euler's formula with the number of faces counted by walking around them; rays turn counter-clockwise and differ.
TEST(SegmentGraph, is_planar) {
  std::size_t crossings = 0, merged = 0;
  for_tiny_pairs(200, [&](const Region& p, const Region& q, oracles::Random&) {
    const Operands o(p, q);
    const Tracing tracing = kinetic_tracing(o);
    const SegmentGraph graph = graph_of(tracing);
    const std::size_t n = graph.nodes().size(), m = graph.edges().size();
    std::vector<std::uint32_t> parent(n);
    for (std::uint32_t v = 0; v < n; ++v) parent[v] = v;
    const auto find = [&](std::uint32_t v) {
      while (parent[v] != v) v = parent[v];
      return v;
    };
    std::size_t pieces = n;
    for (const SegmentGraph::Edge& e : graph.edges()) {
      merged += e.last - e.first > 1;
      const std::uint32_t a = find(e.low), b = find(e.high);
      if (a != b) --pieces;
      parent[a] = b;
    }
    // Half-edges: 2 edge + (0 from low to high, 1 back); the face on the left goes on with the next ray clockwise.
    std::vector<std::size_t> next(2 * m);
    for (std::uint32_t v = 0; v < n; ++v) {
      const auto rays = graph.rays(v);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i > 0) {
          ASSERT_LT(graph.compare(rays[i - 1], rays[i]), 0);
        }
        const auto& before = rays[(i + rays.size() - 1) % rays.size()];
        next[2 * rays[i].edge + (rays[i].forward ? 1 : 0)] = 2 * before.edge + (before.forward ? 0 : 1);
      }
    }
    std::size_t cycles = 0;
    std::vector<bool> seen(2 * m, false);
    for (std::size_t h = 0; h < 2 * m; ++h) {
      if (seen[h]) continue;
      ++cycles;
      for (std::size_t at = h; !seen[at]; at = next[at]) seen[at] = true;
    }
    EXPECT_EQ(n - m + cycles, 2 * pieces);
    crossings += graph.crossing_count();
  });
  EXPECT_GT(crossings, 300u);
  EXPECT_GT(merged, 300u);
}

TEST(WindingNumbers, around_nodes_are_those_of_rays_and_positive_exactly_inside) {
  std::size_t edges = 0, boundary = 0;
  for_tiny_pairs(200, [&](const Region& p, const Region& q, oracles::Random&) {
    const Operands o(p, q);
    const Tracing tracing = kinetic_tracing(o);
    const SegmentGraph graph = graph_of(tracing);
    const std::vector<Sides> sides = find_windings(tracing, graph);
    Collision collision(*o.lattice, o.p, o.q, false);
    for (std::uint32_t e = 0; e < sides.size(); ++e) {
      const SegmentGraph::Edge& edge = graph.edges()[e];
      const SegmentPosition x = graph.sample(e);
      const bool forward = SegmentGraph::forward(edge, graph.sub_edges()[edge.first]);
      const int right = forward ? sides[e].right : sides[e].left;
      int passed = 0;
      RayRows(tracing.soup).for_each_passed(x, [&](std::uint32_t s, int by) { passed += by * tracing.signs[s]; });
      ASSERT_EQ(passed, right);
      ASSERT_EQ(collision.overlaps_right_of(x), right > 0);
      ++edges;
      boundary += (sides[e].left > 0) != (sides[e].right > 0);
    }
  });
  EXPECT_GT(edges, 3000u);
  EXPECT_GT(boundary, 500u);
}

TEST(WindingNumbers, of_a_tracing_that_is_not_closed_are_refused) {
  const Operands o(shapes::rectangle(0, 0, 2, 2), shapes::rectangle(0, 0, 1, 1));
  Tracing tracing = kinetic_tracing(o);
  tracing.signs[0] = 2;
  EXPECT_THROW(find_windings(tracing, graph_of(tracing)), std::logic_error);
}

TEST(WindingEngine, gives_the_sum_by_definition_and_those_of_the_other_engines) {
  std::uint64_t tight = 0, holes = 0;
  for_tiny_pairs(400, [&](const Region& p, const Region& q, oracles::Random&) {
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      const Result<PlanarSum> mine = sum_by(Engine::winding, p, q, semantics);
      ASSERT_TRUE(mine.ok());
      ASSERT_EQ(oracles::check_sum(p, q, semantics, *mine), "");
      ASSERT_TRUE(*mine == *sum_by(Engine::brute, p, q, semantics)) << "semantics " << static_cast<int>(semantics);
      ASSERT_TRUE(*mine == *sum_by(Engine::fast, p, q, semantics)) << "semantics " << static_cast<int>(semantics);
      tight += mine->tight_points.size() + mine->tight_segments.size();
      holes += mine->hole_count();
    }
  });
  EXPECT_GT(tight, 50u);
  EXPECT_GT(holes, 10u);
}

TEST(WindingEngine, gives_the_sums_of_the_other_engines_on_larger_shapes) {
  const Region shapes[] = {
      snapped_shapes::star(9, 1, 3),  shapes::grate(5, 3, 1, 7),     shapes::random_polygon(40, 3, 11),
      shapes::comb(5, 2, 1, 4),       snapped_shapes::gear(8, 2, 3), snapped_shapes::spiral(2, 9, 1.5, 0.5),
      shapes::noisy_star(30, 0.6, 4), shapes::letter_u(4, 4, 1),     snapped_shapes::pockets(4, 1)};
  for (const Region& p : shapes)
    for (const Region& q : shapes) {
      const Result<PlanarSum> mine = sum_by(Engine::winding, p, q);
      ASSERT_TRUE(mine.ok());
      ASSERT_TRUE(*mine == *sum_by(Engine::fast, p, q)) << oracles::to_text(p.data(), q.data());
      ASSERT_TRUE(*sum_by(Engine::winding, p, negated(q)) == *sum_by(Engine::fast, p, negated(q)))
          << oracles::to_text(p.data(), negated(q).data());
    }
}

TEST(WindingEngine, tests_no_face_for_collision) {
  SumOptions options;
  options.engine = Engine::winding;
  options.semantics = Semantics::regular;
  const Result<PlanarSum> sum = minkowski_sum(shapes::grate(4, 3, 1, 5), snapped_shapes::star(5, 0.2, 0.6), options);
  ASSERT_TRUE(sum.ok());
  EXPECT_EQ(sum->stats.collision_tests, 0u);
  EXPECT_GT(sum->hole_count(), 0u);
  EXPECT_EQ(sum->stats.reduced_segments,
            convolution_sizes(shapes::grate(4, 3, 1, 5), snapped_shapes::star(5, 0.2, 0.6)).kinetic);
}

TEST(WindingEngine, stops_on_request_at_every_stage) {
  const Region p = snapped_shapes::star(9, 1, 3), q = shapes::letter_u(4, 4, 1);
  for (const std::string_view stage : {"convolution", "crossings", "arrangement", "windings", "loops", "tight"}) {
    SumOptions options;
    options.engine = Engine::winding;
    options.progress = [&](std::string_view at, double fraction) { return at != stage || fraction < 1; };
    const Result<PlanarSum> sum = minkowski_sum(p, q, options);
    ASSERT_FALSE(sum.ok()) << stage;
    EXPECT_EQ(sum.error().code, ErrorCode::cancelled);
  }
}

TEST(WindingEngine, agrees_on_the_shapes_of_the_thesis) {
  const std::filesystem::path folder = std::filesystem::path(DYMSUM_SOURCE_DIR) / "../shared/data/planar";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no thesis data";
  const auto load = [&](const char* name) {
    return Region::create(read_region_data((folder / name).string()).value()).value();
  };
  const Region star = load("star.poly"), texas = load("texas.poly"), dog = load("dog.poly");
  for (const auto& [p, q] :
       {std::pair{star, star}, std::pair{star, negated(star)}, std::pair{texas, star}, std::pair{dog, star}})
    EXPECT_TRUE(*sum_by(Engine::winding, p, q) == *sum_by(Engine::fast, p, q));
}

}  // namespace
}  // namespace dymsum::planar
