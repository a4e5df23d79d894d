// Coordinates on a grid, and what only rounding keeps off one.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/double_text.h"
#include "dymsum/snapping.h"

namespace dymsum {
namespace {

// 2^970 is the ulp of the largest double: all that are larger than 2^53 times the grid are on it.
constexpr int kLeastTwo = -1074, kMostTwo = 970;
constexpr int kLeastTen = -100;  // 10^-100: the texts of coordinates have no more digits than that after the point

bool is_known(const CoordinateGrid& grid) {
  return (grid.base == 2 && grid.exponent >= kLeastTwo && grid.exponent <= kMostTwo) ||
         (grid.base == 10 && grid.exponent >= kLeastTen && grid.exponent <= 0);
}

/// The nearest multiple of 2^k. What does not change its double is a multiple already: it is 2^53 times as large.
double nearest_of_two(double x, int k) {
  const double scaled = std::ldexp(x, -k);
  return std::isfinite(scaled) ? std::ldexp(std::nearbyint(scaled), k) : x;
}

/// The nearest double of the nearest decimal with so many digits after the point: both roundings are those of correctly
/// rounded conversions to text and back.
double nearest_decimal(double x, int digits) {
  std::array<char, 512> text{};  // 309 digits, 100 after the point, a sign and the point
  const char* const end = base::fixed_text(text.data(), text.data() + text.size(), x, digits);
  double value = x;
  base::read_double(text.data(), end, value);
  return value;
}

double snapped_coordinate(double x, const CoordinateGrid& grid) {
  return (grid.base == 2 ? nearest_of_two(x, grid.exponent) : nearest_decimal(x, -grid.exponent)) + 0.0;
}

template <class F>
void for_each_coordinate(RegionData& data, F f) {
  const auto all = [&](std::vector<Point>& points) {
    for (Point& p : points) f(p.x), f(p.y);
  };
  for (Part& part : data.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  for (Polyline& line : data.polylines) all(line);
  all(data.points);
}
template <class F>
void for_each_coordinate(MeshData& data, F f) {
  for (Point3& p : data.vertices) f(p.x), f(p.y), f(p.z);
}

template <class Data>
Result<Snapped<Data>> snapped_data(Data data, const CoordinateGrid& grid) {
  if (!is_known(grid))
    return Error{
        ErrorCode::out_of_range, "a grid is 2^K with K from -1074 to 970, or a power of ten from 1e-100 to 1", {}};
  SnapReport report;
  bool finite = true;
  for_each_coordinate(data, [&](double& x) {
    finite = finite && std::isfinite(x);
    if (!finite) return;
    const double before = std::exchange(x, snapped_coordinate(x, grid));
    ++report.coordinates;
    report.moved += x != before;
    report.largest_move = std::max(report.largest_move, std::abs(x - before));
  });
  if (!finite) return Error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
  return Snapped<Data>{std::move(data), report};
}

constexpr double kUlps = 4;       // how far a noisy coordinate may be off
constexpr int kLeastFine = 20;    // a grid is at least 2^20 ulps
constexpr std::size_t kMost = 9;  // of ten coordinates that have to be on the grid

struct Coordinates {
  std::vector<double> values;
  double ulp = 0;  ///< of the largest one
};

template <class Data>
Coordinates coordinates_of(Data data) {
  Coordinates all;
  double largest = 0;
  for_each_coordinate(data, [&](double& x) {
    all.values.push_back(x);
    largest = std::max(largest, std::abs(x));
  });
  if (std::isfinite(largest) && largest > 0) all.ulp = std::ldexp(1.0, std::ilogb(largest) - 52);
  return all;
}

/// The coordinate that snapped_coordinate gives, but for ties and for what is 2^53 steps away; powers of ten up to 10^9
/// are doubles.
double nearly_snapped(double x, const CoordinateGrid& grid) {
  if (grid.base == 2) return nearest_of_two(x, grid.exponent);
  const double steps = std::pow(10, -grid.exponent);
  return std::nearbyint(x * steps) / steps;
}

/// How many coordinates are off a grid that enough of them are on, or nearly. Nothing where they are not.
std::optional<std::size_t> noisy_on(const Coordinates& all, const CoordinateGrid& grid) {
  std::size_t noisy = 0, off = 0;
  for (const double x : all.values) {
    const double distance = std::abs(nearly_snapped(x, grid) - x);
    if (!(distance <= kUlps * all.ulp)) ++off;
    else if (distance > 0) ++noisy;
    if (10 * off > (10 - kMost) * all.values.size()) return std::nullopt;
  }
  return noisy;
}

std::vector<CoordinateGrid> grids_from_coarse() {
  std::vector<CoordinateGrid> grids;
  for (int k = 0; k >= -20; --k) grids.push_back({2, k});
  for (int k = -1; k >= -9; --k) grids.push_back({10, k});
  const auto step = [](const CoordinateGrid& grid) { return std::pow(grid.base, grid.exponent); };
  std::stable_sort(grids.begin(), grids.end(),
                   [&](const CoordinateGrid& a, const CoordinateGrid& b) { return step(a) > step(b); });
  return grids;
}

template <class Data>
std::optional<CoordinateNoise> noise_of(const Data& data) {
  const Coordinates all = coordinates_of(data);
  if (!(all.ulp > 0)) return std::nullopt;
  for (const CoordinateGrid& grid : grids_from_coarse()) {
    if (std::pow(grid.base, grid.exponent) < std::ldexp(all.ulp, kLeastFine)) return std::nullopt;
    const std::optional<std::size_t> noisy = noisy_on(all, grid);
    if (!noisy) continue;
    if (*noisy == 0) return std::nullopt;
    return CoordinateNoise{grid, *noisy, all.values.size()};
  }
  return std::nullopt;
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

std::string CoordinateGrid::to_string() const {
  return base == 2 ? "2^" + std::to_string(exponent) : exponent == 0 ? "1" : "1e" + std::to_string(exponent);
}

Result<CoordinateGrid> coordinate_grid(const std::string& text) {
  const std::string_view view = text;
  CoordinateGrid grid;
  if (view.starts_with("2^")) {
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), grid.exponent);
    if (error == std::errc() && end == text.data() + text.size() && is_known(grid)) return grid;
  } else {
    double value = 0;
    const auto [end, error] = base::read_double(text.data(), text.data() + text.size(), value);
    for (grid = {10, 0}; error == std::errc() && end == text.data() + text.size() && is_known(grid); --grid.exponent)
      if (nearest_decimal(value, -grid.exponent) == value && value > 0) {
        // The first grid that the number is on: it is a power of ten where its text there has the digit 1 alone.
        const std::string power = "1e" + std::to_string(grid.exponent);
        double exact = 0;
        base::read_double(power.data(), power.data() + power.size(), exact);
        if (value == exact) return grid;
        break;
      }
  }
  return Error{ErrorCode::malformed,
               "a grid is 2^K with K from -1074 to 970, or a power of ten from 1e-100 to 1, not '" + text + "'",
               {}};
}

std::string SnapReport::to_string() const {
  if (moved == 0) return "all coordinates were on the grid";
  return std::to_string(moved) + " of " + std::to_string(coordinates) + " coordinates moved, at most by " +
         short_number(largest_move);
}

std::string CoordinateNoise::to_string() const {
  return std::to_string(noisy) + " of " + std::to_string(coordinates) + " coordinates are off multiples of " +
         grid.to_string() + " by rounding alone, which exact arithmetic keeps";
}

Result<Snapped<RegionData>> snapped(RegionData data, const CoordinateGrid& grid) {
  return snapped_data(std::move(data), grid);
}
Result<Snapped<MeshData>> snapped(MeshData data, const CoordinateGrid& grid) {
  return snapped_data(std::move(data), grid);
}

std::optional<CoordinateNoise> coordinate_noise(const RegionData& data) { return noise_of(data); }
std::optional<CoordinateNoise> coordinate_noise(const MeshData& data) { return noise_of(data); }

}  // namespace dymsum
