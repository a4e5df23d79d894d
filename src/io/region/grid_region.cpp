#include <algorithm>
#include <array>
#include <cmath>

#include "io/region/grid_map.h"

namespace dymsum::io {
namespace {

// Directions counter-clockwise: right, up, left, down.
constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

struct Corner {
  std::int64_t i = 0, j = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};
using Loop = std::vector<Corner>;

// Cells of a set with a frame of cells around them that are not in it.
class CellSet {
 public:
  CellSet(const GridMap& map, GridSet set) : border_(set == GridSet::blocked ? 1 : 0) {
    width_ = static_cast<std::int64_t>(map.width) + 2 * border_ + 2;
    height_ = static_cast<std::int64_t>(map.height) + 2 * border_ + 2;
    inside_.assign(static_cast<std::size_t>(width_ * height_), 0);
    for (std::int64_t j = 1; j + 1 < height_; ++j)
      for (std::int64_t i = 1; i + 1 < width_; ++i)
        inside_[at(i, j)] = holds(map, set, i - 1 - border_, j - 1 - border_);
  }

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  bool inside(std::int64_t i, std::int64_t j) const { return inside_[at(i, j)] != 0; }
  std::size_t at(std::int64_t i, std::int64_t j) const { return static_cast<std::size_t>(j * width_ + i); }
  // The corner in cells of the map.
  Corner on_map(Corner c) const { return {c.i - 1 - border_, c.j - 1 - border_}; }

  /// The cell on the left of the grid edge that leaves a corner in a direction.
  bool left_of(Corner c, int d) const { return inside(c.i - (d == 1 || d == 2), c.j - (d == 2 || d == 3)); }
  bool right_of(Corner c, int d) const { return inside(c.i - (d == 2 || d == 3), c.j - (d == 3 || d == 0)); }

 private:
  bool holds(const GridMap& map, GridSet set, std::int64_t i, std::int64_t j) const {
    const auto w = static_cast<std::int64_t>(map.width), h = static_cast<std::int64_t>(map.height);
    if (i < 0 || j < 0 || i >= w || j >= h) return set == GridSet::blocked;
    const GridCell cell = map.cells[static_cast<std::size_t>(j * w + i)];
    switch (set) {
      case GridSet::blocked:
        return cell != GridCell::free;
      case GridSet::occupied:
        return cell == GridCell::occupied;
      case GridSet::unknown:
        return cell == GridCell::unknown;
      case GridSet::free:
        break;
    }
    return cell == GridCell::free;
  }

  std::int64_t width_ = 0, height_ = 0, border_ = 0;
  std::vector<std::uint8_t> inside_;
};

// Boundaries with the set on their left. Where two cells of the set meet in a corner a loop stays with its cell: parts
// are connected through sides.
class Tracer {
 public:
  explicit Tracer(const CellSet& set) : set_(set), done_(static_cast<std::size_t>(set.width() * set.height()), 0) {}

  std::vector<Loop> loops() {
    std::vector<Loop> all;
    for (std::int64_t j = 1; j < set_.height(); ++j)
      for (std::int64_t i = 1; i < set_.width(); ++i)
        for (const int d : {0, 2}) {
          const Corner c{i, j};
          if (is_boundary(c, d) && !done(c, d)) split(traced(c, d), all);
        }
    return all;
  }

 private:
  bool is_boundary(Corner c, int d) const {
    const Corner to{c.i + kStep[d][0], c.j + kStep[d][1]};
    if (to.i < 1 || to.j < 1 || to.i >= set_.width() || to.j >= set_.height()) return false;
    return set_.left_of(c, d) && !set_.right_of(c, d);
  }
  bool done(Corner c, int d) const { return (done_[set_.at(c.i, c.j)] >> d & 1) != 0; }

  // All corners of the grid along it.
  Loop traced(Corner c, int d) {
    Loop loop;
    while (!done(c, d)) {
      done_[set_.at(c.i, c.j)] |= static_cast<std::uint8_t>(1 << d);
      loop.push_back(c);
      c = {c.i + kStep[d][0], c.j + kStep[d][1]};
      // Left first, which keeps the cell.
      for (const int turn : {1, 0, 3})
        if (const int next = (d + turn) % 4; is_boundary(c, next)) {
          d = next;
          break;
        }
    }
    return loop;
  }

  // A loop that comes to a corner twice is two that touch there.
  void split(const Loop& loop, std::vector<Loop>& all) {
    Loop open;
    std::vector<std::size_t> positions;
    for (const Corner& c : loop) {
      std::uint32_t& position = position_of(c);
      if (position != 0) {
        const auto first = open.begin() + static_cast<std::ptrdiff_t>(position - 1);
        all.emplace_back(first, open.end());
        for (auto k = first + 1; k != open.end(); ++k) position_of(*k) = 0;
        open.erase(first + 1, open.end());
        continue;
      }
      open.push_back(c);
      position = static_cast<std::uint32_t>(open.size());
    }
    for (const Corner& c : open) position_of(c) = 0;
    all.push_back(std::move(open));
  }
  std::uint32_t& position_of(Corner c) {
    if (positions_.empty()) positions_.assign(done_.size(), 0);
    return positions_[set_.at(c.i, c.j)];
  }

  const CellSet& set_;
  std::vector<std::uint8_t> done_;        // directions that were walked, per corner
  std::vector<std::uint32_t> positions_;  // in the open loop, from 1
};

// Parts of cells that are connected through sides, by index + 1.
std::vector<std::uint32_t> parts_of(const CellSet& set, std::uint32_t& count) {
  std::vector<std::uint32_t> part(static_cast<std::size_t>(set.width() * set.height()), 0);
  std::vector<Corner> open;
  for (std::int64_t j = 1; j + 1 < set.height(); ++j)
    for (std::int64_t i = 1; i + 1 < set.width(); ++i) {
      if (!set.inside(i, j) || part[set.at(i, j)] != 0) continue;
      part[set.at(i, j)] = ++count;
      open.push_back({i, j});
      while (!open.empty()) {
        const Corner c = open.back();
        open.pop_back();
        for (const auto& step : kStep) {
          const Corner to{c.i + step[0], c.j + step[1]};
          if (!set.inside(to.i, to.j) || part[set.at(to.i, to.j)] != 0) continue;
          part[set.at(to.i, to.j)] = count;
          open.push_back(to);
        }
      }
    }
  return part;
}

// Twice the area, positive counter-clockwise.
std::int64_t twice_area(const Loop& loop) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Corner &a = loop[k], &b = loop[(k + 1) % loop.size()];
    sum += a.i * b.j - a.j * b.i;
  }
  return sum;
}

Point placed(const GridMap& map, double c, double s, Corner corner) {
  const auto i = static_cast<double>(corner.i), j = static_cast<double>(corner.j);
  if (map.yaw == 0) return {std::fma(i, map.resolution, map.x), std::fma(j, map.resolution, map.y)};
  const double u = i * map.resolution, v = j * map.resolution;
  return {map.x + (c * u - s * v), map.y + (s * u + c * v)};
}

Ring ring_of(const GridMap& map, const CellSet& set, const Loop& loop) {
  const double c = std::cos(map.yaw), s = std::sin(map.yaw);
  Ring ring;
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Corner &a = loop[(k + n - 1) % n], &b = loop[k], &d = loop[(k + 1) % n];
    if ((b.i - a.i) * (d.j - b.j) - (b.j - a.j) * (d.i - b.i) != 0) ring.push_back(placed(map, c, s, set.on_map(b)));
  }
  return ring;
}

// The cell on the left of a loop's first edge.
std::size_t cell_beside(const CellSet& set, const Loop& loop) {
  const Corner &a = loop[0], &b = loop[1];
  const bool left = b.i < a.i, down = b.j<a.j, up = b.j> a.j;
  return set.at(a.i - (left || up), a.j - (left || down));
}

}  // namespace

RegionData grid_region(const GridMap& map, GridSet set) {
  const CellSet cells(map, set);
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> part = parts_of(cells, count);
  RegionData data;
  data.parts.resize(count);
  for (const Loop& loop : Tracer(cells).loops()) {
    Part& owner = data.parts[part[cell_beside(cells, loop)] - 1];
    if (twice_area(loop) > 0) owner.outer = ring_of(map, cells, loop);
    else owner.holes.push_back(ring_of(map, cells, loop));
  }
  return data;
}

}  // namespace dymsum::io
