#include "planar/crossing_grates.h"

namespace dymsum::bench {
namespace {

Region made(Ring outer) {
  RegionData data;
  data.parts.push_back({std::move(outer), {}});
  return Region::create(std::move(data)).value();
}

/// Pitch 1 between the bars of the sum, each twice as wide as the bars of the operands.
constexpr double kBar = 0.125;

}  // namespace

std::pair<Region, Region> crossing_grates(int n) {
  const double tall = n * n + 4;    // length of the bars; the grates of the sum are n^2 wide
  const double far = 2 * tall + 4;  // distance between upright and lying bars
  const double first_p = far + tall, pitch_p = n, first_q = 1;
  const double end = first_p + (n - 1) * pitch_p + kBar + 1;

  // P: an L with its corner at the origin, bars on the far ends of its arms.
  Ring p{{-1, -1}, {end, -1}, {end, 0}};
  for (int i = n - 1; i >= 0; --i) {
    const double left = first_p + i * pitch_p, right = left + kBar;
    p.insert(p.end(), {{right, 0}, {right, tall}, {left, tall}, {left, 0}});
  }
  p.push_back({0, 0});
  for (int i = 0; i < n; ++i) {
    const double low = first_p + i * pitch_p, high = low + kBar;
    p.insert(p.end(), {{0, low}, {tall, low}, {tall, high}, {0, high}});
  }
  p.insert(p.end(), {{0, end}, {-1, end}});

  // Q: an L turned round with its corner at (far, far), bars on the outside of its arms.
  Ring q{{0, far - 1}, {far - 1, far - 1}, {far - 1, 0}, {far, 0}};
  for (int i = 0; i < n; ++i) {
    const double low = first_q + i, high = low + kBar;
    q.insert(q.end(), {{far, low}, {far + tall, low}, {far + tall, high}, {far, high}});
  }
  q.push_back({far, far});
  for (int i = n - 1; i >= 0; --i) {
    const double left = first_q + i, right = left + kBar;
    q.insert(q.end(), {{right, far}, {right, far + tall}, {left, far + tall}, {left, far}});
  }
  q.push_back({0, far});
  return {made(std::move(p)), made(std::move(q))};
}

}  // namespace dymsum::bench
