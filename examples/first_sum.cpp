#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Region slot = shapes::letter_u(4, 4, 1);     // a slot of width 2 ...
  const Region peg = shapes::rectangle(0, 0, 2, 1);  // ... and a peg of exactly that width
  const PlanarSum sum = nfp(slot, peg).value();      // where the peg's corner makes it hit the slot
  std::cout << "area " << sum.area_exact().to_string() << ", " << sum.hole_count() << " holes\n";
  for (const SumSegment& passage : sum.tight_segments) {
    const Point from = passage.from.at, to = passage.to.at;
    std::cout << "the peg fits, and slides from (" << from.x << ", " << from.y << ") to (" << to.x << ", " << to.y
              << ")\n";
  }
}
