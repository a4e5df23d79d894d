#include "pictures/layout_picture.h"

#include <cmath>
#include <set>
#include <sstream>

#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

/// A shape as it stands, in doubles.
Drawn standing(const Layout& layout, const LayoutPart& part) {
  Drawn set = drawn(layout.shapes[part.shape]);
  const double theta = part.orientation.radians(), c = std::cos(theta), s = std::sin(theta);
  const Point at{part.at.x.to_double(), part.at.y.to_double()};
  set.box = {};
  for (Chain& chain : set.chains)
    for (Point& p : chain.points) {  // y downwards
      p = {c * p.x + s * p.y + at.x, c * p.y - s * p.x - at.y};
      set.box.see(p);
    }
  return set;
}

void draw_set(std::ostringstream& svg, const Drawn& set, Point origin, double factor, const char* style) {
  svg << "<path d=\"" << path_data(set.chains, origin) << "\" fill-rule=\"evenodd\" stroke-width=\""
      << number(1 / factor) << "\" " << style << "/>\n";
}

}  // namespace

std::string layout_picture(const Layout& layout, const LayoutCheck& check) {
  constexpr double kSize = 1200, kMargin = 16;
  std::set<std::uint32_t> wrong;
  for (const LayoutFault& f : check.faults) wrong.insert({f.part, f.other});
  std::vector<Drawn> parts;
  Box seen;
  for (const LayoutPart& part : layout.parts) seen.see(parts.emplace_back(standing(layout, part)).box);
  const Drawn container = layout.container ? drawn(*layout.container) : Drawn{};
  seen.see(container.box);
  const Box box = seen.drawable();
  const double factor = kSize / box.size();
  const Point origin = origin_of(box);
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(box.width() * factor + 2 * kMargin) << ' '
      << number(box.height() * factor + 2 * kMargin) << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
      << "<g transform=\"translate(" << number(kMargin) << ' ' << number(kMargin) << ") scale(" << number(factor)
      << ") translate(" << number(-(box.x0 - origin.x)) << ' ' << number(-(box.y0 - origin.y)) << ")\">\n";
  draw_set(svg, container, origin, factor, "fill=\"#f4f4f4\" stroke=\"#333333\"");
  for (std::uint32_t k = 0; k < parts.size(); ++k)
    draw_set(svg, parts[k], origin, factor,
             wrong.contains(k) ? "fill=\"#e8a33d\" fill-opacity=\"0.7\" stroke=\"#a8650a\""
                               : "fill=\"#9ecae1\" fill-opacity=\"0.7\" stroke=\"#08519c\"");
  for (std::size_t k = check.faults.size(); k-- > 0;) {
    const Point at = check.faults[k].at;
    svg << "<circle cx=\"" << number(at.x - origin.x) << "\" cy=\"" << number(-at.y - origin.y) << "\" r=\""
        << number((k == 0 ? 14 : 8) / factor) << "\" fill=\"none\" stroke=\"" << kTightColour << "\" stroke-width=\""
        << number((k == 0 ? 3 : 1.5) / factor) << "\"/>\n";
  }
  svg << "</g>\n</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
