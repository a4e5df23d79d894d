#include "planar/region/region_reference.h"

#include <optional>
#include <utility>
#include <vector>

namespace dymsum::test {
namespace {

struct Vec {
  int x, y;
  friend bool operator==(const Vec&, const Vec&) = default;
};
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
int cross(Vec a, Vec b) { return a.x * b.y - a.y * b.x; }
int dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
bool on(Vec p, Vec a, Vec b) { return cross(b - a, p - a) == 0 && dot(a - p, b - p) <= 0; }
int sign(int v) { return (v > 0) - (v < 0); }

using Loop = std::vector<Vec>;

// In thirds, so that centroids of lattice triangles are lattice points.
Loop in_thirds(const Ring& ring) {
  Loop loop;
  for (const Point p : ring) loop.push_back({3 * static_cast<int>(p.x), 3 * static_cast<int>(p.y)});
  return loop;
}

int twice_area(const Loop& loop) {
  int sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
  return sum;
}

// Ray of v strictly within the counter-clockwise turn from a to b.
bool between(Vec a, Vec v, Vec b) {
  const auto half = [a](Vec w) { return cross(a, w) > 0 || (cross(a, w) == 0 && dot(a, w) > 0) ? 0 : 1; };
  const auto before = [&half](Vec u, Vec w) { return half(u) != half(w) ? half(u) < half(w) : cross(u, w) > 0; };
  return before(a, v) && before(v, b);
}

// Do the strands p -> a0, a1 and p -> b0, b1 cross in p? Rays that coincide count as crossing.
bool strands_cross(Vec a0, Vec a1, Vec b0, Vec b1) {
  for (const Vec a : {a0, a1}) {
    for (const Vec b : {b0, b1}) {
      if (cross(a, b) == 0 && dot(a, b) > 0) return true;
    }
  }
  return between(a0, b0, a1) != between(a0, b1, a1);
}

struct Strand {
  Vec before, after;
};

// All strands of a loop through p.
std::vector<Strand> strands_at(const Loop& loop, Vec p) {
  std::vector<Strand> strands;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec a = loop[i], b = loop[(i + 1) % n];
    if (a == p) strands.push_back({loop[(i + n - 1) % n] - p, b - p});
    if (a != p && b != p && on(p, a, b)) strands.push_back({a - p, b - p});
  }
  return strands;
}

bool edges_cross_inside(const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec p = a[i], q = a[(i + 1) % a.size()], r = b[j], s = b[(j + 1) % b.size()];
      if (sign(cross(q - p, r - p)) * sign(cross(q - p, s - p)) < 0 &&
          sign(cross(s - r, p - r)) * sign(cross(s - r, q - r)) < 0) {
        return true;
      }
    }
  }
  return false;
}

// Crossing or running along. Loops that run along each other do so up to a vertex of one of them.
bool loops_cross(const Loop& a, const Loop& b) {
  if (edges_cross_inside(a, b)) return true;
  for (const Loop* vertices : {&a, &b}) {
    for (const Vec p : *vertices) {
      for (const Strand& s : strands_at(a, p)) {
        for (const Strand& t : strands_at(b, p)) {
          if (strands_cross(s.before, s.after, t.before, t.after)) return true;
        }
      }
    }
  }
  return false;
}

bool loop_crosses_itself(const Loop& loop) {
  if (edges_cross_inside(loop, loop)) return true;
  for (const Vec p : loop) {
    const std::vector<Strand> strands = strands_at(loop, p);
    for (std::size_t i = 0; i < strands.size(); ++i) {
      const Strand& s = strands[i];
      if (cross(s.before, s.after) == 0 && dot(s.before, s.after) > 0) return true;
      for (std::size_t j = 0; j < i; ++j) {
        if (strands_cross(s.before, s.after, strands[j].before, strands[j].after)) return true;
      }
    }
  }
  return false;
}

// 0 outside, 1 inside, -1 on the loop.
int location(const Loop& loop, Vec p) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    Vec a = loop[i], b = loop[(i + 1) % loop.size()];
    if (on(p, a, b)) return -1;
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.y > b.y) std::swap(a, b);
    if (cross(b - a, p - a) > 0) inside = !inside;
  }
  return inside ? 1 : 0;
}

// How often the point is covered: by parts, and by holes that are nowhere to be. -1 on an edge.
struct Cover {
  int parts = 0;
  bool stray_hole = false;
};

std::optional<Cover> cover(const std::vector<std::vector<Loop>>& parts, Vec p) {
  Cover result;
  for (const std::vector<Loop>& part : parts) {
    int holes = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int where = location(part[i], p);
      if (where < 0) return std::nullopt;
      if (i > 0) holes += where;
    }
    const int outer = location(part[0], p);
    result.stray_hole |= holes > outer;
    result.parts += outer == 1 && holes == 0;
  }
  return result;
}

}  // namespace

bool encloses_counter_clockwise(const Ring& ring) { return twice_area(in_thirds(ring)) > 0; }

std::string reference_verdict(const RegionData& data) {
  std::vector<std::vector<Loop>> parts;
  std::vector<Loop> loops;
  std::vector<bool> outer;
  for (const Part& part : data.parts) {
    parts.emplace_back(1, in_thirds(part.outer));
    for (const Ring& hole : part.holes) parts.back().push_back(in_thirds(hole));
    for (std::size_t i = 0; i < parts.back().size(); ++i) outer.push_back(i == 0);
    loops.insert(loops.end(), parts.back().begin(), parts.back().end());
  }
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == loop[(i + 1) % loop.size()]) return "repeated_vertex";
    }
    bool flat = true;
    for (const Vec p : loop) flat &= cross(loop[1] - loop[0], p - loop[0]) == 0;
    if (flat) return "no_area";
  }
  bool self = false, pair = false;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    self |= loop_crosses_itself(loops[i]);
    for (std::size_t j = 0; j < i; ++j) pair |= loops_cross(loops[i], loops[j]);
  }
  if (self || pair) return self && pair ? "self_crossing or rings_cross" : self ? "self_crossing" : "rings_cross";
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if ((twice_area(loops[i]) > 0) != outer[i]) return "wrong_orientation";
  }
  for (int x = 0; x <= 12; ++x) {
    for (int y = 0; y <= 12; ++y) {
      const std::optional<Cover> here = cover(parts, {x, y});
      if (here && (here->stray_hole || here->parts > 1)) return "hole_outside or parts_overlap";
    }
  }
  return "valid";
}

}  // namespace dymsum::test
