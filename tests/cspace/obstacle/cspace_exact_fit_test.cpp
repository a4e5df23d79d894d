// Placements that are free at one angle only, where that angle has an irrational half tangent and many contacts
// coincide; and angles at which nothing happens.
#include "cspace/obstacle/obstacle_slices.h"
#include "oracles/sanitized.h"

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

std::vector<Configuration> tight(const CspaceObstacle& c) {
  std::vector<Configuration> all;
  for (const ObstacleEvent& e : c.events())
    if (e.kind == ObstacleEvent::Kind::tight) all.push_back({e.at.x, e.at.y, c.angles()[e.angle].theta});
  return all;
}

std::size_t tight_near(const CspaceObstacle& c, const Configuration& z) {
  std::size_t n = 0;
  for (const Configuration& t : tight(c)) {
    const double turned = std::remainder(t.theta - z.theta, 2 * std::numbers::pi);
    n += std::hypot(t.x - z.x, t.y - z.y) < 1e-8 && std::abs(turned) < 1e-8;
  }
  return n;
}

Point plus(Point a, Point b, double f = 1) { return {a.x + f * b.x, a.y + f * b.y}; }
double plus_shape(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// cos = c0 + c1 sqrt(d), sin = s0 + s1 sqrt(d), all of them dyadic.
struct Angle {
  double c0, c1, s0, s1, d;
  double cosine() const { return c0 + c1 * std::sqrt(d); }
  double sine() const { return s0 + s1 * std::sqrt(d); }
  double theta() const { return std::atan2(sine(), cosine()); }
  Point turned(Point p) const { return {cosine() * p.x - sine() * p.y, sine() * p.x + cosine() * p.y}; }
};

constexpr std::array<Angle, 6> kAngles{Angle{0, 0.5, 0, 0.5, 2},     Angle{0.5, 0, 0, 0.5, 3},
                                       Angle{-0.5, 0, 0, 0.5, 3},    Angle{0.75, 0, 0, 0.25, 7},
                                       Angle{0.25, 0, 0, -0.25, 15}, Angle{0.125, 0, 0, 0.375, 7}};

/// Darts at an angle and a position of its field, and pins that touch their tips there: triangles with an edge on the
/// only rational line through such a tip. (Where sqrt(d) varies as if it were rational, every tip stays on its line and
/// all are scaled: so pins around one polygon hold it never.)
struct Held {
  std::vector<Ring> darts, pins;
  std::vector<std::array<double, 3>> normals;  ///< what each pin allows: normal . (dx, dy, dtheta) >= 0
  Configuration at;
};

bool far_apart(const std::vector<Ring>& rings, const Ring& ring) {
  for (const Ring& other : rings)
    for (const Point& x : other)
      for (const Point& y : ring)
        if (std::hypot(x.x - y.x, x.y - y.y) < 4) return false;
  return true;
}

Held random_held(Random& random) {
  const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
  const Angle& angle = kAngles[random() % kAngles.size()];
  const double root = std::sqrt(angle.d);
  const Point z0{below(64) / 8, below(64) / 8}, z1{(below(65) - 32) / 4, (below(65) - 32) / 4}, z = plus(z0, z1, root);
  Held held;
  held.at = {z.x, z.y, angle.theta()};
  std::vector<Ring> placed_darts;
  const std::size_t count = 4 + random() % 4;
  for (int tries = 0; tries < 60 && held.darts.size() < count; ++tries) {
    const Point p{below(33) - 16, below(33) - 16};
    const double phi = below(1000) / 500 * std::numbers::pi;
    const auto corner = [&](double by) {
      return Point{p.x + std::nearbyint(12 * std::cos(phi + by)) / 4,
                   p.y + std::nearbyint(12 * std::sin(phi + by)) / 4};
    };
    const Ring dart{p, corner(-0.25), corner(0.25)};
    const Point a = plus(z0, {angle.c0 * p.x - angle.s0 * p.y, angle.s0 * p.x + angle.c0 * p.y});
    const Point d = plus(z1, {angle.c1 * p.x - angle.s1 * p.y, angle.s1 * p.x + angle.c1 * p.y});
    const double length = std::hypot(d.x, d.y);
    if (length < 1) continue;
    Ring placed;
    for (const Point& x : dart) placed.push_back(plus(z, angle.turned(x)));
    // The dart lies on the left of d, or of -d.
    const double u = plus_shape(d, plus(placed[1], placed[0], -1)) / length,
                 v = plus_shape(d, plus(placed[2], placed[0], -1)) / length;
    if (!(u * v > 0 && std::min(std::abs(u), std::abs(v)) > 0.5)) continue;
    const double step = 1.0 / 64, midpoint = std::nearbyint(root / step) * step, side = u > 0 ? 1 : -1;
    const double width = std::max(2.0, std::nearbyint(0.75 / length / step)) * step,
                 off = std::max(1.0, std::nearbyint(32 / length)) / 64;
    Ring pin{plus(a, d, midpoint - width), plus(a, d, midpoint + width),
             plus(plus(a, d, midpoint), {d.y, -d.x}, off * side)};
    if (u > 0) std::reverse(pin.begin(), pin.end());
    if (!far_apart(held.darts, dart) || !far_apart(held.pins, pin)) continue;
    if (!far_apart(placed_darts, pin) || !far_apart(held.pins, placed)) continue;
    const Point normal{-side * d.y / length, side * d.x / length}, arm = plus(placed[0], z, -1);
    held.darts.push_back(dart);
    held.pins.push_back(pin);
    placed_darts.push_back(placed);
    held.normals.push_back({normal.x, normal.y, normal.x * -arm.y + normal.y * arm.x});
  }
  return held;
}

enum class Hold { tight, loose, unclear };

// To first order: no motion is allowed by all pins, or one parts with all of them. Extreme motions are along two pins.
Hold hold_of(const Held& held) {
  using Vector = std::array<double, 3>;
  const auto times = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  std::vector<Vector> pins = held.normals;
  for (Vector& w : pins) w[2] /= 10;
  const auto least = [&](const Vector& m) {
    double low = INFINITY;
    const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (const Vector& w : pins) low = std::min(low, (w[0] * m[0] + w[1] * m[1] + w[2] * m[2]) / length);
    return low;
  };
  if (pins.size() < 3) return Hold::unclear;
  bool held_all = true;
  Vector sum{};
  for (std::size_t i = 0; i < pins.size(); ++i)
    for (std::size_t j = 0; j < pins.size(); ++j) {
      if (i == j) continue;
      const Vector m = times(pins[i], pins[j]);
      const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
      if (length < 1e-3) return Hold::unclear;
      const double low = least(m);
      if (low > -1e-3) held_all = false;
      if (low > -1e-12)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += m[k] / length;
    }
  if (held_all) return Hold::tight;
  if (sum == Vector{}) return Hold::unclear;
  return least(sum) > 1e-3 ? Hold::loose : Hold::unclear;
}

Region of_rings(const std::vector<Ring>& rings) {
  RegionData data;
  for (const Ring& ring : rings) data.parts.push_back({ring, {}});
  return *Region::create(std::move(data));
}

TEST(CspaceExactFit, pins_hold_darts_at_an_irrational_angle) {
  int held = 0, loose = 0;
  for_seeds(50, [&](Random& random) {
    const Held h = random_held(random);
    const Hold expected = hold_of(h);
    if (expected == Hold::unclear) return;
    (expected == Hold::tight ? held : loose) += 1;
    const std::size_t count = expected == Hold::tight ? 1 : 0;
    const Region darts = of_rings(h.darts), pins = of_rings(h.pins);
    const CspaceObstacle c = CspaceObstacle::create(darts, pins).value();
    EXPECT_EQ(tight_near(c, h.at), count)
        << "at " << h.at.x << ' ' << h.at.y << ' ' << h.at.theta << "\nrobot "
        << format_region(darts, RegionFormat::wkt) << "\nobstacle " << format_region(pins, RegionFormat::wkt);
    // The pins held by the darts: x + R y = z turns into -R^-1 x, R^-1.
    const double cosine = std::cos(h.at.theta), sine = std::sin(h.at.theta);
    const Configuration turned{-cosine * h.at.x - sine * h.at.y, sine * h.at.x - cosine * h.at.y, -h.at.theta};
    EXPECT_EQ(tight_near(CspaceObstacle::create(pins, darts).value(), turned), count);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GE(held, 10 / static_cast<int>(kFractionOfSeeds));
  EXPECT_GE(loose, 10);
}

// The same pins at two positions; and by whole slices.
TEST(CspaceExactFit, each_place_of_one_angle_is_reported) {
  int held = 0;
  for_seeds(12, [&](Random& random) {
    const Held h = random_held(random);
    if (hold_of(h) != Hold::tight) return;
    ++held;
    std::vector<Ring> twice = h.pins;
    for (Ring ring : h.pins) {
      for (Point& p : ring) p.x += 128;
      twice.push_back(ring);
    }
    const Region darts = of_rings(h.darts);
    const CspaceObstacle c = CspaceObstacle::create(darts, of_rings(twice)).value();
    EXPECT_EQ(tight_near(c, h.at), 1u);
    EXPECT_EQ(tight_near(c, {h.at.x + 128, h.at.y, h.at.theta}), 1u);
    if (held > 1) return;
    ObstacleOptions options;
    options.reference = true;
    EXPECT_EQ(tight_near(CspaceObstacle::create(darts, of_rings(h.pins), options).value(), h.at), 1u);
  });
  if (std::getenv("DYMSUM_SEED") == nullptr) {
    EXPECT_GE(held, kFractionOfSeeds == 1 ? 2 : 1);
  }
}

// A clamp around a slab, in a corridor: inner tips 4 apart around a thickness of 2, outer tips 6 apart in a height
// of 3. At 60 degrees it slides.
TEST(CspaceExactFit, a_clamp_slides_at_an_irrational_angle_only) {
  const Region clamp =
      polygon({{0, -1}, {2.75, -5.375}, {5, -4}, {0, 5}, {0, 4}, {4.25, -3.25}, {2.5, -4.375}, {0, 0}});
  const Region walls = of_rings({box(-40, -5, 40, -0.5), box(-40, 2.5, 40, 7), box(-20, 0, 4, 2)});
  const CspaceObstacle c = CspaceObstacle::create(clamp, walls).value();
  std::vector<Configuration> all = tight(c);
  ASSERT_EQ(all.size(), 4u);  // and the same at the slab's other end, turned by a half turn about its midpoint (-8, 1)
  for (const Configuration& t : all)
    if (t.theta < 0) {
      EXPECT_EQ(tight_near(c, {-16 - t.x, 2 - t.y, t.theta + std::numbers::pi}), 1u);
    }
  std::erase_if(all, [](const Configuration& t) { return t.theta < 0; });
  ASSERT_EQ(all.size(), 2u);
  for (const Configuration& t : all) {
    EXPECT_NEAR(t.theta, std::numbers::pi / 3, 1e-12);
    EXPECT_NEAR(t.y, 0, 1e-12);
  }
  EXPECT_NEAR(std::max(all[0].x, all[1].x), 4, 1e-12);  // its inner tip leaves the slab
  // There the inner side, from (2.5, -4.375) to (4.25, -3.25), comes to the slab's corner (4, 0).
  const double root = std::sqrt(3.0);
  const Point p{1.25 + 4.375 * root / 2, 2.5 * root / 2 - 4.375 / 2},
      d{0.875 - 1.125 * root / 2, 1.75 * root / 2 + 1.125 / 2};
  EXPECT_NEAR(std::min(all[0].x, all[1].x), 4 - std::min(p.x - d.x * p.y / d.y, p.x + d.x * (2 - p.y) / d.y), 1e-12);
  // A corridor a hair higher on both sides gives it clearance; a hair lower on one there is no place for it.
  const Region wider = of_rings({box(-40, -5, 40, -0.5 - 0x1p-20), box(-40, 2.5 + 0x1p-20, 40, 7), box(-20, 0, 4, 2)});
  EXPECT_TRUE(tight(CspaceObstacle::create(clamp, wider).value()).empty());
  const Region lower = of_rings({box(-40, -5, 40, -0.5), box(-40, 2.5 - 0x1p-20, 40, 7), box(-20, 0, 4, 2)});
  EXPECT_TRUE(tight(CspaceObstacle::create(clamp, lower).value()).empty());
}

// What can be reached by turning is not free at one angle only.
TEST(CspaceExactFit, a_passage_that_shuts_is_not_tight) {
  const Region rhombus = polygon({{2, 0}, {0, 1}, {-2, 0}, {0, -1}});
  const Region room = polygon(box(-40, -40, 40, 40), {reversed(box(-20, -2, 20, 2))});
  EXPECT_TRUE(tight(CspaceObstacle::create(rhombus, room).value()).empty());
}

// Edges (1, 2) and (2, 1) have one length: the cavity is the robot, turned by an angle whose cosine is 4 / 5.
TEST(CspaceExactFit, a_square_in_its_turned_cavity_is_held_at_four_angles) {
  const Region square = polygon({{0, 0}, {2, -1}, {3, 1}, {1, 2}});
  const Region room = polygon(box(-9, -9, 9, 9), {reversed({{0, 0}, {1, -2}, {3, -1}, {2, 1}})});
  for (const bool reference : {false, true}) {
    ObstacleOptions options;
    options.reference = reference;
    const CspaceObstacle c = CspaceObstacle::create(square, room, options).value();
    EXPECT_EQ(tight(c).size(), 4u);
    EXPECT_EQ(tight_at(c, -std::atan2(3, 4)), 1u);
  }
}

// Whether two sub-edges of a slab that do not follow each other come together at an angle.
bool touches(const CspaceObstacle& c, std::uint32_t slab, double theta) {
  std::vector<std::array<Point, 2>> ends;
  for (const auto& loop : c.loops(slab))
    for (const std::uint32_t p : loop) ends.push_back(c.ends(c.patches()[p], theta));
  const auto near = [](Point x, const std::array<Point, 2>& s) {
    const Point d = plus(s[1], s[0], -1);
    const double t = std::clamp(dot(d, plus(x, s[0], -1)) / dot(d, d), 0.0, 1.0);
    const Point off = plus(x, plus(s[0], d, t), -1);
    return std::hypot(off.x, off.y) < 1e-7;
  };
  const auto apart = [](Point x, Point y) { return std::hypot(x.x - y.x, x.y - y.y) > 1e-7; };
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < ends.size(); ++j) {
      if (i == j) continue;
      if (!apart(ends[i][0], ends[j][0])) return true;
      for (const Point& x : ends[i])
        if (near(x, ends[j]) && apart(x, ends[j][0]) && apart(x, ends[j][1])) return true;
    }
  return false;
}

double to_segment(Point x, Point a, Point b) {
  const Point d = plus(b, a, -1);
  const double l = dot(d, d), t = l > 0 ? std::clamp(dot(d, plus(x, a, -1)) / l, 0.0, 1.0) : 0.0;
  return std::hypot(x.x - a.x - t * d.x, x.y - a.y - t * d.y);
}

// Every tight event is an end of a tight feature, and the other way round; at rational angles the open slice has them
// too.
TEST(CspaceExactFit, tight_features_end_at_tight_events_and_lie_on_open_slices) {
  std::size_t points = 0, segments = 0;
  for_seeds(30, [&](Random& random) {
    RegionData data;
    data.parts.push_back({box(-20, -20, 20, 20), {}});
    const Region room = random_cells(random, 3, 1);
    for (const Part& part : room.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    const CspaceObstacle c = CspaceObstacle::create(random_cells(random, 2, 1), *Region::create(data)).value();
    std::set<std::tuple<std::uint32_t, double, double>> events, ends;
    for (const ObstacleEvent& e : c.events())
      if (e.kind == ObstacleEvent::Kind::tight) events.insert({e.angle, e.at.x, e.at.y});
    for (const TightFeature& f : c.tight()) {
      for (const Point& p : {f.from, f.to}) ends.insert({f.angle, p.x, p.y});
      (f.from == f.to ? points : segments) += 1;
      EXPECT_LT(f.error, 1e-9);
      if (!c.angles()[f.angle].exact) continue;
      const PlanarSum slice = *c.slice(*c.angles()[f.angle].exact, Semantics::open);
      for (const Point& p : {f.from, f.to, plus(plus({0, 0}, f.from, 0.5), f.to, 0.5)}) {
        double least = INFINITY;
        for (const SumSegment& s : slice.tight_segments) least = std::min(least, to_segment(p, s.from.at, s.to.at));
        for (const SumVertex& v : slice.tight_points) least = std::min(least, to_segment(p, v.at, v.at));
        EXPECT_LE(least, f.error + 1e-13);
      }
    }
    EXPECT_EQ(ends, events);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(points, oracles::kSanitized ? 3u : 10u);
  EXPECT_GT(segments, oracles::kSanitized ? 3u : 10u);
}

// At every angle that is listed a patch begins or ends, something is tight, or the boundary touches itself.
void expect_happenings(const CspaceObstacle& c) {
  std::set<std::uint32_t> happens;
  for (const Patch& p : c.patches()) {
    happens.insert(p.begin);
    happens.insert(p.end);
  }
  for (const ObstacleEvent& e : c.events())
    if (e.kind == ObstacleEvent::Kind::tight) happens.insert(e.angle);
  for (std::uint32_t k = 0; k < c.angles().size(); ++k) {
    if (happens.contains(k)) continue;
    EXPECT_TRUE(touches(c, k, c.angles()[k].theta)) << "nothing happens at angle " << k << ", " << c.angles()[k].theta
                                                    << "\nrobot " << format_region(c.robot(), RegionFormat::wkt)
                                                    << "\nobstacle " << format_region(c.obstacle(), RegionFormat::wkt);
  }
  for (const ObstacleEvent& e : c.events()) EXPECT_LT(e.angle, c.angles().size());
}

// Two tips as far apart as the rhombus is long: upright it touches both, and nothing else is different.
TEST(CspaceExactFit, an_angle_at_which_the_boundary_only_touches_itself_is_listed) {
  const Region rhombus = polygon({{2, 0}, {0, 1}, {-2, 0}, {0, -1}});
  const auto listed = [&](double gap) {
    const CspaceObstacle c =
        CspaceObstacle::create(rhombus,
                               of_rings({{{-1, -4}, {1, -4}, {0, 0}}, {{0, gap}, {1, gap + 4}, {-1, gap + 4}}}))
            .value();
    expect_happenings(c);
    EXPECT_TRUE(tight(c).empty());
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < c.angles().size(); ++k) {
      if (std::abs(std::abs(c.angles()[k].theta) - std::numbers::pi / 2) > 1e-12) continue;
      ++n;
      for (const Patch& p : c.patches()) EXPECT_TRUE(p.begin != k && p.end != k);
    }
    return n;
  };
  EXPECT_EQ(listed(4), 2u);
  EXPECT_EQ(listed(4.125), 0u);
}

// The same with slits and cavities that nothing reaches, so many of whose edges are aligned upright that one slice
// stands for all events there.
TEST(CspaceExactFit, crowded_quarter_turns_are_listed_where_something_happens) {
  const auto crosses = [](double y) {
    std::vector<Ring> all;
    for (double x = -10; x <= 10; x += 4)
      all.push_back({{x, y - 1},
                     {x - 1, y - 1},
                     {x - 1, y},
                     {x, y},
                     {x, y + 1},
                     {x + 1, y + 1},
                     {x + 1, y},
                     {x + 2, y},
                     {x + 2, y - 1},
                     {x + 1, y - 1},
                     {x + 1, y - 2},
                     {x, y - 2}});
    return all;
  };
  Ring slit_rhombus{{64, 0}};
  for (double x = 48; x > 8; x -= 6) {
    const double y = 32 - x / 2;
    slit_rhombus.insert(slit_rhombus.end(), {{x, y}, {x, y - 8}, {x - 2, y - 8}, {x - 2, y + 1}});
  }
  slit_rhombus.insert(slit_rhombus.end(), {{0, 32}, {-64, 0}, {0, -32}});
  const auto listed = [&](double gap, bool crowded) {
    RegionData robot, tips;
    robot.parts = {{crowded ? slit_rhombus : Ring{{64, 0}, {0, 32}, {-64, 0}, {0, -32}}, {}}};
    tips.parts = {{{{-32, -128}, {32, -127}, {0, 0}}, {}}, {{{0, gap}, {32, gap + 127}, {-32, gap + 128}}, {}}};
    if (crowded) {
      tips.parts[0].holes = crosses(-104);
      tips.parts[1].holes = crosses(gap + 104);
    }
    const CspaceObstacle c = CspaceObstacle::create(*Region::create(robot), *Region::create(tips)).value();
    expect_happenings(c);
    std::size_t n = 0;
    for (const EventAngle& a : c.angles()) n += std::abs(std::remainder(a.theta, std::numbers::pi / 2)) < 1e-12;
    return n;
  };
  for (const bool crowded : {false, true}) {
    EXPECT_EQ(listed(128, crowded), 2u);
    EXPECT_EQ(listed(129, crowded), 0u);
  }
}

TEST(CspaceExactFit, something_happens_at_every_angle_that_is_listed) {
  for_seeds(60, [](Random& random) {
    const bool cells = random() % 2 == 0;
    const int reach = random() % 2 == 0 ? 4 : 6;
    const Region robot = cells ? random_cells(random, 2, 1) : random_shape(random, 3, 5, false);
    RegionData data;
    data.parts.push_back({box(-40.0 * reach, -40.0 * reach, 40.0 * reach, 40.0 * reach), {}});
    const Region room = cells ? random_cells(random, 4, 1 + static_cast<double>(random() % 3) / 2)
                              : random_shape(random, reach, 8, false);
    for (const Part& part : room.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    expect_happenings(CspaceObstacle::create(robot, *Region::create(data)).value());
    expect_happenings(CspaceObstacle::create(robot, room).value());
  });
  expect_happenings(CspaceObstacle::create(snapped_shapes::star(5, 0.5, 1), snapped_shapes::star(5, 0.5, 1)).value());
  expect_happenings(CspaceObstacle::create(snapped_shapes::gear(6, 0.8, 1), snapped_shapes::gear(8, 1.5, 2)).value());
}

}  // namespace
}  // namespace dymsum
