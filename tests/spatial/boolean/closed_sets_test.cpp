// Boolean operations of closed sets, against their definition: at positions of every cell of the operands' arrangement.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "dymsum/planar_boolean.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_sum_io.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "oracles/random.h"
#include "spatial/boolean/closed_sets.h"
#include "spatial/sum/exact_locator.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
namespace {

using exact::BigRational;
using oracles::Random;
using spatial::ExactPosition;
using spatial::SetOperation;
using spatial::Side;

/// A convex polytope of any dimension by its corners, as a closed set: what is outside of it by signs alone.
struct Piece {
  std::vector<std::array<int, 3>> corners;  ///< of a box, or of a simplex of as many corners
  bool is_box = false;
};

using Normal = std::array<BigRational, 3>;

Normal between(const ExactPosition& a, const ExactPosition& b) {
  return {BigRational(b[0] - a[0]), BigRational(b[1] - a[1]), BigRational(b[2] - a[2])};
}
Normal crossed(const Normal& a, const Normal& b) {
  return {BigRational(a[1] * b[2] - a[2] * b[1]), BigRational(a[2] * b[0] - a[0] * b[2]),
          BigRational(a[0] * b[1] - a[1] * b[0])};
}
BigRational dotted(const Normal& a, const Normal& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A linear map with whole entries and a factor, which is exact.
struct Map {
  std::array<std::array<int, 3>, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double scale = 1, shift = 0;

  Point3 of(const std::array<int, 3>& c) const {
    const auto along = [&](int i) {
      return scale * (rows[i][0] * c[0] + rows[i][1] * c[1] + rows[i][2] * c[2]) + shift;
    };
    return {along(0), along(1), along(2)};
  }
  ExactPosition of(const ExactPosition& c) const {
    ExactPosition at;
    for (int i = 0; i < 3; ++i)
      at[i] = exact::exact_value(scale) * (rows[i][0] * c[0] + rows[i][1] * c[1] + rows[i][2] * c[2]) +
              exact::exact_value(shift);
    return at;
  }
};

const Map kMaps[] = {{},
                     {{{{2, 1, 0}, {0, 3, 1}, {1, 0, 2}}}, 1, 0},
                     {{{{1, 2, 2}, {-2, 2, -1}, {2, 1, -2}}}, 0x1p-24, 0.1},
                     {{{{3, -1, 4}, {1, 5, -9}, {2, 6, 5}}}, 0x1p10, 1}};

/// A box from one corner to another one, or less: a rectangle, a segment, a point.
Mesh box_mesh(const std::array<int, 3>& low, const std::array<int, 3>& high, const Map& map) {
  std::vector<int> free;
  for (int i = 0; i < 3; ++i)
    if (low[i] < high[i]) free.push_back(i);
  MeshData data;
  for (unsigned k = 0; k < 1U << free.size(); ++k) {
    std::array<int, 3> c = low;
    for (std::size_t i = 0; i < free.size(); ++i)
      if (k >> i & 1) c[free[i]] = high[free[i]];
    data.vertices.push_back(map.of(c));
  }
  if (free.empty()) data.faces = {{0}};
  else if (free.size() == 1) data.faces = {{0, 1}};
  else if (free.size() == 2) data.faces = {{0, 1, 3, 2}};
  else data.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  if (free.size() < 3) return Mesh::with_thin_parts(data).value();
  Result<Mesh> made = Mesh::create(data);
  if (made) return *std::move(made);
  for (Face& face : data.faces) std::reverse(face.begin(), face.end());
  return Mesh::create(data).value();
}

Side side_of_box(const std::array<int, 3>& low, const std::array<int, 3>& high, const ExactPosition& x) {
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    if (x[i] < low[i] || x[i] > high[i]) return Side::outside;
    inside = inside && x[i] > low[i] && x[i] < high[i];
  }
  return inside ? Side::inside : Side::boundary;
}

/// Where a position lies to a result as a closed set, and whether it lies on something tight.
struct Place {
  bool closed = false, open = false;
};

class Places {
 public:
  explicit Places(const SpatialSum& sum) : sum_(sum), locator_(sum) {}

  Place of(const ExactPosition& x) const {
    using Where = spatial::ExactLocator::Where;
    const Where where = locator_.of(x);
    const bool tight = on_tight(x);
    return {where != Where::outside || tight, where == Where::inside && !tight};
  }
  Side side(const ExactPosition& x) const {
    using Where = spatial::ExactLocator::Where;
    const Where where = locator_.of(x);
    return where == Where::inside                    ? Side::inside
           : where == Where::boundary || on_tight(x) ? Side::boundary
                                                     : Side::outside;
  }

 private:
  bool on_tight(const ExactPosition& x) const {
    if (locator_.on_tight_face(x)) return true;
    if (sum_.vertices.empty()) return false;
    const spatial::SpatialPositions& at = spatial::SpatialSumInternals::positions(sum_);
    for (const auto& [from, to] : sum_.tight_segments)
      if (spatial::lies_on_segment(at.at(from), at.at(to), x)) return true;
    return std::any_of(sum_.tight_points.begin(), sum_.tight_points.end(),
                       [&](std::uint32_t v) { return at.at(v) == x; });
  }
  const SpatialSum& sum_;
  spatial::ExactLocator locator_;
};

Result<SpatialSum> made(SetOperation operation, std::span<const SpatialOperand> sets,
                        const SpatialOptions& options = {}) {
  switch (operation) {
    case SetOperation::united:
      return united(sets, options);
    case SetOperation::intersection:
      return intersection(sets, options);
    case SetOperation::difference:
      return difference(sets[0], sets.subspan(1), options);
    case SetOperation::symmetric_difference:
      return symmetric_difference(sets[0], sets[1], options);
  }
  return Error{};
}

constexpr SetOperation kOperations[] = {SetOperation::united, SetOperation::intersection, SetOperation::difference,
                                        SetOperation::symmetric_difference};

/// No tight segment lies on a tight face, no tight point on either.
void expect_least(const SpatialSum& sum, const std::string& name) {
  if (sum.vertices.empty()) return;
  const spatial::ExactLocator locator(sum);
  const spatial::SpatialPositions& at = spatial::SpatialSumInternals::positions(sum);
  const auto on_face = [&](std::uint32_t from, std::uint32_t to, const BigRational& t) {
    return locator.on_tight_face(spatial::position_between(at.at(from), at.at(to), t));
  };
  for (const auto& [from, to] : sum.tight_segments)
    EXPECT_FALSE(on_face(from, to, {1, 2}) && on_face(from, to, {1, 3})) << name;  // it may cross one
  for (const std::uint32_t v : sum.tight_points) {
    EXPECT_FALSE(locator.on_tight_face(at.at(v))) << name;
    for (const auto& [from, to] : sum.tight_segments)
      EXPECT_FALSE(spatial::lies_on_segment(at.at(from), at.at(to), at.at(v))) << name;
  }
}

/// DYMSUM_CLOSED_SOLIDS: so many times as many rounds.
std::uint64_t rounds(std::uint64_t few) {
  const char* many = std::getenv("DYMSUM_CLOSED_SOLIDS");
  return many == nullptr ? few : few * std::strtoull(many, nullptr, 10);
}

// Boxes on a tiny grid, of any dimension: at halves of the grid's unit lie all cells of their arrangement.
TEST(ClosedSolids, boxes_on_tiny_grids_equal_their_definition) {
  constexpr int kSize = 3;
  std::size_t tight = 0;
  for (std::uint64_t seed = 1; seed <= rounds(60); ++seed) {
    Random random(seed);
    const Map& map = kMaps[seed % 4];
    const std::size_t count = 2 + random.next() % 2;
    std::vector<std::array<std::array<int, 3>, 2>> boxes(count);
    std::vector<Mesh> meshes;
    for (auto& [low, high] : boxes) {
      for (int i = 0; i < 3; ++i) {
        low[i] = random.below(kSize);
        high[i] = random.chance(seed % 3 == 0 ? 30 : 8) ? low[i] : low[i] + 1 + random.below(kSize - low[i]);
      }
      meshes.push_back(box_mesh(low, high, map));
    }
    const std::vector<SpatialOperand> sets(meshes.begin(), meshes.end());
    for (const SetOperation operation : kOperations) {
      const std::string name = "seed " + std::to_string(seed) + ", operation " + std::to_string(int(operation));
      const std::span<const SpatialOperand> used(sets.data(),
                                                 operation == SetOperation::symmetric_difference ? 2 : count);
      const Result<SpatialSum> result = made(operation, used);
      ASSERT_TRUE(result.ok()) << name << ": " << result.error().to_string();
      expect_least(*result, name);
      tight += result->tight_faces.size() + result->tight_segments.size() + result->tight_points.size();
      const Places places(*result);
      std::vector<Side> sides(used.size());
      for (int x = -1; x <= 2 * kSize + 1; ++x)
        for (int y = -1; y <= 2 * kSize + 1; ++y)
          for (int z = -1; z <= 2 * kSize + 1; ++z) {
            const ExactPosition at{BigRational(x, 2), BigRational(y, 2), BigRational(z, 2)};
            for (std::size_t k = 0; k < used.size(); ++k) sides[k] = side_of_box(boxes[k][0], boxes[k][1], at);
            const Place place = places.of(map.of(at));
            ASSERT_EQ(place.closed, holds(operation, sides, false)) << name << " at " << x << ' ' << y << ' ' << z;
            ASSERT_EQ(place.open, holds(operation, sides, true)) << name << " at " << x << ' ' << y << ' ' << z;
          }
    }
  }
  EXPECT_GT(tight, 100U);
}

/// The planes of a simplex, their normals away from it, its own plane or lines among them.
struct Simplex {
  std::vector<ExactPosition> corners;

  Side side(const ExactPosition& x) const {
    if (corners.size() == 4) {
      bool inside = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const ExactPosition &a = corners[(k + 1) % 4], &b = corners[(k + 2) % 4], &c = corners[(k + 3) % 4];
        const Normal n = crossed(between(a, b), between(a, c));
        const int own = dotted(n, between(a, corners[k])).sign(), of = dotted(n, between(a, x)).sign();
        if (of == -own) return Side::outside;
        inside = inside && of == own;
      }
      return inside ? Side::inside : Side::boundary;
    }
    if (corners.size() == 3)
      return spatial::lies_on(x, {corners[0], corners[1], corners[2]}) ? Side::boundary : Side::outside;
    return spatial::lies_on_segment(corners.front(), corners.back(), x) ? Side::boundary : Side::outside;
  }
};

/// Positions in all cells that few planes make: where three of them meet, between any two of these, and more.
std::vector<ExactPosition> critical_positions(const std::vector<Simplex>& all, Random& random, std::size_t most) {
  std::vector<std::array<ExactPosition, 3>> planes;
  std::vector<ExactPosition> at;
  for (const Simplex& s : all) {
    const std::size_t n = s.corners.size();
    at.insert(at.end(), s.corners.begin(), s.corners.end());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k) planes.push_back({s.corners[i], s.corners[j], s.corners[k]});
  }
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        std::array<Normal, 3> n;
        std::array<BigRational, 3> d;
        const std::array<std::size_t, 3> of{i, j, k};
        for (int r = 0; r < 3; ++r) {
          const auto& p = planes[of[r]];
          n[r] = crossed(between(p[0], p[1]), between(p[0], p[2]));
          d[r] = dotted(n[r], {p[0][0], p[0][1], p[0][2]});
        }
        const BigRational det = dotted(n[0], crossed(n[1], n[2]));
        if (det == 0) continue;
        ExactPosition x;
        const Normal a = crossed(n[1], n[2]), b = crossed(n[2], n[0]), c = crossed(n[0], n[1]);
        for (int axis = 0; axis < 3; ++axis) x[axis] = (d[0] * a[axis] + d[1] * b[axis] + d[2] * c[axis]) / det;
        at.push_back(x);
      }
  std::sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return spatial::lexicographic_order(a, b) < 0; });
  at.erase(std::unique(at.begin(), at.end()), at.end());
  const std::size_t corners = at.size();
  while (at.size() < most) {
    const auto some = [&] { return at[random.next() % corners]; };
    ExactPosition x = spatial::position_between(some(), some(), BigRational(1, 2));
    if (random.chance(50)) x = spatial::position_between(x, some(), BigRational(1, 3));
    if (random.chance(30)) x = spatial::position_between(x, some(), BigRational(1, 5));
    at.push_back(x);
  }
  return at;
}

Mesh simplex_mesh(const Simplex& s) {
  MeshData data;
  for (const ExactPosition& c : s.corners)
    data.vertices.push_back({exact::round_to_double(c[0]), exact::round_to_double(c[1]), exact::round_to_double(c[2])});
  const std::size_t n = s.corners.size();
  if (n == 4) {
    data.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    if (dotted(crossed(between(s.corners[0], s.corners[1]), between(s.corners[0], s.corners[2])),
               between(s.corners[0], s.corners[3])) > 0)
      for (Face& f : data.faces) std::reverse(f.begin(), f.end());
    return Mesh::create(data).value();
  }
  Face face;
  for (std::uint32_t v = 0; v < n; ++v) face.push_back(v);
  data.faces = {face};
  return Mesh::with_thin_parts(data).value();
}

/// A simplex on a tiny grid of any dimension, its corners in general position for that.
Simplex random_simplex(Random& random, std::size_t corners, const Map& map) {
  for (;;) {
    Simplex s;
    for (std::size_t k = 0; k < corners; ++k)
      s.corners.push_back(map.of(
          ExactPosition{BigRational(random.below(4)), BigRational(random.below(4)), BigRational(random.below(4))}));
    if (corners == 1) return s;
    const Normal along = between(s.corners[0], s.corners[1]);
    if (dotted(along, along) == 0) continue;
    if (corners == 2) return s;
    const Normal across = crossed(along, between(s.corners[0], s.corners[2]));
    if (dotted(across, across) == 0) continue;
    if (corners == 3 || dotted(across, between(s.corners[0], s.corners[3])) != 0) return s;
  }
}

TEST(ClosedSolids, simplices_on_tiny_grids_equal_their_definition_and_results_are_operands) {
  std::size_t tight = 0;
  for (std::uint64_t seed = 1; seed <= rounds(24); ++seed) {
    Random random(seed);
    const Map& map = kMaps[random.next() % 4];
    std::vector<Simplex> all;
    std::vector<Mesh> meshes;
    for (int k = 0; k < 3; ++k) {
      const int kind = random.below(10);
      all.push_back(random_simplex(random, kind < 6 ? 4 : kind < 8 ? 3 : kind < 9 ? 2 : 1, map));
      meshes.push_back(simplex_mesh(all.back()));
    }
    const std::vector<ExactPosition> positions = critical_positions(all, random, 400);
    for (const SetOperation first : kOperations) {
      const std::string name = "seed " + std::to_string(seed) + ", first " + std::to_string(int(first));
      const SpatialOperand both[]{meshes[0], meshes[1]};
      const Result<SpatialSum> result = made(first, both);
      ASSERT_TRUE(result.ok()) << name << ": " << result.error().to_string();
      expect_least(*result, name);
      tight += result->tight_faces.size() + result->tight_segments.size() + result->tight_points.size();
      const Places places(*result);
      for (const ExactPosition& x : positions) {
        const Side sides[]{all[0].side(x), all[1].side(x)};
        const Place place = places.of(x);
        ASSERT_EQ(place.closed, holds(first, sides, false)) << name;
        ASSERT_EQ(place.open, holds(first, sides, true)) << name;
      }
      for (const SetOperation second : {SetOperation::united, SetOperation::intersection, SetOperation::difference}) {
        const std::string chain = name + ", second " + std::to_string(int(second));
        const SpatialOperand next[]{*result, meshes[2]};
        const Result<SpatialSum> last = made(second, next);
        ASSERT_TRUE(last.ok()) << chain << ": " << last.error().to_string();
        expect_least(*last, chain);
        const Places after(*last);
        for (const ExactPosition& x : positions) {
          const Side sides[]{places.side(x), all[2].side(x)};
          const Place place = after.of(x);
          ASSERT_EQ(place.closed, holds(second, sides, false)) << chain;
          ASSERT_EQ(place.open, holds(second, sides, true)) << chain;
        }
      }
    }
  }
  EXPECT_GT(tight, 30U);
}

Mesh unit_box(double x, double y, double z) { return solids::box(x, y, z, x + 1, y + 1, z + 1); }

TEST(ClosedSolids, what_two_boxes_that_touch_have_in_common) {
  const Mesh box = unit_box(0, 0, 0);
  const SpatialSum face = intersection(box, unit_box(1, 0, 0)).value();
  EXPECT_TRUE(face.faces.empty());
  EXPECT_EQ(face.tight_faces.size(), 1U);
  const SpatialSum edge = intersection(box, unit_box(1, 1, 0)).value();
  EXPECT_EQ(edge.tight_faces.size(), 0U);
  EXPECT_EQ(edge.tight_segments.size(), 1U);
  const SpatialSum point = intersection(box, unit_box(1, 1, 1)).value();
  EXPECT_EQ(point.tight_points.size(), 1U);
  EXPECT_EQ(point.tight_segments.size(), 0U);
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  for (const Mesh& other : {unit_box(1, 0, 0), unit_box(1, 1, 0), unit_box(1, 1, 1)})
    EXPECT_TRUE(intersection(box, other, regular).value().vertices.empty());
  // What is left of a box without itself is where it ends.
  EXPECT_EQ(difference(box, box).value().tight_faces.size(), 6U);
  EXPECT_TRUE(difference(box, box, regular).value().vertices.empty());
  // In the union of open boxes the wall between them is missing.
  const SpatialSum two = united(std::vector<Mesh>{box, unit_box(1, 0, 0)}).value();
  EXPECT_EQ(two.faces.size(), 6U);
  EXPECT_EQ(two.tight_faces.size(), 1U);
}

TEST(ClosedSolids, a_fit_that_is_a_face_is_its_own_union_and_intersection) {
  const Mesh room = solids::box(0, 0, 0, 3, 2, 1), part = solids::box(0, 0, 0, 1, 1, 1);
  const SpatialSum fit = erode(room, part).value();
  ASSERT_EQ(fit.tight_faces.size(), 1U);
  ASSERT_TRUE(fit.faces.empty());
  const SpatialOperand twice[]{fit, fit};
  EXPECT_EQ(united(twice).value(), fit);
  EXPECT_EQ(intersection(fit, fit).value(), fit);
  // Half of it is taken by an open box, whose sides stay.
  const SpatialSum left = difference(fit, solids::box(-1, -1, -1, 1, 5, 5)).value();
  ASSERT_EQ(left.tight_faces.size(), 1U);
  EXPECT_EQ(left.tight_segments.size(), 0U);
  const SpatialSum cut = intersection(fit, solids::box(-1, -1, -1, 1, 5, 5)).value();
  ASSERT_EQ(cut.tight_faces.size(), 1U);
  const SpatialOperand halves[]{left, cut};
  EXPECT_EQ(united(halves).value(), fit);
  EXPECT_EQ(parse_solid_sum(solid_sum_to_json(left), "left").value(), left);
}

TEST(ClosedSolids, laws) {
  Random random(7);
  for (int round = 0; round < 30; ++round) {
    std::array<Mesh, 3> m;
    for (Mesh& mesh : m) {
      std::array<int, 3> low, high;
      for (int i = 0; i < 3; ++i) low[i] = random.below(3), high[i] = low[i] + 1 + random.below(3);
      mesh = box_mesh(low, high, kMaps[round % 4]);
    }
    const SpatialOperand ab[]{m[0], m[1]}, ba[]{m[1], m[0]}, abc[]{m[0], m[1], m[2]};
    const auto all_equal = [&](SetOperation operation) {
      EXPECT_EQ(made(operation, ab).value(), made(operation, ba).value()) << round;
      const SpatialSum first = made(operation, ab).value();
      const SpatialOperand then[]{first, m[2]};
      // Of unions in two steps the walls of the first step are inside of an operand of the second.
      if (operation == SetOperation::intersection) {
        EXPECT_EQ(made(operation, then).value(), made(operation, abc).value()) << round;
      }
    };
    all_equal(SetOperation::united);
    all_equal(SetOperation::intersection);
    const SpatialSum common = intersection(m[0], m[1]).value();
    const SpatialOperand absorbed[]{m[0], common};
    EXPECT_EQ(united(absorbed).value().volume_exact(), united(std::span(&m[0], 1)).value().volume_exact()) << round;
    EXPECT_TRUE(united(absorbed).value().tight_faces.empty()) << round;
  }
}

}  // namespace
}  // namespace dymsum
