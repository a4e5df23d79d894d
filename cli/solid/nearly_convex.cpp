#include "solid/nearly_convex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <vector>

#include "inputs.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

using Vector = std::array<double, 3>;

/// The largest rounding of a solid, as a fraction of its size; what is reflex by more is a shape of its own.
constexpr double kRounding = 1e-12;

Vector minus(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The plane of a face, and its edges with their faces.
struct Plane {
  Point3 at;
  Vector normal{};
};
struct Side {
  std::uint32_t low, high, face;
};

class Bends {
 public:
  explicit Bends(const Mesh& mesh) : mesh_(mesh) {
    for (const Face& face : mesh.faces()) planes_.push_back(plane_of(face));
  }

  /// How far the faces at an edge rise over each other at most, by the better one of their two planes.
  double deepest() const {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < mesh_.faces().size(); ++f) {
      const Face& face = mesh_.faces()[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
        sides.push_back({low, high, f});
      }
    }
    const auto ends = [](const Side& s) { return std::pair(s.low, s.high); };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return ends(a) < ends(b); });
    double deepest = 0;
    for (std::size_t k = 1; k < sides.size(); ++k) {
      if (ends(sides[k - 1]) != ends(sides[k])) continue;
      const std::uint32_t f = sides[k - 1].face, g = sides[k].face;
      deepest = std::max(deepest, std::min(rise(f, g), rise(g, f)));
    }
    return deepest;
  }

 private:
  Plane plane_of(const Face& face) const {
    const std::vector<Point3>& v = mesh_.vertices();
    Plane plane{v[face[0]], {}};
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Vector part = cross(minus(v[face[k - 1]], plane.at), minus(v[face[k]], plane.at));
      for (std::size_t i = 0; i < 3; ++i) plane.normal[i] += part[i];
    }
    const double size = length_of(plane.normal[0], plane.normal[1], plane.normal[2]);
    for (double& n : plane.normal) n = size > 0 ? n / size : 0;
    return plane;
  }
  double rise(std::uint32_t over, std::uint32_t face) const {
    const Plane& plane = planes_[over];
    double most = 0;
    for (const std::uint32_t v : mesh_.faces()[face]) {
      const Vector to = minus(mesh_.vertices()[v], plane.at);
      most = std::max(most, to[0] * plane.normal[0] + to[1] * plane.normal[1] + to[2] * plane.normal[2]);
    }
    return most;
  }

  const Mesh& mesh_;
  std::vector<Plane> planes_;
};

}  // namespace

void report_nearly_convex(const SolidInput& input) {
  const Mesh& mesh = input.mesh;
  if (mesh.shell_count() != 1 || mesh.has_thin_parts() || !convexity_error(mesh)) return;
  const std::array<double, 6> box = bounds(mesh);
  const double size = length_of(box[3] - box[0], box[4] - box[1], box[5] - box[2]), deepest = Bends(mesh).deepest();
  if (!(deepest <= kRounding * size)) return;
  std::cerr << shown_file(input.file) << ": convex but for edges that are reflex by " << deepest
            << " at most: --hull takes its convex hull, which is much faster\n";
}

}  // namespace dymsum::cli
