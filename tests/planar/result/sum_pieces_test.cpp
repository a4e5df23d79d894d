// Pieces of sums of points and polylines, with the contacts that carry them.
#include "planar/result/pieces.h"

#include <gtest/gtest.h>

#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

Region thin(std::vector<Polyline> lines, std::vector<Point> points) {
  return Region::create({{}, std::move(lines), std::move(points)}).value();
}

TEST(SumPieces, a_point_moves_points_and_polylines) {
  const PlacedPair o = placed_pair(thin({{{0, 0}, {4, 0}}}, {{9, 9}}), thin({}, {{1, 1}}));
  const PieceCandidates found = lower_dimensional_candidates(*o.lattice, *o.p, *o.q);
  EXPECT_EQ(found.segments.size(), 2u) << "there and back";
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points[0].at, (Point{10, 10}));
  const SumSource source(o.lattice, o.p, o.q);
  std::vector<SumSegment> segments;
  std::vector<SumVertex> points;
  merge_pieces(source, {}, found, segments, points);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].from.at, (Point{1, 1}));
  EXPECT_EQ(segments[0].to.at, (Point{5, 1}));
  EXPECT_EQ(points.size(), 1u);
}

TEST(SumPieces, parallel_edges_are_added_end_to_end) {
  const PlacedPair o = placed_pair(thin({{{0, 0}, {4, 2}}}, {}), thin({{{0, 0}, {2, 1}}}, {}));
  const PieceCandidates found = lower_dimensional_candidates(*o.lattice, *o.p, *o.q);
  const SumSource source(o.lattice, o.p, o.q);
  std::vector<SumSegment> segments;
  std::vector<SumVertex> points;
  merge_pieces(source, {}, found, segments, points);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].to.at, (Point{6, 3}));
  EXPECT_TRUE(points.empty());
}

}  // namespace
}  // namespace dymsum::planar
