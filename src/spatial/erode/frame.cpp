#include "spatial/erode/frame.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {

namespace {

struct Range {
  double low = 0, high = 0;
};

Range range_of(const MeshData& mesh, double Point3::*axis) {
  Range range{mesh.vertices[0].*axis, mesh.vertices[0].*axis};
  for (const Point3& v : mesh.vertices) range = {std::min(range.low, v.*axis), std::max(range.high, v.*axis)};
  return range;
}

/// Ends may be rounded ones, off by an ulp.
bool fits(Range a, Range b) {
  const double ulps = 0x1p-50 * std::max({-a.low, a.high, -b.low, b.high});
  return !(b.high / 2 - b.low / 2 > (a.high / 2 - a.low / 2) * (1 + 0x1p-40) + ulps + 0x1p-1000);
}

constexpr double kLargestFramed = 0x1p1000;

}  // namespace

std::array<double, 2> framed(double low, double high, double length) {
  const double far = std::max({std::abs(low), std::abs(high), 0x1p-1000});
  const double unit = std::ldexp(1.0, std::max(std::ilogb(std::max(length, 0x1p-1000)), std::ilogb(far) - 50));
  return {(std::floor(low / unit) - 3) * unit, (std::ceil(high / unit) + 3) * unit};
}

bool fits_lengthwise(const MeshData& a, const MeshData& b) {
  return fits(range_of(a, &Point3::x), range_of(b, &Point3::x)) &&
         fits(range_of(a, &Point3::y), range_of(b, &Point3::y)) &&
         fits(range_of(a, &Point3::z), range_of(b, &Point3::z));
}

Result<MeshData> framed_complement(const MeshData& a, const MeshData& b) {
  for (std::size_t k = 0; k < a.vertices.size(); ++k) {
    const Point3& v = a.vertices[k];
    if (std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kLargestFramed) continue;
    Error error{ErrorCode::unsupported_operand,
                "a coordinate is larger than 2^1000, too large to look for room inside a solid",
                {}};
    error.evidence.vertex = static_cast<std::int64_t>(k);
    error.evidence.x = v.x, error.evidence.y = v.y, error.evidence.z = v.z;
    return error;
  }
  const auto frame = [&](double Point3::*axis) {
    const Range of_a = range_of(a, axis), of_b = range_of(b, axis);
    const auto [low, high] = framed(of_a.low, of_a.high, of_b.high - of_b.low);
    return Range{low, high};
  };
  const Range x = frame(&Point3::x), y = frame(&Point3::y), z = frame(&Point3::z);
  MeshData all;
  all.vertices = a.vertices;
  for (const Face& face : a.faces) all.faces.emplace_back(face.rbegin(), face.rend());
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const double at_z : {z.low, z.high})
    for (const auto& [at_x, at_y] :
         {std::pair{x.low, y.low}, std::pair{x.high, y.low}, std::pair{x.high, y.high}, std::pair{x.low, y.high}})
      all.vertices.push_back({at_x, at_y, at_z});
  for (const Face& face :
       {Face{3, 2, 1, 0}, Face{4, 5, 6, 7}, Face{0, 1, 5, 4}, Face{1, 2, 6, 5}, Face{2, 3, 7, 6}, Face{3, 0, 4, 7}}) {
    Face& added = all.faces.emplace_back(face);
    for (std::uint32_t& v : added) v += first;
  }
  return all;
}

}  // namespace dymsum::spatial
