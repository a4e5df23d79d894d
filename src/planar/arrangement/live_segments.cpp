#include "planar/arrangement/live_segments.h"

#include <algorithm>
#include <array>

#include "planar/arrangement/same_segments.h"

namespace dymsum::planar {

Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll) {
  const std::uint32_t n = convolution.size();
  Array<std::uint32_t> live(n, kNone, soup.memory);
  SameSegments same(soup);
  if (twins == Twins::merged) same.reserve(n);
  soup.reserve(std::min<std::size_t>(n, 256));
  const Grid g = mask != nullptr ? mask->grid() : Grid{};
  // The cells that an edge reaches, as distances from the other operand's vertex. Without clamps: coordinates lie in
  // [0, span], and the grid reaches farther than that by more than a cell.
  struct Cells {
    std::array<float, 4> bounds;  // low row, low column, high row, high column
  };
  Array<Cells> cells(soup.memory);
  if (mask != nullptr) cells.reserve(std::max(soup.operands[0]->boxes.size(), soup.operands[1]->boxes.size()));
  const auto reach_of = [&](const Operand& o) {
    cells.clear();
    // A rounding errs by at most kReach, as there are fewer than 2048 rows and columns.
    constexpr double reach = 3 * kReach;
    static_assert(kReach >= 0x1p-14);
    for (const EdgeBox& b : o.boxes)
      cells.push_back({{static_cast<float>(std::min(b.ay, b.by) * g.per_cell - reach),
                        static_cast<float>(std::min(b.ax, b.bx) * g.per_cell - reach),
                        static_cast<float>(std::max(b.ay, b.by) * g.per_cell + reach),
                        static_cast<float>(std::max(b.ax, b.bx) * g.per_cell + reach)}});
  };
  const auto dead = [&](const Cells& edge, double row, double column) {
    const std::array<double, 4> at{row, column, row, column};
    std::array<int, 4> cell;
    for (std::size_t k = 0; k < 4; ++k) cell[k] = static_cast<int>(edge.bounds[k] + at[k]);
    return !mask->any_live(cell[0], cell[1], cell[2], cell[3]);
  };
  std::uint32_t side_of_cells = 2;
  std::uint32_t* to = live.data();
  std::size_t asked = 0;  // when poll was
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges,
                                std::uint32_t lo, std::uint32_t count) {
    if (const auto done = static_cast<std::size_t>(to - live.data()); done - asked > 10000) {
      asked = done;
      poll(static_cast<double>(done) / n);
    }
    const Operand &o = *soup.operands[side], &other = *soup.operands[1 - side];
    const EdgeBox* own = o.boxes.data();
    const double vx = other.x[v], vy = other.y[v];
    if (mask != nullptr && side_of_cells != side) {
      reach_of(o);
      side_of_cells = side;
    }
    const double row = vy * g.per_cell, column = vx * g.per_cell;
    for (std::uint32_t k = 0, at = lo; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1, ++to) {
      const std::uint32_t e = edges[at];
      if (mask != nullptr && dead(cells[e], row, column)) continue;
      const SoupBox b = moved(own[e], vx, vy);
      if (soup.size() == soup.segments.capacity()) soup.reserve(std::min<std::size_t>(n, 2 * soup.size()));
      *to = static_cast<std::uint32_t>(soup.size());
      soup.add({side, e, v}, b);
      if (twins == Twins::kept) continue;
      if (const std::uint32_t twin = same.find_or_add(*to); twin != kNone) {
        *to = twin;
        soup.segments.pop_back();
        soup.boxes.pop_back();
      }
    }
  });
  return live;
}

}  // namespace dymsum::planar
