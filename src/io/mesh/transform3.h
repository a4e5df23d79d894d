// Maps by which formats place their meshes. They are computed in doubles, as the programs do that write such files:
// exact where a mesh stays where it is, or is turned by right angles, moved and scaled within what doubles hold.
#pragma once

#include <array>
#include <cstddef>

#include "dymsum/mesh.h"

namespace dymsum::io {

/// x -> (row · (x, 1)) for three rows.
struct Transform3 {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Point3 operator()(const Point3& p) const {
    const auto of = [&](const std::array<double, 4>& r) { return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]; };
    return {of(rows[0]), of(rows[1]), of(rows[2])};
  }

  /// First `inner`, then `outer`.
  friend Transform3 operator*(const Transform3& outer, const Transform3& inner) {
    Transform3 both;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        both.rows[i][j] = j == 3 ? outer.rows[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) both.rows[i][j] += outer.rows[i][k] * inner.rows[k][j];
      }
    }
    return both;
  }

  /// Whether it turns what is outside to the inside: faces have to run the other way round then.
  bool mirrors() const {
    const auto& [a, b, c] = rows;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]) <
           0;
  }
};

}  // namespace dymsum::io
