#include "spatial/convolution/inner_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

namespace {

Vec3 midpoint(Vec3 a, Vec3 b) { return 0.5 * (a + b); }

Box box_around(Vec3 a, Vec3 b, Vec3 c) {
  Box box;
  box.add(a), box.add(b), box.add(c);
  return box;
}

/// The axis along which two boxes have the fewest rows.
int flattest(Vec3 p, Vec3 q) {
  const double across[3] = {p.y * p.z * q.y * q.z, p.z * p.x * q.z * q.x, p.x * p.y * q.x * q.y};
  return static_cast<int>(std::min_element(across, across + 3) - across);
}

}  // namespace

int passes_upward(Vec3 from, Vec3 a, Vec3 b, Vec3 c, double margin) {
  const Box box = box_around(a, b, c);
  if (from.x < box.low.x - margin || from.x > box.high.x + margin || from.y < box.low.y - margin ||
      from.y > box.high.y + margin || from.z > box.high.z + margin)
    return 0;
  const auto side = [&](Vec3 u, Vec3 v) {
    const double d = (v.x - u.x) * (from.y - u.y) - (v.y - u.y) * (from.x - u.x);
    const double error =
        margin * 8 *
        (std::abs(v.x - u.x) + std::abs(v.y - u.y) + std::abs(from.x - u.x) + std::abs(from.y - u.y) + margin);
    return d > error ? 1 : d < -error ? -1 : 0;
  };
  const int s = side(a, b), t = side(b, c), u = side(c, a);
  const bool left = s > 0 || t > 0 || u > 0, right = s < 0 || t < 0 || u < 0;
  if (left && right) return 0;
  if (s == 0 || t == 0 || u == 0) return -1;
  const double h = dot(cross(b - a, c - a), from - a) * s;
  const double error = 64 * margin * (direction_norm(b - a) + direction_norm(c - a) + margin) *
                       (direction_norm(from - a) + direction_norm(b - a) + margin);
  return h < -error ? 1 : h > error ? 0 : -1;
}

InnerCells::InnerCells(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, int across,
                       StageWatch& watch)
    : space_(space), margin_(space.sum_radius() + space.span() * 0x1p-44) {
  if (across < 2 || p.triangles.empty() || q.triangles.empty()) return;
  Box of_p, of_q;
  for (const Vec3& v : space.p()) of_p.add(v);
  for (const Vec3& v : space.q()) of_q.add(v);
  axis_ = flattest(of_p.high - of_p.low, of_q.high - of_q.low);
  step_ = (1.0 / across) * turned((of_p.high - of_p.low) + (of_q.high - of_q.low));
  if (!(std::min({step_.x, step_.y, step_.z}) > 64 * margin_)) return;
  Lattice both[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<Vec3>& from = k == 0 ? space.p() : space.q();
    std::vector<Vec3> at;
    at.reserve(from.size());
    for (const Vec3& v : from) at.push_back(turned(v));
    both[k] = inside(k == 0 ? p : q, at, watch);
  }
  const Lattice &a = both[0], &b = both[1];
  low_ = a.low + b.low;
  for (std::size_t i = 0; i < 3; ++i) size_[i] = a.size[i] + b.size[i] - 1;
  words_ = (static_cast<std::size_t>(size_[2]) + 63) / 64;
  const std::vector<Row> p_rows = rows(a), q_rows = rows(b);
  if (p_rows.empty() || q_rows.empty()) return;
  bits_.assign(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * words_, 0);
  watch.run(static_cast<std::size_t>(size_[0]), [&](std::size_t x) { add_rows(static_cast<int>(x), p_rows, q_rows); });
}

/// The boxes that lie inside a solid: those that no triangle comes near fall into connected parts, and one of its boxes
/// decides for a part.
InnerCells::Lattice InnerCells::inside(const SolidOperand& solid, const std::vector<Vec3>& at,
                                       StageWatch& watch) const {
  Lattice lattice;
  Box box;
  for (const Vec3& v : at) box.add(v);
  lattice.low = box.low;
  const Vec3 size = box.high - box.low;
  lattice.size = {static_cast<int>(size.x / step_.x) + 1, static_cast<int>(size.y / step_.y) + 1,
                  static_cast<int>(size.z / step_.z) + 1};
  lattice.state.assign(lattice.at(lattice.size[0], 0, 0), 0);
  const auto in_steps = [&](std::uint32_t v) {
    const Vec3 d = at[v] - lattice.low;
    return Vec3{d.x / step_.x, d.y / step_.y, d.z / step_.z};
  };
  watch.run_intervals(solid.triangles.size(), 32, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const Triangle& t = solid.triangles[k];
      mark(lattice, in_steps(t[0]), in_steps(t[1]), in_steps(t[2]));
    }
  });
  for (int x = 0; x < lattice.size[0]; ++x)
    for (int y = 0; y < lattice.size[1]; ++y)
      for (int z = 0; z < lattice.size[2]; ++z)
        if (lattice.state[lattice.at(x, y, z)] == 0) fill(lattice, solid, at, {x, y, z});
  return lattice;
}

/// Marks what a triangle comes near: in halves until they are smaller than half a box. Coordinates are in steps from
/// the lattice's corner, off by less than 2^-42.
void InnerCells::mark(Lattice& lattice, Vec3 a, Vec3 b, Vec3 c) const {
  const Box box = box_around(a, b, c);
  const Vec3 size = box.high - box.low;
  if (size.x > 0.5 || size.y > 0.5 || size.z > 0.5) {
    const auto length = [](Vec3 d) { return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}); };
    const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
    if (ab >= bc && ab >= ca) return mark(lattice, a, midpoint(a, b), c), mark(lattice, midpoint(a, b), b, c);
    if (bc >= ca) return mark(lattice, a, b, midpoint(b, c)), mark(lattice, a, midpoint(b, c), c);
    return mark(lattice, a, b, midpoint(c, a)), mark(lattice, midpoint(c, a), b, c);
  }
  const auto index = [&](double v, std::size_t axis) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, lattice.size[axis] - 1);
  };
  const Vec3 room{margin_ / step_.x + 0x1p-40, margin_ / step_.y + 0x1p-40, margin_ / step_.z + 0x1p-40};
  const Vec3 low = box.low - room, high = box.high + room;
  const Position from{index(low.x, 0), index(low.y, 1), index(low.z, 2)},
      to{index(high.x, 0), index(high.y, 1), index(high.z, 2)};
  for (int x = from[0]; x <= to[0]; ++x)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int z = from[2]; z <= to[2]; ++z) base::set_shared_byte(lattice.state[lattice.at(x, y, z)], 3);
}

/// Decides for the connected part of boxes away from the surface that one of them belongs to.
void InnerCells::fill(Lattice& lattice, const SolidOperand& solid, const std::vector<Vec3>& at, Position from) const {
  std::vector<Position> part{from};
  const std::uint8_t open = 2;
  lattice.state[lattice.at(from[0], from[1], from[2])] = open;
  for (std::size_t k = 0; k < part.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Position next = part[k];
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= lattice.size[axis]) continue;
        std::uint8_t& state = lattice.state[lattice.at(next[0], next[1], next[2])];
        if (state != 0) continue;
        state = open;
        part.push_back(next);
      }
  }
  // A ray that passes too near an edge does not decide: then the next box is asked.
  for (const Position& cell : part) {
    const Vec3 centre{lattice.low.x + (cell[0] + 0.5) * step_.x, lattice.low.y + (cell[1] + 0.5) * step_.y,
                      lattice.low.z + (cell[2] + 0.5) * step_.z};
    bool inside = false, known = true;
    for (const Triangle& t : solid.triangles) {
      const int pass = passes_upward(centre, at[t[0]], at[t[1]], at[t[2]], margin_);
      known = known && pass >= 0;
      if (!known) break;
      inside ^= pass == 1;
    }
    if (!known) continue;
    if (inside)
      for (const Position& c : part) lattice.state[lattice.at(c[0], c[1], c[2])] = 1;
    return;
  }
}

std::vector<InnerCells::Row> InnerCells::rows(const Lattice& lattice) const {
  std::vector<Row> result;
  for (int x = 0; x < lattice.size[0]; ++x)
    for (int y = 0; y < lattice.size[1]; ++y)
      for (int z = 0; z < lattice.size[2]; ++z) {
        if (lattice.state[lattice.at(x, y, z)] != 1) continue;
        const int first = z;
        while (z + 1 < lattice.size[2] && lattice.state[lattice.at(x, y, z + 1)] == 1) ++z;
        result.push_back({x, y, first, z});
      }
  return result;
}

/// All sums of rows with one x; rows are sorted by x.
void InnerCells::add_rows(int x, const std::vector<Row>& p, const std::vector<Row>& q) {
  auto begin = q.end(), end = q.end();
  for (const Row& a : p) {
    while (begin != q.begin() && (begin - 1)->x >= x - a.x) --begin;
    while (end != q.begin() && (end - 1)->x > x - a.x) --end;
    for (auto b = begin; b != end; ++b) set(x, a.y + b->y, a.first + b->first, a.last + b->last);
  }
}

void InnerCells::set(int x, int y, int first, int last) {
  std::uint64_t* row =
      &bits_[(static_cast<std::size_t>(x) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(y)) * words_];
  const auto from = static_cast<std::size_t>(first), to = static_cast<std::size_t>(last);
  const std::uint64_t head = ~std::uint64_t{0} << (from % 64), tail = ~std::uint64_t{0} >> (63 - to % 64);
  if (from / 64 == to / 64) {
    row[from / 64] |= head & tail;
    return;
  }
  row[from / 64] |= head, row[to / 64] |= tail;
  for (std::size_t w = from / 64 + 1; w < to / 64; ++w) row[w] = ~std::uint64_t{0};
}

/// The open box that the sum of two boxes is reaches one step either way from its midpoint, a point of the lattice. Any
/// box less than half a step away from such a point in each direction, corners included, lies in it.
bool InnerCells::hold(const Box& box) const {
  if (bits_.empty()) return false;
  std::size_t at[3];
  const Vec3 from = turned(box.low), to = turned(box.high);
  const double low[3] = {from.x, from.y, from.z}, high[3] = {to.x, to.y, to.z};
  const double origin[3] = {low_.x, low_.y, low_.z}, step[3] = {step_.x, step_.y, step_.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double m = std::floor((0.5 * (low[i] + high[i]) - origin[i]) / step[i] + 0.5);
    if (m < 1 || m > size_[i]) return false;
    if (low[i] < origin[i] + (m - 1) * step[i] + 4 * margin_ || high[i] > origin[i] + (m + 1) * step[i] - 4 * margin_)
      return false;
    at[i] = static_cast<std::size_t>(m) - 1;
  }
  return bits_[(at[0] * static_cast<std::size_t>(size_[1]) + at[1]) * words_ + at[2] / 64] >> (at[2] % 64) & 1;
}

bool InnerCells::holds_piece(Vec3 a, Vec3 b, Vec3 c) const {
  const Box box = box_around(a, b, c);
  if (hold(box)) return true;
  const Vec3 size = turned(box.high - box.low);
  if (size.x <= step_.x && size.y <= step_.y && size.z <= step_.z) return false;
  Box centre;
  centre.add(1.0 / 3 * (a + b + c));
  if (!hold(centre)) return false;
  const Vec3 ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
  return holds_piece(ab, bc, ca) && holds_piece(a, ab, ca) && holds_piece(b, bc, ab) && holds_piece(c, ca, bc);
}

bool InnerCells::hold(const SumFacet& facet) const {
  if (bits_.empty()) return false;
  Vec3 at[4];
  for (int k = 0; k < facet.corners; ++k) {
    at[k] = space_.approx(facet.corner[k]);
    Box corner;
    corner.add(at[k]);
    if (!hold(corner)) return false;
  }
  return holds_piece(at[0], at[1], at[2]) && (facet.corners == 3 || holds_piece(at[0], at[2], at[3]));
}

}  // namespace dymsum::spatial
