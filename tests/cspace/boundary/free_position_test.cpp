// Exact fits at one angle: places at rational angles, where they are integers, against membership in the static sum.
#include "cspace/boundary/free_position.h"

#include "cspace/obstacle/obstacle_slices.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {
namespace {

using namespace testing_obstacles;
using testing_obstacles::reversed;

// 5 cos and 5 sin are integers: so are robots turned whose coordinates are divided by 5.
struct Turn {
  int n, d, cosine, sine;
};
constexpr std::array<Turn, 7> kTurns{Turn{0, 1, 5, 0},   Turn{1, 1, 0, 5},  Turn{1, 2, 3, 4},   Turn{-1, 3, 4, -3},
                                     Turn{-1, 1, 0, -5}, Turn{2, 1, -3, 4}, Turn{-3, 1, -4, -3}};

Region scaled(const Region& r, double f) {
  return *Region::create(mapped(r, [&](Point p) { return Point{f * p.x, f * p.y}; }));
}

// The reflected robot, turned. Requires multiples of 5.
Region turned_back(const Region& r, const Turn& turn) {
  return *Region::create(mapped(r, [&](Point p) {
    return Point{-(turn.cosine * p.x - turn.sine * p.y) / 5, -(turn.sine * p.x + turn.cosine * p.y) / 5};
  }));
}

struct Tally {
  int free = 0, covered = 0;
};

class Positions {
 public:
  Positions(const Region& robot, const Region& obstacle, const Turn& turn)
      : turn_(turn),
        base_(pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true}).value()),
        forms_(*base_),
        angle_(exact_angle(*Orientation::of(turn.n, turn.d))),
        signs_(forms_, angle_),
        obstacle_(obstacle),
        robot_(turned_back(robot, turn)) {}

  void check(Random& random, int count, Tally& tally) {
    const auto any = [&](std::uint32_t op) { return static_cast<std::uint32_t>(random() % forms_.size(op)); };
    const auto segment = [&] {
      const auto side = static_cast<std::uint32_t>(random() % 2);
      return WalkSegment{side, any(side), any(1 - side)};
    };
    for (int k = 0; k < count; ++k) {
      const Pair v{any(0), any(1)}, w{any(0), any(1)};
      compare({{false, v, {}, {}}, {}}, position(v), tally);
      const Point y = position(v), z = position(w);
      compare({{false, v, {}, {}}, ExactPosition::Simple{false, w, {}, {}}}, {(y.x + z.x) / 2, (y.y + z.y) / 2}, tally);
      const WalkSegment a = segment(), b = segment();
      if (const std::optional<Point> x = crossing(a, b)) compare({{true, {}, a, b}, {}}, *x, tally);
    }
  }

 private:
  Point input(std::uint32_t op, std::uint32_t v) const {
    return base_->lattice->points[op]->input[forms_.operand(op).source[v]];
  }
  Point position(Pair v) const {
    const Point p = input(0, v.p), q = input(1, v.q);
    return {p.x + (turn_.cosine * q.x - turn_.sine * q.y) / 5, p.y + (turn_.sine * q.x + turn_.cosine * q.y) / 5};
  }
  // On the first segment, where it is an integer.
  std::optional<Point> crossing(const WalkSegment& a, const WalkSegment& b) const {
    const Point p = position(TurningForms::start(a)), q = position(TurningForms::start(b)),
                p1 = position(forms_.end(a)), q1 = position(forms_.end(b));
    const Point d{p1.x - p.x, p1.y - p.y}, e{q1.x - q.x, q1.y - q.y};
    const double cross = d.x * e.y - d.y * e.x, side = (q.x - p.x) * e.y - (q.y - p.y) * e.x;
    if (cross == 0 || std::fmod(side * d.x, cross) != 0 || std::fmod(side * d.y, cross) != 0) return std::nullopt;
    if (side / cross < 0 || side / cross > 1) return std::nullopt;
    return Point{p.x + side * d.x / cross, p.y + side * d.y / cross};
  }
  void compare(const ExactPosition& exact, Point z, Tally& tally) const {
    const bool covered = contains(obstacle_, robot_, z, Semantics::open);
    (covered ? tally.covered : tally.free) += 1;
    ASSERT_EQ(is_free(signs_, exact), !covered)
        << z.x << ' ' << z.y << " at " << turn_.n << '/' << turn_.d << "\nreflected robot "
        << format_region(robot_, RegionFormat::wkt) << "\nobstacle " << format_region(obstacle_, RegionFormat::wkt);
  }

  Turn turn_;
  std::shared_ptr<const OperandPair> base_;
  TurningForms forms_;
  ExactAngle angle_;
  SignsAt signs_;
  Region obstacle_, robot_;
};

TEST(FreePosition, equals_membership_in_the_open_sum) {
  Tally tally;
  for_seeds(static_cast<std::uint64_t>(oracles::rounds(120, 3)), [&](Random& random) {
    const int parts = 1 + static_cast<int>(random() % 2);
    const bool cells = random() % 3 == 0;
    const Region robot = scaled(cells ? random_cells(random, 3, 1) : random_shape(random, 2, 5, false, parts), 5);
    const bool board = random() % 2 == 0, hole = random() % 2 == 0;
    const Region obstacle = !cells  ? random_shape(random, 12, 6, hole, 1 + static_cast<int>(random() % 2))
                            : board ? random_board(random, 4, 5)
                                    : random_cells(random, 4, 5);
    Positions(robot, obstacle, kTurns[random() % kTurns.size()]).check(random, 12, tally);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(tally.free, oracles::rounds(500, 3) / static_cast<int>(kFractionOfSeeds));
  EXPECT_GT(tally.covered, oracles::rounds(500, 3) / static_cast<int>(kFractionOfSeeds));
}

// Parts, a bent polyline and a point, in any place, against parts; either way round.
TEST(FreePosition, of_pieces_without_area_equals_membership_in_the_open_sum) {
  Tally tally;
  for_seeds(static_cast<std::uint64_t>(oracles::rounds(120, 3)), [&](Random& random) {
    const auto grid = [&](int reach) {
      return 5.0 * (static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
    };
    const bool robot = random() % 2 == 0;
    const int reach = robot ? 2 : 3;
    RegionData thin;
    if (random() % 2 == 0) thin.parts = scaled(random_shape(random, reach, 4, false), 5).parts();
    Polyline& line = thin.polylines.emplace_back();
    while (line.size() < 3)
      if (const Point p{grid(reach), grid(reach)}; line.empty() || p != line.back()) line.push_back(p);
    thin.points.push_back({grid(reach), grid(reach)});
    const Region one = *Region::create(thin),
                 other = scaled(random_shape(random, robot ? 3 : 2, 6, random() % 2 == 0), 5);
    Positions(robot ? one : other, robot ? other : one, kTurns[random() % kTurns.size()]).check(random, 12, tally);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(tally.free, oracles::rounds(300, 3) / static_cast<int>(kFractionOfSeeds));
  EXPECT_GT(tally.covered, oracles::rounds(300, 3) / static_cast<int>(kFractionOfSeeds));
}

TEST(FreePosition, of_a_segment_equals_membership_in_the_open_sum) {
  Tally tally;
  for_seeds(static_cast<std::uint64_t>(oracles::rounds(120, 3)), [&](Random& random) {
    const auto at = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 4); };
    RegionData rod;
    rod.polylines.push_back({{at(), at()}, {at() + 0.5, at()}});
    const Region obstacle = random() % 2 == 0 ? random_board(random, 4, 5) : random_shape(random, 12, 6, true, 2);
    Positions(scaled(*Region::create(rod), 10), obstacle, kTurns[random() % kTurns.size()]).check(random, 20, tally);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(tally.free, oracles::rounds(500, 3) / static_cast<int>(kFractionOfSeeds));
  EXPECT_GT(tally.covered, oracles::rounds(500, 3) / static_cast<int>(kFractionOfSeeds));
}

// The robot in its own cavity; and in place of the obstacle itself, or with a ring of one in the other.
TEST(FreePosition, equal_shapes_and_shapes_inside_of_each_other) {
  Tally tally;
  for_seeds(60, [&](Random& random) {
    const Region shape = scaled(random_shape(random, 3, 7, false), 5);
    RegionData room;
    room.parts.push_back({box(-100, -100, 100, 100), {}});
    for (const Part& part : shape.parts()) room.parts[0].holes.push_back(reversed(part.outer));
    const Region cavity = *Region::create(room);
    Positions(shape, cavity, kTurns[0]).check(random, 60, tally);
    Positions(shape, shape, kTurns[0]).check(random, 60, tally);
    Positions(cavity, shape, kTurns[random() % kTurns.size()]).check(random, 60, tally);
    Positions(scaled(shape, 8), scaled(shape, 1), kTurns[random() % kTurns.size()]).check(random, 20, tally);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(tally.free, 500 / static_cast<int>(kFractionOfSeeds));
  EXPECT_GT(tally.covered, 500 / static_cast<int>(kFractionOfSeeds));
}

}  // namespace
}  // namespace dymsum::planar
