// Generators of solids. Only +, -, *, / and square roots, which IEEE rounds correctly, and circle points made of them:
// the same arguments give the same coordinates everywhere.
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "dymsum/rational.h"
#include "dymsum/solids.h"
#include "planar/shapes/shapes.h"

namespace dymsum::solids {

// Generators of solids. Only +, -, *, / and square roots, which IEEE rounds correctly, and circle points made of them:
// the same arguments give the same coordinates everywhere.

namespace {

void require(bool condition, std::string_view solid) {
  if (!condition) throw std::invalid_argument(std::string(solid) + ": these arguments give no valid solid");
}

Mesh made(std::string_view solid, MeshData data) {
  Result<Mesh> mesh = Mesh::create(std::move(data));
  if (!mesh) throw std::invalid_argument(std::string(solid) + ": " + mesh.error().to_string());
  return std::move(mesh).value();
}

/// The hull of the points, snapped, with its faces split into triangles. Requires that every one of the
/// `count` different points is a corner of it: then there are 2 count - 4 triangles.
Mesh hull_of(std::string_view solid, std::vector<Point3> points, std::size_t count, double snap) {
  const shapes::Snap to(solid, snap);
  for (Point3& p : points) p = {to(p.x), to(p.y), to(p.z)};
  const Result<Mesh> hull = convex_hull(points);
  if (!hull) throw std::invalid_argument(std::string(solid) + ": " + hull.error().to_string());
  require(hull->vertices().size() == count, solid);
  MeshData data{hull->vertices(), {}};
  for (const Face& face : hull->faces()) {
    for (std::size_t k = 2; k < face.size(); ++k) data.faces.push_back({face[0], face[k - 1], face[k]});
  }
  return made(solid, std::move(data));
}

void add_ring(std::vector<Point3>& points, int sides, double rx, double ry, double z) {
  for (int k = 0; k < sides; ++k) {
    const Point p = shapes::circle_point(k, sides);
    points.push_back({rx * p.x, ry * p.y, z});
  }
}

constexpr std::size_t size(int n) { return static_cast<std::size_t>(n); }

Point3 times(double s, const Point3& p) { return {s * p.x, s * p.y, s * p.z}; }
Point3 plus(const Point3& p, const Point3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
double length(const Point3& p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }

double golden_ratio() { return (1 + std::sqrt(5.0)) / 2; }

/// The 12 vertices of an icosahedron with edges of length 2.
std::vector<Point3> icosahedron() {
  const double g = golden_ratio();
  std::vector<Point3> points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      points.push_back({0, a, b});
      points.push_back({a, b, 0});
      points.push_back({b, 0, a});
    }
  }
  return points;
}

/// Its 20 faces, each with its vertices in ascending order: the triples with three edges.
std::vector<std::array<std::size_t, 3>> icosahedron_faces(const std::vector<Point3>& points) {
  const auto edge = [&](std::size_t i, std::size_t j) { return length(plus(points[i], times(-1, points[j]))) < 2.5; };
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        if (edge(i, j) && edge(j, k) && edge(i, k)) faces.push_back({i, j, k});
      }
    }
  }
  return faces;
}

}  // namespace

Mesh box(double x0, double y0, double z0, double x1, double y1, double z1, double snap) {
  const shapes::Snap to("box", snap);
  MeshData data;
  for (const double z : {z0, z1}) {
    for (const double y : {y0, y1}) {
      for (const double x : {x0, x1}) data.vertices.push_back({to(x), to(y), to(z)});
    }
  }
  data.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return made("box", std::move(data));
}

Mesh prism(const Ring& base, double height, double snap) {
  require(height > 0, "prism");
  const shapes::Snap to("prism", snap);
  MeshData data;
  const auto n = static_cast<std::uint32_t>(base.size());
  for (const double z : {0.0, height})
    for (const Point& p : base) data.vertices.push_back({to(p.x), to(p.y), to(z)});
  Face bottom, top;
  for (std::uint32_t k = 0; k < n; ++k) {
    bottom.push_back(n - 1 - k);
    top.push_back(n + k);
    data.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  data.faces.push_back(std::move(bottom));
  data.faces.push_back(std::move(top));
  return made("prism", std::move(data));
}

Mesh cone(int sides, double radius, double height, double snap) {
  require(sides >= 3 && radius > 0 && height > 0, "cone");
  std::vector<Point3> points{{0, 0, height}};
  add_ring(points, sides, radius, radius, 0);
  return hull_of("cone", std::move(points), size(sides) + 1, snap);
}

Mesh pyramid(int sides, double radius, double height, double snap) { return cone(sides, radius, height, snap); }

Mesh cylinder(int sides, double radius, double height, double snap) {
  require(sides >= 3 && radius > 0 && height > 0, "cylinder");
  std::vector<Point3> points;
  add_ring(points, sides, radius, radius, 0);
  add_ring(points, sides, radius, radius, height);
  return hull_of("cylinder", std::move(points), 2 * size(sides), snap);
}

Mesh dipyramid(int sides, double radius, double height, double snap) {
  require(sides >= 3 && radius > 0 && height > 0, "dipyramid");
  std::vector<Point3> points{{0, 0, -height}, {0, 0, height}};
  add_ring(points, sides, radius, radius, 0);
  return hull_of("dipyramid", std::move(points), size(sides) + 2, snap);
}

Mesh geodesic_sphere(int frequency, double radius, double snap) {
  require(frequency >= 1 && radius > 0, "geodesic_sphere");
  const std::vector<Point3> corners = icosahedron();
  const double n = frequency;
  std::vector<Point3> points;
  // A point of an edge is the same sum in both faces, because faces list their vertices in ascending order.
  for (const auto& [a, b, c] : icosahedron_faces(corners)) {
    for (int i = 0; i <= frequency; ++i) {
      for (int j = 0; i + j <= frequency; ++j) {
        const double k = frequency - i - j;
        const Point3 p = plus(plus(times(i / n, corners[a]), times(j / n, corners[b])), times(k / n, corners[c]));
        points.push_back(times(radius / length(p), p));
      }
    }
  }
  return hull_of("geodesic_sphere", std::move(points), 10 * size(frequency) * size(frequency) + 2, snap);
}

Mesh ellipsoid(int slices, int stacks, double rx, double ry, double rz, double snap) {
  require(slices >= 3 && stacks >= 2 && rx > 0 && ry > 0 && rz > 0, "ellipsoid");
  std::vector<Point3> points{{0, 0, -rz}, {0, 0, rz}};
  for (int k = 1; k < stacks; ++k) {
    const Point p = shapes::circle_point(k, 2 * stacks);  // from pole to pole
    add_ring(points, slices, rx * p.y, ry * p.y, rz * p.x);
  }
  return hull_of("ellipsoid", std::move(points), size(slices) * size(stacks - 1) + 2, snap);
}

Mesh rod(int slices, int stacks, double radius, double length, double snap) {
  require(slices >= 3 && stacks >= 3 && stacks % 2 == 1 && radius > 0 && length > 0, "rod");
  const double half = length / 2;
  std::vector<Point3> points{{0, 0, -half - radius}, {0, 0, half + radius}};
  const int rings = (stacks - 1) / 2;  // of each end
  for (int k = 1; k <= rings; ++k) {
    const Point p = shapes::circle_point(k, 4 * rings);  // from the pole to the equator
    add_ring(points, slices, radius * p.y, radius * p.y, half + radius * p.x);
    add_ring(points, slices, radius * p.y, radius * p.y, -half - radius * p.x);
  }
  return hull_of("rod", std::move(points), size(slices) * size(stacks - 1) + 2, snap);
}

Mesh triakis_icosahedron(double radius, double snap) {
  require(radius > 0, "triakis_icosahedron");
  std::vector<Point3> corners = icosahedron();
  // The edges have length 2: the short edges are (15 - sqrt 5) / 11; an apex stands above a face's centre, which is at
  // g^2 / sqrt 3 from the centre and 2 / sqrt 3 from the corners.
  const double g = golden_ratio(), edge = (15 - std::sqrt(5.0)) / 11;
  const double distance = g * g / std::sqrt(3.0) + std::sqrt(edge * edge - 4.0 / 3);
  std::vector<Point3> points;
  const double scale = radius / length(corners[0]);
  for (const auto& [a, b, c] : icosahedron_faces(corners)) {
    const Point3 centre = plus(plus(corners[a], corners[b]), corners[c]);
    points.push_back(times(scale * distance / length(centre), centre));
  }
  for (const Point3& p : corners) points.push_back(times(scale, p));
  return hull_of("triakis_icosahedron", std::move(points), 32, snap);
}

Mesh truncated_icosidodecahedron(double radius, double snap) {
  require(radius > 0, "truncated_icosidodecahedron");
  const double g = golden_ratio(), h = g - 1;  // h = 1 / g
  // all signs and even permutations of these: 120 points
  const std::array<Point3, 5> seeds = {
      {{h, h, 3 + g}, {2 * h, g, 1 + 2 * g}, {h, g * g, 3 * g - 1}, {2 * g - 1, 2, 2 + g}, {g, 3, 2 * g}}};
  std::vector<Point3> points;
  for (const Point3& seed : seeds) {
    const Point3 s = times(radius / length(seed), seed);
    for (int signs = 0; signs < 8; ++signs) {
      const double x = signs & 1 ? -s.x : s.x, y = signs & 2 ? -s.y : s.y, z = signs & 4 ? -s.z : s.z;
      points.push_back({x, y, z});
      points.push_back({y, z, x});
      points.push_back({z, x, y});
    }
  }
  return hull_of("truncated_icosidodecahedron", std::move(points), 120, snap);
}

std::vector<NamedMesh> thesis_models() {
  return {{"cone", cone(40, 1, 2, kDemoSnap)},
          {"cube", tessellated_cube(2, 1, kDemoSnap)},
          {"cylinder", cylinder(36, 1, 2, kDemoSnap)},
          {"DD", dipyramid(16, 1, 1.5, kDemoSnap)},
          {"ellipse", ellipsoid(32, 16, 1, 0.75, 0.5, kDemoSnap)},
          {"GS1", geodesic_sphere(2, 1, kDemoSnap)},
          {"GS2", geodesic_sphere(3, 1, kDemoSnap)},
          {"GS3", geodesic_sphere(4, 1, kDemoSnap)},
          {"GS4", geodesic_sphere(5, 1, kDemoSnap)},
          {"HP", pyramid(6, 1, 1.5, kDemoSnap)},
          {"T", triakis_icosahedron(1, kDemoSnap)},
          {"TI", truncated_icosidodecahedron(1, kDemoSnap)},
          {"v-rod", rod(27, 7, 0.25, 2, kDemoSnap)}};
}

// The cube whose faces are split into a grid.

namespace {

/// The lattice points of a cube's surface, numbered as they are requested.
class CubeLattice {
 public:
  CubeLattice(double size, int k, double snap)
      : size_(Rational::of(size).value()), k_(k), snap_("tessellated_cube", snap) {}

  std::uint32_t vertex(int x, int y, int z) {
    const auto [at, added] = numbers_.try_emplace({x, y, z}, static_cast<std::uint32_t>(vertices_.size()));
    if (added) vertices_.push_back({coordinate(x), coordinate(y), coordinate(z)});
    return at->second;
  }
  std::vector<Point3> vertices() && { return std::move(vertices_); }

 private:
  /// size (i / k - 1 / 2), rounded once.
  double coordinate(int i) const {
    return snap_((size_ * Rational::of(2 * std::int64_t{i} - k_, 2 * std::int64_t{k_}).value()).to_double());
  }

  Rational size_;
  int k_;
  shapes::Snap snap_;
  std::map<std::tuple<int, int, int>, std::uint32_t> numbers_;
  std::vector<Point3> vertices_;
};

/// The square at (i, j) of the face whose outside is the positive (or negative) end of `axis`, as two triangles.
void add_square(std::vector<Face>& faces, CubeLattice& lattice, int axis, int level, bool outwards, int i, int j) {
  const auto at = [&](int u, int v) {
    if (axis == 0) return lattice.vertex(level, u, v);
    if (axis == 1) return lattice.vertex(v, level, u);
    return lattice.vertex(u, v, level);
  };
  std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
  if (!outwards) std::swap(b, d);
  faces.push_back({a, b, c});
  faces.push_back({a, c, d});
}

}  // namespace

Mesh tessellated_cube(double size, int k, double snap) {
  if (!(size > 0) || !std::isfinite(size) || k < 1)
    throw std::invalid_argument("tessellated_cube: these arguments give no valid solid");
  CubeLattice lattice(size, k, snap);
  MeshData data;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool outwards : {false, true}) {
      for (int i = 0; i < k; ++i) {
        for (int j = 0; j < k; ++j) add_square(data.faces, lattice, axis, outwards ? k : 0, outwards, i, j);
      }
    }
  }
  data.vertices = std::move(lattice).vertices();
  Result<Mesh> mesh = Mesh::create(std::move(data));
  if (!mesh) throw std::invalid_argument("tessellated_cube: " + mesh.error().to_string());
  return std::move(mesh).value();
}

}  // namespace dymsum::solids
