#include "planar/growth.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"

namespace dymsum::bench {
namespace {

struct Sized {
  double ms = 0;
  SumStats stats;
  std::size_t vertices = 0;
};

// The least of some runs, two for sums that take longer than a second.
Sized measure(const Region& p, const Region& q) {
  Sized best;
  double all = 0;
  for (int run = 0; run < 5 && (run < 2 || all < 2000); ++run) {
    const auto start = std::chrono::steady_clock::now();
    const Result<PlanarSum> sum = minkowski_sum(p, q);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    if (!sum) throw std::runtime_error(sum.error().to_string());
    all += ms;
    if (run == 0 || ms < best.ms) best = {ms, sum->stats, sum->vertex_count()};
  }
  return best;
}

void print(std::ostream& out, const std::string& name, const Sized& s, double exponent) {
  out << "| " << name << " | " << std::fixed << std::setprecision(s.ms < 100 ? 1 : 0) << s.ms << " | "
      << s.stats.reduced_segments << " | " << s.stats.live_segments << " | " << s.stats.crossings << " | " << s.vertices
      << " | " << std::setprecision(1) << static_cast<double>(s.stats.peak_bytes) / 1e6 << " | ";
  if (exponent != 0) out << std::setprecision(2) << exponent;
  out << " |\n";
}

}  // namespace

bool measure_growth(int largest, Kind kind, const std::string& dir, std::ostream& out) {
  std::ostringstream table;
  table << "# Growth of large sums\n\nRandom stars with radii between 1 - noise and 1, each with itself, and a circle "
           "of jittered vertices with a regular polygon. "
           "Memory is that of\nthe engine's own arrays. The exponent compares a star with the one half as large; the "
           "sum's reduced convolution grows\n"
           "with the square.\n\n    ./run bench planar --growth --results docs/results\n\n";
  if (kind) table << "Coordinates: " << name(*kind) << "\n\n";
  table << "| operands | ms | segments | live | crossings | vertices | MB | exponent "
           "|\n|---|---|---|---|---|---|---|---|\n";
  const auto spoilt = [&](const std::string& operand, const Result<Region>& shape) {
    if (!shape) table << "| " << operand << " | spoilt by rounding: " << shape.error().to_string() << " |||||||\n";
    return !shape;
  };
  for (const double noise : {0.1, 0.6, 0.9}) {
    double before = 0;
    for (int n = 250; n <= largest; n *= 2) {
      std::ostringstream name;
      name << "star " << n << ", noise " << noise;
      const Result<Region> star = with_coordinates(shapes::noisy_star(n, noise, 1), kind);
      if (spoilt(name.str(), star)) continue;
      const Sized s = measure(*star, *star);
      print(table, name.str(), s, before > 0 ? std::log2(s.ms / before) : 0);
      before = s.ms;
      out << "." << std::flush;
    }
  }
  for (const double jitter : {1e-5, 1e-4, 1e-3}) {
    std::ostringstream name;
    name << "circle 100000, jitter " << jitter << ", 64-gon";
    const Result<Region> circle = with_coordinates(shapes::noisy_star(100000, jitter, 7), kind),
                         disc = with_coordinates(shapes::disc(64, 0.1, shapes::demo_snap(0.1)), kind);
    if (!spoilt(name.str(), circle) && !spoilt(name.str(), disc)) print(table, name.str(), measure(*circle, *disc), 0);
    out << "." << std::flush;
  }
  out << "\n" << table.str();
  if (dir.empty()) return true;
  std::filesystem::create_directories(dir);
  std::ofstream file(dir + "/growth.md");
  file << table.str();
  return static_cast<bool>(file.flush());
}

}  // namespace dymsum::bench
