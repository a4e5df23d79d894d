#include "tiny_regions.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "membership.h"
#include "vertices_by.h"

namespace dymsum::oracles {
namespace {

using Lattice = Pt<Small>;

Lattice exact(const Point& c) { return {from_double<Small>(c.x), from_double<Small>(c.y)}; }

int turn_of(const Point& a, const Point& b, const Point& c) { return turn(exact(a), exact(b), exact(c)); }

bool meet_segments(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Seg<Small> s{exact(a), exact(b)}, t{exact(c), exact(d)};
  if (on_segment(s, t.a) || on_segment(s, t.b) || on_segment(t, s.a) || on_segment(t, s.b)) return true;
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

double doubled_area_of(const Ring& ring) {  // exact for lattice coordinates
  double total = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    total += a.x * b.y - a.y * b.x;
  }
  return total;
}

bool is_simple(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
    if (a == b || (turn_of(a, b, c) == 0 && (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) <= 0)) return false;
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && meet_segments(a, b, ring[j], ring[(j + 1) % n])) return false;
  }
  return true;
}

RegionData region_of(Ring outer) {
  RegionData out;
  out.parts.push_back({std::move(outer), {}});
  return out;
}

/// Two rims share more than points.
bool run_together(const RegionData& p, const RegionData& q) {
  const Pieces<Small> a = pieces_of<Small>(p), b = pieces_of<Small>(q);
  for (const Seg<Small>& s : a.rim)
    for (const Seg<Small>& t : b.rim) {
      if (turn(s.a, s.b, t.a) != 0 || turn(s.a, s.b, t.b) != 0) continue;
      const auto &s_low = std::min(s.a, s.b), &s_high = std::max(s.a, s.b);
      const auto &t_low = std::min(t.a, t.b), &t_high = std::max(t.a, t.b);
      if (s_low < t_high && t_low < s_high) return true;
    }
  return false;
}

const Pt<Small> kOrigin{Small(0), Small(0)};

bool share_interior(const RegionData& p, const RegionData& q) {
  return Membership<Small>(p, mapped(q, -1, 0, 0, -1)).overlaps(kOrigin);
}

/// `hole`, counter-clockwise, may be cut out of the region's part `index`.
bool may_cut(const RegionData& region, std::size_t index, const Ring& hole) {
  const RegionData lid = region_of(hole);
  RegionData only;
  only.parts.push_back(region.parts[index]);
  return Membership<Small>(only, lid).holds(kOrigin) && !run_together(only, lid);
}

void try_hole(Random& random, RegionData& region, int grid) {
  for (int attempt = 0; attempt < 25; ++attempt) {
    Ring hole = random_polygon(random, grid, 3 + random.below(2));
    const auto index = static_cast<std::size_t>(random.below(static_cast<int>(region.parts.size())));
    if (!may_cut(region, index, hole)) continue;
    std::reverse(hole.begin(), hole.end());
    region.parts[index].holes.push_back(std::move(hole));
    return;
  }
}

void try_part(Random& random, RegionData& region, int grid, int corners) {
  for (int attempt = 0; attempt < 25; ++attempt) {
    const RegionData extra = region_of(random_polygon(random, grid, corners));
    if (share_interior(region, extra) || run_together(region, extra)) continue;
    region.parts.push_back(extra.parts[0]);
    return;
  }
}

Point random_point(Random& random, int grid) {
  return {static_cast<double>(random.below(grid + 1)), static_cast<double>(random.below(grid + 1))};
}

Polyline random_polyline(Random& random, int grid) {
  const std::size_t wanted = 2 + static_cast<std::size_t>(random.below(3));
  Polyline line{random_point(random, grid)};
  while (line.size() < wanted) {
    const Point next = random_point(random, grid);
    if (!(next == line.back())) line.push_back(next);
  }
  if (line.size() > 2 && random.chance(20) && !(line.front() == line.back())) line.push_back(line.front());
  return line;
}

RegionData random_cells(Random& random, int grid) {
  const int width = 1 + random.below(std::min(grid, 4)), height = 1 + random.below(std::min(grid, 4));
  std::vector<bool> cells(static_cast<std::size_t>(width * height));
  const int percent = 50 + random.below(45);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = random.chance(percent);
  cells[static_cast<std::size_t>(random.below(width * height))] = true;
  RegionData out = cells_region(cells, width, height, random.chance(50));
  if (random.chance(25)) out = mapped(out, 1, 1, 0, 1);
  return random.chance(25) ? mapped(out, 0, 1, 1, 0) : out;
}

/// Directed unit edges with the filled cell on the left, joined to rings; where two rings meet at a lattice point,
/// `joined` takes the right turn (around both cells), otherwise the left one (around one cell).
std::vector<Ring> trace_cells(const std::vector<bool>& cells, int width, int height, bool joined) {
  const auto filled = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && cells[static_cast<std::size_t>(y * width + x)];
  };
  using Corner = std::pair<int, int>;
  std::map<Corner, std::set<Corner>> leaving;  // directions of the edges that leave a corner
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!filled(x, y)) continue;
      if (!filled(x, y - 1)) leaving[{x, y}].insert({1, 0});
      if (!filled(x + 1, y)) leaving[{x + 1, y}].insert({0, 1});
      if (!filled(x, y + 1)) leaving[{x + 1, y + 1}].insert({-1, 0});
      if (!filled(x - 1, y)) leaving[{x, y + 1}].insert({0, -1});
    }
  std::vector<Ring> rings;
  while (!leaving.empty()) {
    const Corner start = leaving.begin()->first;
    Corner at = start, way = *leaving.begin()->second.begin();
    const Corner first_way = way;
    Ring ring;
    do {
      ring.push_back({static_cast<double>(at.first), static_cast<double>(at.second)});
      leaving[at].erase(way);
      if (leaving[at].empty()) leaving.erase(at);
      at = {at.first + way.first, at.second + way.second};
      const Corner left{-way.second, way.first}, right{way.second, -way.first};
      if (at == start && (leaving.count(at) == 0 || (joined ? right : left) == first_way)) break;
      const std::set<Corner>& ways = leaving.at(at);
      for (const Corner& choice : {joined ? right : left, way, joined ? left : right})
        if (ways.count(choice)) {
          way = choice;
          break;
        }
    } while (true);
    rings.push_back(std::move(ring));
  }
  return rings;
}

void drop_straight(Ring& ring) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (turn_of(ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]) != 0)
      out.push_back(ring[i]);
  ring = std::move(out);
}

}  // namespace

RegionData cells_region(const std::vector<bool>& cells, int width, int height, bool joined) {
  RegionData out;
  std::vector<Ring> holes;
  for (Ring& ring : trace_cells(cells, width, height, joined)) {
    drop_straight(ring);
    if (doubled_area_of(ring) > 0) {
      out.parts.push_back({std::move(ring), {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (Ring& hole :
       holes) {  // the cell on the left of its first edge is in its part; the smallest ring around it is the outer one
    const double dx = hole[1].x - hole[0].x, dy = hole[1].y - hole[0].y, unit = std::max(std::fabs(dx), std::fabs(dy));
    const Point inside{hole[0].x + (dx - dy) / unit / 2, hole[0].y + (dx + dy) / unit / 2};
    const auto around = [&](const Part& part) {
      RegionData dot;
      dot.points.push_back(inside);
      return Membership<Small>(region_of(part.outer), dot).holds(kOrigin);
    };
    Part* best = nullptr;
    for (Part& part : out.parts)
      if (around(part) && (best == nullptr || doubled_area_of(part.outer) < doubled_area_of(best->outer))) best = &part;
    best->holes.push_back(std::move(hole));
  }
  return out;
}

Ring random_polygon(Random& random, int grid, int corners) {
  while (true) {
    Ring ring;
    for (int i = 0; i < corners; ++i) ring.push_back(random_point(random, grid));
    if (!is_simple(ring)) {
      if (corners > 3 && random.chance(5)) --corners;  // crowded grids hold few polygons with many corners
      continue;
    }
    if (doubled_area_of(ring) < 0) std::reverse(ring.begin(), ring.end());
    return ring;
  }
}

/// A frame and, mostly, parts inside its hole.
RegionData random_islands(Random& random, int grid) {
  const double g = std::max(grid, 4);
  RegionData out = region_of({{0, 0}, {g, 0}, {g, g}, {0, g}});
  Ring hole{{1, 1}, {g - 1, 1}, {g - 1, g - 1}, {1, g - 1}};
  if (random.chance(40)) hole[static_cast<std::size_t>(random.below(4))] = {g / 2, g / 2};
  if (random.chance(30)) hole[static_cast<std::size_t>(random.below(4))] = {static_cast<double>(random.below(2)), 1};
  if (!is_simple(hole) || doubled_area_of(hole) <= 0 || !may_cut(out, 0, hole))
    hole = {{1, 1}, {g - 1, 1}, {g - 1, g - 1}, {1, g - 1}};
  std::reverse(hole.begin(), hole.end());
  out.parts[0].holes.push_back(std::move(hole));
  if (random.chance(50) && out.parts[0].holes[0].size() == 4) {
    const double x = 2 + random.below(static_cast<int>(g) - 3), y = 2 + random.below(static_cast<int>(g) - 3);
    const RegionData island = region_of({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
    if (!share_interior(out, island) && !run_together(out, island)) out.parts.push_back(island.parts[0]);
  } else {
    try_part(random, out, static_cast<int>(g), 3 + random.below(2));
  }
  if (random.chance(30)) try_part(random, out, static_cast<int>(g), 3);
  return out;
}

RegionData random_parts(Random& random, int grid) {
  const int kind = random.below(100);
  if (kind < 20) return random_cells(random, grid);
  if (kind < 25) return random_islands(random, grid);
  RegionData out = region_of(random_polygon(random, grid, 3 + random.below(kind < 70 ? 4 : 3)));
  if (kind >= 70 && kind < 85) {
    out = region_of(random_polygon(random, grid, 4));
    try_hole(random, out, grid);
    if (random.chance(30)) try_hole(random, out, grid);
  }
  if (kind >= 85) {
    out = region_of(random_polygon(random, grid, 3));
    try_part(random, out, grid, 3);
    if (random.chance(30)) try_part(random, out, grid, 3);
  }
  return out;
}

RegionData random_region(Random& random, int grid) {
  const int kind = random.below(100);
  if (kind < 78) return random_parts(random, grid);
  RegionData out;
  if (kind < 86) {
    out.polylines.push_back(random_polyline(random, grid));
  } else if (kind < 90) {
    out.points.push_back(random_point(random, grid));
  } else {
    if (random.chance(60)) out = random_parts(random, std::min(grid, 3));
    if (random.chance(60)) out.polylines.push_back(random_polyline(random, grid));
    if (random.chance(60)) out.points.push_back(random_point(random, grid));
    out.points.push_back(random_point(random, grid));
  }
  return out;
}

Pair random_pair(Random& random, int grid) {
  const int kind = random.below(100);
  if (kind < 67) return {random_region(random, grid), random_region(random, grid)};
  if (kind < 82) {  // hole against hole, or minus a lid
    RegionData p;
    const Part* found = nullptr;
    for (int attempt = 0; attempt < 50 && found == nullptr; ++attempt) {
      p = random_parts(random, grid);
      for (const Part& part : p.parts)
        if (!part.holes.empty()) found = &part;
    }
    if (found == nullptr) return {p, random_parts(random, grid)};
    Ring lid = found->holes[static_cast<std::size_t>(random.below(static_cast<int>(found->holes.size())))];
    std::reverse(lid.begin(), lid.end());
    RegionData q = mapped(region_of(std::move(lid)), -1, 0, 0, -1);
    if (random.chance(15)) q = mapped(q, 0, 1, 1, 0);
    return {p, q};
  }
  if (kind < 87) return {random_islands(random, grid + 3), region_of(random_polygon(random, 1, 3 + random.below(2)))};
  const int size = std::max(grid, 4), width = 3 + random.below(size - 2), height = 3 + random.below(size - 2);
  std::vector<bool> cells(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i == 0 || random.chance(70);
  const double w = 1 + random.below(2), h = 1 + random.below(2);
  const int skew = random.chance(20) ? 1 : 0;
  const bool joined = random.chance(50);
  Pair pair{cells_region(cells, width, height, joined), region_of({{0, 0}, {w, 0}, {w, h}, {0, h}})};
  return {mapped(pair.p, 1, skew, 0, 1), mapped(pair.q, 1, skew, 0, 1)};
}

RegionData mapped(const RegionData& region, double a, double b, double c, double d) {
  RegionData out = vertices_by(region, [&](Point v) {
    return Point{a * v.x + b * v.y + 0.0, c * v.x + d * v.y + 0.0};
  });
  if (a * d - b * c >= 0) return out;
  for (Part& part : out.parts) {
    std::reverse(part.outer.begin(), part.outer.end());
    for (Ring& hole : part.holes) std::reverse(hole.begin(), hole.end());
  }
  return out;
}

RegionData moved(RegionData region, double dx, double dy) {
  return vertices_by(std::move(region), [&](Point v) { return Point{v.x + dx, v.y + dy}; });
}

std::vector<RegionData> all_small_polygons(int corners) {
  std::vector<RegionData> out;
  std::vector<int> pick(static_cast<std::size_t>(corners), 0);
  const auto position = [](int k) { return Point{static_cast<double>(k % 3), static_cast<double>(k / 3)}; };
  const auto add = [&] {
    if (*std::min_element(pick.begin(), pick.end()) != pick[0]) return;  // one start vertex
    Ring ring;
    for (const int k : pick) ring.push_back(position(k));
    const auto low = [](const Ring& list, auto member) {
      return std::min_element(list.begin(), list.end(),
                              [&](const Point& a, const Point& b) { return a.*member < b.*member; });
    };
    if ((*low(ring, &Point::x)).x != 0 || (*low(ring, &Point::y)).y != 0) return;  // one translate
    if (!is_simple(ring) || doubled_area_of(ring) <= 0) return;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (turn_of(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) == 0) return;
    out.push_back(region_of(std::move(ring)));
  };
  while (true) {
    add();
    std::size_t digit = 0;
    while (digit < pick.size() && ++pick[digit] == 9) pick[digit++] = 0;
    if (digit == pick.size()) return out;
  }
}

}  // namespace dymsum::oracles
