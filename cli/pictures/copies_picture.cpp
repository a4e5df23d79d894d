#include "pictures/copies_picture.h"

#include <sstream>

#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

/// The highest vertex of all sums: no copy covers it, so the robot touches there and hits nothing.
Point highest(const std::vector<CopySum>& sums) {
  Point best{0, -INFINITY};
  for (const CopySum& copy : sums)
    for (const SumPart& part : copy.sum.parts)
      for (const SumVertex& v : part.outer.vertices)
        if (v.at.y + copy.at.y > best.y) best = {v.at.x + copy.at.x, v.at.y + copy.at.y};
  return std::isfinite(best.y) ? best : Point{0, 0};
}

void dot(std::ostringstream& svg, Point at, double factor, const char* fill) {
  svg << "<circle cx=\"" << number(at.x) << "\" cy=\"" << number(at.y) << "\" r=\"" << number(3 / factor)
      << "\" fill=\"" << fill << "\"/>\n";
}

void draw(std::ostringstream& svg, const Drawn& set, const char* style, Point origin, double factor) {
  svg << "<path d=\"" << path_data(set.chains, origin) << "\" fill-rule=\"evenodd\" stroke-width=\""
      << number(1.2 / factor) << "\" " << style << "/>\n";
  svg << tight_features(set, origin, factor);
}

void legend(std::ostringstream& svg, double x, double y, const char* style, const std::string& text) {
  svg << "<rect x=\"" << number(x) << "\" y=\"" << number(y - 10) << "\" width=\"12\" height=\"12\" " << style
      << "/><text x=\"" << number(x + 18) << "\" y=\"" << number(y) << "\">" << escaped(text) << "</text>\n";
}

}  // namespace

std::string copies_picture(const Region& master, const Region& robot, const std::vector<ScaledCopy>& copies,
                           const std::vector<CopySum>& sums) {
  constexpr double kSize = 900, kMargin = 16, kLegend = 28;
  constexpr const char* kGrown = "fill=\"#9ecae1\" stroke=\"#08519c\"";
  constexpr const char* kObstacle = "fill=\"#ffffff\" stroke=\"#333333\"";
  constexpr const char* kRobot = "fill=\"#e8a33d\" stroke=\"#a8650a\"";
  const Point stand = highest(sums);
  const Drawn body = drawn(robot, 1, stand);
  std::vector<Drawn> grown, solid;
  Box seen = body.box;
  seen.see(Point{stand.x, -stand.y});
  for (std::size_t i = 0; i < copies.size(); ++i) {
    grown.push_back(drawn(sums[i].sum, sums[i].at));
    solid.push_back(drawn(master, copies[i].scale.approx(), copies[i].at));
    seen.see(grown.back().box);
    seen.see(solid.back().box);
  }
  const Box box = seen.drawable();
  const double factor = kSize / box.size();
  const Point origin = origin_of(box);
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(box.width() * factor + 2 * kMargin) << ' '
      << number(box.height() * factor + 2 * kMargin + kLegend) << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<g transform=\"translate(" << number(kMargin) << ' '
      << number(kMargin) << ") scale(" << number(factor) << ") translate(" << number(-(box.x0 - origin.x)) << ' '
      << number(-(box.y0 - origin.y)) << ")\">\n";
  for (const Drawn& set : grown) draw(svg, set, kGrown, origin, factor);
  for (const Drawn& set : solid) draw(svg, set, kObstacle, origin, factor);
  draw(svg, body, kRobot, origin, factor);
  dot(svg, {stand.x - origin.x, -stand.y - origin.y}, factor, "#333333");
  svg << "</g>\n";
  const double y = box.height() * factor + 2 * kMargin + 12;
  legend(svg, kMargin, y, kObstacle, "obstacles");
  legend(svg, kMargin + 110, y, kGrown, "where the robot's reference point hits one");
  legend(svg, kMargin + 420, y, kRobot, "robot, touching; the dot is its reference point");
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
