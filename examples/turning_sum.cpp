// A rod turns among the bars of a grate: the sum follows the orientation, exactly, and says which rings are new.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Region rod = shapes::rectangle(-1.5, -0.25, 1.5, 0.25), grate = shapes::grate(4, 2, 1, 6);
  RotatingSum sum = RotatingSum::create(rod, grate).value();  // R(theta) rod (+) grate, at theta = 0
  for (const double radians : {1.35, 1.4, 1.45, 1.5}) {
    const Orientation theta = Orientation::nearest(radians, 1e-3).value();  // a simple one so near
    const FrameChanges changes = sum.set(theta).value();
    std::cout << "tan(theta / 2) = " << theta.tan_half().to_string() << ": area " << sum.sum().area_exact().to_string()
              << ", " << sum.sum().hole_count() << " holes; rings";
    for (const RingChange& ring : changes.rings) {
      static const char* const kChanges[] = {"appeared", "disappeared", "reshaped", "moved"};
      std::cout << " " << ring.ring << " " << kChanges[static_cast<int>(ring.kind)];
    }
    std::cout << "\n";
  }
}
