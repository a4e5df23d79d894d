#include "pictures/svg_paths.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "exit_code.h"

namespace dymsum::cli {
namespace {

/// Collects path data; everything is moved and turned upside down here.
class Pen {
 public:
  explicit Pen(double scale, Point moved) : scale_(scale), moved_(moved) { path_.precision(7); }

  // Zero has no sign.
  Point place(Point p) const { return {scale_ * p.x + moved_.x + 0.0, -(scale_ * p.y + moved_.y) + 0.0}; }
  void to(char command, Point p) {
    const Point q = place(p);
    path_ << command << q.x << ' ' << q.y;
    set_.box.see(q);
  }
  void segments(const std::vector<SumSegment>& list) {
    for (const SumSegment& s : list) {
      to('M', s.from.at);
      to('L', s.to.at);
    }
  }
  /// What follows is tight.
  void begin_tight() {
    set_.path = path_.str();
    path_.str("");
    tight_ = true;
  }
  void close() { path_ << 'Z'; }
  void dot(Point p) {
    set_.dots.push_back(place(p));
    set_.box.see(set_.dots.back());
  }
  Drawn finish() {
    (tight_ ? set_.tight : set_.path) = path_.str();
    return std::move(set_);
  }

 private:
  double scale_;
  Point moved_;
  std::ostringstream path_;
  bool tight_ = false;
  Drawn set_;
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

Drawn drawn(const PlanarSum& sum, Point moved) {
  Pen pen(1, moved);
  const auto ring = [&](const SumRing& r) {
    for (std::size_t k = 0; k < r.vertices.size(); ++k) pen.to(k == 0 ? 'M' : 'L', r.vertices[k].at);
    pen.close();
  };
  for (const SumPart& part : sum.parts) {
    ring(part.outer);
    for (const SumRing& hole : part.holes) ring(hole);
  }
  pen.segments(sum.segments);
  pen.begin_tight();
  pen.segments(sum.tight_segments);
  for (const auto* points : {&sum.points, &sum.tight_points})
    for (const SumVertex& v : *points) pen.dot(v.at);
  return pen.finish();
}

Drawn drawn(const Region& region, double scale, Point moved) {
  Pen pen(scale, moved);
  const auto chain = [&](const std::vector<Point>& points) {
    for (std::size_t k = 0; k < points.size(); ++k) pen.to(k == 0 ? 'M' : 'L', points[k]);
  };
  for (const Part& part : region.parts()) {
    chain(part.outer);
    pen.close();
    for (const Ring& hole : part.holes) {
      chain(hole);
      pen.close();
    }
  }
  for (const Polyline& line : region.polylines()) chain(line);
  for (const Point& p : region.points()) pen.dot(p);
  return pen.finish();
}

std::string tight_features(const Drawn& set, double factor) {
  std::string svg;
  if (!set.tight.empty())
    svg = "<path class=\"tight\" d=\"" + set.tight + "\" fill=\"none\" stroke=\"" + kTightColour +
          "\" stroke-width=\"" + number(2 / factor) + "\" stroke-linecap=\"round\"/>";
  for (const Point& p : set.dots)
    svg += "<circle cx=\"" + number(p.x) + "\" cy=\"" + number(p.y) + "\" r=\"" + number(2.5 / factor) + "\" fill=\"" +
           kTightColour + "\"/>";
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
