#include "cspace/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

namespace dymsum::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWidth = 1180, kHeight = 760, kMargin = 40;
constexpr double kStep = kPi / 36;  // of theta from one quadrangle to the next, at most
constexpr int kPiecesAcross = 16;   // of an edge as long as the slice is wide
constexpr int kShades = 10;

struct Position {
  double x, y, z;
};
Position operator-(Position a, Position b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Position cross(Position a, Position b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dot(Position a, Position b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The smallest box around what is to be drawn, and the map from it into a rectangle of the page, y upwards.
class Frame {
 public:
  void add(Point p) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  void fit(double left, double top, double width, double height) {
    scale_ = std::min(width / (high_.x - low_.x), height / (high_.y - low_.y));
    origin_ = {left + (width - scale_ * (low_.x + high_.x)) / 2, top + (height + scale_ * (low_.y + high_.y)) / 2};
  }
  Point operator()(Point p) const { return {origin_.x + scale_ * p.x, origin_.y - scale_ * p.y}; }
  double width() const { return high_.x - low_.x; }
  double height() const { return high_.y - low_.y; }

 private:
  Point low_{INFINITY, INFINITY}, high_{-INFINITY, -INFINITY}, origin_;
  double scale_ = 1;
};

/// Parallel projection from above.
class View {
 public:
  explicit View(double height_of_turn) : lift_(height_of_turn / (2 * kPi)) {}
  Position at(Point p, double theta) const { return {p.x, p.y, lift_ * theta}; }
  Point flat(Position p) const {
    const double back = p.x * kSinA + p.y * kCosA;
    return {p.x * kCosA - p.y * kSinA, back * kSinE + p.z * kCosE};
  }
  static Position towards() { return {-kSinA * kCosE, -kCosA * kCosE, kSinE}; }

 private:
  // About 32 degrees to the side and 35 upwards.
  static constexpr double kSinA = 0.53, kCosA = 0.848, kSinE = 0.574, kCosE = 0.819;
  double lift_;
};

struct Facet {
  std::array<Point, 4> corners;
  double near = 0;
  bool rotating = false;
  int shade = 0;
};

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}
std::string position(Point p) { return number(p.x) + " " + number(p.y); }

template <class Map>
std::string path_of(const PlanarSum& sum, const Map& map) {
  std::string path;
  const auto add = [&](const SumRing& ring) {
    const char* command = "M";
    for (const SumVertex& v : ring.vertices) path += std::exchange(command, "L") + position(map(v.at));
    path += "z";
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return path;
}

std::string path_of(const Region& region, const Frame& frame) {
  std::string path;
  const auto add = [&](const Ring& ring) {
    const char* command = "M";
    for (const Point p : ring) path += std::exchange(command, "L") + position(frame(p));
    path += "z";
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return path;
}

class Solid {
 public:
  Solid(const CspaceObstacle& obstacle, const View& view, double across)
      : obstacle_(obstacle), view_(view), across_(across) {
    for (const Patch& patch : obstacle.patches()) add(patch);
    std::sort(facets_.begin(), facets_.end(), [](const Facet& a, const Facet& b) { return a.near < b.near; });
  }
  const std::vector<Facet>& facets() const { return facets_; }

 private:
  void add(const Patch& patch) {
    const auto theta = [&](std::uint32_t angle) { return obstacle_.angles()[angle].theta; };
    if (patch.begin == Patch::kNone) return interval(patch, -kPi, kPi);
    if (patch.begin < patch.end) return interval(patch, theta(patch.begin), theta(patch.end));
    interval(patch, theta(patch.begin), kPi);
    interval(patch, -kPi, theta(patch.end));
  }

  /// From a little after one angle to a little before the other: at the angles themselves lines may be parallel.
  void interval(const Patch& patch, double low, double high) {
    if (!(high > low)) return;
    const int steps = std::max(1, static_cast<int>(std::ceil((high - low) / kStep)));
    const double inset = 1e-6 * (high - low);
    const auto theta = [&](int k) { return low + inset + (high - low - 2 * inset) * k / steps; };
    for (int k = 0; k < steps; ++k) strip(patch, theta(k), theta(k + 1));
  }

  void strip(const Patch& patch, double low, double high) {
    const auto [a, b] = obstacle_.ends(patch, low);
    const auto [c, d] = obstacle_.ends(patch, high);
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), std::hypot(d.x - c.x, d.y - c.y));
    const int pieces = std::clamp(static_cast<int>(std::ceil(kPiecesAcross * length / across_)), 1, kPiecesAcross);
    const auto between = [&](Point from, Point to, int k) {
      return Point{from.x + (to.x - from.x) * k / pieces, from.y + (to.y - from.y) * k / pieces};
    };
    for (int k = 0; k < pieces; ++k)
      facet(patch.rotating(), {view_.at(between(a, b, k), low), view_.at(between(a, b, k + 1), low),
                               view_.at(between(c, d, k + 1), high), view_.at(between(c, d, k), high)});
  }

  /// Only what shows its free side to the viewer.
  void facet(bool rotating, const std::array<Position, 4>& p) {
    const Position normal = cross(p[2] - p[0], p[3] - p[1]), to = View::towards();
    const double length = std::sqrt(dot(normal, normal));
    if (!(dot(normal, to) > 0)) return;
    const Position light{-0.8, -0.3, 0.52};
    const double bright = std::clamp(0.5 + 0.5 * dot(normal, light) / length, 0.0, 0.999);
    Facet f;
    for (std::size_t k = 0; k < 4; ++k) {
      f.corners[k] = view_.flat(p[k]);
      f.near += dot(p[k], to);
    }
    f.rotating = rotating;
    f.shade = static_cast<int>(kShades * bright);
    facets_.push_back(f);
  }

  const CspaceObstacle& obstacle_;
  const View& view_;
  double across_;
  std::vector<Facet> facets_;
};

/// Light for fixed patches, dark for rotating ones.
std::string styles() {
  std::string text = "<style>text{font-family:sans-serif;fill:#222}path{stroke-width:.5;stroke-linejoin:round}";
  const auto tone = [](double full, double shade) { return static_cast<int>(full * (0.55 + 0.45 * shade)); };
  for (int k = 0; k < kShades; ++k) {
    const double s = static_cast<double>(k) / (kShades - 1);
    char line[160];
    for (const auto& [name, r, g, b] : {std::tuple{'f', 250., 205., 120.}, std::tuple{'r', 40., 115., 185.}}) {
      const int red = tone(r, s), green = tone(g, s), blue = tone(b, s);
      std::snprintf(line, sizeof line, ".%c%d{fill:rgb(%d,%d,%d);stroke:rgb(%d,%d,%d)}", name, k, red, green, blue, red,
                    green, blue);
      text += line;
    }
  }
  return text + "</style>\n";
}

std::string caption(double x, double y, int size, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-size=\"" + std::to_string(size) + "\">" + text +
         "</text>\n";
}

std::string filled(const std::string& path, const std::string& fill, const std::string& stroke) {
  return "<path fill-rule=\"evenodd\" fill=\"" + fill + "\" stroke=\"" + stroke + "\" d=\"" + path + "\"/>\n";
}

std::string draw_slice(const CspaceObstacle& obstacle, const PlanarSum& slice, Frame frame) {
  const double side = 0.38 * kWidth - kMargin;
  frame.fit(kMargin, 110, side, kHeight - 110 - kMargin);
  return filled(path_of(slice, frame), "#dbe7f2", "#2873b9") +
         filled(path_of(obstacle.obstacle(), frame), "#c8c8c8", "#555") + caption(kMargin, 90, 15, "theta = 0");
}

std::string draw_solid(const Solid& solid, const View& view, const PlanarSum& cover) {
  Frame page;
  for (const Facet& f : solid.facets())
    for (const Point p : f.corners) page.add(p);
  const auto above = [&](Point p) { return view.flat(view.at(p, kPi)); };
  for (const SumPart& part : cover.parts)
    for (const SumVertex& v : part.outer.vertices) page.add(above(v.at));
  page.fit(0.4 * kWidth, 80, 0.6 * kWidth - kMargin, kHeight - 80 - kMargin);
  std::string text;
  for (const Facet& f : solid.facets()) {
    text += std::string("<path class=\"") + (f.rotating ? 'r' : 'f') + std::to_string(f.shade) + "\" d=\"";
    const char* command = "M";
    for (const Point p : f.corners) text += std::exchange(command, "L") + position(page(p));
    text += "z\"/>\n";
  }
  return text + filled(path_of(cover, [&](Point p) { return page(above(p)); }), "#f4f4f4", "#444");
}

}  // namespace

std::string draw_obstacle(const CspaceObstacle& obstacle, const std::string& title) {
  const PlanarSum slice = obstacle.slice(Orientation()).value();
  const PlanarSum cover = obstacle.slice(Orientation::half_turn()).value();
  Frame plan;
  for (const PlanarSum* sum : {&slice, &cover})
    for (const SumPart& part : sum->parts)
      for (const SumVertex& v : part.outer.vertices) plan.add(v.at);
  const double across = std::max(plan.width(), plan.height());
  const View view(1.1 * across);
  const Solid solid(obstacle, view, across);
  const std::string size = "width=\"" + number(kWidth) + "\" height=\"" + number(kHeight) + "\" viewBox=\"0 0 " +
                           number(kWidth) + " " + number(kHeight) + "\"";
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + ">\n" + styles() +
                     "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + caption(kMargin, 36, 20, title);
  text += caption(kMargin, 60, 14,
                  std::to_string(obstacle.patches().size()) + " patches, " + std::to_string(obstacle.shells().size()) +
                      " shells, " + std::to_string(obstacle.angles().size()) +
                      " event angles; light: fixed edges, dark: rotating edges; theta from -pi upwards to pi");
  return text + draw_slice(obstacle, slice, plan) + draw_solid(solid, view, cover) + "</svg>\n";
}

}  // namespace dymsum::bench
