// Sums of a bracket and a box at poses that do not lie near each other: prepared once, on all cores, in any order.
#include <dymsum/dymsum.h>

#include <algorithm>
#include <iostream>
#include <vector>

int main() {
  using namespace dymsum;
  const Mesh bracket = solids::prism(shapes::letter_l(3, 2, 1).parts()[0].outer, 1),
             box = solids::box(0, 0, 0, 1, 1, 2);
  std::vector<SolidPose> poses;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) poses.push_back({Rotation::of(3, x, y, z).value(), {}});

  MovingSolidOptions options;
  options.threads = 0;  // as many as there are cores
  std::vector<double> volumes(poses.size());
  const auto visit = [&](std::size_t k, const SpatialSum& sum) { volumes[k] = sum.volume(); };  // one call at a time
  if (const auto work = posed_sums(bracket, box, poses, {}, visit, options); !work) {
    std::cerr << work.error().to_string() << "\n";
    return 2;
  }
  const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
  std::cout << poses.size() << " poses, volumes from " << *least << " to " << *most << "\n";
}
