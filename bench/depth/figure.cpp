// Figure 7.4 of the thesis: whole sums above, the parts that a ball meets below.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "depth/continuous.h"
#include "dymsum/local_sum.h"
#include "dymsum/shapes.h"
#include "dymsum/solids.h"
#include "page.h"
#include "solid/inputs.h"

namespace dymsum::bench {
namespace {

constexpr double kPanel = 300, kGap = 20, kTop = 60;

/// Seen from (1, -2, 1.2), z upwards on the page.
struct View {
  Point3 centre;
  double scale = 1, x0 = 0, y0 = 0;

  static constexpr double kC = 0.4472135955, kS = 0.894427191, kU = 0.4724, kV = 0.8814;  // turns of the camera
  Point3 turned(const Point3& v) const {
    const double x = kS * (v.x - centre.x) + kC * (v.y - centre.y), y = -kC * (v.x - centre.x) + kS * (v.y - centre.y);
    const double z = v.z - centre.z;
    return {x, kV * z + kU * y, kV * y - kU * z};  // right, up, away
  }
  std::array<double, 2> page(const Point3& turned_point) const {
    return {x0 + scale * turned_point.x, y0 - scale * turned_point.y};
  }
};

struct Drawn {
  double away;
  std::string text;
};

/// Faces that look at us, the furthest first, shaded by how they face the light.
void draw_faces(std::ostringstream& out, const View& view, const SpatialSum& sum, std::array<double, 3> colour,
                bool both_sides) {
  const SpatialSum::Rounded all = sum.drawn();
  std::vector<Drawn> list;
  for (const Face& f : all.mesh.faces) {
    std::array<Point3, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = view.turned(all.mesh.vertices[f[k]]);
    const Point3 a{v[1].x - v[0].x, v[1].y - v[0].y, v[1].z - v[0].z},
        b{v[2].x - v[0].x, v[2].y - v[0].y, v[2].z - v[0].z};
    // Right, up, away is a left-handed system.
    const Point3 n{a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x, a.y * b.x - a.x * b.y};
    const double size = std::hypot(n.x, n.y, n.z);
    const bool front = n.z < 0;
    if (size == 0 || (!front && !both_sides)) continue;
    const double light = front ? 0.45 + 0.55 * std::max(0.0, (-0.35 * n.x + 0.5 * n.y - 0.79 * n.z) / size) : 0.35;
    std::ostringstream path;
    path.precision(1), path << std::fixed << "<path d='M";
    for (std::size_t k = 0; k < 3; ++k) path << (k > 0 ? "L" : "") << view.page(v[k])[0] << " " << view.page(v[k])[1];
    char shade[8];
    std::snprintf(shade, sizeof shade, "#%02x%02x%02x", static_cast<int>(light * colour[0]),
                  static_cast<int>(light * colour[1]), static_cast<int>(light * colour[2]));
    path << "Z' fill='" << shade << "' stroke='" << (both_sides ? "#2d5a36" : shade) << "' stroke-width='0.6'/>\n";
    list.push_back({std::max({v[0].z, v[1].z, v[2].z}), path.str()});
  }
  std::stable_sort(list.begin(), list.end(), [](const Drawn& a, const Drawn& b) { return a.away > b.away; });
  for (const Drawn& one : list) out << one.text;
}

struct FigurePair {
  std::string name;
  MeshData p, q;
};

MeshData scaled_data(MeshData m, double x, double y, double z) {
  for (Point3& v : m.vertices) v = {x * v.x, y * v.y, z * v.z};
  return m;
}

std::vector<FigurePair> figure_pairs() {
  const Ring channel = shapes::letter_u(4, 4, 1).parts()[0].outer;
  return {{"cone + crossing bars", solids::cone(40, 2, 3, solids::kDemoSnap).data(), grate(2)},
          {"ellipsoid + channel", scaled_data(blob(1, 0.1, 12, 12, 4), 0.5, 0.5, 1.5),
           solids::prism(channel, 3, solids::kDemoSnap).data()},
          {"blob + torus", blob(1, 0.3, 14, 14, 1), torus(1.5, 0.3, 24, 10)},
          {"torus + torus", torus(1, 0.3, 24, 10), turned(torus(1, 0.3, 24, 10), 0.7, 0.3, 0.2)}};
}

void draw_pair(std::ostringstream& out, const FigurePair& pair, double left) {
  const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
  const SpatialSum sum = minkowski_sum(p, q).value();
  Point3 low = sum.vertices.front(), high = low;
  for (const Point3& v : sum.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const double diagonal = std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
  View view{{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2},
            1.15 * kPanel / diagonal,
            left + kPanel / 2,
            kTop + kPanel / 2};
  out << "<text x='" << left + kPanel / 2 << "' y='" << kTop - 12 << "' text-anchor='middle'>" << pair.name << ", "
      << sum.faces.size() << " faces</text>\n";
  draw_faces(out, view, sum, {205, 205, 210}, false);
  // A fifth of the sum's radius, as there; about the vertex nearest to us.
  const Point3* near = &sum.vertices.front();
  for (const Point3& v : sum.vertices)
    if (view.turned(v).z < view.turned(*near).z) near = &v;
  const ClipBall ball{*near, diagonal / 10};
  const auto circle = [&](const View& from) {
    const std::array<double, 2> at = from.page(from.turned(ball.centre));
    out << "<circle cx='" << fixed(at[0], 1) << "' cy='" << fixed(at[1], 1) << "' r='"
        << fixed(from.scale * ball.radius, 1) << "' fill='none' stroke='#d81e3a' stroke-width='1.5'/>\n";
  };
  circle(view);
  const LocalPart part = LocalSum::create(p, q).value().in(ball).value();
  view.centre = ball.centre, view.scale *= 3, view.y0 += kPanel + kGap;
  draw_faces(out, view, part.boundary, {120, 200, 130}, true);
  circle(view);
  out << "<text x='" << left + kPanel / 2 << "' y='" << kTop + 2 * kPanel + kGap + 18 << "' text-anchor='middle'>"
      << part.boundary.faces.size() << " faces meet the ball</text>\n";
}

}  // namespace

std::string figure_7_4() {
  const std::vector<FigurePair> pairs = figure_pairs();
  const double width = static_cast<double>(pairs.size()) * (kPanel + kGap) + kGap;
  std::ostringstream out;
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << " " << 2 * kPanel + kGap + kTop + 40
      << "' font-family='sans-serif' font-size='14'>\n<rect width='100%' height='100%' fill='white'/>\n"
      << "<text x='" << kGap
      << "' y='24' font-size='16'>Whole sums, and below, enlarged, what of them a ball meets "
         "(figure 7.4 of the thesis, with stand-ins)</text>\n";
  for (std::size_t k = 0; k < pairs.size(); ++k)
    draw_pair(out, pairs[k], kGap + static_cast<double>(k) * (kPanel + kGap));
  out << "</svg>\n";
  return out.str();
}

}  // namespace dymsum::bench
