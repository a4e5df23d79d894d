#include "dymsum/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/region_io.h"

namespace dymsum {
namespace {

Region comb(int teeth) {
  Ring ring{{0, 0}, {double(8 * teeth + 4), 0}};
  for (int i = teeth; i >= 0; --i) {
    const double x = 8 * i;
    ring.push_back({x + 4, 20});
    ring.push_back({x, 20});
    if (i > 0) ring.push_back({x, 5}), ring.push_back({x - 4, 5});
  }
  return Region::create({{{ring, {}}}, {}, {}}).value();
}

Region plate_with_holes() {
  std::vector<Ring> holes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const double x = 10 * i + 3, y = 10 * j + 3, s = 2 + i;
      holes.push_back({{x, y}, {x, y + s}, {x + s, y + s}, {x + s, y}});
    }
  return Region::create({{{{{0, 0}, {30, 0}, {30, 20}, {0, 20}}, holes}}, {}, {}}).value();
}

/// A star-shaped ring with random radii.
Region random_star(unsigned seed, int n) {
  std::mt19937 random(seed);
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, r = 300 + double(random() % 700);
    ring.push_back({std::round(r * std::cos(angle)), std::round(r * std::sin(angle))});
  }
  return Region::create({{{ring, {}}}, {}, {}}).value();
}

Rational twice_area(const Region& region) {
  Rational sum;
  const auto add = [&](const Ring& ring) {
    RationalRing exact;
    for (const Point& p : ring) exact.push_back({Rational::of(p.x).value(), Rational::of(p.y).value()});
    sum += dymsum::twice_area(exact);
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return sum;
}

Decomposition cut(const Region& region, const Rational& tau, const FeatureOptions& options = {}) {
  return decompose(ShapeFeatures::create(region, options).value(), {tau, 0, std::nullopt, {}}).value();
}

Rational turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool properly_cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return turn(a, b, c).sign() * turn(a, b, d).sign() < 0 && turn(c, d, a).sign() * turn(c, d, b).sign() < 0;
}

std::vector<Region> shapes() { return {comb(4), plate_with_holes(), random_star(1, 24), random_star(7, 40)}; }

TEST(Decompose, PiecesTileTheRegion) {
  for (const Region& region : shapes())
    for (const int tau : {0, 3, 5, 400}) {
      const Decomposition made = cut(region, tau);
      Rational sum;
      for (const Piece& piece : made.pieces) {
        EXPECT_GT(dymsum::twice_area(piece.outer), Rational(0));
        sum += dymsum::twice_area(piece.outer);
        for (const RationalRing& hole : piece.holes) {
          EXPECT_LT(dymsum::twice_area(hole), Rational(0));
          sum += dymsum::twice_area(hole);
        }
      }
      EXPECT_EQ(sum, twice_area(region)) << "tau " << tau;
    }
}

TEST(Decompose, AllNotchesResolvedLeaveConvexPieces) {
  for (const Region& region : shapes()) {
    const Decomposition made = cut(region, 0);
    for (const Piece& piece : made.pieces) {
      EXPECT_TRUE(piece.holes.empty());
      const RationalRing& r = piece.outer;
      for (std::size_t i = 0; i < r.size(); ++i)
        EXPECT_GE(turn(r[i], r[(i + 1) % r.size()], r[(i + 2) % r.size()]).sign(), 0);
    }
  }
}

TEST(Decompose, CutsDoNotCrossAndEndWhereTheySay) {
  for (const Region& region : shapes()) {
    const Decomposition made = cut(region, 0);
    std::vector<Point> vertices;
    std::vector<std::uint32_t> next;
    for (const Part& part : region.parts()) {
      std::vector<Ring> rings{part.outer};
      rings.insert(rings.end(), part.holes.begin(), part.holes.end());
      for (const Ring& ring : rings) {
        const auto first = std::uint32_t(vertices.size());
        for (std::uint32_t i = 0; i < ring.size(); ++i) next.push_back(first + (i + 1) % std::uint32_t(ring.size()));
        vertices.insert(vertices.end(), ring.begin(), ring.end());
      }
    }
    const auto at = [&](std::uint32_t v) {
      return RationalPoint{Rational::of(vertices[v].x).value(), Rational::of(vertices[v].y).value()};
    };
    for (std::size_t i = 0; i < made.cuts.size(); ++i) {
      const Cut& c = made.cuts[i];
      EXPECT_EQ(c.from, at(c.vertex));
      if (c.end == Cut::End::vertex) {
        EXPECT_EQ(c.to, at(c.index));
      } else if (c.end == Cut::End::edge) {
        EXPECT_EQ(turn(at(c.index), at(next[c.index]), c.to).sign(), 0);
      } else {
        ASSERT_LT(c.index, i);
        EXPECT_EQ(turn(made.cuts[c.index].from, made.cuts[c.index].to, c.to).sign(), 0);
      }
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_FALSE(properly_cross(c.from, c.to, made.cuts[j].from, made.cuts[j].to));
    }
  }
}

TEST(Decompose, LevelsAreNested) {
  for (const Region& region : shapes()) {
    const std::vector<Cut> all = cut(region, 0).cuts;
    std::size_t before = all.size();
    for (const int tau : {1, 2, 3, 4, 5, 50, 200, 1000}) {
      const std::vector<Cut> some = cut(region, tau).cuts;
      ASSERT_LE(some.size(), before);
      EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << "tau " << tau;
      before = some.size();
    }
  }
}

TEST(Decompose, SmallNoiseLeavesLastingCutsWhereTheyWere) {
  // A notch in each side, and teeth 1/16 high along the bottom.
  Ring clean{{0, 0}, {40, 0}, {40, 20}, {24, 20}, {20, 8}, {16, 20}, {0, 20}}, noisy{{0, 0}};
  for (int i = 1; i < 40; ++i) noisy.push_back({double(i), i % 2 == 1 ? -0.0625 : 0.0});
  noisy.insert(noisy.end(), clean.begin() + 1, clean.end());
  const Decomposition a = cut(Region::create({{{clean, {}}}, {}, {}}).value(), 6);
  const Decomposition b = cut(Region::create({{{noisy, {}}}, {}, {}}).value(), 6);
  ASSERT_EQ(a.cuts.size(), 1u);
  ASSERT_EQ(b.cuts.size(), 1u);
  EXPECT_EQ(a.cuts[0].from, b.cuts[0].from);
  EXPECT_EQ(a.pieces.size(), b.pieces.size());
}

TEST(Decompose, NoiseMovesTheCutsOfARealShapeAsLittleAsItself) {
  const std::filesystem::path folder = std::filesystem::path(DYMSUM_SOURCE_DIR) / "../shared/data/planar";
  if (!std::filesystem::exists(folder / "mammoth_noise.poly")) GTEST_SKIP() << "no such data";
  const auto cuts = [&](const char* name) {
    const RegionData data = read_region_data((folder / name).string()).value();
    return cut(repair(data).value().region, 3).cuts;
  };
  const std::vector<Cut> clean = cuts("mammoth.poly"), noisy = cuts("mammoth_noise.poly");
  ASSERT_EQ(clean.size(), 6u);
  ASSERT_EQ(noisy.size(), 6u);
  const auto far = [](const RationalPoint& a, const RationalPoint& b) {
    return std::hypot((a.x - b.x).to_double(), (a.y - b.y).to_double());
  };
  for (const Cut& a : clean)
    EXPECT_TRUE(std::any_of(noisy.begin(), noisy.end(),
                            [&](const Cut& b) { return far(a.from, b.from) < 0.05 && far(a.to, b.to) < 0.05; }));
}

TEST(Decompose, WideShallowNoiseCountsByItsDepth) {
  // Notches 1/16 deep and 8 wide, alone and beside each other.
  Ring ring{{0, 0}};
  for (int i = 1; i < 10; ++i) ring.push_back({4.0 * i, i % 2 == 1 ? 0.0625 : 0.0});
  ring.insert(ring.end(), {{40, 0}, {40, 20}, {0, 20}});
  const Region region = Region::create({{{ring, {}}}, {}, {}}).value();
  EXPECT_TRUE(cut(region, Rational::parse("1/8").value()).cuts.empty());
  EXPECT_EQ(cut(region, Rational::parse("1/16").value()).cuts.size(), 5u);
}

Region small_polygon(unsigned seed) {
  std::mt19937 random(seed);
  for (;;) {
    Ring ring;
    for (int i = 0; i < 5 + int(seed % 4); ++i) ring.push_back({double(random() % 6), double(random() % 6)});
    if (Result<Region> made = Region::create({{{ring, {}}}, {}, {}}); made && made.value().touching_points().empty())
      return made.value();
  }
}

bool inside(const RationalRing& ring, const RationalPoint& p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const RationalPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y)) odd = odd != ((turn(a, b, p).sign() > 0) == (b.y > a.y));
  }
  return odd;
}

bool inside(const Piece& piece, const RationalPoint& p) {
  bool in = inside(piece.outer, p);
  for (const RationalRing& hole : piece.holes) in = in && !inside(hole, p);
  return in;
}

TEST(Decompose, EveryPointOfATinyGridLiesInOnePiece) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Region region = small_polygon(seed);
    RationalRing outer;
    for (const Point& p : region.parts()[0].outer)
      outer.push_back({Rational::of(p.x).value(), Rational::of(p.y).value()});
    for (const int tau : {0, 1}) {
      const Decomposition made = cut(region, tau);
      for (int i = 0; i < 15; ++i)
        for (int j = 0; j < 15; ++j) {  // on no edge and on no cut: the denominators are large primes
          const RationalPoint p{Rational(i) / Rational(3) + Rational(1) / Rational(100003),
                                Rational(j) / Rational(3) + Rational(1) / Rational(10007)};
          const auto holders = std::count_if(made.pieces.begin(), made.pieces.end(),
                                             [&](const Piece& piece) { return inside(piece, p); });
          ASSERT_EQ(holders, inside(outer, p) ? 1 : 0) << "seed " << seed << ", tau " << tau;
        }
    }
  }
}

/// Whether two segments of a line have more than a point in common.
bool run_along(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  if (turn(a, b, c).sign() != 0 || turn(a, b, d).sign() != 0) return false;
  const auto along = [&](const RationalPoint& p) { return (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y); };
  return std::max(along(a), std::min(along(c), along(d))) < std::min(along(b), std::max(along(c), along(d)));
}

bool neighbours(const Piece& one, const Piece& other) {
  const auto sides = [](const Piece& piece) {
    std::vector<RationalSegment> made;
    std::vector<RationalRing> rings = piece.holes;
    rings.push_back(piece.outer);
    for (const RationalRing& r : rings)
      for (std::size_t i = 0; i < r.size(); ++i) made.push_back({r[i], r[(i + 1) % r.size()]});
    return made;
  };
  for (const RationalSegment& s : sides(one))
    for (const RationalSegment& t : sides(other))
      if (run_along(s[0], s[1], t[0], t[1])) return true;
  return false;
}

TEST(Decompose, NeighbouringPiecesHaveDifferentColours) {
  std::vector<Region> regions = shapes();
  regions.push_back(comb(20));
  for (unsigned seed = 0; seed < 40; ++seed) regions.push_back(small_polygon(seed));
  std::size_t pairs = 0;
  for (const Region& region : regions)
    for (const int tau : {0, 1, 50}) {
      const Decomposition made = cut(region, tau);
      const std::vector<std::uint32_t> colours = piece_colours(made);
      ASSERT_EQ(colours.size(), made.pieces.size());
      for (std::size_t i = 0; i < colours.size(); ++i) {
        EXPECT_LT(colours[i], 6u);
        for (std::size_t j = 0; j < i; ++j)
          if (neighbours(made.pieces[i], made.pieces[j])) {
            ++pairs;
            EXPECT_NE(colours[i], colours[j]) << "pieces " << j << " and " << i << ", tau " << tau;
          }
      }
    }
  EXPECT_GT(pairs, 200u);
  EXPECT_TRUE(piece_colours({}).empty());
}

bool are_doubles(const Decomposition& made) {
  const auto plain = [](const Rational& v) { return Rational::of(v.to_double()).value() == v; };
  return std::all_of(made.cuts.begin(), made.cuts.end(), [&](const Cut& c) { return plain(c.to.x) && plain(c.to.y); });
}

TEST(Decompose, TheUnionOfThePiecesIsTheRegion) {
  std::vector<Region> regions{comb(4), plate_with_holes()};
  for (unsigned seed = 0; seed < 60; ++seed) regions.push_back(small_polygon(seed));
  int cuts = 0;
  for (const Region& region : regions) {
    const Decomposition made = cut(region, 0);
    if (!are_doubles(made)) continue;
    cuts += int(made.cuts.size());
    EXPECT_EQ(union_of(rounded(made).value()).value().rounded().value(), region.canonical());
  }
  EXPECT_GT(cuts, 40);
}

/// Cuts as pairs of points, in order.
std::vector<std::string> cut_texts(const std::vector<Cut>& cuts,
                                   const std::function<RationalPoint(RationalPoint)>& map) {
  std::vector<std::string> texts;
  for (const Cut& c : cuts) {
    const RationalPoint from = map(c.from), to = map(c.to);
    texts.push_back(from.x.to_string() + " " + from.y.to_string() + " " + to.x.to_string() + " " + to.y.to_string());
  }
  return texts;
}

TEST(Decompose, MotionsMoveTheCuts) {
  const auto same = [](const RationalPoint& p) { return p; };
  const std::vector<std::function<RationalPoint(RationalPoint)>> motions{
      [](const RationalPoint& p) {
        return RationalPoint{-p.y, p.x};
      },
      [](const RationalPoint& p) {
        return RationalPoint{-p.x, -p.y};
      },
      [](const RationalPoint& p) {
        return RationalPoint{p.y, -p.x};
      },
      [](const RationalPoint& p) {
        return RationalPoint{-p.x, p.y};
      },
      [](const RationalPoint& p) {
        return RationalPoint{p.y, p.x};
      },
      [](const RationalPoint& p) {
        return RationalPoint{p.x + Rational(12345), p.y - Rational(678)};
      }};
  for (const unsigned seed : {1u, 2u, 3u, 7u}) {
    const Region region = random_star(seed, 24);
    for (const int tau : {0, 50, 200}) {
      const std::vector<Cut> cuts = cut(region, tau).cuts;
      for (std::size_t k = 0; k < motions.size(); ++k) {
        Ring ring;
        for (const Point& p : region.parts()[0].outer) {
          const RationalPoint moved = motions[k]({Rational::of(p.x).value(), Rational::of(p.y).value()});
          ring.push_back({moved.x.to_double(), moved.y.to_double()});
        }
        if (k == 3 || k == 4) std::reverse(ring.begin(), ring.end());
        const Region turned = Region::create({{{ring, {}}}, {}, {}}).value();
        EXPECT_EQ(cut_texts(cut(turned, tau).cuts, same), cut_texts(cuts, motions[k])) << seed << " motion " << k;
      }
    }
  }
}

TEST(Decompose, ADentBeforeANeckTakesNothingFromThePocketBehindIt) {
  const Ring dented{{-20, 0},   {20, 0},  {20, 20},    {15, 20}, {1.42, 8.359999}, {1, 8},
                    {1.3, 7.5}, {0, 6.5}, {-1.3, 7.5}, {-1, 8},  {-15, 20},        {-20, 20}};
  Ring plain = dented;
  plain.erase(plain.begin() + 4);
  for (const Ring& ring : {dented, plain}) {
    const std::vector<Cut> cuts = cut(Region::create({{{ring, {}}}, {}, {}}).value(), 3).cuts;
    ASSERT_EQ(cuts.size(), 1u);
    EXPECT_EQ(cuts[0].from.y.to_double(), 6.5);
  }
}

/// What congruent rings have in common: squares of edges and scalar products of neighbours, from the least start on,
/// in the lesser direction.
std::vector<std::string> ring_shape(const RationalRing& ring) {
  std::vector<std::string> least;
  for (const bool back : {false, true}) {
    std::vector<std::string> seen;
    const std::size_t n = ring.size();
    const auto at = [&](std::size_t k) { return ring[back ? n - 1 - k % n : k % n]; };
    for (std::size_t i = 0; i < n; ++i) {
      const RationalPoint a = at(i), b = at(i + 1), c = at(i + 2);
      const Rational dx = b.x - a.x, dy = b.y - a.y, ex = c.x - b.x, ey = c.y - b.y;
      seen.push_back((dx * dx + dy * dy).to_string() + " " + (dx * ex + dy * ey).to_string());
    }
    for (std::size_t i = 0; i < n; ++i) {
      std::rotate(seen.begin(), seen.begin() + 1, seen.end());
      if (least.empty() || seen < least) least = seen;
    }
  }
  return least;
}

std::vector<std::vector<std::vector<std::string>>> piece_shapes(const RegionData& data, const Rational& tau,
                                                                const FeatureOptions& options = {}) {
  std::vector<std::vector<std::vector<std::string>>> shapes;
  for (const Piece& piece : cut(Region::create(data).value(), tau, options).pieces) {
    shapes.push_back({ring_shape(piece.outer)});
    for (const RationalRing& hole : piece.holes) shapes.back().push_back(ring_shape(hole));
    std::sort(shapes.back().begin() + 1, shapes.back().end());
  }
  std::sort(shapes.begin(), shapes.end());
  return shapes;
}

/// Rings begun `start` vertices later; of odd copies parts and holes in the other order; turned by quarter turns,
/// mirrored.
RegionData seen_otherwise(RegionData data, std::size_t start, int quarters, bool mirrored) {
  const auto change = [&](Ring& ring) {
    std::rotate(ring.begin(), ring.begin() + std::ptrdiff_t(start % ring.size()), ring.end());
    for (Point& p : ring) {
      if (mirrored) p.x = -p.x;
      for (int k = 0; k < quarters; ++k) p = {-p.y, p.x};
    }
    if (mirrored) std::reverse(ring.begin(), ring.end());
  };
  for (Part& part : data.parts) {
    change(part.outer);
    for (Ring& hole : part.holes) change(hole);
    if (start % 2 == 1) std::reverse(part.holes.begin(), part.holes.end());
  }
  if (start % 2 == 1) std::reverse(data.parts.begin(), data.parts.end());
  return data;
}

void expect_seen_the_same(const RegionData& data, const Rational& tau, std::size_t starts,
                          const FeatureOptions& options = {}) {
  const auto expected = piece_shapes(data, tau, options);
  for (std::size_t start = 0; start < starts; ++start)
    for (int quarters = 0; quarters < 4; ++quarters)
      for (const bool mirrored : {false, true})
        ASSERT_EQ(piece_shapes(seen_otherwise(data, start, quarters, mirrored), tau, options), expected)
            << "start " << start << ", " << quarters << " quarter turns" << (mirrored ? ", mirrored" : "");
}

TEST(Decompose, PiecesDoNotDependOnWhereRingsBeginOrHowTheyAreTurned) {
  const Ring ring{{0, 0}, {1, 0}, {1, 1}, {3, 1}, {3, 0}, {4, 0}, {4, 2}, {1, 2}, {1, 3}, {4, 3}, {4, 4}, {0, 4}};
  const RegionData issue{{{ring, {}}}, {}, {}};
  for (const char* tau : {"0", "1/2", "1"}) expect_seen_the_same(issue, Rational::parse(tau).value(), ring.size());
  EXPECT_EQ(piece_shapes(issue, Rational::parse("1/2").value()).size(), 3u);
  const Ring plus{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  expect_seen_the_same({{{plus, {}}}, {}, {}}, 0, plus.size());
  expect_seen_the_same(comb(3).data(), 0, 5);
  expect_seen_the_same(plate_with_holes().data(), 0, 4);
  expect_seen_the_same({{{{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                          {{{1, 1}, {1, 3}, {3, 3}, {3, 1}},
                           {{5, 1}, {5, 3}, {7, 3}, {7, 1}},
                           {{1, 5}, {1, 7}, {3, 7}, {3, 5}},
                           {{5, 5}, {5, 7}, {7, 7}, {7, 5}}}}},
                        {},
                        {}},
                       0, 4);
}

TEST(Decompose, PiecesOfAnyDoublesDoNotDependOnWhereRingsBegin) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Ring ring = small_polygon(seed).parts()[0].outer;
    Ring turned, decimal, single, noisy;
    std::mt19937 random(seed);
    for (const Point& p : ring) {
      turned.push_back({p.x * std::cos(0.3) - p.y * std::sin(0.3), p.x * std::sin(0.3) + p.y * std::cos(0.3)});
      decimal.push_back({p.x * 0.1, p.y * 0.1});
      single.push_back({double(float(p.x * 0.1)), double(float(p.y * 0.1))});
      noisy.push_back({p.x + 1e-9 * double(random() % 1000), p.y + 1e-9 * double(random() % 1000)});
    }
    for (const Ring& copy : {ring, turned, decimal, single, noisy}) expect_seen_the_same({{{copy, {}}}, {}, {}}, 0, 3);
  }
}

/// Cells of a small grid, put together until nothing more fits: corridors with many corners, equally deep by many ways.
Region random_cells(unsigned seed, int size) {
  std::mt19937 random(seed);
  for (;;) {
    std::vector<Region> cells;
    std::vector<bool> taken(std::size_t(size * size), false);
    for (int k = 0; k < size * size * 3 / 5; ++k) {
      const int x = int(random() % unsigned(size)), y = int(random() % unsigned(size));
      if (taken[std::size_t(y * size + x)]) continue;
      taken[std::size_t(y * size + x)] = true;
      RegionData cell;
      cell.parts.push_back({{{x + 0.0, y + 0.0}, {x + 1.0, y + 0.0}, {x + 1.0, y + 1.0}, {x + 0.0, y + 1.0}}, {}});
      cells.push_back(Region::create(cell).value());
    }
    Region all = union_of(cells).value().rounded().value();
    if (!all.touching_points().empty()) continue;
    std::size_t most = 0;
    for (std::size_t i = 0; i < all.parts().size(); ++i)
      if (all.parts()[i].outer.size() > all.parts()[most].outer.size()) most = i;
    return Region::create({{all.parts()[most]}, {}, {}}).value();
  }
}

std::vector<FeatureOptions> other_depths() {
  std::vector<FeatureOptions> all;
  for (const Concavity concavity : {Concavity::shortest_path, Concavity::hybrid1, Concavity::hybrid2}) {
    all.emplace_back();
    all.back().concavity = concavity;
    all.back().hybrid_tolerance = 2;
  }
  return all;
}

TEST(Decompose, PiecesByShortestPathsDoNotDependOnHowTheRegionIsTurned) {
  for (const FeatureOptions& options : other_depths()) {
    SCOPED_TRACE("concavity " + std::to_string(int(options.concavity)));
    for (unsigned seed = 0; seed < 10; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const RegionData cells = random_cells(seed, 5 + int(seed % 4)).data();
      for (const char* tau : {"0", "1/2", "1"}) expect_seen_the_same(cells, Rational::parse(tau).value(), 2, options);
      RegionData noisy = cells;
      std::mt19937 random(seed);
      for (Part& part : noisy.parts)
        for (Point& p : part.outer) p = {0.1 * p.x + 1e-3 * double(random() % 2), 0.1 * p.y};
      if (Region::create(noisy)) expect_seen_the_same(noisy, 0, 2, options);
      expect_seen_the_same(random_star(seed, 24).data(), 50, 2, options);
    }
  }
}

TEST(Decompose, SliversThatRoundAwayAreToldOrRepaired) {
  // Doubles are 1 apart at 2^52, 1/2 below: ends of cuts have no room.
  int decided = 0, emptied = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    std::mt19937 random(seed);
    Ring ring;
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * M_PI * i / 40, r = 20 + double(random() % 20);
      ring.push_back({0x1p52 + std::round(r * std::cos(angle)), 0x1p52 + std::round(r * std::sin(angle))});
    }
    const Result<Region> region = Region::create({{{ring, {}}}, {}, {}});
    if (!region || !region->touching_points().empty()) continue;
    const Decomposition made = cut(*region, 0);
    const auto plain = rounded(made);
    const std::vector<Repaired> repaired = rounded_with_repair(made).value();
    ASSERT_EQ(repaired.size(), made.pieces.size());
    std::optional<std::int64_t> first;
    for (std::size_t i = 0; i < repaired.size(); ++i) {
      if (repaired[i].report.changed() && !first) first = std::int64_t(i);
      emptied += repaired[i].region.empty() ? 1 : 0;
      EXPECT_TRUE(!plain || repaired[i].region == (*plain)[i]);
    }
    if (plain) continue;
    ++decided;
    EXPECT_EQ(plain.error().code, ErrorCode::rounding_changed_topology);
    EXPECT_EQ(plain.error().evidence.part, first);
  }
  EXPECT_GT(decided, 2);
  EXPECT_GT(emptied, 0);
}

TEST(Decompose, ProgressStopsIt) {
  const ShapeFeatures features = ShapeFeatures::create(random_star(5, 200)).value();
  std::vector<std::string> stages;
  const auto watch = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return true;
  };
  const Decomposition made = decompose(features, {0, 0, std::nullopt, watch}).value();
  EXPECT_EQ(stages, (std::vector<std::string>{"significance", "cuts", "pieces"}));
  for (const std::string& last : stages) {
    const auto stop = [&](std::string_view stage, double) { return stage != last; };
    EXPECT_EQ(decompose(features, {0, 0, std::nullopt, stop}).error().code, ErrorCode::cancelled);
  }
  EXPECT_EQ(made.pieces.size(), decompose(features).value().pieces.size());
}

TEST(Decompose, WhatCannotBeCutIsTold) {
  const ShapeFeatures line =
      ShapeFeatures::create(Region::create({{}, {{{0, 0}, {1, 0}, {1, 1}}}, {}}).value()).value();
  EXPECT_EQ(decompose(line).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(decompose(line).error().evidence.x, 0);
  EXPECT_EQ(decompose(line).error().message,
            "decompose takes polygons whose rings do not touch, no polylines and points");
  const ShapeFeatures features = ShapeFeatures::create(comb(2)).value();
  EXPECT_EQ(decompose(features, {-1, 0, std::nullopt, {}}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(decompose(features, {0, 2, Rational(1), {}}).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace dymsum
