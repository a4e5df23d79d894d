// Events of scaling sums of solids: between them the combinatorics are constant, at them they differ; no tuple of
// moving planes meets outside of the open sum at another scale and changes anything.
#include "dymsum/solid_scale_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "dymsum/moving_solid_sum.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/convex/setting.h"
#include "spatial/events/meeting_point.h"
#include "spatial/events/moving_facets.h"
#include "spatial/events/plane_names.h"
#include "spatial/moving/moving_cases.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum {
namespace {

using exact::BigRational;
using spatial::SumShape;

Scale scale(const Rational& s) { return Scale::of(s).value(); }
Scale scale(const char* text) { return Scale::parse(text).value(); }

SpatialSum fresh(const Mesh& p, const Mesh& q, const Rational& s) {
  SolidPose of_q;
  of_q.scale = {scale(s), scale(s), scale(s)};
  return posed_sum(p, q, {}, of_q).value();
}
SumShape shape_at(const Mesh& p, const Mesh& q, const Rational& s) {
  const spatial::ScalingPair pair(spatial::solid_pair(p, q), 1);
  return spatial::shape_of(fresh(p, q, s), [&](const SolidContact& c) { return spatial::plane_name(pair, c); });
}

/// What a list of events promises, asked of sums from scratch.
void check_events(const std::string& name, const Mesh& p, const Mesh& q, const Scale& a, const Scale& b,
                  const std::vector<ScaleEvent>& events) {
  std::vector<Rational> ends{a.exact()};
  for (const ScaleEvent& e : events) ends.push_back(e.parameter);
  ends.push_back(b.exact());
  std::vector<SumShape> between;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    ASSERT_LE(ends[k], ends[k + 1]) << name;
    const Rational gap = ends[k + 1] - ends[k];
    between.push_back(shape_at(p, q, ends[k] + gap / Rational(3)));
    for (const Rational& fraction : {*Rational::of(1, 17), *Rational::of(5, 8), *Rational::of(30, 31)})
      ASSERT_EQ(shape_at(p, q, ends[k] + gap * fraction).hash, between.back().hash)
          << name << ": between " << ends[k].to_string() << " and " << ends[k + 1].to_string();
  }
  for (std::size_t k = 0; k < events.size(); ++k) {
    if (ends[k] == ends[k + 1] || ends[k + 1] == ends[k + 2]) continue;
    const SumShape here = shape_at(p, q, events[k].parameter);
    EXPECT_FALSE(here == between[k] && here == between[k + 1])
        << name << ": nothing at " << events[k].parameter.to_string();
    EXPECT_EQ(events[k].topology,
              !(here.topology == between[k].topology) || !(here.topology == between[k + 1].topology))
        << name << ": topology at " << events[k].parameter.to_string();
  }
}

std::size_t run(const std::string& name, const Mesh& p, const Mesh& q, const Scale& a, const Scale& b) {
  const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
  const Result<std::vector<ScaleEvent>> events = sum.events(a, b);
  EXPECT_TRUE(events.ok()) << name << ": " << events.error().to_string();
  if (!events.ok()) return 0;
  check_events(name, p, q, a, b, *events);
  return events->size();
}

TEST(SolidScaleEvents, EventsSeparateTheCombinatoricsOfSmallPairs) {
  std::size_t found = 0;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    const bool long_one = name == "torus with itself" || name == "gears in mesh" || name == "tori";
    found += run(name, p, q, scale(long_one ? "31/32" : "3/4"), scale(long_one ? "33/32" : "3/2"));
  }
  EXPECT_GT(found, 40u);
}

/// Seven of these events are points of four facets, no two of which share a facet edge: the thesis has none of them.
TEST(SolidScaleEvents, FourFacetsInAPointAreEvents) {
  MeshData across = moving_cases::torus(2, 0.75, 5, 5);
  for (Point3& v : across.vertices) v = {v.y, v.z, v.x};
  const Mesh p = moving_cases::mesh_of(moving_cases::torus(3, 1, 6, 4)), q = moving_cases::mesh_of(across);
  EXPECT_EQ(run("tori across each other", p, q, scale("1/2"), scale("2")), 28u);
}

TEST(SolidScaleEvents, EventsOfRandomPolyhedraOnTinyGrids) {
  const std::uint64_t seed = test::setting("DYMSUM_FUZZ_SEED", 71), rounds = test::setting("DYMSUM_FUZZ_EVENTS", 6);
  std::mt19937_64 random(seed);
  std::size_t found = 0;
  for (std::uint64_t k = 0; k < rounds; ++k) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    found += run("seed " + std::to_string(seed) + ", round " + std::to_string(k), p, q, scale("1/4"), scale("4"));
  }
  EXPECT_GT(found, rounds / 2);
}

/// Every four of the planes of facets and of those along facet edges, by exact rationals: the sum has no other
/// combinatorics beside any of their scales than the events tell.
TEST(SolidScaleEvents, NoFourPlanesMeetWhereAnEventIsMissing) {
  std::mt19937_64 random(9);
  std::size_t candidates = 0;
  for (int round = 0; round < 2; ++round) {
    const Mesh p = moving_cases::mesh_of(round == 0 ? ell() : tunnel()), q = random_solids::valid_polyhedron(random);
    SpatialStats stats;
    SpatialOptions options;
    spatial::StageWatch watch(options, stats);
    watch.begin("convolution");
    const spatial::MovingFacets all(spatial::ScalingPair(spatial::solid_pair(p, q), 1), watch);
    std::set<BigRational> scales;
    std::vector<const spatial::MovingPlane*> planes;
    std::set<std::uint32_t> known;
    for (std::uint32_t f = 0; f < all.facets().size(); ++f)
      if (known.insert(all.name(f)).second) planes.push_back(&all.plane(f));
    // All corners against all planes, and a fraction of all fours.
    for (const auto* plane : planes)
      for (const spatial::SumPoint c : all.corners().all())
        if (const auto at = spatial::meeting_of(all, c, *plane)) scales.insert(at->scale());
    for (int k = 0; k < 4000; ++k) {
      const auto any = [&] { return planes[random() % planes.size()]; };
      if (const auto at = spatial::meeting_of({any(), any(), any(), any()})) scales.insert(at->scale());
    }
    const BigRational low(3, 4), high(5, 4);
    std::erase_if(scales, [&](const BigRational& s) { return s <= low || s >= high; });
    const std::vector<ScaleEvent> events =
        SolidScaleEvents::create(p, q).value().events(scale("3/4"), scale("5/4")).value();
    std::set<BigRational> listed;
    for (const ScaleEvent& e : events) listed.insert(exact::exact_value(e.parameter));
    const std::vector<BigRational> order(scales.begin(), scales.end());
    const std::size_t step = std::max<std::size_t>(1, order.size() / 60);
    for (std::size_t k = 1; k + 1 < order.size(); k += step) {
      if (listed.contains(order[k])) continue;
      ++candidates;
      const auto hash = [&](const BigRational& s) { return shape_at(p, q, exact::to_rational(s)).hash; };
      const auto next = listed.upper_bound(order[k]);
      BigRational after = BigRational((order[k] + order[k + 1]) / 2),
                  before = BigRational((order[k] + order[k - 1]) / 2);
      if (next != listed.end() && after >= *next) after = BigRational((order[k] + *next) / 2);
      if (next != listed.begin() && *std::prev(next) >= before) before = BigRational((order[k] + *std::prev(next)) / 2);
      ASSERT_EQ(hash(before), hash(order[k])) << order[k];
      ASSERT_EQ(hash(after), hash(order[k])) << order[k];
    }
  }
  EXPECT_GT(candidates, 10u);
}

/// Two combs across each other: hundreds of facet edges and facets in few planes, where most fours of planes have no
/// one point in common or share one, so that few are looked at.
TEST(SolidScaleEvents, MassesInFewPlanesAreDecidedOnce) {
  Ring teeth;
  for (int k = 0; k < 4; ++k)
    for (const auto& [x, y] : {std::pair{2, 1}, {2, 4}, {3, 4}, {3, 1}})
      teeth.push_back({static_cast<double>(2 * k + x), static_cast<double>(y)});
  teeth.push_back({9, 0}), teeth.push_back({2, 0});
  // Counter-clockwise, and the other comb with its teeth along another axis.
  std::reverse(teeth.begin(), teeth.end());
  const Mesh p = solids::prism(teeth, 1, solids::kDemoSnap);
  MeshData upright = p.data();
  for (Point3& v : upright.vertices) v = {v.y, v.z, v.x};
  const Mesh q = moving_cases::mesh_of(upright);
  const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
  SolidEventWork work;
  const std::vector<ScaleEvent> events = sum.events(scale("1/2"), scale("9/8"), {}, &work).value();
  EXPECT_FALSE(events.empty());
  check_events("combs", p, q, scale("1/2"), scale("9/8"), events);
  EXPECT_LT(work.candidates, 100000u);
}

/// Turned in doubles, plane faces are planes 1e-16 apart, and no position in front of what meets there is apart from
/// all else in doubles: the facets there tell nearly all the same.
TEST(SolidScaleEvents, EventsOfTurnedTorusesTakeFewSums) {
  std::mt19937_64 random(4);
  const Mesh p = moving_cases::mesh_of(of_kind(moving_cases::torus(2, 0.75, 8, 5), CoordinateKind::turned, random)),
             q = moving_cases::mesh_of(of_kind(moving_cases::torus(1, 0.375, 6, 4), CoordinateKind::turned, random));
  const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
  SolidEventWork work;
  const std::vector<ScaleEvent> events = sum.events(scale("1"), scale("17/16"), {}, &work).value();
  EXPECT_FALSE(events.empty());
  EXPECT_LT(work.sums, 10u + work.values / 4) << work.values << " scales, " << events.size() << " events";
  check_events("turned tori", p, q, scale("1"), scale("17/16"), events);
}

/// Coordinates that are long because a solid is far away, moved back exactly: nothing else decides the events, and no
/// candidate, exact point or sum more is needed.
TEST(SolidScaleEvents, SolidsFarFromTheOriginCostNoMoreThanBesideIt) {
  std::mt19937_64 random(9);
  std::size_t all = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const MovingOperand moving : {MovingOperand::p, MovingOperand::q}) {
      const auto far = [&](MeshData data, Point3 by) {
        data = of_kind(std::move(data), kind, random);
        for (Point3& v : data.vertices) v = {v.x + by.x, v.y + by.y, v.z + by.z};
        return moving_cases::mesh_of(data);
      };
      // Along every axis the coordinate nearest to zero is subtracted, which has to be exact.
      const auto back = [](const Mesh& mesh) {
        MeshData data = mesh.data();
        Point3 least = data.vertices[0];
        const auto nearer = [](double a, double b) { return std::abs(b) < std::abs(a) ? b : a; };
        for (const Point3& v : data.vertices)
          least = {nearer(least.x, v.x), nearer(least.y, v.y), nearer(least.z, v.z)};
        for (Point3& v : data.vertices) {
          const Point3 to{v.x - least.x, v.y - least.y, v.z - least.z};
          EXPECT_EQ(exact::exact_value(to.x), BigRational(exact::exact_value(v.x) - exact::exact_value(least.x)));
          v = to;
        }
        return moving_cases::mesh_of(data);
      };
      const Mesh p = far(moving_cases::torus(2, 0.75, 8, 5), {1e5 / 3, -1e4 / 7, 777}),
                 q = far(moving_cases::torus(1, 0.375, 6, 4), {-1e3 / 7, 1e6 / 3, -1e4});
      SolidScaleOptions options;
      options.moving = moving;
      SolidEventWork there, here;
      const SolidScaleEvents sum = SolidScaleEvents::create(p, q, options).value();
      const std::vector<ScaleEvent> events = sum.events(scale("1"), scale("17/16"), {}, &there).value();
      EXPECT_EQ(
          events,
          SolidScaleEvents::create(back(p), back(q), options)->events(scale("1"), scale("17/16"), {}, &here).value())
          << name_of(kind);
      EXPECT_EQ(std::tie(there.candidates, there.exact, there.points, there.values, there.sums),
                std::tie(here.candidates, here.exact, here.points, here.values, here.sums))
          << name_of(kind);
      all += events.size();
      // Sums stay where the operands are.
      SolidPose pose;
      pose.scale = {scale("33/32"), scale("33/32"), scale("33/32")};
      EXPECT_EQ(sum.at(scale("33/32")).value(),
                moving == MovingOperand::q ? posed_sum(p, q, {}, pose).value() : posed_sum(p, q, pose, {}).value())
          << name_of(kind);
      if (kind == CoordinateKind::grid && moving == MovingOperand::q)
        check_events("far", p, q, scale("1"), scale("17/16"), events);
    }
  EXPECT_GT(all, 8u);
}

TEST(SolidScaleEvents, BoxesCoincideAtQuarterScales) {
  // A peg of side 1 in a block with a square hole of side 1: at scale 1 it fits exactly, above 1 it does not enter.
  const Mesh block = moving_cases::mesh_of(tunnel()), peg = moving_cases::mesh_of(box(1));
  const SolidScaleEvents sum = SolidScaleEvents::create(block, peg).value();
  const std::vector<ScaleEvent> events = sum.events(scale("1/4"), scale("2")).value();
  std::size_t topology = 0;
  for (const ScaleEvent& e : events) {
    EXPECT_TRUE((e.parameter * Rational(4)).is_integer()) << e.parameter.to_string();
    topology += e.topology;
    if (e.parameter == Rational(1)) {
      const SpatialSum at = sum.at(scale("1")).value();
      EXPECT_EQ(at.tight_faces.size() + at.tight_segments.size() + at.tight_points.size(), 1u);
      EXPECT_EQ(e.kind, ScaleEvent::Kind::coplanar_facets);
    }
  }
  EXPECT_EQ(topology, 1u);
  check_events("peg", block, peg, scale("1/4"), scale("2"), events);
}

TEST(SolidScaleEvents, PrismsHaveTheEventsOfTheirBases) {
  // A gear-like base and a square: the extruded solids meet as their bases do.
  const Ring star{{0, 0}, {4, 1}, {8, 0}, {7, 4}, {8, 8}, {4, 7}, {0, 8}, {1, 4}};
  const Ring ell_ring{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Region p = Region::create({{{star, {}}}, {}, {}}).value(),
               q = Region::create({{{ell_ring, {}}}, {}, {}}).value();
  MovingOptions moving;
  moving.moving = MovingOperand::q;
  std::vector<Rational> planar;
  for (const ScaleEvent& e : ScalingSum::create(p, q, moving)->events(scale("1/2"), scale("3")).value())
    if (e.visible) planar.push_back(e.parameter);
  std::vector<Rational> spatial;
  const Mesh solid_p = solids::prism(star, 5, solids::kDemoSnap),
             solid_q = solids::prism(ell_ring, 1, solids::kDemoSnap);
  for (const ScaleEvent& e : SolidScaleEvents::create(solid_p, solid_q)->events(scale("1/2"), scale("3")).value())
    spatial.push_back(e.parameter);
  EXPECT_FALSE(planar.empty());
  EXPECT_EQ(spatial, planar);
}

TEST(SolidScaleEvents, BallInACupIsShutIn) {
  // A cavity of side 3 and a cube: the cavity of the sum vanishes where the cube is as large.
  const Mesh p = moving_cases::mesh_of(cavity()), q = moving_cases::mesh_of(box(1));
  const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
  const std::optional<ScaleEvent> change = sum.next_topology_change(scale("1/8"), scale("8")).value();
  ASSERT_TRUE(change.has_value());
  const SpatialSum before = sum.at(scale(change->parameter * *Rational::of(99, 100))).value(),
                   at = sum.at(scale(change->parameter)).value(),
                   after = sum.at(scale(change->parameter * *Rational::of(101, 100))).value();
  EXPECT_EQ(before.shells, 2u);
  EXPECT_EQ(after.shells, 1u);
  EXPECT_EQ(at.tight_points.size() + at.tight_segments.size() + at.tight_faces.size(), 1u);
  EXPECT_FALSE(sum.next_topology_change(scale(change->parameter), scale("8")).value().has_value());
}

TEST(SolidScaleEvents, NextEventsAreThoseOfTheList) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(2, 1)), q = moving_cases::mesh_of(moving_cases::bumpy(2, 2));
  const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
  const std::vector<ScaleEvent> events = sum.events(scale("1"), scale("11/10")).value();
  ASSERT_GT(events.size(), 3u);
  Scale from = scale("1");
  for (const ScaleEvent& e : events) {
    const std::optional<ScaleEvent> next = sum.next_event(from, scale("11/10")).value();
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(*next, e);
    from = scale(next->parameter);
  }
  EXPECT_FALSE(sum.next_event(from, scale("11/10")).value().has_value());
  SolidScaleOptions options;
  options.threads = 2;
  EXPECT_EQ(SolidScaleEvents::create(p, q, options)->events(scale("1"), scale("11/10")).value(), events);
}

TEST(SolidScaleEvents, EitherOperandScales) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(2, 1)), q = moving_cases::mesh_of(moving_cases::bumpy(2, 2));
  SolidScaleOptions options;
  options.moving = MovingOperand::p;
  // s P + Q at s is s (P + Q / s).
  std::vector<Rational> forth, back;
  for (const ScaleEvent& e : SolidScaleEvents::create(p, q, options)->events(scale("20/21"), scale("21/20")).value())
    forth.push_back(e.parameter);
  for (const ScaleEvent& e : SolidScaleEvents::create(p, q)->events(scale("20/21"), scale("21/20")).value())
    back.insert(back.begin(), Rational(1) / e.parameter);
  EXPECT_FALSE(forth.empty());
  EXPECT_EQ(forth, back);
}

TEST(SolidScaleEvents, RefusesWhatItDoesNotTake) {
  const Mesh cube = moving_cases::mesh_of(box(1));
  const Mesh plate = Mesh::with_thin_parts({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).value();
  EXPECT_EQ(SolidScaleEvents::create(cube, plate).error().code, ErrorCode::unsupported_operand);
  SolidScaleOptions options;
  options.threads = -1;
  EXPECT_EQ(SolidScaleEvents::create(cube, cube, options).error().code, ErrorCode::out_of_range);
  const SolidScaleEvents sum = SolidScaleEvents::create(cube, cube).value();
  EXPECT_EQ(sum.events(scale("2"), scale("1")).error().code, ErrorCode::bad_scale);
  EXPECT_EQ(sum.events(scale("1"), scale("2"), [](std::string_view, double) { return false; }).error().code,
            ErrorCode::cancelled);
  EXPECT_TRUE(SolidScaleEvents::create(Mesh(), cube)->events(scale("1"), scale("2"))->empty());
}

}  // namespace
}  // namespace dymsum
