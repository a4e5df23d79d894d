#include "spatial/mesh/face_axes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dymsum::spatial {

namespace {

/// A face's plane, as doubles see it.
struct Plate {
  std::uint32_t face = 0;
  Vec3 area;             ///< normal, twice as long as the face is large
  double longest = 0;    ///< its longest edge
  double tilt = 0;       ///< by this sine a normal may be off
  bool by_three = true;  ///< three vertices always lie in a plane
  double size() const { return length(area); }
};

Vec3 at(const MeshData& data, std::uint32_t v) {
  const Point3& p = data.vertices[v];
  return {p.x, p.y, p.z};
}

std::vector<Plate> plates_of(const MeshData& data, std::span<const std::uint32_t> faces, double tolerance) {
  std::vector<Plate> plates;
  for (const std::uint32_t f : faces) {
    const Face& face = data.faces[f];
    Plate plate;
    plate.face = f, plate.by_three = face.size() == 3;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3 a = at(data, face[k]) - at(data, face[0]),
                 b = at(data, face[(k + 1) % face.size()]) - at(data, face[0]);
      plate.area = plate.area + cross(a, b);
      plate.longest = std::max(plate.longest, length(b - a));
    }
    // Moving a vertex by the tolerance tilts the face by that over its height.
    const double height = plate.longest > 0 ? plate.size() / plate.longest : 0;
    if (!(height > 4 * tolerance)) continue;
    plate.tilt = tolerance / height;
    plates.push_back(plate);
  }
  std::sort(plates.begin(), plates.end(), [](const Plate& a, const Plate& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.face < b.face;
  });
  return plates;
}

/// Faces with one normal or its opposite.
struct Family {
  Vec3 normal;
  double area = 0;
  std::vector<const Plate*> plates;
};

bool parallel(const Plate& a, const Plate& b) {
  return length(cross(a.area, b.area)) <= (a.tilt + b.tilt) * a.size() * b.size();
}

/// Families of parallel faces around the largest faces, those that say more than that three points lie in a plane.
std::vector<Family> families_of(const std::vector<Plate>& plates) {
  constexpr std::size_t kMost = 32;  // seeds, so that the cost is linear
  std::vector<Family> families;
  std::vector<bool> taken(plates.size());
  std::size_t seeds = 0;
  for (std::size_t s = 0; s < plates.size() && seeds < kMost; ++s) {
    if (taken[s]) continue;
    ++seeds;
    Family family;
    Vec3 sum;
    for (std::size_t k = s; k < plates.size(); ++k) {
      if (taken[k] || !parallel(plates[s], plates[k])) continue;
      taken[k] = true;
      sum = dot(plates[k].area, plates[s].area) < 0 ? sum - plates[k].area : sum + plates[k].area;
      family.area += plates[k].size();
      family.plates.push_back(&plates[k]);
    }
    if (family.plates.size() == 1 && plates[s].by_three) continue;
    family.normal = (1 / length(sum)) * sum;
    families.push_back(std::move(family));
  }
  std::stable_sort(families.begin(), families.end(), [](const Family& a, const Family& b) { return a.area > b.area; });
  return families;
}

double tilt_of(const Family& family) { return family.plates.front()->tilt; }

/// The normal at a right angle to n, of what is nearly so.
Vec3 orthogonal_to(Vec3 n, Vec3 v) {
  const Vec3 rest = v - dot(n, v) * n;
  return (1 / length(rest)) * rest;
}

Vec3 longest_edge(const MeshData& data, const Family& family) {
  Vec3 longest;
  for (const Plate* plate : family.plates) {
    const Face& face = data.faces[plate->face];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3 edge = at(data, face[(k + 1) % face.size()]) - at(data, face[k]);
      if (length(edge) > length(longest)) longest = edge;
    }
  }
  return longest;
}

FaceAxes orthogonal_axes(Vec3 first, Vec3 second) { return {first, second, cross(first, second)}; }

/// The directions in which the planes of three families meet, two by two.
FaceAxes axes_of_planes(Vec3 a, Vec3 b, Vec3 c) {
  FaceAxes axes{cross(b, c), cross(c, a), cross(a, b)};
  for (Vec3& axis : axes) axis = (1 / length(axis)) * axis;
  if (dot(axes[0], cross(axes[1], axes[2])) < 0)
    for (Vec3& axis : axes) axis = -axis;
  return axes;
}

}  // namespace

std::optional<FaceAxes> face_axes(const MeshData& data, std::span<const std::uint32_t> faces, double tolerance) {
  const std::vector<Plate> plates = plates_of(data, faces, tolerance);
  const std::vector<Family> families = families_of(plates);
  if (families.empty()) return std::nullopt;
  const Family& first = families[0];
  for (std::size_t k = 1; k < families.size(); ++k) {
    const double cosine = std::abs(dot(first.normal, families[k].normal));
    if (cosine <= tilt_of(first) + tilt_of(families[k]))
      return orthogonal_axes(first.normal, orthogonal_to(first.normal, families[k].normal));
  }
  constexpr double kFlat = 0.1;  // the sine or determinant of planes that are no good coordinates
  for (std::size_t j = 1; j < families.size(); ++j) {
    for (std::size_t k = j + 1; k < families.size(); ++k) {
      const Vec3 a = first.normal, b = families[j].normal, c = families[k].normal;
      if (std::abs(dot(a, cross(b, c))) > kFlat) return axes_of_planes(a, b, c);
    }
  }
  return orthogonal_axes(first.normal, orthogonal_to(first.normal, longest_edge(data, first)));
}

namespace {

bool has_axis(const FaceAxes& axes, const Vec3& u, double angle) {
  return std::any_of(axes.begin(), axes.end(), [&](const Vec3& v) { return length(cross(u, v)) <= angle; });
}

}  // namespace

bool same_axes(const FaceAxes& a, const FaceAxes& b, double angle) {
  return std::all_of(a.begin(), a.end(), [&](const Vec3& u) { return has_axis(b, u, angle); });
}

bool have_common_axis(const FaceAxes& a, const FaceAxes& b, double angle) {
  return std::any_of(a.begin(), a.end(), [&](const Vec3& u) { return has_axis(b, u, angle); });
}

}  // namespace dymsum::spatial
