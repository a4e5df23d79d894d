// Rings and tight features by winding numbers.
#include "planar/boundary/winding_boundary.h"

#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/convolution/convolution.h"
#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

TEST(WindingBoundary, of_a_frame_and_the_square_that_fits_into_it) {
  const Region frame =
      Region::create({{{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}}}, {}, {}}).value();
  const PlacedPair o = placed_pair(frame, shapes::rectangle(0, 0, 1, 1));
  Tracing tracing(*o.lattice, *o.p, *o.q);
  for (const KineticSegment& s : kinetic_convolution(*o.lattice, *o.p, *o.q)) tracing.add(s.walk, s.sign);
  const Progress never;
  const SegmentGraph graph(tracing.soup, all_meetings(tracing.soup, nullptr, Poll(never)));
  const std::vector<Sides> sides = find_windings(tracing, graph);
  const GraphRings boundary = winding_rings(tracing, graph, sides);
  const std::vector<BoundaryEdges> rings = boundary.rings();
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_TRUE(boundary.counter_clockwise(rings[0]));
  double error = 0;
  EXPECT_EQ(boundary.ring(rings[0], error).vertices.size(), 4u) << "collinear edges are merged";
  EXPECT_EQ(error, 0);
  Collision collision(*o.lattice, *o.p, *o.q, false);
  RawBoundary found;
  find_tight_features(tracing, graph, sides, collision, found, error);
  EXPECT_TRUE(found.cracks.empty());
  ASSERT_EQ(found.punctures.size(), 1u);
  EXPECT_EQ(found.punctures[0].at, (Point{2, 2}));
}

}  // namespace
}  // namespace dymsum::planar
