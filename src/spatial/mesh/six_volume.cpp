#include "spatial/mesh/six_volume.h"

#include <cstdlib>

#include "exact/orient.h"
#include "spatial/mesh/grid_points.h"

namespace dymsum::spatial {

namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::Int;

// A sum of fewer than 2^32 determinants of vertices' differences: B + 1 bits each, determinants 3B + 6, sums 3B + 38.
template <class C>
struct Widths {
  using Sum = Big;
};
template <int B>
struct Widths<Int<B>> {
  using Difference = GridPoint<Int<B + 1>>;
  using Determinant = decltype(exact::determinant(Difference{}, Difference{}, Difference{}));
  static_assert(Determinant::kBits == 3 * B + 6);
  using Sum = Int<Determinant::kBits + 32>;
};
static_assert(Widths<Int<29>>::Sum::kBits == 125 && sizeof(Widths<Int<29>>::Sum) == 16);
static_assert(Widths<Int<61>>::Sum::kBits == 221 && sizeof(Widths<Int<61>>::Sum) == 32);
static_assert(Widths<Int<125>>::Sum::kBits == 413 && sizeof(Widths<Int<125>>::Sum) == 56);

Big plus(const Big& a, const Big& b) { return a + b; }
template <int S, int D>
Int<S> plus(const Int<S>& a, const Int<D>& b) {
  return Int<S>::from_raw(exact::raw_cast<S>((a + b).raw()));
}

/// f(six times the volume of shell k, on the grid) for every shell, seen from the first vertex of its first face: the
/// signed sum of the tetrahedra over the fans of its faces.
template <class C, class F>
void for_each_shell(const std::vector<GridPoint<C>>& points, const std::vector<Face>& faces, const Shells& shells,
                    F f) {
  std::vector<typename Widths<C>::Sum> sums(shells.count);
  std::vector<std::uint32_t> apex(shells.count, HalfEdges::kNone);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    const std::uint32_t shell = shells.of_face[i];
    if (apex[shell] == HalfEdges::kNone) apex[shell] = face[0];
    const GridPoint<C>& from = points[apex[shell]];
    for (std::size_t k = 2; k < face.size(); ++k) {
      sums[shell] = plus(
          sums[shell], exact::determinant(points[face[0]] - from, points[face[k - 1]] - from, points[face[k]] - from));
    }
  }
  for (std::uint32_t k = 0; k < shells.count; ++k) f(k, sums[k]);
}

BigRational power_of_two(int exponent) {
  const BigInteger power = BigInteger(1) << std::abs(exponent);
  return exponent >= 0 ? BigRational(power) : BigRational(BigInteger(1), power);
}

}  // namespace

std::vector<int> shell_signs(const MeshData& data, const Shells& shells) {
  std::vector<int> signs(shells.count);
  with_grid_points(data.vertices, space_grid(data.vertices), [&](const auto& points) {
    for_each_shell(points, data.faces, shells, [&](std::uint32_t k, const auto& sum) { signs[k] = sign(sum); });
  });
  return signs;
}

BigRational exact_volume(const MeshData& data) {
  const SpaceGrid grid = space_grid(data.vertices);
  const Shells one{std::vector<std::uint32_t>(data.faces.size(), 0), data.faces.empty() ? 0u : 1u};
  Big six;
  with_grid_points(data.vertices, grid, [&](const auto& points) {
    for_each_shell(points, data.faces, one, [&](std::uint32_t, const auto& sum) { six = exact::to_big(sum); });
  });
  return BigRational(six.value()) * power_of_two(grid.x.exponent + grid.y.exponent + grid.z.exponent) / 6;
}

}  // namespace dymsum::spatial
