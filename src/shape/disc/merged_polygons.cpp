#include "shape/disc/merged_polygons.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace dymsum::shape {

namespace {

using Indices = std::vector<std::uint32_t>;

/// Positions that stand for all vertices near them.
class Positions {
 public:
  explicit Positions(double near) : near_(near) {}

  std::uint32_t of(Point p) {
    const Cell here = cell(p);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find({here.first + dx, here.second + dy});
        if (found == cells_.end()) continue;
        for (const std::uint32_t i : found->second)
          if (std::abs(at_[i].x - p.x) <= near_ && std::abs(at_[i].y - p.y) <= near_) return i;
      }
    at_.push_back(p);
    cells_[here].push_back(std::uint32_t(at_.size() - 1));
    return std::uint32_t(at_.size() - 1);
  }

  Point at(std::uint32_t i) const { return at_[i]; }

  /// Once all are known.
  void sort() {
    for (std::uint32_t i = 0; i < at_.size(); ++i) by_x_.push_back(i);
    std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t i, std::uint32_t j) { return at_[i].x < at_[j].x; });
  }
  /// Those near a segment, and not its ends, in its order.
  Indices along(std::uint32_t from, std::uint32_t to) const {
    const Point a = at_[from], b = at_[to];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    std::vector<std::pair<double, std::uint32_t>> found;
    const auto first = std::partition_point(by_x_.begin(), by_x_.end(),
                                            [&](std::uint32_t i) { return at_[i].x < std::min(a.x, b.x) - near_; });
    for (auto k = first; k != by_x_.end() && at_[*k].x <= std::max(a.x, b.x) + near_; ++k) {
      const double px = at_[*k].x - a.x, py = at_[*k].y - a.y;
      const double t = (px * dx + py * dy) / length, off = (px * dy - py * dx) / length;
      if (*k != from && *k != to && t > 0 && t < length && std::abs(off) <= near_) found.push_back({t, *k});
    }
    std::sort(found.begin(), found.end());
    Indices made;
    for (const auto& [t, i] : found) made.push_back(i);
    return made;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell(Point p) const { return {std::int64_t(std::floor(p.x / near_)), std::int64_t(std::floor(p.y / near_))}; }

  double near_;
  std::vector<Point> at_;
  std::map<Cell, Indices> cells_;
  Indices by_x_;
};

double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice +=
        (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) - (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
  return twice / 2;
}

/// Whether a ray towards +x crosses the ring an odd number of times.
bool is_around(const Ring& ring, Point p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

class Merger {
 public:
  Merger(const RegionData& data, double near) : positions_(near) {
    made_.data.polylines = data.polylines, made_.data.points = data.points;
    std::vector<Indices> rings;
    const auto see = [&](const Ring& ring) {
      Indices positions;
      for (const Point& p : ring)
        if (const std::uint32_t i = positions_.of(p); positions.empty() || positions.back() != i)
          positions.push_back(i);
      while (positions.size() > 1 && positions.front() == positions.back()) positions.pop_back();
      rings.push_back(std::move(positions));
    };
    for (const Part& part : data.parts) {
      see(part.outer);
      for (const Ring& hole : part.holes) see(hole);
    }
    positions_.sort();
    // A vertex is moved once, and an edge with every position that it is bent to: bends of bends are not followed.
    made_.moved = 4 * near;
    for (const Indices& ring : rings) add(ring);
  }

  MergedPolygons run() {
    take_twins_out();
    collect();
    keep_thin();
    return std::move(made_);
  }

 private:
  struct Half {
    std::uint32_t from, to, next, previous;
    bool gone = false;
  };

  void add(const Indices& ring) {
    if (ring.size() == 1) {
      made_.data.points.push_back(positions_.at(ring[0]));
      ++made_.merged;
      return;
    }
    Indices bent;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      bent.push_back(ring[i]);
      const Indices between = positions_.along(ring[i], ring[(i + 1) % ring.size()]);
      bent.insert(bent.end(), between.begin(), between.end());
    }
    const auto first = std::uint32_t(halves_.size()), count = std::uint32_t(bent.size());
    for (std::uint32_t k = 0; k < count; ++k)
      halves_.push_back({bent[k], bent[(k + 1) % count], first + (k + 1) % count, first + (k + count - 1) % count});
  }

  void take_twins_out() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Indices> open;
    for (std::uint32_t h = 0; h < halves_.size(); ++h) {
      const auto twin = open.find({halves_[h].to, halves_[h].from});
      if (twin == open.end() || twin->second.empty()) {
        open[{halves_[h].from, halves_[h].to}].push_back(h);
        continue;
      }
      const std::uint32_t g = twin->second.back();
      twin->second.pop_back();
      thin_.push_back({halves_[h].from, halves_[h].to});
      const Half there = halves_[h], back = halves_[g];
      halves_[h].gone = halves_[g].gone = true;
      if (there.previous != g) link(there.previous, back.next);
      if (back.previous != h) link(back.previous, there.next);
    }
  }
  void link(std::uint32_t first, std::uint32_t second) {
    halves_[first].next = second;
    halves_[second].previous = first;
  }

  void collect() {
    std::vector<Ring> holes;
    std::vector<std::uint8_t> done(halves_.size(), 0);
    for (std::uint32_t start = 0; start < halves_.size(); ++start) {
      if (done[start] || halves_[start].gone) continue;
      Ring ring;
      for (std::uint32_t h = start; !done[h]; h = halves_[h].next) {
        done[h] = 1;
        ring.push_back(positions_.at(halves_[h].from));
      }
      if (area_of(ring) > 0) made_.data.parts.push_back({std::move(ring), {}});
      else holes.push_back(std::move(ring));
    }
    for (Ring& hole : holes) {
      // The middle of an edge: rings touch at vertices.
      const Point at{(hole[0].x + hole[1].x) / 2, (hole[0].y + hole[1].y) / 2};
      Part* around = nullptr;
      for (Part& part : made_.data.parts)
        if (is_around(part.outer, at) && (around == nullptr || area_of(part.outer) < area_of(around->outer)))
          around = &part;
      if (around != nullptr) around->holes.push_back(std::move(hole));
    }
  }

  /// What lies inside of a part on both sides is none of its boundary any more.
  void keep_thin() {
    for (const auto& [a, b] : thin_) {
      const Point from = positions_.at(a), to = positions_.at(b), at{(from.x + to.x) / 2, (from.y + to.y) / 2};
      const bool inside = std::any_of(made_.data.parts.begin(), made_.data.parts.end(), [&](const Part& part) {
        return is_around(part.outer, at) && std::none_of(part.holes.begin(), part.holes.end(),
                                                         [&](const Ring& hole) { return is_around(hole, at); });
      });
      ++made_.merged;
      if (!inside) made_.data.polylines.push_back({from, to});
    }
  }

  Positions positions_;
  std::vector<Half> halves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> thin_;
  MergedPolygons made_;
};

}  // namespace

MergedPolygons merged_polygons(const RegionData& data, double near) { return Merger(data, near).run(); }

}  // namespace dymsum::shape
