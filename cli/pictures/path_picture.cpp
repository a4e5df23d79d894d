#include "pictures/path_picture.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

// The robot at a configuration, y downwards.
std::vector<Chain> placed(const Region& region, const Configuration& q, Box& seen) {
  const double c = std::cos(q.theta), s = std::sin(q.theta);
  std::vector<Chain> chains;
  const auto add = [&](const Ring& ring) {
    Chain& chain = chains.emplace_back(Chain{{}, true});
    for (const Point& p : ring) {
      chain.points.push_back({q.x + c * p.x - s * p.y, -(q.y + s * p.x + c * p.y)});
      seen.see(chain.points.back());
    }
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  // There and back, so that nothing between its ends is filled.
  for (const Polyline& line : region.polylines()) {
    Ring walk(line);
    walk.insert(walk.end(), line.rbegin() + 1, line.rend());
    add(walk);
  }
  for (const Point& point : region.points()) add({point});
  return chains;
}

double turn_of(const Waypoint& from, const Waypoint& to) {
  const double turn = to.approx.theta - from.approx.theta, whole = 2 * std::numbers::pi;
  if (to.move == Waypoint::Move::counter_clockwise) return turn < 0 ? turn + whole : turn;
  if (to.move == Waypoint::Move::clockwise) return turn > 0 ? turn - whole : turn;
  return 0;
}

}  // namespace

std::string path_picture(const Region& robot, const Region& obstacle, const std::vector<Waypoint>& path) {
  constexpr double kSize = 900, kMargin = 16;
  constexpr int kBetween = 6;
  Box seen;
  const std::vector<Chain> wall = placed(obstacle, {}, seen);
  std::vector<std::vector<Chain>> pale, full;
  Chain way;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Configuration& q = path[k].approx;
    full.push_back(placed(robot, q, seen));
    way.points.push_back({q.x, -q.y});
    for (int i = 1; k + 1 < path.size() && i < kBetween; ++i) {
      const double s = static_cast<double>(i) / kBetween;
      const Configuration& next = path[k + 1].approx;
      const double theta = q.theta + s * turn_of(path[k], path[k + 1]);
      pale.push_back(placed(robot, {q.x + s * (next.x - q.x), q.y + s * (next.y - q.y), theta}, seen));
    }
  }
  const Box box = seen.drawable();
  const double factor = kSize / box.size(), line = 1 / factor;
  const Point origin = origin_of(box);
  const auto outlined = [&](const std::vector<Chain>& chains, const char* style, double width) {
    return "<path d=\"" + path_data(chains, origin) + "\" fill-rule=\"evenodd\" stroke-width=\"" + number(width) +
           "\" " + style + "/>\n";
  };
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(box.width() * factor + 2 * kMargin) << ' '
      << number(box.height() * factor + 2 * kMargin)
      << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<g transform=\"translate(" << number(kMargin)
      << ' ' << number(kMargin) << ") scale(" << number(factor) << ") translate(" << number(-(box.x0 - origin.x)) << ' '
      << number(-(box.y0 - origin.y)) << ")\">\n";
  svg << outlined(wall, "fill=\"#9ecae1\" stroke=\"#08519c\"", line);
  for (const std::vector<Chain>& robot_there : pale)
    svg << outlined(robot_there, "fill=\"#e8a33d\" fill-opacity=\"0.12\" stroke=\"#a8650a\" stroke-opacity=\"0.4\"",
                    0.6 * line);
  for (const std::vector<Chain>& robot_there : full)
    svg << outlined(robot_there, "fill=\"#e8a33d\" fill-opacity=\"0.45\" stroke=\"#a8650a\"", line);
  if (!way.points.empty()) svg << outlined({way}, "fill=\"none\" stroke=\"#333333\"", 1.2 * line);
  svg << "</g>\n</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
