// A rod in front of a comb has to turn before it fits between two teeth; no path leads into a grate.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Region rod = shapes::rectangle(-1.5, -0.25, 1.5, 0.25);
  const Configuration start{-3, 10, 0}, goal{1.5, 3, 1.5};  // x, y and theta: lying above, standing in the gap
  for (const Region& obstacle : {shapes::comb(3, 2, 1, 6), shapes::grate(3, 2, 1, 6)}) {
    const CspaceObstacle forbidden = CspaceObstacle::create(rod, obstacle).value();
    const Plan answer = plan(forbidden, start, goal).value();
    if (!answer.found()) std::cout << answer.reason->text << "\n";
    for (const Waypoint& point : answer.path) {
      static const char* const kMoves[] = {"start at ", "move to ", "turn left to ", "turn right to "};
      std::cout << kMoves[static_cast<int>(point.move)] << "(" << point.approx.x << ", " << point.approx.y << ", "
                << point.approx.theta << ")\n";
    }
  }
}
