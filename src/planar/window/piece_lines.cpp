#include "planar/window/piece_lines.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace dymsum::planar {
namespace {

using Four = float __attribute__((vector_size(16)));
using Decided = std::int32_t __attribute__((vector_size(16)));

Four all(float v) { return Four{v, v, v, v}; }
Four lower_of(Four a, Four b) { return a < b ? a : b; }
Four higher_of(Four a, Four b) { return a > b ? a : b; }
Four sizes_of(Four a) { return higher_of(a, -a); }

std::uint32_t bits(Decided decided) {
#ifdef __SSE2__
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(decided)));
#else
  return static_cast<std::uint32_t>((decided[0] & 1) | (decided[1] & 2) | (decided[2] & 4) | (decided[3] & 8));
#endif
}

}  // namespace

// Beyond 2^-120 of the span nothing that matters underflows.
PieceLines::PieceLines(double span, double half, Scratch* memory)
    : scale_(1 / span),
      half_(static_cast<float>(half) * exact::kFloatOutwards),
      second_(static_cast<float>(0.5 * half * half + 0x1p-100) * exact::kFloatOutwards),
      pieces_(memory) {}

PieceLines::Lines PieceLines::lines(const std::array<std::uint32_t, 4>& of) const {
  const Piece &a = pieces_[of[0]], &b = pieces_[of[1]], &c = pieces_[of[2]], &d = pieces_[of[3]];
  const auto turned = [](Four p, Four q, Four r, Four s, Four& x, Four& y, Four& z, Four& w) {
    const Four pq = __builtin_shufflevector(p, q, 0, 4, 1, 5), rs = __builtin_shufflevector(r, s, 0, 4, 1, 5),
               qp = __builtin_shufflevector(p, q, 2, 6, 3, 7), sr = __builtin_shufflevector(r, s, 2, 6, 3, 7);
    x = __builtin_shufflevector(pq, rs, 0, 1, 4, 5);
    y = __builtin_shufflevector(pq, rs, 2, 3, 6, 7);
    z = __builtin_shufflevector(qp, sr, 0, 1, 4, 5);
    w = __builtin_shufflevector(qp, sr, 2, 3, 6, 7);
  };
  Lines l;
  turned(a.positions, b.positions, c.positions, d.positions, l.fx, l.fy, l.tx, l.ty);
  turned(a.line, b.line, c.line, d.line, l.dx, l.dy, l.head, l.tail);
  const Four ab = __builtin_shufflevector(a.rest, b.rest, 0, 4, 1, 5),
             cd = __builtin_shufflevector(c.rest, d.rest, 0, 4, 1, 5);
  l.length = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  l.side = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  return l;
}

// Taylor's formula proves it. The side of the position at fraction u of one piece against the line of the other one is
// value + u k, and its slope slope + u dot: what turns against a line is the other operand's vertex.
std::uint32_t PieceLines::apart(const std::array<std::uint32_t, 4>& first,
                                const std::array<std::uint32_t, 4>& second) const {
  const Lines a = lines(first), b = lines(second);
  const Four fx = b.fx - a.fx, fy = b.fy - a.fy, tx = b.tx - a.tx, ty = b.ty - a.ty, wx = fx + tx, wy = fy + ty;
  const Four mixed = sizes_of(a.side - b.side), k = a.dx * b.dy - a.dy * b.dx,
             dot = mixed * (a.dx * b.dx + a.dy * b.dy);
  const auto beside = [&](const Lines& line, const Lines& other, Four sign) {
    const Four rx = tx + line.side * (fx - tx), ry = ty + line.side * (fy - ty);
    const Four value = line.dx * wy - line.dy * wx, slope = sign * (line.dx * rx + line.dy * ry);
    const Four u = value + other.head * k, v = value + other.tail * k;
    const Four turn = all(half_) * higher_of(sizes_of(slope + other.head * dot), sizes_of(slope + other.tail * dot)) +
                      line.length * (all(second_) * (sizes_of(rx) + sizes_of(ry) + mixed * other.length) +
                                     all(static_cast<float>(kApart))) +
                      all(0x1p-110F);
    return (lower_of(u, v) > turn) | (higher_of(u, v) < -turn);
  };
  return bits(beside(a, b, all(1)) | beside(b, a, all(-1)));
}

}  // namespace dymsum::planar
