// Regions by their lines: turned, noisy and rounded regions have the edges that they had, exactly, near where they
// were.
#include "dymsum/region_by_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "oracles/vertices_by.h"

namespace dymsum {
namespace {

using exact::BigRational;
using exact::exact_value;

RegionData polygon(Ring ring, std::vector<Ring> holes = {}) { return {{{std::move(ring), std::move(holes)}}, {}, {}}; }

RegionData ell() { return polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}); }
/// A comb with tips on one line and slanted sides.
RegionData comb() {
  return polygon(
      {{0, 0}, {8, 0}, {8, 2}, {7, 2}, {6.5, 1}, {6, 2}, {4, 2}, {3.5, 1}, {3, 2}, {1, 2}, {0.5, 1}, {0, 2}});
}
RegionData frame() {
  return polygon({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}},
                 {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}, {{2, 2}, {2, 3}, {3, 2}}});
}
/// Chamfers along diagonals, and collinear vertices on one of them.
RegionData chamfered() {
  return polygon({{1, 0}, {3, 0}, {4, 1}, {4, 3}, {3.5, 3.5}, {3.25, 3.75}, {3, 4}, {1, 4}, {0, 3}, {0, 1}});
}
RegionData hexagon() {
  RegionData data;
  data.parts.emplace_back();
  for (int k = 0; k < 6; ++k)
    data.parts[0].outer.push_back({2 * std::cos(k * std::acos(-1.0) / 3), 2 * std::sin(k * std::acos(-1.0) / 3)});
  return data;
}

struct NamedRegion {
  std::string name;
  RegionData data;
  std::size_t vertices, directions, right_angles;
};
std::vector<NamedRegion> drawings() {
  return {{"ell", ell(), 6, 2, 1},
          {"comb", comb(), 12, 4, 1},
          {"frame", frame(), 11, 3, 1},
          {"chamfered", chamfered(), 8, 4, 2},
          {"hexagon", hexagon(), 6, 3, 0}};
}

RegionData turned_by(RegionData data, double angle, Point by = {0, 0}) {
  const double c = std::cos(angle), s = std::sin(angle);
  return oracles::vertices_by(std::move(data), [&](Point p) {
    return Point{c * p.x - s * p.y + by.x, s * p.x + c * p.y + by.y};
  });
}
RegionData each(RegionData data, const std::function<double(double)>& f) {
  return oracles::vertices_by(std::move(data), [&](Point p) { return Point{f(p.x), f(p.y)}; });
}
double single(double c) { return static_cast<double>(static_cast<float>(c)); }
double decimal(double c) { return std::nearbyint(c * 1e6) / 1e6; }

using ExactPoint = std::array<BigRational, 2>;
std::vector<std::vector<ExactPoint>> exact_rings(const PlanarSum& sum) {
  std::vector<std::vector<ExactPoint>> rings;
  const auto add = [&](const SumRing& ring) {
    rings.emplace_back();
    for (const SumVertex& v : ring.vertices) {
      const RationalPoint at = sum.exact(v);
      rings.back().push_back({exact_value(at.x), exact_value(at.y)});
    }
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return rings;
}

/// The directions of all edges as slopes, each once.
std::set<std::pair<bool, BigRational>> directions(const PlanarSum& sum) {
  std::set<std::pair<bool, BigRational>> all;
  for (const auto& ring : exact_rings(sum)) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const ExactPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const BigRational x = b[0] - a[0], y = b[1] - a[1];
      all.insert(x == 0 ? std::pair(true, BigRational(0)) : std::pair(false, BigRational(y / x)));
    }
  }
  return all;
}
/// Pairs of directions at right angles, exactly.
std::size_t right_angles(const PlanarSum& sum) {
  std::size_t pairs = 0;
  const auto all = directions(sum);
  for (const auto& a : all)
    for (const auto& b : all)
      pairs += (a.first && !b.first && b.second == 0) || (!a.first && !b.first && a < b && a.second * b.second == -1);
  return pairs;
}

/// Every vertex of the result is within the largest move of one of the data's.
void expect_near(const RegionByLines& made, const RegionData& data) {
  EXPECT_LE(made.largest_move, made.tolerance);
  std::vector<Point> given = data.points;
  for (const Part& part : data.parts) {
    given.insert(given.end(), part.outer.begin(), part.outer.end());
    for (const Ring& hole : part.holes) given.insert(given.end(), hole.begin(), hole.end());
  }
  const BigRational most = exact_value(made.largest_move) * exact_value(made.largest_move);
  for (const auto& ring : exact_rings(made.region)) {
    for (const ExactPoint& at : ring) {
      const double near_x = exact::round_to_double(at[0]);
      EXPECT_TRUE(std::any_of(given.begin(), given.end(), [&](const Point& p) {
        if (std::abs(near_x - p.x) > 4 * made.largest_move + 1e-9 * std::abs(p.x)) return false;  // it is others
        const BigRational x = at[0] - exact_value(p.x), y = at[1] - exact_value(p.y);
        return x * x + y * y <= most;
      }));
    }
  }
}

TEST(ByLines, turned_regions_have_the_edges_that_they_had) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(0, 6.3), shift(-20, 20);
  for (const NamedRegion& drawing : drawings()) {
    SCOPED_TRACE(drawing.name);
    for (int k = 0; k < oracles::rounds(40); ++k) {
      const double by = angle(random);
      SCOPED_TRACE(by);
      const RegionData data = turned_by(drawing.data, by, {shift(random), shift(random)});
      const RegionByLines made = by_lines(data).value();
      EXPECT_EQ(made.region.vertex_count(), drawing.vertices);
      EXPECT_EQ(directions(made.region).size(), drawing.directions);
      EXPECT_EQ(right_angles(made.region), drawing.right_angles);
      EXPECT_EQ(made.loose_edges, 0u);
      EXPECT_LT(made.largest_move, 1e-11);
      expect_near(made, data);
    }
  }
}

TEST(ByLines, regions_of_single_precision_and_decimals_that_were_turned) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(0, 6.3);
  for (const auto rounding : {single, decimal}) {
    for (const NamedRegion& drawing : drawings()) {
      SCOPED_TRACE(drawing.name + (rounding == single ? ", single" : ", decimals"));
      for (int k = 0; k < oracles::rounds(40); ++k) {
        const double by = angle(random);
        SCOPED_TRACE(by);
        const RegionData data = each(turned_by(drawing.data, by), rounding);
        const RegionByLines made = by_lines(data).value();
        EXPECT_EQ(made.region.vertex_count(), drawing.vertices);
        EXPECT_EQ(directions(made.region).size(), drawing.directions);
        EXPECT_EQ(made.loose_edges, 0u);
        expect_near(made, data);
      }
    }
  }
}

TEST(ByLines, every_kind_of_coordinates) {
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    for (const NamedRegion& drawing : drawings()) {
      SCOPED_TRACE(drawing.name);
      std::mt19937_64 random(3);
      const RegionData data = of_kind(drawing.data, kind, random);
      const RegionByLines made = by_lines(data).value();
      expect_near(made, data);
      if (kind == CoordinateKind::decimals && drawing.name != "ell") continue;  // 4 digits change what is parallel
      EXPECT_EQ(made.region.vertex_count(), drawing.vertices);
      EXPECT_EQ(directions(made.region).size(), drawing.directions);
    }
  }
}

TEST(ByLines, regions_on_the_grid_stay_what_they_are) {
  for (const NamedRegion& drawing : drawings()) {
    if (drawing.name == "hexagon") continue;
    SCOPED_TRACE(drawing.name);
    const RegionByLines made = by_lines(drawing.data).value();
    EXPECT_TRUE(made.axes.empty());
    EXPECT_EQ(made.largest_move, 0);
    EXPECT_EQ(made.merged, 0u);
    EXPECT_EQ(made.region, united(std::vector<PlanarOperand>{Region::create(drawing.data).value()}).value());
  }
}

TEST(ByLines, sums_of_parts_turned_alike_have_the_vertices_of_the_unturned) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> angle(0, 6.3);
  const auto list = drawings();
  for (const NamedRegion& p : list) {
    for (const NamedRegion& q : list) {
      SCOPED_TRACE(p.name + " " + q.name);
      const double by = angle(random);
      SCOPED_TRACE(by);
      const std::vector<RegionByLines> grid = by_lines(std::vector{p.data, q.data}).value();
      const std::vector<RegionByLines> turned =
          by_lines(std::vector{turned_by(p.data, by, {3.7, 0.1}), turned_by(q.data, by, {-0.3, 9.1})}).value();
      const PlanarSum plain = minkowski_sum(grid[0].region, grid[1].region).value(),
                      sum = minkowski_sum(turned[0].region, turned[1].region).value();
      EXPECT_EQ(sum.vertex_count(), plain.vertex_count());
      EXPECT_EQ(sum.hole_count(), plain.hole_count());
      EXPECT_EQ(directions(sum).size(), directions(plain).size());
      EXPECT_NEAR(sum.area(), plain.area(), 1e-8);
    }
  }
}

/// A sheet along the axes with a slot, which the angle turns.
RegionData slotted(const Ring& slot, double angle, Point at) {
  RegionData hole = turned_by(polygon(slot), angle, at);
  std::reverse(hole.parts[0].outer.begin(), hole.parts[0].outer.end());
  return polygon({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, {hole.parts[0].outer});
}

TEST(ByLines, a_turned_part_fits_a_turned_slot_exactly) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(0.01, 6.27);
  const std::vector<Ring> parts{
      ell().parts[0].outer, comb().parts[0].outer, chamfered().parts[0].outer, {{0, 0}, {3, 0}, {0, 4}}};
  const auto fits_as = [](const RegionData& slotted_sheet, const RegionData& part) {
    const std::vector<RegionByLines> made = by_lines(std::vector{slotted_sheet, part}).value();
    // Where the part lies in the slot: in what the sheet leaves of its outline.
    SumOptions regular;
    regular.semantics = Semantics::regular;
    const PlanarSum slot = difference(Region::create(polygon({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}})).value(),
                                      made[0].region, regular)
                               .value();
    return erode(slot, made[1].region).value();
  };
  for (const Ring& part : parts) {
    for (int k = 0; k < oracles::rounds(20); ++k) {
      const double by = angle(random);
      SCOPED_TRACE(by);
      const RegionData sheet = slotted(part, by, {0.7, -1.3}), loose = turned_by(polygon(part), by, {30, 17.3});
      const PlanarSum fit = fits_as(sheet, loose);
      EXPECT_EQ(fit.points.size(), 1u);
      EXPECT_TRUE(fit.parts.empty() && fit.segments.empty());
    }
  }
  // Lengths that are no multiples of anything fit where both are rounded to one unit, whatever the sizes of the
  // regions; noise may take one of them to the next multiple.
  const Ring plate{{0, 0}, {std::sqrt(2.0), 0}, {std::sqrt(2.0), 1 / std::sqrt(3.0)}, {0, 1 / std::sqrt(3.0)}};
  std::size_t fitting = 0;
  const int rounds = oracles::rounds(20);
  for (int k = 0; k < rounds; ++k) {
    const double by = angle(random);
    fitting += fits_as(slotted(plate, by, {0.7, -1.3}), turned_by(polygon(plate), by, {3, 1})).points.size();
  }
  EXPECT_GE(10 * fitting, 8u * static_cast<std::size_t>(rounds));
  // A square fits its slot also a quarter turned.
  const Ring square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (int k = 0; k < oracles::rounds(20); ++k) {
    const double by = angle(random);
    const PlanarSum fit = fits_as(slotted(square, by, {0.7, -1.3}), turned_by(polygon(square), by + std::acos(0.0)));
    EXPECT_EQ(fit.points.size(), 1u) << by;
  }
}

TEST(ByLines, the_order_of_regions_does_not_matter) {
  const RegionData a = turned_by(ell(), 0.4), b = turned_by(comb(), 0.4, {5, 5}), c = turned_by(hexagon(), 1.4);
  const auto forth = by_lines(std::vector{a, b, c}).value(), back = by_lines(std::vector{c, b, a}).value();
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(forth[k].region, back[2 - k].region);
  EXPECT_EQ(forth[0].axes, forth[1].axes);
}

TEST(ByLines, rings_with_axes_of_their_own_lines_and_points) {
  RegionData data = slotted({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, 0.7, {1, 1});
  const RegionData part = turned_by(ell(), 2.1, {20, 0});
  data.parts.push_back(part.parts[0]);
  const RegionData line = turned_by(polygon({{0, 0}, {1, 0}, {2, 0}, {2, 3}, {0, 3}}), 2.1, {30, 0});
  data.polylines = {line.parts[0].outer, line.parts[0].outer};
  data.polylines[1].push_back(data.polylines[1][0]);
  for (Point& p : data.polylines[1]) p.x += 40;
  data.points = {{1.0 / 3, 100}};
  const RegionByLines made = by_lines(data).value();
  EXPECT_EQ(made.axes.size(), 2u);
  EXPECT_EQ(made.region.vertex_count(), 14u);
  EXPECT_EQ(made.region.segments.size(), 3u + 4u);
  EXPECT_EQ(made.region.points.size(), 1u);
  EXPECT_EQ(made.edges, 8u + 6u + 4u + 5u);
  EXPECT_EQ(directions(made.region).size(), 6u);
}

TEST(ByLines, rounds_and_gears_stay_within_the_tolerance) {
  std::mt19937_64 random(6);
  for (const Region& round : {shapes::disc(64, 1), shapes::disc(2000, 1), shapes::gear(9, 1, 1.5),
                              shapes::star(44, 1, 2), shapes::random_polygon(300, 7, 2)}) {
    const RegionData data = turned_by(round.data(), 0.3, {1, 2});
    const RegionByLines made = by_lines(data).value();
    expect_near(made, data);
    EXPECT_EQ(made.region.vertex_count(), round.canonical().vertex_count());
    EXPECT_NEAR(made.region.area(), area(round), 1e-9);
    if (round.vertex_count() == 64) {
      EXPECT_EQ(directions(made.region).size(), 32u);
      EXPECT_EQ(minkowski_sum(made.region, made.region)->vertex_count(), 64u);
    }
  }
}

TEST(ByLines, edges_whose_vertices_would_move_too_far_stay_loose) {
  // Long edges that meet at an angle of 2^-20, each parallel to another one but for 2^-44: where rounded lines meet is
  // 2^-23 away.
  const double t = 0x1p-20;
  RegionData data =
      polygon({{0, 0}, {4, 0.1}, {8, 0.2 + 4 * t + 0x1p-42}, {8, 3}, {4, 2.9 - 4 * t}, {0, 2.8 - 4 * t - 0x1p-43}});
  LinesOptions options;
  options.tolerance = 0x1p-38;
  const RegionByLines made = by_lines(data, options).value();
  expect_near(made, data);
  EXPECT_GT(made.loose_edges, 0u);
}

TEST(ByLines, parts_that_rounding_made_overlap_are_one) {
  RegionData data = turned_by(polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), 0.3);
  const RegionData other = turned_by(polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}}), 0.3);
  data.parts.push_back(other.parts[0]);
  const RegionByLines made = by_lines(data).value();
  EXPECT_EQ(made.region.parts.size(), 1u);
  EXPECT_EQ(made.region.vertex_count(), 4u);
}

TEST(ByLines, of_any_size) {
  for (const int power : {-1000, -500, -100, -3, 250, 500, 900}) {
    SCOPED_TRACE(power);
    const RegionData data = each(turned_by(ell(), 0.4), [&](double c) { return std::ldexp(c, power); });
    const RegionByLines made = by_lines(data).value();
    EXPECT_EQ(made.region.vertex_count(), 6u);
    EXPECT_EQ(directions(made.region).size(), 2u);
    expect_near(made, data);
  }
}

TEST(ByLines, noise_along_own_axes_goes_and_vertices_stay_doubles) {
  RegionData data = ell();
  data.parts[0].outer[0].x = 6e-17;
  data.parts[0].outer[2].y += 0x1p-52;
  const RegionByLines made = by_lines(data).value();
  EXPECT_EQ(made.region, by_lines(ell())->region);
  EXPECT_EQ(made.merged, 2u);
}

TEST(ByLines, decimals_that_differ_stay_different) {
  RegionData data = polygon({{0, 0}, {12.347, 0}, {12.347, 5.113}, {7.331, 5.113}, {7.331, 5.114}, {0, 5.114}});
  const RegionByLines made = by_lines(data).value();
  EXPECT_EQ(made.region.vertex_count(), 6u);
  EXPECT_EQ(made.largest_move, 0);
}

TEST(ByLines, errors_name_what_is_wrong) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(by_lines(RegionData{})->region.parts.empty());
  for (const double tolerance : {0.0, -1.0, 1e-17, inf, std::nan("")}) {
    LinesOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(by_lines(ell(), options).error().code, ErrorCode::out_of_range) << tolerance;
  }
  LinesOptions wide;
  wide.tolerance = 100;
  EXPECT_EQ(by_lines(ell(), wide).error().code, ErrorCode::no_area);
  RegionData data = ell();
  data.parts[0].outer[1].y = inf;
  EXPECT_EQ(by_lines(data).error().code, ErrorCode::not_finite);
  EXPECT_EQ(by_lines(RegionData{{}, {{{0, 0}}}, {}}).error().code, ErrorCode::too_few_vertices);
  LinesOptions options;
  options.sums.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(by_lines(ell(), options).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace dymsum
