// Updates of feasible positions: 100 placed parts of 50 vertices, one of which moves, on the grid and off it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "dymsum/placement.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"

namespace dymsum::bench {
namespace {

double milliseconds_now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Region of(const RegionData& data, CoordinateKind kind, std::mt19937_64& random) {
  return Region::create(of_kind(data, kind, random)).value();
}

/// The first candidate from the left, at its exact position or at one in doubles beside it.
RationalPoint position_for(Placement& placement, std::uint32_t shape, const FeasiblePositions& feasible, bool exact) {
  for (const CandidatePosition& c : feasible.candidates) {
    const RationalPoint at = feasible.set.exact(c.vertex);
    if (exact) return at;
    if (const std::optional<Point> near = placement.free_beside(shape, at, 0x1p-16).value())
      return {Rational::of(near->x).value(), Rational::of(near->y).value()};
  }
  return feasible.set.exact(feasible.candidates.front().vertex);
}

struct Times {
  std::vector<double> ms;
  std::string text() {
    std::sort(ms.begin(), ms.end());
    char line[100];
    std::snprintf(line, sizeof line, "%7.2f %7.2f %7.2f", ms[ms.size() / 2], ms[ms.size() * 99 / 100], ms.back());
    return line;
  }
};

void measure(const std::string& name, CoordinateKind kind, bool exact) {
  std::mt19937_64 random(1);
  Placement placement = Placement::create(of(shapes::rectangle(0, 0, 40, 14).data(), kind, random)).value();
  constexpr int kShapes = 4, kParts = 100;
  for (std::uint64_t k = 0; k < kShapes; ++k)
    placement.add_shape(of(shapes::noisy_star(50, 0.5, k + 1).data(), kind, random)).value();
  placement.add_shape(of(shapes::random_polygon(50, 0, 7).data(), kind, random)).value();
  Times placing, moving;
  std::size_t vertices = 0, digits = 0;
  for (int k = 0; k < kParts; ++k) {
    const auto shape = static_cast<std::uint32_t>(k % kShapes);
    const FeasiblePositions before = placement.feasible(shape).value();
    if (before.candidates.empty()) break;
    const RationalPoint at = position_for(placement, shape, before, exact);
    digits = std::max(digits, at.x.denominator().size());
    placement.add_part(shape, at).value();
    const double start = milliseconds_now();
    vertices = placement.feasible(shape).value().candidates.size();
    placing.ms.push_back(milliseconds_now() - start);
  }
  placement.feasible(0).value();
  const std::vector<PlacedPart> parts = placement.parts();
  for (const PlacedPart& part : parts) {
    const RationalPoint at{part.at.x + Rational::of(0.0625).value(), part.at.y};
    placement.move_part(part.part, at).value();
    const double start = milliseconds_now();
    placement.feasible(0).value();
    moving.ms.push_back(milliseconds_now() - start);
    placement.move_part(part.part, part.at).value();
    placement.feasible(0).value();
  }
  std::printf("%-28s %4zu parts %5zu vertices %5zu digits | placed %s | moved %s\n", name.c_str(), parts.size(),
              vertices, digits, placing.text().c_str(), moving.text().c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace dymsum::bench

int main() {
  std::puts("ms of an update, median, 99 %, worst");
  for (const dymsum::CoordinateKind kind : dymsum::kCoordinateKinds)
    for (const bool exact : {false, true})
      dymsum::bench::measure(name_of(kind) + (exact ? ", exact" : ", doubles"), kind, exact);
}
