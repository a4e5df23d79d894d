// Pieces at the midpoint of a range of angles: which of them stay apart throughout it, four pairs at a time in floats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/scratch.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

class PieceLines {
 public:
  /// Serves coordinates of sums up to `span`; `half`: the range reaches so far from its midpoint, at most a radian.
  PieceLines(double span, double half, Scratch* memory = nullptr);

  void reserve(std::size_t n) { pieces_.reserve(n); }
  /// The next piece: of the segment of an edge of operand `side` with vector d that starts at the sum of a fixed and a
  /// turning vertex, the part from share `head` to `tail`.
  void add(std::uint32_t side, Point fixed, Point turning, Point d, double head, double tail) {
    const auto to = [&](double v) { return static_cast<float>(v * scale_); };
    pieces_.push_back({Four{to(fixed.x), to(fixed.y), to(turning.x), to(turning.y)},
                       Four{to(d.x), to(d.y), static_cast<float>(head), static_cast<float>(tail)},
                       Four{to(std::abs(d.x) + std::abs(d.y)), side == 0 ? 0.0F : 1.0F, 0, 0}});
  }

  /// Bit k of four is set where pieces a[k] and b[k] provably meet at no angle of the range, as both ends of one stay
  /// on the same side of the other one's line. Some that stay apart are not found.
  std::uint32_t apart(const std::array<std::uint32_t, 4>& a, const std::array<std::uint32_t, 4>& b) const;

 private:
  using Four = float __attribute__((vector_size(16)));
  struct Piece {
    Four positions;  ///< fixed and turning vertex
    Four line;       ///< vector, head, tail
    Four rest;       ///< |vector|_1, side
  };
  /// The lines of four pieces, one in each lane.
  struct Lines {
    Four fx, fy, tx, ty, dx, dy, head, tail, length, side;
  };
  Lines lines(const std::array<std::uint32_t, 4>& of) const;

  double scale_;
  float half_, second_;
  Array<Piece> pieces_;
};

}  // namespace dymsum::planar
