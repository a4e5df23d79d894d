#include "pictures/svg_paths.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "exit_code.h"

namespace dymsum::cli {
namespace {

/// Collects chains; everything is moved and turned upside down here.
class Pen {
 public:
  Pen(double scale, Point moved) : scale_(scale), moved_(moved) {}

  template <class Points, class At>
  void chain(std::vector<Chain>& to, const Points& points, bool closed, At&& at) {
    Chain& made = to.emplace_back();
    made.closed = closed;
    for (const auto& point : points) made.points.push_back(placed(at(point)));
  }
  void segments(std::vector<Chain>& to, const std::vector<SumSegment>& list) {
    for (const SumSegment& s : list) to.push_back({{placed(s.from.at), placed(s.to.at)}, false});
  }
  void dot(Point p) { set.dots.push_back(placed(p)); }

  Drawn set;

 private:
  Point placed(Point p) {
    // Zero has no sign.
    const Point q{scale_ * p.x + moved_.x + 0.0, -(scale_ * p.y + moved_.y) + 0.0};
    set.box.see(q);
    return q;
  }
  double scale_;
  Point moved_;
};

}  // namespace

void Box::see(Point p) {
  x0 = std::min(x0, p.x);
  y0 = std::min(y0, p.y);
  x1 = std::max(x1, p.x);
  y1 = std::max(y1, p.y);
}

void Box::see(const Box& other) {
  if (other.empty()) return;
  see(Point{other.x0, other.y0});
  see(Point{other.x1, other.y1});
}

Box Box::drawable() const {
  if (empty()) return {0, 0, 1, 1};
  const double furthest = std::max({std::abs(x0), std::abs(y0), std::abs(x1), std::abs(y1)});
  if (!(furthest <= std::numeric_limits<float>::max()) || (size() > 0 && size() < std::numeric_limits<float>::min()))
    throw Stop(
        kBadInput,
        "this cannot be drawn: pictures show coordinates up to 3.4e+38 and extents from 1.2e-38 on, not a drawing of " +
            number(size()) + " that reaches to " + number(furthest));
  Box box = *this;
  if (!(box.width() > 0)) box.x1 = box.x0 + 1;
  if (!(box.height() > 0)) box.y1 = box.y0 + 1;
  return box;
}

Point origin_of(const Box& box) {
  constexpr double kFar = 16;  // leaves six digits and more of seven
  const double furthest = std::max({std::abs(box.x0), std::abs(box.y0), std::abs(box.x1), std::abs(box.y1)});
  return furthest > kFar * box.size() ? Point{box.x0, box.y0} : Point{0, 0};
}

std::string path_data(const std::vector<Chain>& chains, Point origin) {
  std::ostringstream path;
  path.precision(7);
  for (const Chain& chain : chains) {
    char command = 'M';
    for (const Point& p : chain.points) {
      path << command << p.x - origin.x << ' ' << p.y - origin.y;
      command = 'L';
    }
    if (chain.closed) path << 'Z';
  }
  return path.str();
}

Drawn drawn(const PlanarSum& sum, Point moved) {
  Pen pen(1, moved);
  const auto at = [](const SumVertex& v) { return v.at; };
  for (const SumPart& part : sum.parts) {
    pen.chain(pen.set.chains, part.outer.vertices, true, at);
    for (const SumRing& hole : part.holes) pen.chain(pen.set.chains, hole.vertices, true, at);
  }
  pen.segments(pen.set.chains, sum.segments);
  pen.segments(pen.set.tight, sum.tight_segments);
  for (const auto* points : {&sum.points, &sum.tight_points})
    for (const SumVertex& v : *points) pen.dot(v.at);
  return std::move(pen.set);
}

Drawn drawn(const Region& region, double scale, Point moved) {
  Pen pen(scale, moved);
  const auto chain = [&](const std::vector<Point>& points, bool closed) {
    pen.chain(pen.set.chains, points, closed, [](const Point& p) { return p; });
  };
  for (const Part& part : region.parts()) {
    chain(part.outer, true);
    for (const Ring& hole : part.holes) chain(hole, true);
  }
  for (const Polyline& line : region.polylines()) chain(line, false);
  for (const Point& p : region.points()) pen.dot(p);
  return std::move(pen.set);
}

std::string tight_features(const Drawn& set, Point origin, double factor) {
  std::string svg;
  if (!set.tight.empty())
    svg = "<path class=\"tight\" d=\"" + path_data(set.tight, origin) + "\" fill=\"none\" stroke=\"" + kTightColour +
          "\" stroke-width=\"" + number(2 / factor) + "\" stroke-linecap=\"round\"/>";
  for (const Point& p : set.dots)
    svg += "<circle cx=\"" + number(p.x - origin.x) + "\" cy=\"" + number(p.y - origin.y) + "\" r=\"" +
           number(2.5 / factor) + "\" fill=\"" + kTightColour + "\"/>";
  return svg;
}

std::string number(double v) {
  std::ostringstream text;
  text.precision(7);
  text << v;
  return text.str();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') out += "&lt;";
    else if (c == '&') out += "&amp;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

}  // namespace dymsum::cli
