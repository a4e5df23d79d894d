#include "scaling/scatter.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dymsum::bench {
namespace {

constexpr double kSize = 300, kLeft = 60, kTop = 40;

void panel(std::ostringstream& svg, double at, const std::string& x_axis, const std::string& y_axis,
           const std::vector<Dot>& dots) {
  double x0 = INFINITY, x1 = -INFINITY, y0 = 0, y1 = 0;
  for (const Dot& d : dots) {
    if (!(d.x > 0 && d.y > 0)) continue;
    x0 = std::min(x0, std::floor(std::log10(d.x)));
    x1 = std::max(x1, std::ceil(std::log10(d.x)));
    y0 = std::min(y0, std::floor(std::log10(d.y)));
    y1 = std::max(y1, std::ceil(std::log10(d.y)));
  }
  if (!(x0 < x1)) x1 = (x0 = std::isfinite(x0) ? x0 : 0) + 1;
  if (!(y0 < y1)) y1 = y0 + 1;
  svg << "<g transform=\"translate(" << at << ' ' << kTop << ")\"><rect width=\"" << kSize << "\" height=\"" << kSize
      << "\" fill=\"none\" stroke=\"#444\"/>\n";
  const auto px = [&](double lx) { return kSize * (lx - x0) / (x1 - x0); };
  const auto py = [&](double ly) { return kSize * (1 - (ly - y0) / (y1 - y0)); };
  for (double e = x0; e <= x1; ++e)
    svg << "<line x1=\"" << px(e) << "\" x2=\"" << px(e) << "\" y1=\"0\" y2=\"" << kSize
        << "\" stroke=\"#ddd\"/><text x=\"" << px(e) << "\" y=\"" << kSize + 15 << "\" text-anchor=\"middle\">1e" << e
        << "</text>\n";
  for (double e = y0; e <= y1; ++e)
    svg << "<line y1=\"" << py(e) << "\" y2=\"" << py(e) << "\" x1=\"0\" x2=\"" << kSize
        << "\" stroke=\"#ddd\"/><text x=\"-6\" y=\"" << py(e) + 4 << "\" text-anchor=\"end\">1e" << e << "</text>\n";
  for (const Dot& d : dots)
    if (d.x > 0 && d.y > 0)
      svg << "<circle cx=\"" << px(std::log10(d.x)) << "\" cy=\"" << py(std::log10(d.y))
          << "\" r=\"2.2\" fill=\"#0072b2\" fill-opacity=\"0.6\"/>\n";
  svg << "<text x=\"" << kSize / 2 << "\" y=\"" << kSize + 34 << "\" text-anchor=\"middle\">" << x_axis
      << "</text><text transform=\"translate(-42 " << kSize / 2 << ") rotate(-90)\" text-anchor=\"middle\">" << y_axis
      << "</text></g>\n";
}

}  // namespace

std::string draw_scatter(const std::string& title, const std::string& x_axis, const std::string& y_axis,
                         const std::vector<Dot>& left, const std::string& second_x_axis,
                         const std::vector<Dot>& right) {
  std::ostringstream svg;
  svg.precision(5);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 400\" font-family=\"sans-serif\" "
         "font-size=\"11\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/><text x=\"380\" y=\"20\" text-anchor=\"middle\" "
         "font-size=\"13\">"
      << title << "</text>\n";
  panel(svg, kLeft, x_axis, y_axis, left);
  panel(svg, kLeft + kSize + 80, second_x_axis, y_axis, right);
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace dymsum::bench
