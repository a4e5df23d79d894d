// Every question to an obstacle, at quarter turns and at turns by the angles of 3-4-5 triangles, where edges of small
// integers are flush, against membership by definition.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/path_check.h"
#include "dymsum/planner.h"
#include "oracles/membership.h"

namespace dymsum::testing_questions {

using namespace testing_obstacles;

inline constexpr double kOnlyMoves = std::numeric_limits<double>::infinity();

/// tan(theta / 2) = n / d; 5 cos and 5 sin.
struct Turn {
  int n, d, cosine, sine;
  Orientation orientation() const { return *Orientation::of(n, d); }
};
inline constexpr std::array<Turn, 12> kTurns{Turn{0, 1, 5, 0}, {1, 1, 0, 5},    {-1, 1, 0, -5}, {1, 0, -5, 0},
                                             {1, 2, 3, 4},     {-1, 2, 3, -4},  {1, 3, 4, 3},   {-1, 3, 4, -3},
                                             {2, 1, -3, 4},    {-2, 1, -3, -4}, {3, 1, -4, 3},  {-3, 1, -4, -3}};

inline Region made(RegionData data) { return *Region::create(std::move(data)); }

/// What is true of positions at one orientation, by definition; times 5 all coordinates are integers.
class Truth {
 public:
  Truth(const Region& robot, const Region& obstacle, const Turn& t)
      : membership_(mapped(obstacle,
                           [](Point p) {
                             return Point{5 * p.x, 5 * p.y};
                           }),
                    mapped(robot, [&](Point p) {
                      return Point{t.sine * p.y - t.cosine * p.x, -t.sine * p.x - t.cosine * p.y};
                    })) {}
  bool overlaps(Point z) const { return membership_.overlaps(exact(z)); }
  bool touches(Point z) const { return !overlaps(z) && membership_.meets(exact(z)); }

 private:
  static oracles::Pt<oracles::Small> exact(Point z) {
    const oracles::Small five(5);
    return {oracles::from_double<oracles::Small>(z.x) * five, oracles::from_double<oracles::Small>(z.y) * five};
  }
  oracles::Membership<oracles::Small> membership_;
};

/// A position at an orientation, and the truth about it.
struct Queried {
  Point z;
  Configuration at;
  bool overlaps = false, touches = false;
};

struct Tally {
  int touching = 0, jammed = 0, single = 0, tight = 0, reached = 0, curves = 0, plans = 0;
};

inline double grid(Random& random, int reach) {
  return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
}

inline double to_piece(Point z, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  const double t = l > 0 ? std::clamp(((z.x - a.x) * dx + (z.y - a.y) * dy) / l, 0.0, 1.0) : 0.0;
  return std::hypot(z.x - a.x - t * dx, z.y - a.y - t * dy);
}
inline double to_edges(const PlanarSum& slice, Point z) {
  double least = kOnlyMoves;
  const auto add = [&](const SumRing& ring) {
    for (std::size_t i = 0; i < ring.vertices.size(); ++i)
      least = std::min(least, to_piece(z, ring.vertices[i].at, ring.vertices[(i + 1) % ring.vertices.size()].at));
  };
  for (const SumPart& part : slice.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return least;
}

class Questions {
 public:
  Questions(const CspaceObstacle& c, Random& random, Tally& tally)
      : c_(c), queries_(c), random_(random), tally_(tally), weight_(queries_.gyration_radius()) {}

  void query() {
    for (const Turn& turn : kTurns) query_at(turn);
    for (const Queried& a : queried_) expect_distances(a);
    expect_tight();
    expect_plan();
  }

 private:
  void query_at(const Turn& turn) {
    const Truth truth(c_.robot(), c_.obstacle(), turn);
    const Orientation theta = turn.orientation();
    std::vector<Queried> here;
    for (const Point z : positions(turn)) {
      SCOPED_TRACE(testing::Message() << z.x << ' ' << z.y << " at " << turn.n << '/' << turn.d);
      const Queried a{z, {z.x, z.y, theta.radians()}, truth.overlaps(z), truth.touches(z)};
      expect_membership(a, theta);
      if (!(*Orientation::nearest(theta.radians()) == theta)) continue;
      expect_clearance(a);
      expect_free_angles(a);
      here.push_back(a);
    }
    if (!here.empty()) expect_ways(here, theta, truth);
    queried_.insert(queried_.end(), here.begin(), here.end());
  }

  // Sums of two vertices and the midpoints between two of them, where doubles hold them, and the grid.
  std::vector<Point> positions(const Turn& t) {
    std::vector<Point> sums, all;
    const auto vertices = [](const Region& region) {
      std::vector<Point> v;
      mapped(region, [&](Point p) {
        v.push_back(p);
        return p;
      });
      return v;
    };
    for (const Point o : vertices(c_.obstacle()))
      for (const Point r : vertices(c_.robot())) {
        const double x = 5 * o.x - t.cosine * r.x + t.sine * r.y, y = 5 * o.y - t.sine * r.x - t.cosine * r.y;
        if (std::remainder(x, 2.5) == 0 && std::remainder(y, 2.5) == 0) sums.push_back({x / 5, y / 5});
      }
    for (int k = 0; k < 8; ++k) all.push_back({grid(random_, 8) / 2, grid(random_, 8) / 2});
    for (int k = 0; k < 8 && !sums.empty(); ++k) {
      const Point a = sums[random_() % sums.size()], b = sums[random_() % sums.size()];
      all.push_back(a);
      all.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2});
    }
    return all;
  }

  void expect_membership(const Queried& a, const Orientation& theta) {
    EXPECT_EQ(c_.contains(a.z.x, a.z.y, theta), a.overlaps);
    EXPECT_EQ(queries_.contains(a.z.x, a.z.y, theta), a.overlaps);
    for (const Touching touch : {Touching::allowed, Touching::forbidden})
      EXPECT_EQ(check_translation(c_.robot(), c_.obstacle(), a.z, a.z, theta, touch)->free,
                !a.overlaps && (touch == Touching::allowed || !a.touches));
  }

  void expect_clearance(const Queried& a) {
    for (const double weight : {weight_, 0.25, kOnlyMoves}) {
      const Clearance found = queries_.clearance(a.at, weight);
      EXPECT_EQ(found.distance < 0, a.overlaps) << "weight " << weight << ": " << found.distance;
      EXPECT_EQ(found.distance == 0 && found.error == 0, a.touches)
          << "weight " << weight << ": " << found.distance << " by " << found.error;
      tally_.touching += a.touches;
      tally_.jammed += a.touches && found.patch == Patch::kNone;
    }
  }

  bool is_free_at(Point z, double theta) const { return !c_.contains(z.x, z.y, *Orientation::nearest(theta)); }

  void expect_free_angles(const Queried& a) {
    bool free = false, single = false;
    for (const FreeAngles& f : queries_.free_angles(a.z.x, a.z.y)) {
      const double turn = 2 * std::numbers::pi, b = f.begin - f.begin_error,
                   e = f.end + f.end_error + (f.begin <= f.end ? 0 : turn);
      const auto holds = [&](double theta) { return b <= theta && theta <= e; };
      if (!holds(a.at.theta) && !holds(a.at.theta - turn) && !holds(a.at.theta + turn)) continue;
      free = true;
      single |= f.single();
    }
    EXPECT_EQ(free, !a.overlaps);
    const bool alone = !a.overlaps && !is_free_at(a.z, a.at.theta - 1e-7) && !is_free_at(a.z, a.at.theta + 1e-7);
    EXPECT_EQ(single, alone);
    tally_.single += single;
  }

  // No boundary is nearer than the distance to it: a way from here to any configuration of the other kind crosses it.
  void expect_distances(const Queried& a) {
    SCOPED_TRACE(testing::Message() << a.z.x << ' ' << a.z.y << " at " << a.at.theta);
    const Clearance found = queries_.clearance(a.at, weight_), moves = queries_.clearance(a.at, kOnlyMoves);
    for (const Queried& b : queried_) {
      if (a.overlaps == b.overlaps && !b.touches) continue;
      const double way = std::hypot(a.z.x - b.z.x, a.z.y - b.z.y);
      const double turn = weight_ * std::remainder(a.at.theta - b.at.theta, 2 * std::numbers::pi);
      EXPECT_LE(std::abs(found.distance), std::hypot(way, turn) + found.error + 1e-9)
          << b.z.x << ' ' << b.z.y << " at " << b.at.theta;
      if (a.at.theta == b.at.theta) {
        EXPECT_LE(std::abs(moves.distance), way + moves.error + 1e-9) << b.z.x << ' ' << b.z.y;
      }
    }
  }

  // Straight ways between two positions, by the truth at shares of them and just after the first contact.
  void expect_ways(const std::vector<Queried>& here, const Orientation& theta, const Truth& truth) {
    const Queried &a = here[random_() % here.size()], &b = here[random_() % here.size()];
    SCOPED_TRACE(testing::Message() << "from " << a.z.x << ' ' << a.z.y << " to " << b.z.x << ' ' << b.z.y << " at "
                                    << theta.radians());
    const TranslationCheck way = check_translation(c_.robot(), c_.obstacle(), a.z, b.z, theta).value();
    const auto along = [&](double fraction) {
      return Point{a.z.x + fraction * (b.z.x - a.z.x), a.z.y + fraction * (b.z.y - a.z.y)};
    };
    const double first = way.first.to_double();
    bool any = false;
    for (int k = 0; k <= 64; ++k) {
      const bool overlaps = truth.overlaps(along(k / 64.0));
      any |= overlaps;
      EXPECT_FALSE(overlaps && (way.free || k / 64.0 < first)) << k;
    }
    if (!way.free && !(a.z == b.z)) {
      EXPECT_TRUE(truth.overlaps(along(std::ceil(first * 0x1p20 + 0.5) * 0x1p-20))) << first;
    }
    const PathCheck path =
        check_path(c_.robot(), c_.obstacle(), std::vector<Configuration>{a.at, b.at}, Touching::allowed).value();
    EXPECT_EQ(path.outcome == MotionCheck::Outcome::free, way.free);
    expect_turn(a);
  }

  // In place to another special angle: by the truth at those between.
  void expect_turn(const Queried& a) {
    const Turn& to = kTurns[random_() % kTurns.size()];
    const Orientation from = *Orientation::nearest(a.at.theta), goal = to.orientation();
    const auto turn = [&](Touching touch) {
      return check_rotation(c_.robot(), c_.obstacle(), a.z, from, goal, TurnDirection::counter_clockwise, touch)
          .value();
    };
    const RotationCheck allowed = turn(Touching::allowed), forbidden = turn(Touching::forbidden);
    const auto ahead = [&](const Orientation& o) {
      return std::fmod(o.radians() - from.radians() + 4 * std::numbers::pi, 2 * std::numbers::pi);
    };
    for (const Turn& t : kTurns) {
      if (ahead(t.orientation()) > ahead(goal) + 1e-9) continue;
      const Truth truth(c_.robot(), c_.obstacle(), t);
      EXPECT_FALSE(truth.overlaps(a.z) && allowed.free) << "turned to " << to.n << '/' << to.d;
      EXPECT_FALSE((truth.overlaps(a.z) || truth.touches(a.z)) && forbidden.free) << "to " << to.n << '/' << to.d;
    }
    if (!allowed.free) {
      EXPECT_FALSE(is_free_at(a.z, allowed.first->theta + (a.overlaps ? 0 : 1e-9)));
    }
    if (!forbidden.free && forbidden.first->exact) {
      EXPECT_FALSE(
          check_translation(c_.robot(), c_.obstacle(), a.z, a.z, *forbidden.first->exact, Touching::forbidden)->free);
    }
  }

  // What is tight in the open slice at an angle, and not a limit of the boundary beside it.
  void expect_tight() {
    if (c_.may_have_tight_curves()) {
      ++tally_.curves;
      return;
    }
    for (std::uint32_t k = 0; k < c_.angles().size(); ++k)
      if (c_.angles()[k].exact) expect_tight_at(k, *c_.angles()[k].exact);
    for (const Turn& turn : kTurns) {
      if (!c_.slab_of(turn.orientation())) continue;  // an event angle
      const PlanarSum open = c_.slice(turn.orientation(), Semantics::open).value();
      EXPECT_TRUE(open.tight_points.empty() && open.tight_segments.empty()) << turn.n << '/' << turn.d;
    }
  }
  void expect_tight_at(std::uint32_t angle, const Orientation& theta) {
    SCOPED_TRACE(testing::Message() << "angle " << theta.radians());
    const PlanarSum open = c_.slice(theta, Semantics::open).value(),
                    before = c_.slice(*Orientation::nearest(theta.radians() - 1e-9)).value(),
                    after = c_.slice(*Orientation::nearest(theta.radians() + 1e-9)).value();
    const auto listed = [&](Point z) {
      return std::any_of(c_.tight().begin(), c_.tight().end(),
                         [&](const TightFeature& f) { return f.angle == angle && to_piece(z, f.from, f.to) < 1e-9; });
    };
    const auto expect = [&](Point z) {
      const bool reached = std::min(to_edges(before, z), to_edges(after, z)) < 1e-3;
      EXPECT_NE(listed(z), reached) << z.x << ' ' << z.y;
      ++(reached ? tally_.reached : tally_.tight);
    };
    for (const SumVertex& v : open.tight_points) expect(v.at);
    for (const SumSegment& s : open.tight_segments)
      for (const double f : {0.137, 0.461, 0.822})
        expect({s.from.at.x + f * (s.to.at.x - s.from.at.x), s.from.at.y + f * (s.to.at.y - s.from.at.y)});
    for (const TightFeature& f : c_.tight()) {
      if (f.angle != angle) continue;
      const Point z{(f.from.x + f.to.x) / 2, (f.from.y + f.to.y) / 2};
      double off = kOnlyMoves;
      for (const SumVertex& v : open.tight_points) off = std::min(off, to_piece(z, v.at, v.at));
      for (const SumSegment& s : open.tight_segments) off = std::min(off, to_piece(z, s.from.at, s.to.at));
      EXPECT_LT(off, 1e-9) << z.x << ' ' << z.y;
    }
  }

  // Between two free configurations: a path that is found is free.
  void expect_plan() {
    std::vector<Configuration> free;
    for (const Queried& a : queried_)
      if (!a.overlaps) free.push_back(a.at);
    if (free.empty() || random_() % 4 != 0) return;
    PlanOptions options;
    options.time_limit_seconds = 0.5;
    const Plan plan = dymsum::plan(c_, free[random_() % free.size()], free[random_() % free.size()], options).value();
    if (!plan.found()) {
      EXPECT_TRUE(plan.reason->kind == NoPath::Kind::separated || plan.reason->kind == NoPath::Kind::undecided);
      return;
    }
    ++tally_.plans;
    EXPECT_EQ(check_path(c_.robot(), c_.obstacle(), plan.path)->outcome, MotionCheck::Outcome::free);
  }

  const CspaceObstacle& c_;
  ObstacleQueries queries_;
  Random& random_;
  Tally& tally_;
  double weight_;
  std::vector<Queried> queried_;
};

}  // namespace dymsum::testing_questions
