#include "planar/open_ends.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "inputs.h"
#include "report.h"

namespace dymsum::cli {
namespace {

/// Ends of lines count as meant to meet within a millionth of the drawing.
constexpr double kNear = 1e-6;

std::vector<Point> open_ends(const RegionData& data) {
  std::vector<Point> ends;
  for (const Polyline& line : data.polylines) {
    if (line.empty() || line.front() == line.back()) continue;
    ends.push_back(line.front());
    ends.push_back(line.back());
  }
  std::sort(ends.begin(), ends.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return ends;
}

double extent(const RegionData& data, Point from) {
  double size = 0;
  for (const Polyline& line : data.polylines)
    for (const Point& p : line) size = std::max({size, std::abs(p.x - from.x), std::abs(p.y - from.y)});
  return size;
}

}  // namespace

void report_open_ends(const RegionData& data, const std::string& file) {
  if (!data.parts.empty()) return;
  const std::vector<Point> ends = open_ends(data);
  const double most = ends.empty() ? 0 : kNear * extent(data, ends.front());
  constexpr std::size_t kNeighbours = 8;  // of an end in the order of x that are looked at: it is a hint
  std::size_t near = 0;
  double widest = 0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(i + kNeighbours, ends.size()) && ends[j].x - ends[i].x <= most; ++j) {
      const double gap = std::hypot(ends[j].x - ends[i].x, ends[j].y - ends[i].y);
      if (!(gap > 0) || gap > most) continue;
      ++near;
      widest = std::max(widest, gap);
    }
  if (near == 0) return;
  std::cerr << shown_file(file) << ": lines end near each other and do not meet, " << counted(near, "time")
            << ", with gaps of up to " << widest
            << ": nothing is enclosed, as they are joined only in equal coordinates "
            << "(--join TOLERANCE joins them)\n";
}

}  // namespace dymsum::cli
