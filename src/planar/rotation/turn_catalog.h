// Which segments of the reduced convolution exist at which angle: edges and convex vertices by direction.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "planar/rotation/turning_forms.h"

namespace dymsum::planar {

inline constexpr double kTurn = 2 * std::numbers::pi;
/// Angles of edges err by less; an angle that is nearer to a limit is not decided by doubles.
inline constexpr double kAngleSlack = 0x1p-40;

/// In [0, 2 pi).
inline double positive_angle(double a) {
  a = a - kTurn * static_cast<double>(static_cast<long long>(a / kTurn));
  return a < 0 ? a + kTurn : a;
}

class TurnCatalog {
 public:
  explicit TurnCatalog(const TurningForms& forms);

  enum class Existence : std::uint8_t { no, yes, unsure };
  /// Whether a segment exists at theta; `unsure` near the alignments at which it begins or ends.
  Existence exists(const WalkSegment& s, double theta) const;

  /// Calls f(WalkSegment) for every segment that exists somewhere in [low, high], and perhaps for some that only nearly
  /// do.
  template <class F>
  void for_each(double low, double high, F&& f) const {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t vertex_op = 1 - side;
      for (const Corner& corner : corners_[vertex_op]) {
        const std::vector<Edge>& edges = corner.of_hole ? outer_edges_[side] : edges_[side];
        if (edges.empty()) continue;
        // Directions of edges, less the rotation of the turning operand, between those of the corner.
        const double from = positive_angle(corner.in + (side == 0 ? low : -high) - kAngleSlack), length = corner.turn + (high - low) + 2 * kAngleSlack;
        std::size_t at = lower_bound(edges, from);
        for (std::size_t k = 0; k < edges.size(); ++k, at = at + 1 == edges.size() ? 0 : at + 1) {
          if (at == edges.size()) at = 0;
          if (positive_angle(edges[at].angle - from) > length) break;
          f(WalkSegment{side, edges[at].edge, corner.vertex});
        }
      }
    }
  }

  /// The segment that ends at a pair at theta, and the one that starts there; kNoRank edges where there is none.
  /// `unsure` is set where doubles do not tell.
  struct Joint {
    bool has_in = false, has_out = false, unsure = false;
    WalkSegment in, out;
  };
  Joint joint(Pair v, double theta) const;
  bool convex(std::uint32_t op, std::uint32_t v) const { return forms_.operand(op).convex[v] != 0; }
  /// Whether hole edges and hole vertices keep edge and vertex apart at every angle.
  bool may_exist(const WalkSegment& s) const;
  double edge_angle(std::uint32_t op, std::uint32_t e) const { return angle_[op][e]; }

 private:
  struct Edge {
    double angle = 0;
    std::uint32_t edge = 0;
  };
  struct Corner {
    double in = 0, turn = 0;
    std::uint32_t vertex = 0;
    bool of_hole = false;
  };
  static std::size_t lower_bound(const std::vector<Edge>& edges, double angle);

  const TurningForms& forms_;
  std::array<std::vector<Edge>, 2> edges_, outer_edges_;  // sorted
  std::array<std::vector<Corner>, 2> corners_;
  std::array<std::vector<double>, 2> angle_, turn_;  // of edges; of convex vertices
  std::array<std::vector<std::uint8_t>, 2> of_hole_;
};

}  // namespace dymsum::planar
