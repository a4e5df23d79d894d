// A rod turns beside a box: the sum follows, and the depth of their overlap.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Mesh rod = solids::rod(18, 9, 0.5, 3, solids::kDemoSnap), box = solids::box(-1, -1, -1, 1, 1, 1);
  ConvexSum difference = ConvexSum::create(rod, negated(box)).value();  // holds the translations at which they overlap
  const Rotation step = Rotation::about({1, 2, 3}, 0.05).value();
  for (int k = 0; k < 3; ++k) {
    const MotionWork work = difference.set(step * difference.p_pose().rotation);
    const ConvexDepth depth = difference.depth({0.75, 0, 0});  // the box moved to x = 0.75
    std::cout << difference.sum().faces.size() << " facets, " << work.facets_added << " new; depth " << depth.depth
              << "\n";
  }
}
