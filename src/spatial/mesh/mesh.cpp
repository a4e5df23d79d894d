// What a mesh reports about itself, and moving meshes.
#include "dymsum/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/doubles.h"
#include "dymsum/volume_text.h"
#include "exact/big.h"
#include "exact/rational_text.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/scaled_number.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/thin_faces.h"

namespace dymsum {

namespace {

/// Every vertex through f; with `reverse`, faces run the other way round from the same first vertex.
template <class F>
MeshData mapped(const Mesh& mesh, F f, bool reverse) {
  MeshData data = mesh.data();
  std::transform(data.vertices.begin(), data.vertices.end(), data.vertices.begin(), f);
  if (!reverse) return data;
  for (Face& face : data.faces) std::reverse(face.begin() + 1, face.end());
  return data;
}

/// Validated as the mesh was.
Result<Mesh> checked_like(const Mesh& mesh, MeshData data) {
  return mesh.has_thin_parts() ? Mesh::with_thin_parts(std::move(data)) : Mesh::create(std::move(data));
}

/// Twice the area of a face whose coordinates are at most 1 in magnitude.
double doubled_area(const std::vector<Point3>& vertices, const Face& face, int exponent) {
  const auto from_first = [&](std::uint32_t v) {
    const Point3 &p = vertices[v], &first = vertices[face[0]];
    const auto unit = [exponent](double a, double b) { return std::scalbn(a, -exponent) - std::scalbn(b, -exponent); };
    return Point3{unit(p.x, first.x), unit(p.y, first.y), unit(p.z, first.z)};
  };
  if (face.size() < 3) return 0;
  Point3 sum, a = from_first(face[1]);
  for (std::size_t i = 2; i < face.size(); ++i) {
    const Point3 b = from_first(face[i]);
    sum = {sum.x + (a.y * b.z - a.z * b.y), sum.y + (a.z * b.x - a.x * b.z), sum.z + (a.x * b.y - a.y * b.x)};
    a = b;
  }
  return base::hypot3(sum.x, sum.y, sum.z);
}

spatial::ScaledNumber surface_of(const Mesh& mesh) {
  double largest = 0;
  for (const double v : bounds(mesh)) largest = std::max(largest, std::abs(v));
  if (largest == 0) return {};
  // a power of two keeps products within the double range
  const int exponent = std::ilogb(largest) + 1;
  double doubled = 0;
  for (const Face& face : mesh.faces()) doubled += doubled_area(mesh.vertices(), face, exponent);
  return {doubled / 2, 2 * exponent};
}

}  // namespace

std::size_t Mesh::edge_count() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Face& face : faces()) {
    for (std::size_t k = 0; face.size() > 1 && k < face.size(); ++k)
      pairs.push_back(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  std::sort(pairs.begin(), pairs.end());
  return static_cast<std::size_t>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
}

std::size_t Mesh::triangle_count() const {
  std::size_t count = 0;
  for (const Face& face : faces()) count += std::max<std::size_t>(face.size(), 2) - 2;
  return count;
}

double volume(const Mesh& mesh) { return exact::round_to_double(spatial::exact_volume(spatial::solid_part(mesh))); }

double surface_area(const Mesh& mesh) { return surface_of(mesh).nearest(); }

std::string volume_text(const Mesh& mesh) {
  return exact::decimal_text(spatial::exact_volume(spatial::solid_part(mesh)), 17);
}

std::string surface_text(const Mesh& mesh) { return surface_of(mesh).text(); }

std::array<double, 6> bounds(const Mesh& mesh) {
  if (mesh.empty()) return {};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Point3& p : mesh.vertices()) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // Zero has no sign.
  return {low.x + 0.0, low.y + 0.0, low.z + 0.0, high.x + 0.0, high.y + 0.0, high.z + 0.0};
}

Mesh negated(const Mesh& mesh) {
  // Subtracting from zero leaves no negative zeros. A reflection through a point turns every face over.
  const auto reflect = [](const Point3& p) { return Point3{0 - p.x, 0 - p.y, 0 - p.z}; };
  return spatial::trusted_mesh(mapped(mesh, reflect, true), mesh.shell_count(), mesh.thin_faces());
}

Result<Mesh> translated(const Mesh& mesh, double dx, double dy, double dz) {
  return checked_like(mesh, mapped(
                                mesh,
                                [=](const Point3& p) {
                                  return Point3{p.x + dx, p.y + dy, p.z + dz};
                                },
                                false));
}

Result<Mesh> scaled(const Mesh& mesh, double sx, double sy, double sz) {
  for (const double s : {sx, sy, sz}) {
    if (std::isfinite(s) && s != 0) continue;
    return Error{ErrorCode::unsupported_operand, "a scale factor is zero or not finite", {}};
  }
  const bool reflects = (sx < 0) != ((sy < 0) != (sz < 0));
  return checked_like(mesh, mapped(
                                mesh,
                                [=](const Point3& p) {
                                  return Point3{p.x * sx, p.y * sy, p.z * sz};
                                },
                                reflects));
}

}  // namespace dymsum
