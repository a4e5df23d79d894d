#include "cspace/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/shapes.h"

namespace dymsum::bench {
namespace {

double processor_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Between the x-coordinates of neighbouring columns the upper and the lower bound are monotone in x: simple whatever
// the heights are.
Region grid_polygon(int n) {
  std::mt19937 random(static_cast<unsigned>(n));
  const int columns = n / 2, height = 12;
  const auto draw = [&](int low) { return static_cast<double>(low + static_cast<int>(random() % height)); };
  Ring ring;
  for (int x = 0; x < columns; ++x) ring.push_back({static_cast<double>(x), -draw(1)});
  for (int x = n - columns - 1; x >= 0; --x) ring.push_back({static_cast<double>(x), draw(1)});
  return repair(RegionData{{{std::move(ring), {}}}, {}, {}}).value().region;
}

Region rectilinear(int n) {
  std::mt19937 random(static_cast<unsigned>(n));
  const int columns = n / 4;
  Ring upper, ring;
  const auto fresh = [&](double last) {
    for (;;)
      if (const double y = 1 + static_cast<double>(random() % 10); y != last) return y;
  };
  double low = 0, high = 0;
  for (int x = 0; x < columns; ++x) {
    low = fresh(low);
    high = fresh(high);
    for (const int end : {x, x + 1}) {
      ring.push_back({static_cast<double>(end), -low});
      upper.push_back({static_cast<double>(end), high});
    }
  }
  ring.insert(ring.end(), upper.rbegin(), upper.rend());
  return Region::create({{{std::move(ring), {}}}, {}, {}}).value();
}

Region comb(int n, double gap) { return shapes::comb((n + 2) / 4, 1 + gap, 1, 5); }
Region spiky_star(int n) { return shapes::star(n / 2, 0.2, 1, shapes::demo_snap(1)); }

struct Family {
  const char* name;
  Region (*make)(int n);
  int largest;  ///< what takes minutes is left out
};

void print(std::ostream& table, const char* name, const Region& shape, double ms, double exponent,
           const CspaceObstacle& obstacle) {
  const ObstacleWork& w = obstacle.work();
  table << "| " << name << " | " << shape.vertex_count() << " | " << std::fixed << std::setprecision(ms < 100 ? 1 : 0)
        << ms << " | ";
  if (exponent != 0) table << std::setprecision(2) << exponent;
  table << " | " << obstacle.patches().size() << " | " << obstacle.angles().size() << " | " << w.windows << " | "
        << w.candidate_pairs << " | " << w.candidate_triples << " | " << w.potential_events << " | " << w.local_updates
        << " | " << w.slices << " |\n";
}

}  // namespace

bool measure_obstacle_growth(Kind kind, const std::string& dir, std::ostream& out) {
  constexpr std::array<Family, 5> kFamilies{{{"integer-grid polygon", grid_polygon, 200},
                                             {"rectilinear polygon", rectilinear, 200},
                                             {"comb, gap 2", [](int n) { return comb(n, 2); }, 200},
                                             {"comb, exact fit", [](int n) { return comb(n, 1); }, 200},
                                             {"spiky star", spiky_star, 100}}};
  std::ostringstream table;
  table << "# Growth of obstacles\n\nPolygons whose events coincide or crowd, each as robot and as obstacle. Processor "
           "time of all threads together, of one run. "
           "The exponent\ncompares with the row before, by vertices. Teeth of combs are 1 wide; in a gap of width 1 "
           "they fit exactly.\nThe star of 200 vertices takes minutes and is left out.\n\n"
           "    ./run bench cspace --growth --results docs/results\n\n";
  if (kind) table << "Coordinates: " << name(*kind) << "\n\n";
  table << "| polygon with itself | vertices | ms | exponent | patches | angles | windows | pairs | triples | "
           "potential events | near the event | whole slices |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Family& family : kFamilies) {
    double before = 0, size_before = 0;
    for (const int n : {25, 50, 100, 200}) {
      if (n > family.largest) continue;
      const Result<Region> made = with_coordinates(family.make(n), kind);
      if (!made) {
        table << "| " << family.name << " | " << n << " | spoilt by rounding: " << made.error().to_string() << " |\n";
        continue;
      }
      const Region& shape = *made;
      const double start = processor_ms();
      const CspaceObstacle obstacle = CspaceObstacle::create(shape, shape).value();
      const double ms = processor_ms() - start, size = static_cast<double>(shape.vertex_count());
      print(table, family.name, shape, ms, before > 0 ? std::log(ms / before) / std::log(size / size_before) : 0,
            obstacle);
      before = ms;
      size_before = size;
      out << "." << std::flush;
    }
  }
  out << "\n" << table.str();
  if (dir.empty()) return true;
  std::ofstream file(dir + "/cspace-growth.md");
  file << table.str();
  return static_cast<bool>(file.flush());
}

}  // namespace dymsum::bench
