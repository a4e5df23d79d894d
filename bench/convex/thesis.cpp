#include "convex/thesis.h"

#include <array>

namespace dymsum::bench {
namespace {

struct Value {
  std::string_view p, q;
  double speed_up;
};

constexpr std::array kRotation{
    Value{"cone", "HP", 8},       Value{"ellipse", "ellipse", 176}, Value{"GS3", "GS3", 86.26},
    Value{"GS3", "GS4", 100.15},  Value{"GS4", "GS4", 121.26},      Value{"GS3", "HP", 11.58},
    Value{"GS4", "HP", 11.51},    Value{"HP", "HP", 9.00},          Value{"GS3", "T", 29.21},
    Value{"GS4", "T", 31.83},     Value{"HP", "T", 10.28},          Value{"T", "T", 16.17},
    Value{"GS3", "TI", 69.25},    Value{"GS4", "TI", 78.26},        Value{"HP", "TI", 12.78},
    Value{"T", "TI", 28.08},      Value{"TI", "TI", 63.45},         Value{"GS3", "v-rod", 77.73},
    Value{"GS4", "v-rod", 83.05}, Value{"HP", "v-rod", 15.76},      Value{"T", "v-rod", 34.23},
    Value{"TI", "v-rod", 67.24},  Value{"v-rod", "v-rod", 123.75}};

constexpr std::array<std::string_view, 5> kScaled{"ellipse", "GS3", "GS4", "TI", "v-rod"};
constexpr double kScaling[5][5] = {{17.231, 16.653, 32.312, 14.636, 19.060},
                                   {44.475, 18.311, 17.584, 17.423, 29.902},
                                   {13.109, 17.273, 13.050, 18.026, 34.342},
                                   {18.685, 20.332, 19.669, 24.952, 37.960},
                                   {24.471, 40.246, 40.691, 44.757, 97.410}};

}  // namespace

double thesis_rotation(std::string_view p, std::string_view q) {
  for (const Value& v : kRotation)
    if ((v.p == p && v.q == q) || (v.p == q && v.q == p)) return v.speed_up;
  return 0;
}

double thesis_scaling(std::string_view p, std::string_view q) {
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      if (kScaled[i] == p && kScaled[j] == q) return kScaling[i][j];
  return 0;
}

}  // namespace dymsum::bench
