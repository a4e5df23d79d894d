// A channel and a bar exactly as wide: the bar fits, and the positions at which it does are a tight face.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Mesh channel = solids::prism(shapes::letter_u(4, 4, 1).parts().front().outer, 5);  // its groove is 2 wide
  const Mesh bar = solids::box(0, 0, 0, 2, 1, 1);
  const SpatialSum sum = minkowski_sum(channel, negated(bar)).value();  // where the bar hits the channel
  std::cout << sum.faces.size() << " faces, " << sum.shells << " shell, volume " << sum.volume_exact().to_string()
            << "\n";
  for (const auto& face : sum.tight_faces) {
    std::cout << "the bar fits at";
    for (const std::uint32_t vertex : face.front()) {
      const Point3& at = sum.vertices[vertex];
      std::cout << " (" << at.x << ", " << at.y << ", " << at.z << ")";
    }
    std::cout << "\n";
  }
}
