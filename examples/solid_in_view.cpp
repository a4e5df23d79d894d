// A rod turns beside a box, and a renderer's buffers follow their sum: what has to be uploaded every frame.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  ConvexSum sum = ConvexSum::create(solids::rod(18, 9, 0.5, 3, solids::kDemoSnap), solids::box(-1, -1, -1, 1, 1, 1))
                      .value();  // P turns, Q stays
  const Rotation step = Rotation::about({1, 2, 3}, 0.05).value();
  SolidBuffers buffers;  // positions and triangles, to be drawn as they are
  for (int k = 0; k < 4; ++k) {
    const ConvexSolid& solid = sum.solid();
    solid.write(buffers);
    std::size_t triangles = 0;
    for (const IndexRange& range : buffers.triangles_changed) triangles += range.count;
    std::size_t reshaped = 0, fresh = 0;
    for (const FacetChange& change : solid.changes.facets)
      (change.kind == FacetChange::Kind::reshaped ? reshaped : fresh) += 1;
    std::cout << solid.facet_count << " facets, " << reshaped << " reshaped, " << fresh << " come or gone; upload "
              << triangles << " of " << buffers.triangles.size() / 3 << " triangles\n";
    sum.set(step * sum.p_pose().rotation);
  }
}
