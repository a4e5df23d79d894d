// The shapes of the benchmarks in coordinates as real files have them: tests/oracles/coordinate_kinds.h, but at their
// size, so that positions, radii and steps of a benchmark serve all kinds.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"

namespace dymsum::bench {

enum class Coordinates {
  grid,      ///< the nearest multiples of 2^-20
  decimals,  ///< four decimals; more for shapes smaller than 1
  single,    ///< single precision
  noise,     ///< doubles with all their bits, half of the zeros 6e-17, as the cosine of a right angle is
  turned,    ///< turned by 30 degrees, about z and then x, in doubles
};
inline constexpr std::array kCoordinates{Coordinates::grid, Coordinates::decimals, Coordinates::single,
                                         Coordinates::noise, Coordinates::turned};
std::string name(Coordinates kind);

/// How a run has its shapes: of a kind, or as the benchmark makes them.
using Kind = std::optional<Coordinates>;

/// The same shape but for rounding; decimals, single and noise are larger by a 3,000th, or coordinates with few bits
/// would stay what they are. Equal shapes stay equal. Errors where rounding spoils it: as Region::create, Mesh::create.
Result<Region> with_coordinates(const Region& region, Kind kind);
/// Of a kind: in triangles, as files have it. A polygon is in no plane once its vertices are rounded.
Result<Mesh> with_coordinates(const Mesh& mesh, Kind kind);
/// Of a kind: the hull of the vertices. A convex solid has reflex edges once they are rounded.
Result<Mesh> hull_with_coordinates(const Mesh& mesh, Kind kind);

/// Words that every benchmark takes.
struct KindOptions {
  std::vector<Kind> kinds{std::nullopt};
  bool off_grid = false;  ///< nothing but the table of kinds (off_grid.h)

  /// Takes argv[i], and the word after it where it has one, if it is of these. Throws std::invalid_argument for kinds
  /// that there are not.
  bool take(int argc, char** argv, int& i);
  bool chosen() const { return kinds.front().has_value(); }
  /// Where pages of a run go: those of a kind not where the others are, but in a folder of its name.
  static std::string folder(const std::string& results, Kind kind);
};
extern const char* const kKindUsage;

}  // namespace dymsum::bench
