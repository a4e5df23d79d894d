// A force loop that runs faster than geometry: every fourth step a local sum of the turning solids, in between depths
// and directions from the patch of the boundary that it left.
#include <cstdio>

#include "dymsum/continuous_depth.h"
#include "dymsum/solids.h"

int main() {
  using namespace dymsum;
  const Mesh table = solids::box(-2, -2, -1, 2, 2, 0), tool = solids::cone(24, 1, 2, solids::kDemoSnap);

  ContinuousDepthOptions options;
  options.smoothing_length = 1;
  Result<ContinuousDepth> made = ContinuousDepth::create(table, tool, options);
  if (!made) {
    std::printf("%s\n", made.error().to_string().c_str());
    return 1;
  }
  ContinuousDepth pair = *std::move(made);

  std::optional<DepthPatch> patch;
  for (int step = 0; step < 12; ++step) {
    // Over the table's edge.
    const Point3 position{2.45 + 0.05 * step, 0, -0.2};
    if (step % 4 == 0) {  // on one thread, every few milliseconds
      const Rotation turned = Rotation::about({0, 1, 0}, 0.01 * step).value();
      if (const Result<ContinuousContact> contact = pair.query(position, turned); !contact) return 1;
      patch = pair.patch();
    }
    const ContinuousContact now = patch->at(position);  // on another one, every millisecond
    std::printf("%5.2f: depth %.3f, shortest %.3f, direction (%.2f, %.2f, %.2f)%s\n", position.x, now.depth,
                now.euclidean_depth, now.normal.x, now.normal.y, now.normal.z,
                now.discontinuity == Discontinuity::fold ? ", jumped" : "");
  }
}
