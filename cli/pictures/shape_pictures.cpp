#include "pictures/shape_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

constexpr double kSize = 700, kMargin = 16;

/// A picture whose drawing has its own coordinates.
struct Canvas {
  Box box;
  Point origin;
  double factor = 1;

  explicit Canvas(const Box& seen) : box(seen.drawable()), origin(origin_of(box)), factor(kSize / box.size()) {}
  double width() const { return box.width() * factor + 2 * kMargin; }
  double height() const { return box.height() * factor + 2 * kMargin; }
  Point at(Point p) const { return {p.x - origin.x, -p.y - origin.y}; }
  void open(std::ostringstream& svg, double width, double height) const {
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(width) << ' ' << number(height)
        << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        << "<g transform=\"translate(" << number(kMargin) << ' ' << number(kMargin) << ") scale(" << number(factor)
        << ") translate(" << number(-(box.x0 - origin.x)) << ' ' << number(-(box.y0 - origin.y)) << ")\">\n";
  }
  void path(std::ostringstream& svg, const Drawn& set, const std::string& style, double stroke) const {
    svg << "<path d=\"" << path_data(set.chains, origin) << "\" fill-rule=\"evenodd\" stroke-width=\""
        << number(stroke / factor) << "\" " << style << "/>\n";
  }
  void line(std::ostringstream& svg, Point a, Point b, const char* style, double stroke) const {
    const Point p = at(a), q = at(b);
    svg << "<line x1=\"" << number(p.x) << "\" y1=\"" << number(p.y) << "\" x2=\"" << number(q.x) << "\" y2=\""
        << number(q.y) << "\" stroke-width=\"" << number(stroke / factor) << "\" " << style << "/>\n";
  }
  void dot(std::ostringstream& svg, Point a, double radius, const char* fill) const {
    const Point p = at(a);
    svg << "<circle cx=\"" << number(p.x) << "\" cy=\"" << number(p.y) << "\" r=\"" << number(radius / factor)
        << "\" fill=\"" << fill << "\"/>\n";
  }
};

/// Bars in the order given, the axis a little longer than the longest that ends.
void draw_bars(std::ostringstream& svg, const ShapeFeatures& features, const std::vector<std::uint32_t>& order,
               std::size_t strong, double alpha, double x, double height) {
  constexpr double kWidth = 320;
  constexpr std::size_t kMost = 120;
  const std::size_t shown = std::min(order.size(), kMost);
  double last = alpha;
  for (std::size_t i = 0; i < shown; ++i)
    if (features.bars()[order[i]].death) last = std::max(last, features.bars()[order[i]].death_alpha);
  const double unit = last > 0 ? kWidth / (1.08 * last) : 1, step = std::min(14.0, (height - 60) / double(shown + 1));
  for (std::size_t i = 0; i < shown; ++i) {
    const FeatureBar& bar = features.bars()[order[i]];
    const double x0 = x + bar.birth_alpha * unit, x1 = bar.death ? x + bar.death_alpha * unit : x + kWidth;
    const char* colour = i >= strong ? "#c8ced6" : bar.born == FeatureBar::Birth::corner ? "#d81e3a" : "#e8a33d";
    svg << "<rect x=\"" << number(x0) << "\" y=\"" << number(30 + step * double(i)) << "\" width=\""
        << number(std::max(0.6, x1 - x0)) << "\" height=\"" << number(0.6 * step) << "\" fill=\"" << colour << "\"/>\n";
  }
  const double bottom = 34 + step * double(shown);
  svg << "<line x1=\"" << number(x + alpha * unit) << "\" x2=\"" << number(x + alpha * unit) << "\" y1=\"24\" y2=\""
      << number(bottom) << "\" stroke=\"#08519c\" stroke-width=\"1\"/>\n<text x=\"" << number(x) << "\" y=\"18\">"
      << "bars over alpha, 0 to " << number(1.08 * last) << "; the line: alpha = " << number(alpha) << "</text>\n";
  if (shown < order.size())
    svg << "<text x=\"" << number(x) << "\" y=\"" << number(bottom + 16) << "\">the " << shown << " longest of "
        << order.size() << "</text>\n";
}

}  // namespace

std::vector<Point> vertices_of(const Region& region) {
  std::vector<Point> vertices;
  for (const Part& part : region.parts()) {
    vertices.insert(vertices.end(), part.outer.begin(), part.outer.end());
    for (const Ring& hole : part.holes) vertices.insert(vertices.end(), hole.begin(), hole.end());
  }
  for (const Polyline& line : region.polylines()) vertices.insert(vertices.end(), line.begin(), line.end());
  vertices.insert(vertices.end(), region.points().begin(), region.points().end());
  return vertices;
}

std::string features_picture(const ShapeFeatures& features, const Region& sum, const std::vector<AlphaBridge>& bridges,
                             double alpha, const std::vector<std::uint32_t>& kept) {
  const Drawn shape = drawn(features.region()), grown = drawn(sum);
  Box seen = shape.box;
  seen.see(grown.box);
  const Canvas canvas(seen);
  std::ostringstream svg;
  canvas.open(svg, canvas.width() + 360, std::max(canvas.height(), 400.0));
  canvas.path(svg, grown, "fill=\"#e8f1f8\" stroke=\"#6baed6\"", 1);
  canvas.path(svg, shape, "fill=\"#cfd5dc\" stroke=\"#333333\"", 1);
  const std::vector<Point> vertices = vertices_of(features.region());
  for (const AlphaBridge& b : bridges) {
    canvas.line(svg, b.from.at, b.to.at, b.gap ? "stroke=\"#e8a33d\"" : "stroke=\"#2a7d2a\"", 1.4);
    if (b.minimum) canvas.line(svg, b.centre, vertices[*b.minimum], "stroke=\"#888888\"", 0.6);
  }
  for (const AlphaBridge& b : bridges) {
    canvas.dot(svg, b.centre, 3, "#3f8fd0");
    if (b.minimum) canvas.dot(svg, vertices[*b.minimum], 3, "#d81e3a");
  }
  svg << "</g>\n";
  std::vector<std::uint32_t> order = kept;
  for (const std::uint32_t bar : features.lasting(Rational(0)))
    if (std::find(kept.begin(), kept.end(), bar) == kept.end()) order.push_back(bar);
  draw_bars(svg, features, order, kept.size(), alpha, canvas.width() + 10, std::max(canvas.height(), 400.0));
  svg << "</svg>\n";
  return svg.str();
}

std::string decomposition_picture(const Region& region, const Decomposition& decomposition) {
  constexpr std::array<const char*, 6> kColours{"#9ecae1", "#fdd49e", "#c7e9c0", "#dadaeb", "#fcc5c0", "#d9d9a3"};
  const Drawn shape = drawn(region);
  const Canvas canvas(shape.box);
  std::ostringstream svg;
  canvas.open(svg, canvas.width(), canvas.height());
  const std::vector<std::uint32_t> colours = piece_colours(decomposition);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const Piece& piece = decomposition.pieces[i];
    Drawn set;
    const auto add = [&](const RationalRing& ring) {
      Chain chain{{}, true};
      for (const RationalPoint& p : ring) chain.points.push_back({p.x.to_double(), -p.y.to_double()});
      set.chains.push_back(std::move(chain));
    };
    add(piece.outer);
    for (const RationalRing& hole : piece.holes) add(hole);
    canvas.path(svg, set, std::string("fill=\"") + kColours.at(colours[i]) + "\" stroke=\"none\"", 1);
  }
  canvas.path(svg, shape, "fill=\"none\" stroke=\"#333333\"", 1);
  for (const Cut& cut : decomposition.cuts) {
    const auto plain = [](const RationalPoint& p) { return Point{p.x.to_double(), p.y.to_double()}; };
    for (const RationalSegment& run : cut.runs)
      canvas.line(svg, plain(run[0]), plain(run[1]), "stroke=\"#d81e3a\"", 1.6);
    canvas.dot(svg, plain(cut.from), 2.4, "#d81e3a");
  }
  svg << "</g>\n</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
