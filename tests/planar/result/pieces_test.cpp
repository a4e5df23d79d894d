#include "planar/result/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace dymsum::planar {
namespace {

using Q = exact::BigRational;
using Rings = std::vector<std::vector<Position>>;
using Candidates = std::vector<PieceCandidate>;

constexpr std::uint32_t kNone = PieceEnd::kNone;

bool same(const Position& a, const Position& b) { return compare(a, b) == 0; }

/// "[x,y x,y](x,y)", so that a failing comparison can be read.
std::string text(const Position& p) { return p.x.str() + "," + p.y.str(); }
std::string text(const Pieces& pieces) {
  std::string s;
  for (const PieceSegment& piece : pieces.segments) s += "[" + text(piece.from.at) + " " + text(piece.to.at) + "]";
  for (const PiecePoint& point : pieces.points) s += "(" + text(point.at) + ")";
  return s;
}

std::vector<Position> rectangle(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
std::vector<Position> hole(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}}; }

Pieces run(const Rings& rings, const Candidates& segments, const std::vector<Position>& points = {}) {
  return lower_dimensional_pieces(rings, segments, points);
}

TEST(Pieces, NothingGivesNothing) {
  EXPECT_EQ(text(run({}, {})), "");
  EXPECT_EQ(text(run({rectangle(0, 0, 2, 2)}, {})), "");
}

TEST(Pieces, ASegmentThroughAPartLeavesItsTwoEnds) {
  const Pieces pieces = run({rectangle(0, 0, 2, 2)}, {{{3, 1}, {-1, Q(1, 2)}}});
  ASSERT_EQ(text(pieces), "[-1,1/2 0,5/8][2,7/8 3,1]");
  EXPECT_EQ(pieces.segments[0].from.cut_ring, kNone);
  EXPECT_EQ(pieces.segments[0].to.cut_ring, 0u);
  EXPECT_EQ(pieces.segments[0].to.cut_edge, 3u);
  EXPECT_EQ(pieces.segments[1].from.cut_edge, 1u);
  EXPECT_EQ(pieces.segments[1].to.cut_edge, kNone);
}

TEST(Pieces, SegmentsInAPartOrOnItsBoundaryVanish) {
  const Candidates covered{{{1, 1}, {2, 2}}, {{0, 0}, {3, 3}}, {{0, 1}, {0, 2}}, {{0, 0}, {3, 0}}};
  EXPECT_EQ(text(run({rectangle(0, 0, 3, 3)}, covered)), "");
  const Pieces pieces = run({rectangle(0, 0, 3, 3)}, {{{-1, 0}, {4, 0}}});
  ASSERT_EQ(text(pieces), "[-1,0 0,0][3,0 4,0]");
  EXPECT_EQ(pieces.segments[0].to.cut_edge, 3u) << "edge 0 runs along the candidate";
  EXPECT_EQ(pieces.segments[1].from.cut_edge, 1u);
}

TEST(Pieces, AnAntennaStartsWhereThePartEnds) {
  const Pieces pieces = run({rectangle(0, 0, 2, 2)}, {{{2, 1}, {5, 1}}});
  ASSERT_EQ(text(pieces), "[2,1 5,1]");
  EXPECT_EQ(pieces.segments[0].from.cut_ring, kNone) << "an end of the candidate, not a cut";
}

TEST(Pieces, TouchingACornerDoesNotSplitASegment) {
  EXPECT_EQ(text(run({rectangle(0, 0, 2, 2)}, {{{-1, 1}, {1, 3}}})), "[-1,1 1,3]");
}

TEST(Pieces, ASegmentAcrossAHoleIsInTheHole) {
  const Pieces pieces = run({rectangle(0, 0, 6, 6), hole(2, 2, 4, 4)}, {{{1, 3}, {5, 3}}});
  ASSERT_EQ(text(pieces), "[2,3 4,3]");
  EXPECT_EQ(pieces.segments[0].from.cut_ring, 1u);
  EXPECT_EQ(pieces.segments[0].from.cut_edge, 0u);
  EXPECT_EQ(pieces.segments[0].to.cut_edge, 2u);
}

TEST(Pieces, CollinearCandidatesAreMergedAndTheSmallestNumberSupports) {
  const Pieces pieces = run({}, {{{5, 0}, {3, 0}},
                                 {{0, 0}, {1, 0}},
                                 {{1, 0}, {4, 0}},
                                 {{0, 0}, {2, 0}},
                                 {{7, 0}, {6, 0}},
                                 {{0, 1}, {7, 1}},
                                 {{0, 0}, {0, 3}},
                                 {{0, 3}, {0, 4}}});
  ASSERT_EQ(text(pieces), "[0,0 0,4][0,0 5,0][0,1 7,1][6,0 7,0]");
  const PieceSegment& merged = pieces.segments[1];
  EXPECT_EQ(merged.candidate, 0u);
  EXPECT_EQ(merged.from.candidate, 1u);
  EXPECT_EQ(merged.to.candidate, 0u);
  EXPECT_EQ(pieces.segments[0].from.candidate, 6u);
  EXPECT_EQ(pieces.segments[0].to.candidate, 7u);
  EXPECT_EQ(pieces.segments[3].candidate, 4u);
}

TEST(Pieces, ACandidateThatOnlyTouchesAPieceDoesNotSupportIt) {
  // number 0 ends inside the part, where the piece has not begun
  const Pieces pieces = run({rectangle(0, 0, 2, 2)}, {{{0, 1}, {2, 1}}, {{1, 1}, {4, 1}}});
  ASSERT_EQ(text(pieces), "[2,1 4,1]");
  EXPECT_EQ(pieces.segments[0].candidate, 1u);
  EXPECT_EQ(pieces.segments[0].from.candidate, 1u);
}

TEST(Pieces, PointsInPartsOrOnSegmentsAreNotIsolated) {
  const std::vector<Position> points{{9, 9}, {1, 1}, {2, 1},       {2, 2},      {5, 1},
                                     {4, 1}, {9, 9}, {8, Q(1, 3)}, {3, Q(1, 3)}};
  const Pieces pieces = run({rectangle(0, 0, 2, 2)}, {{{2, 1}, {5, 1}}}, points);
  ASSERT_EQ(text(pieces), "[2,1 5,1](3,1/3)(8,1/3)(9,9)");
  EXPECT_EQ(pieces.points[0].candidate, 8u);
  EXPECT_EQ(pieces.points[2].candidate, 0u);
}

TEST(Pieces, APointInTheHoleStays) {
  EXPECT_EQ(text(run({rectangle(0, 0, 6, 6), hole(2, 2, 4, 4)}, {}, {{3, 3}, {4, 3}, {5, 3}})), "(3,3)");
}

TEST(Pieces, NearMissesAreToldApart) {
  const Q hair = Q(1, exact::BigInteger(1) << 300);
  EXPECT_EQ(text(run({rectangle(0, 0, 2, 2)}, {{{0, 2 - hair}, {2, 2 - hair}}})), "");
  EXPECT_EQ(run({rectangle(0, 0, 2, 2)}, {{{0, 2 + hair}, {2, 2 + hair}}}).segments.size(), 1u);
  EXPECT_EQ(run({}, {{{0, 0}, {1, 0}}, {{1 + hair, 0}, {2, 0}}}).segments.size(), 2u);
}

TEST(Pieces, ACandidateWithoutLengthIsABrokenContract) {
  EXPECT_THROW(run({}, {{{1, 1}, {1, 1}}}), std::invalid_argument);
}

// The definition, at random points: of a candidate, outside the parts -> on a piece; of a piece -> on a candidate, and
// in the parts at most where it touches them.
struct Scene {
  Rings rings;
  Candidates segments;
  std::vector<Position> points;
};

Scene random_scene(std::mt19937_64& random) {
  const auto index = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit + 1)); };
  Scene scene;
  // parts in separate columns, some with a hole, corners cut so that edges slant
  for (int column = 0; column < 2; ++column) {
    const int x = 5 * column, y = index(2);
    scene.rings.push_back({{x, y}, {x + 4, y + index(1)}, {x + 4, y + 5}, {x + index(1), y + 5}});
    if (index(1) == 1) scene.rings.push_back({{x + 2, y + 2}, {x + 2, y + 4}, {x + 3, y + 3}});
  }
  while (scene.segments.size() < 12) {
    const Position a{index(10), index(8)}, b{index(10), index(8)};
    if (!same(a, b)) scene.segments.push_back({a, b});
  }
  for (int i = 0; i < 10; ++i) scene.points.push_back({Q(index(20), 2), Q(index(16), 2)});
  return scene;
}

void check_scene(const Scene& scene, std::mt19937_64& random) {
  std::vector<std::vector<Spot>> rings;
  for (const auto& ring : scene.rings) {
    rings.emplace_back();
    for (const Position& p : ring) rings.back().push_back(make_spot(p));
  }
  const Pieces pieces = run(scene.rings, scene.segments, scene.points);
  const auto on = [](const Position& a, const Position& b, const Spot& q) {
    return on_segment(make_spot(a), make_spot(b), q);
  };
  const auto on_piece = [&](const Spot& q) {
    return std::any_of(pieces.segments.begin(), pieces.segments.end(),
                       [&](const PieceSegment& s) { return on(s.from.at, s.to.at, q); });
  };
  const auto at = [&](const Position& a, const Position& b, int k) {
    const Q t(k, 840 + static_cast<int>(random() % 7));
    return make_spot(Position{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  };
  for (const PieceCandidate& c : scene.segments)
    for (int k = 0; k <= 840; k += 42) {
      const Spot q = at(c.a, c.b, k);
      ASSERT_TRUE(locate(rings, q) != Location::outside || on_piece(q)) << text(q.exact);
    }
  for (const PieceSegment& s : pieces.segments) {
    ASSERT_LT(compare(s.from.at, s.to.at), 0);
    int covered = 0;
    for (int k = 21; k < 840; k += 42) {
      const Spot q = at(s.from.at, s.to.at, k);
      covered += locate(rings, q) != Location::outside;
      ASSERT_TRUE(std::any_of(scene.segments.begin(), scene.segments.end(),
                              [&](const PieceCandidate& c) { return on(c.a, c.b, q); }));
    }
    ASSERT_LE(covered, 6) << "touches at corners only";
    const PieceCandidate& from = scene.segments[s.from.candidate];
    const PieceCandidate& to = scene.segments[s.to.candidate];
    ASSERT_TRUE(on(from.a, from.b, make_spot(s.from.at)));
    ASSERT_TRUE(on(to.a, to.b, make_spot(s.to.at)));
    if (s.from.cut_ring != kNone) {
      const auto& ring = scene.rings[s.from.cut_ring];
      ASSERT_TRUE(on(ring[s.from.cut_edge], ring[(s.from.cut_edge + 1) % ring.size()], make_spot(s.from.at)));
    }
    for (const PieceSegment& other : pieces.segments) {  // maximal: what continues on the same line does not touch
      if (&other == &s || orientation(make_spot(s.from.at), make_spot(s.to.at), make_spot(other.from.at)) != 0 ||
          orientation(make_spot(s.from.at), make_spot(s.to.at), make_spot(other.to.at)) != 0)
        continue;
      ASSERT_TRUE(compare(s.to.at, other.from.at) < 0 || compare(other.to.at, s.from.at) < 0) << text(pieces);
    }
  }
  for (const Position& p : scene.points) {
    const Spot q = make_spot(p);
    const bool listed = std::any_of(pieces.points.begin(), pieces.points.end(),
                                    [&](const PiecePoint& point) { return same(point.at, p); });
    ASSERT_EQ(listed, locate(rings, q) == Location::outside && !on_piece(q)) << text(p);
  }
}

TEST(Pieces, RandomScenesKeepTheDefinition) {
  constexpr unsigned kSeed = 4711;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  for (int round = 0; round < 40 && !testing::Test::HasFatalFailure(); ++round) {
    SCOPED_TRACE(round);
    check_scene(random_scene(random), random);
  }
}

}  // namespace
}  // namespace dymsum::planar
