// Events of a sum while an operand rotates: structure is constant between them and changes at visible ones.
#include "dymsum/solid_rotation_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>

#include "dymsum/orientation_sum.h"
#include "dymsum/shapes.h"
#include "dymsum/solids.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/snapped_shapes.h"
#include "spatial/motion/beside_origin.h"
#include "spatial/moving/moving_cases.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum {
namespace {

using moving_cases::mesh_of;

AxisTurn turn_at(const TurnAxis& axis, double radians) { return AxisTurn::nearest(axis, radians).value(); }

struct Seen {
  std::uint64_t hash = 0;
  std::vector<std::int64_t> euler;  // of shells
  friend bool operator==(const Seen&, const Seen&) = default;
};
Seen seen(const SolidRotationEvents& sum, const AxisTurn& turn) {
  const Result<SpatialSum> at = sum.at(turn);
  EXPECT_TRUE(at.ok()) << at.error().to_string();
  return {sum.combinatorial_hash(*at), spatial::shell_euler_numbers(*at)};
}

/// By kinds, then by features, each once: not as the search found them.
void check_order(const std::vector<SolidRotationEvent>& events, const std::string& name) {
  for (const SolidRotationEvent& event : events)
    for (std::size_t k = 1; k < event.contacts.size(); ++k) {
      const SolidRotationContact &a = event.contacts[k - 1], &b = event.contacts[k];
      EXPECT_TRUE(a.kind != b.kind ? a.kind < b.kind : a.features < b.features)
          << name << ": contacts " << k - 1 << " and " << k << " at " << event.approx;
    }
}

/// Between two samples with different structures lies a visible event, between neighbours with the same ones none (or
/// two): looked at by samples alone, which know nothing of events. Returns how many events are visible.
std::size_t check_by_samples(const SolidRotationEvents& sum, double from, double to, int samples,
                             const std::string& name) {
  const TurnAxis axis = sum.axis();
  const Result<std::vector<SolidRotationEvent>> events = sum.events(turn_at(axis, from), turn_at(axis, to));
  EXPECT_TRUE(events.ok()) << name << ": " << events.error().to_string();
  if (!events) return 0;
  check_order(*events, name);
  const SolidRotationWork w = sum.work();
  std::size_t visible = 0, next = 0;
  double last = from + 1e-9;
  Seen before = seen(sum, turn_at(axis, last));
  for (int k = 1; k <= samples; ++k) {
    const double angle = from + (to - from) * (k - 0.3456789) / samples;
    const Seen here = seen(sum, turn_at(axis, angle));
    std::size_t between = 0;
    for (; next < events->size() && (*events)[next].approx < angle; ++next)
      between += (*events)[next].approx > last && (*events)[next].visible;
    if (between == 0) {
      EXPECT_TRUE(here == before) << name << ": changed between " << last << " and " << angle;
    } else if (between == 1) {
      EXPECT_FALSE(here == before) << name << ": the same at " << last << " and " << angle;
    }
    visible += between, before = here, last = angle;
  }
  std::cout << name << ", axis " << axis[2] << " at " << from << ": " << visible << " visible; " << w.windows
            << " windows, " << w.facets << " facets, " << w.candidates << " candidates, " << w.roots << " meetings, "
            << w.covered << " covered, " << w.exact_tests << " tested, " << w.events << " events, " << w.sums
            << " sums, " << w.ms << " ms" << std::endl;
  return visible;
}

TEST(SolidRotationEvents, StructureIsConstantBetweenEventsAndChangesAtThem) {
  std::size_t visible = 0;
  double at = 0.1234;
  for (const auto& [name, p, q] : moving_cases::small_pairs())
    for (const TurnAxis& axis : {TurnAxis{0, 0, 1}, TurnAxis{1, 2, 3}}) {
      at = std::remainder(at + 1.1, 2.8);
      const SolidRotationEvents sum = SolidRotationEvents::create(p, q, axis).value();
      visible += check_by_samples(sum, at, at + 0.02, 8, name);
    }
  EXPECT_GT(visible, 40u);
}

/// Everything of these is parallel at zero: fours of planes that meet there are as many as fours of planes, about a
/// slanted axis 138,000 and 482,000. Nearly all of them have facets that exist on one side of that angle only.
TEST(SolidRotationEvents, MassesOfParallelFacesMeetAtZeroAlone) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name != "tunnel + L" && name != "L with itself" && name != "cubes") continue;
    for (const TurnAxis& axis : {TurnAxis{0, 0, 1}, TurnAxis{1, 2, 3}}) {
      const SolidRotationEvents sum = SolidRotationEvents::create(p, q, axis).value();
      EXPECT_EQ(check_by_samples(sum, -0.01, 0.01, 3, name), 1u) << name;
      EXPECT_LT(sum.work().candidates, 15000u) << name;
    }
  }
}

/// Turned in doubles, what is parallel at zero on a grid is parallel at dozens of angles within 1e-15 of it, between
/// which the sum has other structures. Samples between any two events show one of them, and those beside an event two.
TEST(SolidRotationEvents, MassesThatCoincideButForRoundingMeetOneAfterTheOther) {
  std::mt19937_64 random(6);
  const auto turned_prism = [&](const Ring& ring) {
    MeshData data = of_kind(solids::prism(ring, 1).data(), CoordinateKind::turned, random);
    std::vector<Face> triangles;  // four corners are in one plane but for rounding
    for (const Face& f : data.faces)
      for (std::size_t k = 2; k < f.size(); ++k) triangles.push_back({f[0], f[k - 1], f[k]});
    data.faces = std::move(triangles);
    return mesh_of(data);
  };
  const Mesh wedge = turned_prism({{0, 0}, {1, 0}, {0, 1}}), cube = turned_prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const TurnAxis axis{1, 2, 3};
  const auto exactly = [](double t) { return exact::exact_value(t); };
  for (const auto& [p, q] : {std::pair{wedge, wedge}, std::pair{cube, wedge}}) {
    const SolidRotationEvents sum = SolidRotationEvents::create(p, q, axis).value();
    const double first = -0x1p-8, last = 0x1p-8;
    const std::vector<SolidRotationEvent> events =
        sum.events(AxisTurn::of(exact::to_rational(exactly(first))), AxisTurn::of(exact::to_rational(exactly(last))))
            .value();
    check_order(events, "prisms");
    const SolidRotationWork work = sum.work();
    EXPECT_LT(work.candidates, 6000u);
    ASSERT_GT(events.size(), 3u);
    std::optional<Seen> before;
    std::size_t narrow = 0;
    for (std::size_t k = 0; k <= events.size(); ++k) {
      const exact::BigRational low = exactly(k == 0 ? first : events[k - 1].parameter.t_high),
                               high = exactly(k == events.size() ? last : events[k].parameter.t_low);
      if (!(low < high)) {  // doubles do not distinguish the events
        before.reset();
        continue;
      }
      std::optional<Seen> here;
      for (const int fraction : {1, 7, 15}) {
        const exact::BigRational t = low + (high - low) * fraction / 16;
        const Seen one = seen(sum, AxisTurn::of(exact::to_rational(t)));
        if (here) {
          EXPECT_TRUE(one == *here) << "between event " << k << " and the one before";
        }
        here = one;
      }
      narrow += abs(high) < exactly(1e-12) && abs(low) < exactly(1e-12);
      if (k > 0 && before) {
        const SolidRotationEvent& event = events[k - 1];
        const bool differs =
            !(*before == *here) || (event.parameter.exact && !(seen(sum, *event.parameter.exact) == *here));
        EXPECT_EQ(event.visible, differs) << k;
      }
      before = here;
    }
    EXPECT_GT(narrow, 1u);
    std::cout << events.size() << " events, " << work.windows << " windows, " << work.candidates << " candidates, "
              << work.exact_tests << " tested, " << work.sums << " sums" << std::endl;
  }
}

/// The same events, and the same work, as of the operands moved back, which tests/spatial/motion shows to be exact;
/// places of contacts are where the operands are.
TEST(SolidRotationEvents, SolidsFarFromTheAxisCostNoMoreThanBesideIt) {
  std::mt19937_64 random(21);
  std::size_t all = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const MovingOperand moving : {MovingOperand::p, MovingOperand::q}) {
      const auto far = [&](MeshData data, Point3 by) {
        data = of_kind(std::move(data), kind, random);
        for (Point3& v : data.vertices) v = {v.x + by.x, v.y + by.y, v.z + by.z};
        return mesh_of(data);
      };
      const Mesh p = far(moving_cases::bumpy(1, 3), {1e5 / 3, -1e4 / 7, 777}),
                 q = far(moving_cases::bumpy(1, 8), {-1e3 / 7, 1e5 / 3, 0});
      const Mesh near_p = spatial::beside_origin(p).value(), near_q = spatial::beside_origin(q).value();
      const TurnAxis axis{1, 2, 3};
      SolidRotationOptions options;
      options.moving = moving;
      const SolidRotationEvents there = SolidRotationEvents::create(p, q, axis, options).value(),
                                here = SolidRotationEvents::create(near_p, near_q, axis, options).value();
      const AxisTurn from = turn_at(axis, 0.3), to = turn_at(axis, 0.34);
      const std::vector<SolidRotationEvent> events = there.events(from, to).value(),
                                            same = here.events(from, to).value();
      ASSERT_EQ(events.size(), same.size()) << name_of(kind);
      all += events.size();
      const SolidRotationWork &w = there.work(), &v = here.work();
      EXPECT_EQ(std::tie(w.windows, w.facets, w.candidates, w.roots, w.covered, w.exact_tests, w.sums),
                std::tie(v.windows, v.facets, v.candidates, v.roots, v.covered, v.exact_tests, v.sums))
          << name_of(kind);
      const Point3 of_p = spatial::offset_from_origin(p), of_q = spatial::offset_from_origin(q);
      for (std::size_t k = 0; k < events.size(); ++k) {
        const SolidRotationEvent &a = events[k], &b = same[k];
        EXPECT_EQ(std::tie(a.approx, a.parameter, a.visible, a.topology),
                  std::tie(b.approx, b.parameter, b.visible, b.topology));
        ASSERT_EQ(a.contacts.size(), b.contacts.size());
        // Rodrigues.
        const double c = std::cos(a.approx), s = std::sin(a.approx), l = std::sqrt(14.0);
        const spatial::Vec3 u{1 / l, 2 / l, 3 / l}, x{of_p.x, of_p.y, of_p.z}, y{of_q.x, of_q.y, of_q.z};
        const spatial::Vec3 turning = moving == MovingOperand::p ? x : y, still = moving == MovingOperand::p ? y : x;
        const spatial::Vec3 by = c * turning + s * cross(u, turning) + ((1 - c) * dot(u, turning)) * u + still;
        for (std::size_t m = 0; m < a.contacts.size(); ++m) {
          EXPECT_EQ(a.contacts[m].features, b.contacts[m].features);
          EXPECT_NEAR(a.contacts[m].at.x - b.contacts[m].at.x, by.x, 1e-7);
          EXPECT_NEAR(a.contacts[m].at.y - b.contacts[m].at.y, by.y, 1e-7);
          EXPECT_NEAR(a.contacts[m].at.z - b.contacts[m].at.z, by.z, 1e-7);
        }
      }
    }
  EXPECT_GT(all, 15u);
}

/// The same at a quarter turn, and at half a turn, where the other chart is zero.
TEST(SolidRotationEvents, MassesMeetAtQuarterAndHalfTurns) {
  const Mesh ell_mesh = mesh_of(ell()), cube = mesh_of(box(1));
  for (const double at : {std::numbers::pi / 2, std::numbers::pi - 0.004}) {
    const SolidRotationEvents sum = SolidRotationEvents::create(ell_mesh, cube, {0, 0, 1}).value();
    EXPECT_EQ(check_by_samples(sum, at - 0.01, at + 0.003, 3, "L + cube"), at < 3 ? 1u : 0u);
    EXPECT_LT(sum.work().candidates, 15000u);
  }
  const SolidRotationEvents slanted = SolidRotationEvents::create(ell_mesh, cube, {1, 1, 0}).value();
  const AxisTurn half = AxisTurn::half_turn();
  const std::vector<SolidRotationEvent> events = slanted.events(half, half).value();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].contacts.size(), 16u);
  EXPECT_LT(slanted.work().candidates, 15000u);
}

/// Prisms have the same four times at the same algebraic angle, above and below: each position is tested once.
TEST(SolidRotationEvents, PlacesThatManyMeetingsShareAreTestedOnce) {
  const Mesh p = moving_cases::gear(5, 4, 2), q = moving_cases::gear(4, 3, 2);
  SolidRotationOptions options;
  options.changes = false;
  const TurnAxis axis{0, 0, 1};
  const SolidRotationEvents sum = SolidRotationEvents::create(p, q, axis, options).value();
  EXPECT_FALSE(sum.events(turn_at(axis, 0), turn_at(axis, 0.02)).value().empty());
  const SolidRotationWork work = sum.work();
  EXPECT_GT(work.exact_tests, 0u);
  EXPECT_LT(2 * work.exact_tests, work.roots - work.covered) << work.exact_tests << " of " << work.roots;
  std::cout << work.candidates << " candidates, " << work.roots << " meetings, " << work.covered << " covered, "
            << work.exact_tests << " tested" << std::endl;
}

/// A peg that turns in a cavity of its own shape fits at quarter turns alone: what is tight there is told.
TEST(SolidRotationEvents, ATightFitAtOneAngleIsAChangeOfTopology) {
  const Mesh block = mesh_of(tunnel()), peg = mesh_of(box(1));
  SolidRotationOptions options;
  options.moving = MovingOperand::q;
  const TurnAxis axis{0, 0, 1};
  const SolidRotationEvents sum = SolidRotationEvents::create(block, peg, axis, options).value();
  const auto found = sum.next_topology_change(turn_at(axis, 1.5), turn_at(axis, 1.6)).value();
  ASSERT_TRUE(found.has_value());
  ASSERT_TRUE(found->parameter.exact.has_value());
  EXPECT_EQ(*found->parameter.exact, AxisTurn::of(1));
  const SpatialSum at = sum.at(*found->parameter.exact).value();
  EXPECT_GT(at.tight_faces.size() + at.tight_segments.size() + at.tight_points.size(), 0u);
  EXPECT_FALSE(sum.next_topology_change(turn_at(axis, 1.5), turn_at(axis, 1.55)).value().has_value());
}

/// Prisms about the axis along which they were extruded: the sum is the prism over the planar sum, whose vertices come
/// and go at the same angles.
TEST(SolidRotationEvents, PrismsChangeWhereThePlanarSumDoes) {
  const Region star = snapped_shapes::star(5, 1.25, 3), ell = shapes::letter_l(3, 2, 1);
  const Mesh p = solids::prism(star.parts()[0].outer, 2, solids::kDemoSnap),
             q = solids::prism(ell.parts()[0].outer, 3, solids::kDemoSnap);
  const TurnAxis axis{0, 0, 1};
  const SolidRotationEvents sum = SolidRotationEvents::create(p, q, axis).value();
  const double from = 0.05, to = 0.45;
  const std::vector<SolidRotationEvent> events = sum.events(turn_at(axis, from), turn_at(axis, to)).value();
  std::vector<double> visible{from};
  for (const SolidRotationEvent& e : events)
    if (e.visible) visible.push_back(e.approx);
  visible.push_back(to);
  const auto planar = [&](double angle) {
    const AxisTurn turn = turn_at(axis, angle);
    const PlanarSum flat = rotated_sum(star, ell, Orientation::of(turn.t()).value()).value();
    const SpatialSum solid = sum.at(turn).value();
    EXPECT_EQ(solid.vertices.size(), 2 * flat.vertex_count()) << angle;
    std::set<std::array<std::uint32_t, 6>> contacts;
    const auto add = [&](const SumRing& ring) {
      for (const SumVertex& v : ring.vertices)
        contacts.insert({static_cast<std::uint32_t>(v.in.kind), v.in.p, v.in.q, static_cast<std::uint32_t>(v.out.kind),
                         v.out.p, v.out.q});
    };
    for (const SumPart& part : flat.parts) {
      add(part.outer);
      for (const SumRing& hole : part.holes) add(hole);
    }
    return contacts;
  };
  ASSERT_GT(visible.size(), 3u);
  std::set<std::array<std::uint32_t, 6>> before;
  for (std::size_t k = 0; k + 1 < visible.size(); ++k) {
    const double gap = visible[k + 1] - visible[k];
    const auto low = planar(visible[k] + 0.1 * gap), high = planar(visible[k] + 0.9 * gap);
    EXPECT_EQ(low, high) << visible[k];
    EXPECT_TRUE(k == 0 || before != low) << visible[k];
    before = high;
  }
}

TEST(SolidRotationEvents, BoxesAboutASharedAxisChangeAtQuarterTurnsAlone) {
  const Mesh cube = mesh_of(box(1));
  const SolidRotationEvents sum = SolidRotationEvents::create(cube, cube, {0, 0, 2}).value();
  const std::vector<SolidRotationEvent> events = sum.events_of_turn().value();

  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(*events[0].parameter.exact, AxisTurn::of(-1));
  EXPECT_EQ(*events[1].parameter.exact, AxisTurn::of(0));
  EXPECT_EQ(*events[2].parameter.exact, AxisTurn::of(1));
  EXPECT_EQ(*events[3].parameter.exact, AxisTurn::half_turn());
  for (const SolidRotationEvent& e : events) EXPECT_TRUE(e.visible);
}

TEST(SolidRotationEvents, AHashOfASumOfOtherOperandsIsRefused) {
  const Mesh box = solids::box(0, 0, 0, 1, 1, 1), ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap);
  const SolidRotationEvents boxes = SolidRotationEvents::create(box, box, {0, 0, 1}).value();
  for (const auto& [p, q] : {std::pair{ball, ball}, {ball, box}, {box, ball}}) {
    const SolidRotationEvents others = SolidRotationEvents::create(p, q, {0, 0, 1}).value();
    EXPECT_THROW(boxes.combinatorial_hash(others.at(AxisTurn::of(1)).value()), std::invalid_argument);
  }
  EXPECT_NO_THROW(boxes.combinatorial_hash(boxes.at(AxisTurn::of(1)).value()));
}

}  // namespace
}  // namespace dymsum
