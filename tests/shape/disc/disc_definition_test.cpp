// All sets, semantics, events and radii between them against the definitions, beside every piece of the boundary.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numbers>

#include <gtest/gtest.h>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "shape/disc/disc_centres.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

enum class Which { sum, erosion, opening, closing };
const char* const kNames[] = {"sum", "erosion", "opening", "closing"};
const char* const kSemanticsNames[] = {"closed", "open", "regular"};

Result<DiscSet> made_at(const GrowingDisc& disc, Which which, const DiscRadius& r, Semantics semantics) {
  switch (which) {
    case Which::sum:
      return disc.sum_at(r, semantics);
    case Which::erosion:
      return disc.eroded_at(r, semantics);
    case Which::opening:
      return disc.opened_at(r, semantics);
    default:
      return disc.closed_at(r, semantics);
  }
}

/// How many points were queried and how many the definition in doubles could decide.
struct Queried {
  std::size_t points = 0, decided = 0, sets = 0, polygons = 0;
};

/// One set, and whether points are in it by definition.
class Definition {
 public:
  Definition(const Region& region, Which which, double r, Semantics semantics)
      : which_(which),
        r_(r),
        side_(which == Which::sum || which == Which::closing ? DiscSide::outside : DiscSide::inside),
        exact_fits_(which == Which::opening ? semantics != Semantics::regular : semantics == Semantics::open),
        centres_(region, side_, r + (exact_fits_ || is_level() ? 0 : kRoom)) {}

  bool is_level() const { return which_ == Which::sum || which_ == Which::erosion; }
  std::optional<bool> has(Point z) const {
    if (is_level()) {
      const double beyond = centres_.clearance(z) - r_;
      if (std::abs(beyond) < 1e-9) return std::nullopt;
      return (beyond > 0) == (which_ == Which::erosion);
    }
    // A centre with a little room is further away than one without, by the root of it where two positions are opposite.
    const double margin = (exact_fits_ ? 1e-7 : 1e-3) * (1 + r_);
    const std::optional<double> far = centres_.nearest(z);
    if (far && std::abs(*far - r_) < margin) return std::nullopt;
    return (far && *far < r_) == (which_ == Which::opening);
  }
  /// Well beyond what polygons leave of arcs where winding numbers are counted.
  double step() const { return is_level() || exact_fits_ ? 2e-5 * (1 + r_) : 3e-3 * (1 + r_); }
  double clearance(Point z) const { return centres_.clearance(z); }
  /// Corners of the level itself, with those of exact fits.
  const std::vector<Point>& corners() const { return centres_.corners(); }

 private:
  static constexpr double kRoom = 1e-8;
  Which which_;
  double r_;
  DiscSide side_;
  bool exact_fits_;
  oracles::DiscCentres centres_;
};

double distance_to(const DiscSegment& s, Point z) {
  const Point a = s.from.at, b = s.to.at;
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double t = length > 0 ? std::clamp((dx * (z.x - a.x) + dy * (z.y - a.y)) / length, 0.0, 1.0) : 0;
  return std::hypot(z.x - a.x - t * dx, z.y - a.y - t * dy);
}

double to_tight(const DiscSet& set, Point z) {
  double least = 1e300;
  for (const DiscSegment& s : set.tight_segments) least = std::min(least, distance_to(s, z));
  for (const DiscCorner& p : set.tight_points) least = std::min(least, std::hypot(p.at.x - z.x, p.at.y - z.y));
  return least;
}

double distance_to(const DiscPiece& piece, const DiscPiece& next, double r, Point z) {
  if (piece.of == DiscPiece::Of::edge) return distance_to(DiscSegment{piece.from, next.from}, z);
  const double dx = z.x - piece.centre.x, dy = z.y - piece.centre.y;
  const double turn = std::remainder(std::atan2(dy, dx) - piece.from_angle - piece.sweep / 2, 2 * std::numbers::pi);
  if (std::abs(turn) <= std::abs(piece.sweep) / 2) return std::abs(std::hypot(dx, dy) - r);
  return std::min(std::hypot(z.x - piece.from.at.x, z.y - piece.from.at.y),
                  std::hypot(z.x - next.from.at.x, z.y - next.from.at.y));
}

double to_boundary(const DiscSet& set, Point z) {
  double least = 1e300;
  const auto see = [&](const DiscRing& ring) {
    for (std::size_t i = 0; i < ring.pieces.size(); ++i)
      least = std::min(least, distance_to(ring.pieces[i], ring.pieces[(i + 1) % ring.pieces.size()], set.radius, z));
  };
  for (const DiscPart& part : set.parts) {
    see(part.outer);
    for (const DiscRing& hole : part.holes) see(hole);
  }
  return least;
}

/// Every exact fit lies on a ring or is tight; and what is tight is an exact fit.
void expect_tight(const DiscSet& set, const Definition& definition) {
  const auto is_fit = [&](Point z) { return std::abs(definition.clearance(z) - set.radius) < 1e-7; };
  for (const Point z : definition.corners()) {
    if (!is_fit(z)) continue;
    EXPECT_LT(std::min(to_boundary(set, z), to_tight(set, z)), 1e-4) << "at " << z.x << " " << z.y;
  }
  for (const DiscCorner& p : set.tight_points) EXPECT_TRUE(is_fit(p.at)) << p.at.x << " " << p.at.y;
  for (const DiscSegment& s : set.tight_segments)
    EXPECT_TRUE(is_fit({(s.from.at.x + s.to.at.x) / 2, (s.from.at.y + s.to.at.y) / 2}));
}

void expect_as_defined(const Region& region, const GrowingDisc& disc, Which which, const DiscRadius& r,
                       Semantics semantics, oracles::Random& random, Queried& queried) {
  SCOPED_TRACE(std::string(kNames[int(which)]) + " " + kSemanticsNames[int(semantics)] + " " +
               (r.event ? "event:" + std::to_string(*r.event) : r.value.to_string()));
  std::optional<Result<DiscSet>> made;
  ASSERT_NO_THROW(made = made_at(disc, which, r, semantics));
  ASSERT_TRUE(made->ok()) << made->error().to_string();
  const DiscSet& set = **made;
  oracles::check_form(set);
  const Definition definition(region, which, set.radius, semantics);
  const auto expect_at = [&](Point z) {
    const std::optional<bool> in = definition.has(z);
    ++queried.points;
    if (!in) return;
    ++queried.decided;
    EXPECT_EQ(oracles::winding(set, z), *in ? 1 : 0) << "at " << z.x << " " << z.y;
  };
  const double step = definition.step();
  for (const auto& position : oracles::midpoints(set)) {
    if (position.length < 20 * step) continue;
    expect_at({position.at.x + step * position.left.x, position.at.y + step * position.left.y});
    expect_at({position.at.x - step * position.left.x, position.at.y - step * position.left.y});
  }
  const auto box = bounds(region);
  const double margin = which == Which::sum ? set.radius : 0.5;
  for (int i = 0; i < 4; ++i)
    expect_at({(box[0] + box[2]) / 2 + random.signed_unit() * ((box[2] - box[0]) / 2 + margin),
               (box[1] + box[3]) / 2 + random.signed_unit() * ((box[3] - box[1]) / 2 + margin)});
  if (definition.is_level() && semantics == Semantics::open) expect_tight(set, definition);
  ++queried.sets;
  // Rings that cross or lie in the wrong part are no region.
  for (const double error : {1e-4, 1e-6}) {
    const auto polygons = to_region(set, error * (set.radius + set.at_error / 1e-7), DiscBound::nearest);
    if (polygons.ok()) {
      ++queried.polygons;
      EXPECT_EQ(polygons->region.parts().size(), set.parts.size());
      EXPECT_NEAR(area(polygons->region), area(set).value, 3 * error * (1 + set.radius) * perimeter(set).value);
      break;
    }
    if (error == 1e-6 && std::getenv("DYMSUM_SHOW") != nullptr) {
      std::cout << "no polygons: " << set.radius << " " << kNames[int(which)] << " " << kSemanticsNames[int(semantics)]
                << " " << (r.event ? int(*r.event) : -1) << " " << polygons.error().to_string() << "\n"
                << format_region(region, RegionFormat::wkt);
    }
  }
}

std::vector<DiscRadius> radii_at_and_between(const std::vector<DiscEvent>& events, std::size_t most) {
  std::vector<DiscRadius> radii;
  if (events.empty()) return {*Rational::of(3, 4)};
  const std::size_t step = 1 + events.size() / most;
  for (std::size_t i = 0; i < events.size(); i += step) {
    radii.push_back(DiscRadius::at_event(std::uint32_t(i)));
    const double next = i + 1 < events.size() ? events[i + 1].radius : 2 * events[i].radius;
    radii.push_back(*Rational::of((events[i].radius + next) / 2));
  }
  radii.push_back(*Rational::of(events[0].radius / 2));
  return radii;
}

void expect_all_sets(const Region& region, std::uint64_t seed, Queried& queried, std::size_t most = 100) {
  const std::string wkt = format_region(region, RegionFormat::wkt);
  SCOPED_TRACE("seed " + std::to_string(seed) + " " + wkt);
  oracles::Random random(seed);
  const GrowingDisc disc(region);
  for (const DiscSide side : {DiscSide::outside, DiscSide::inside}) {
    const auto events = disc.events(side);
    if (!events.ok()) {
      EXPECT_EQ(events.error().code, ErrorCode::unsupported_operand) << events.error().to_string();
      return;
    }
    for (const DiscRadius& r : radii_at_and_between(*events, most))
      for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
        expect_as_defined(region, disc, side == DiscSide::outside ? Which::sum : Which::erosion, r, semantics, random,
                          queried);
        expect_as_defined(region, disc, side == DiscSide::outside ? Which::closing : Which::opening, r, semantics,
                          random, queried);
      }
  }
}

int times() {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(1, std::atoi(text) / 100) : 1;
}

void expect_most_decided(const Queried& queried) {
  EXPECT_GT(queried.sets, 0u);
  EXPECT_GT(queried.decided, queried.points * 9 / 10);
  EXPECT_GT(queried.polygons, queried.sets * 9 / 10);
  std::cout << queried.sets << " sets, " << queried.decided << " of " << queried.points << " points decided, "
            << queried.polygons << " as polygons\n";
}

/// Simple polygons with vertices on a square grid, without straight angles, counter-clockwise.
class GridPolygons {
 public:
  GridPolygons(int size, int corners) : size_(size), corners_(corners) {}
  std::vector<Region> all() {
    for (int first = 0; first < size_ * size_; ++first) grow({first});
    return std::move(made_);
  }

 private:
  Point at(int i) const { return {double(i % size_), double(i / size_)}; }
  void grow(std::vector<int> chosen) {
    if (chosen.size() >= 3 && chosen[1] < chosen.back()) close(chosen);
    if (int(chosen.size()) == corners_) return;
    for (int next = chosen[0] + 1; next < size_ * size_; ++next) {
      if (std::find(chosen.begin(), chosen.end(), next) != chosen.end()) continue;
      chosen.push_back(next);
      grow(chosen);
      chosen.pop_back();
    }
  }
  void close(const std::vector<int>& chosen) {
    Ring ring;
    for (const int i : chosen) ring.push_back(at(i));
    double twice = 0;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
      twice += a.x * b.y - a.y * b.x;
      if ((b.x - a.x) * (c.y - b.y) == (b.y - a.y) * (c.x - b.x)) return;
    }
    if (twice < 0) std::reverse(ring.begin(), ring.end());
    if (!touches_sides(ring)) return;
    if (auto region = Region::create({{Part{ring, {}}}, {}, {}})) made_.push_back(*std::move(region));
  }
  bool touches_sides(const Ring& ring) const {
    double x = 9, y = 9;
    for (const Point p : ring) x = std::min(x, p.x), y = std::min(y, p.y);
    return x == 0 && y == 0;
  }
  int size_, corners_;
  std::vector<Region> made_;
};

TEST(DiscDefinition, PolygonsOfTheSmallestGrids) {
  Queried queried;
  const int fraction = times();
  std::vector<Region> regions = GridPolygons(3, 7).all();
  const std::vector<Region> larger = GridPolygons(4, 5).all();
  regions.insert(regions.end(), larger.begin(), larger.end());
  std::cout << regions.size() << " polygons\n";
  const auto step = static_cast<std::size_t>(std::max(1, 200 / fraction));
  for (std::size_t i = 0; i < regions.size() && !HasFailure(); i += step) expect_all_sets(regions[i], 100 + i, queried);
  expect_most_decided(queried);
}

Region region_in(const std::string& name) {
  std::ifstream in(std::string(DYMSUM_CORPUS_DIR) + "/disc/" + name);
  const std::string wkt{std::istreambuf_iterator<char>(in), {}};
  return *Region::create((*parse_shapes(wkt, RegionFormat::wkt, "test")).front().data);
}

TEST(DiscDefinition, HardCases) {
  const struct {
    const char* file;
    Which which;
    DiscRadius radius;
  } cases[] = {
      {"arc_meets_a_contact_within.wkt", Which::opening, DiscRadius::at_event(4)},
      {"arcs_of_one_disc_at_an_event.wkt", Which::opening, DiscRadius::at_event(60)},
      {"hole_in_a_part_behind_a_slit.wkt", Which::closing, *Rational::of(3, 2)},
  };
  Queried queried;
  for (const auto& one : cases) {
    SCOPED_TRACE(one.file);
    const Region region = region_in(one.file);
    const GrowingDisc disc(region);
    oracles::Random random(1);
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular})
      expect_as_defined(region, disc, one.which, one.radius, semantics, random, queried);
  }
  expect_most_decided(queried);
}

TEST(DiscDefinition, StarsCombsAndChannelsAsWideAsTheDisc) {
  Queried queried;
  std::vector<Region> regions{snapped_shapes::star(5, 2, 5), snapped_shapes::star(4, 1, 3),
                              shapes::comb(4, 2, 1, 3),      snapped_shapes::gear(6, 4, 5),
                              shapes::grate(3, 2, 1, 4),     snapped_shapes::pockets(3, 1),
                              shapes::letter_u(5, 4, 1),     shapes::letter_l(4, 3, 1)};
  for (const Region& region : regions) {
    expect_all_sets(region, 7, queried, 8);
    if (HasFailure()) return;
  }
  expect_most_decided(queried);
}

TEST(DiscDefinition, PartsHolesLinesAndPointsOnGrids) {
  Queried queried;
  const char* first = std::getenv("DYMSUM_FIRST_SEED");
  const int begin = first != nullptr ? std::atoi(first) : 0, rounds = oracles::rounds(16) * times();
  for (int round = begin; round < begin + rounds; ++round) {
    oracles::Random random(5000 + std::uint64_t(round));
    const int grid = 3 + round % 4;
    const RegionData data = round % 4 == 3 ? oracles::random_region(random, grid) : oracles::random_parts(random, grid);
    expect_all_sets(*Region::create(data), 5000 + std::uint64_t(round), queried, 8);
    if (HasFailure()) return;
  }
  expect_most_decided(queried);
}

/// Polygons whose coordinates are short, or have all their digits.
TEST(DiscDefinition, RandomPolygons) {
  Queried queried;
  const char* first = std::getenv("DYMSUM_FIRST_SEED");
  const int begin = first != nullptr ? std::atoi(first) : 0, rounds = oracles::rounds(4) * times();
  for (int round = begin; round < begin + rounds; ++round) {
    const Region region = shapes::random_polygon(6 + round % 20, round % 3, std::uint64_t(round) + 1);
    expect_all_sets(region, 6000 + std::uint64_t(round), queried, 6);
    if (HasFailure()) return;
  }
  expect_most_decided(queried);
}

}  // namespace
}  // namespace dymsum
