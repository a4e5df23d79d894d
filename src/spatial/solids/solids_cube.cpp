// The cube whose faces are split into a grid.
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "dymsum/rational.h"
#include "dymsum/solids.h"

#include "planar/shapes/shapes.h"

namespace dymsum::solids {

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
