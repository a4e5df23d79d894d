// A rod among posts: one exact obstacle for all its positions and angles, and one exact slice of it.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Region rod = shapes::rectangle(-1.5, -0.25, 1.5, 0.25), posts = shapes::grate(4, 2, 1, 6);
  const CspaceObstacle obstacle = CspaceObstacle::create(rod, posts).value();
  std::cout << obstacle.patches().size() << " patches, " << obstacle.shells().size() << " shells, "
            << obstacle.angles().size() << " event angles\n";
  const PlanarSum upright = obstacle.slice(Orientation::of(1, 1).value()).value();  // a quarter turn
  std::cout << "upright: " << upright.hole_count() << " holes, area " << upright.area_exact().to_string() << "\n";
  const ObstacleMesh mesh = obstacle_mesh(obstacle).value();
  std::cout << (closure(mesh).watertight() ? "closed" : "open") << ", volume " << enclosed_volume(mesh) << "\n";
}
