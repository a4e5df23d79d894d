// Points as real files have them: on a grid, in decimals, in single precision, with what rounding leaves of zeros,
// turned, and turned far from the origin.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "oracles/vertices_by.h"

namespace dymsum {

enum class CoordinateKind { grid, decimals, single_precision, noise, turned, turned_far };
inline constexpr std::array kCoordinateKinds{
    CoordinateKind::grid,  CoordinateKind::decimals, CoordinateKind::single_precision,
    CoordinateKind::noise, CoordinateKind::turned,   CoordinateKind::turned_far};

inline std::string name_of(CoordinateKind kind) {
  constexpr std::array kNames{"grid", "decimals", "single precision", "noise", "turned", "turned far"};
  return kNames[static_cast<std::size_t>(kind)];
}
/// The same as part of a test's name.
inline std::string test_name_of(CoordinateKind kind) {
  std::string name = name_of(kind);
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
}

/// By 30 degrees about z, then about x, in doubles.
inline Point3 turned(Point3 p) {
  const double c = std::cos(std::acos(-1.0) / 6), s = std::sin(std::acos(-1.0) / 6);
  const double x = c * p.x - s * p.y, y = s * p.x + c * p.y;
  return {x, c * y - s * p.z, s * y + c * p.z};
}

inline Point3 of_kind(Point3 p, CoordinateKind kind, std::mt19937_64& random) {
  const auto each = [&](auto f) { return Point3{f(p.x), f(p.y), f(p.z)}; };
  switch (kind) {
    case CoordinateKind::grid:
      return each([](double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; });
    case CoordinateKind::decimals:
      return each([](double v) { return std::nearbyint(v * 1e4 / 7) / 1e4; });
    case CoordinateKind::single_precision:
      return each([](double v) { return static_cast<double>(static_cast<float>(v / 3)); });
    case CoordinateKind::noise:
      return each([&](double v) { return v == 0 && random() % 2 == 0 ? 6.123233995736766e-17 : v / 3; });
    case CoordinateKind::turned:
      return turned(p);
    case CoordinateKind::turned_far: {
      const Point3 at = turned(p);
      return {at.x + 1e5 / 3, at.y + 1e5 / 3, at.z + 1e5 / 3};
    }
  }
  return p;
}
inline MeshData of_kind(MeshData mesh, CoordinateKind kind, std::mt19937_64& random) {
  for (Point3& p : mesh.vertices) p = of_kind(p, kind, random);
  return mesh;
}

/// Of the plane, as the plane z = 0 of the above, but turned about z alone.
inline Point of_kind(Point p, CoordinateKind kind, std::mt19937_64& random) {
  if (kind == CoordinateKind::turned || kind == CoordinateKind::turned_far) {
    const double c = std::cos(std::acos(-1.0) / 6), s = std::sin(std::acos(-1.0) / 6);
    const double far = kind == CoordinateKind::turned ? 0 : 1e5 / 3;
    return {c * p.x - s * p.y + far, s * p.x + c * p.y + far};
  }
  const Point3 at = of_kind(Point3{p.x, p.y, 0}, kind, random);
  return {at.x, at.y};
}
inline RegionData of_kind(RegionData region, CoordinateKind kind, std::mt19937_64& random) {
  return oracles::vertices_by(std::move(region), [&](Point p) { return of_kind(p, kind, random); });
}

}  // namespace dymsum
