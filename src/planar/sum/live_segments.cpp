#include "planar/sum/live_segments.h"

#include <algorithm>
#include <array>
#include <optional>

#include "planar/arrangement/same_segments.h"

namespace dymsum::planar {
namespace {

// The cells that edges of one operand reach, wherever a vertex of the other moves them.
class EdgeCells {
 public:
  EdgeCells(const InteriorMask& mask, std::size_t most_edges, Scratch* memory) : mask_(mask), bounds_(memory) {
    bounds_.reserve(most_edges);
  }

  void of(const Operand& o) {
    // A float errs by at most kReach, as there are fewer than 2048 rows and columns: half a unit in the last place of
    // 1024 and more.
    constexpr double reach = 3 * kReach;
    static_assert(1024 * exact::kFloatRoundoff <= kReach);
    const double per_cell = mask_.grid().per_cell;
    bounds_.clear();
    for (const EdgeBox& b : o.boxes)
      bounds_.push_back({static_cast<float>(std::min(b.ay, b.by) * per_cell - reach),
                         static_cast<float>(std::min(b.ax, b.bx) * per_cell - reach),
                         static_cast<float>(std::max(b.ay, b.by) * per_cell + reach),
                         static_cast<float>(std::max(b.ax, b.bx) * per_cell + reach)});
  }
  /// Whether all cells that an edge reaches are covered when it is moved by so many rows and columns.
  bool covered(std::uint32_t edge, double row, double column) const {
    const std::array<double, 4> at{row, column, row, column};
    std::array<int, 4> cell;
    for (std::size_t k = 0; k < 4; ++k) cell[k] = static_cast<int>(bounds_[edge][k] + at[k]);
    return !mask_.any_live(cell[0], cell[1], cell[2], cell[3]);
  }

 private:
  // Low row, low column, high row, high column. Without clamps: coordinates lie in [0, span], and the grid reaches
  // farther than that by more than a cell.
  using Bounds = std::array<float, 4>;
  const InteriorMask& mask_;
  Array<Bounds> bounds_;
};

}  // namespace

void add_all(const ReducedConvolution& convolution, Soup& soup) {
  std::size_t i = soup.size();
  soup.segments.resize(i + convolution.size());
  soup.boxes.resize(soup.segments.size());
  SoupSegment* segment = soup.segments.data() + i;
  SoupBox* to = soup.boxes.data() + i;
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges,
                                std::uint32_t lo, std::uint32_t count) {
    const EdgeBox* const own = soup.operands[side]->boxes.data();
    const double vx = soup.operands[1 - side]->x[v], vy = soup.operands[1 - side]->y[v];
    const std::uint32_t *at = edges.data() + lo, *const end = edges.data() + edges.size(), label = side << 31;
    for (SoupBox* const last = to + count; to != last; ++to) {
      const std::uint32_t e = *at;
      *segment++ = {label | e, v};
      *to = moved(own[e], vx, vy);
      if (++at == end) at = edges.data();
    }
  });
}

Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll) {
  const std::uint32_t n = convolution.size();
  Array<std::uint32_t> live(n, kNone, soup.memory);
  SameSegments same(soup);
  if (twins == Twins::merged) same.reserve(n);
  soup.reserve(std::min<std::size_t>(n, 256));
  std::optional<EdgeCells> cells;
  if (mask != nullptr)
    cells.emplace(*mask, std::max(soup.operands[0]->boxes.size(), soup.operands[1]->boxes.size()), soup.memory);
  const double per_cell = mask != nullptr ? mask->grid().per_cell : 0;
  std::uint32_t side_of_cells = 2;
  std::uint32_t* to = live.data();
  std::size_t queried = 0;  // when poll was
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges,
                                std::uint32_t lo, std::uint32_t count) {
    if (const auto done = static_cast<std::size_t>(to - live.data()); done - queried > 10000) {
      queried = done;
      poll(static_cast<double>(done) / n);
    }
    const Operand &o = *soup.operands[side], &other = *soup.operands[1 - side];
    const EdgeBox* own = o.boxes.data();
    const double vx = other.x[v], vy = other.y[v];
    if (cells && side_of_cells != side) {
      cells->of(o);
      side_of_cells = side;
    }
    const double row = vy * per_cell, column = vx * per_cell;
    for (std::uint32_t k = 0, at = lo; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1, ++to) {
      const std::uint32_t e = edges[at];
      if (cells && cells->covered(e, row, column)) continue;
      const SoupBox b = moved(own[e], vx, vy);
      if (soup.size() == soup.segments.capacity()) soup.reserve(std::min<std::size_t>(n, 2 * soup.size()));
      *to = static_cast<std::uint32_t>(soup.size());
      soup.add({side, e, v}, b);
      if (twins == Twins::kept) continue;
      if (const std::uint32_t twin = same.find_or_add(*to); twin != kNone) {
        *to = twin;
        soup.drop_last();
      }
    }
  });
  return live;
}

}  // namespace dymsum::planar
