// A foreign project's program: the sum of two squares of side 1 and 3 has area 16.
#include <cstdio>

#include <dymsum/dymsum.h>

int main() {
  static_assert(DYMSUM_VERSION_NUMBER >= 100, "0.1.0 or later");
  const auto unit = dymsum::shapes::rectangle(0, 0, 1, 1);
  const auto large = dymsum::shapes::rectangle(0, 0, 3, 3);
  const auto sum = dymsum::minkowski_sum(unit, large);
  if (!sum) return 1;
  std::printf("%.17g\n", sum->area());
  return 0;
}
