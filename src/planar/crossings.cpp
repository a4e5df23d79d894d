#include "planar/crossings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace dymsum::planar {

namespace {

// The top bit of each 16-bit field; bounds stay below it.
constexpr std::uint64_t kGuard = 0x8000800080008000;
constexpr int kQuanta = 0x7fff;

// Fields of `low`: x0, y0, -x1, -y1; of `high`: x1, y1, -x0, -y0, negated ones counted from the top. Boxes meet when no field of
// one's low exceeds that of the other's high, that is, when no field of the difference borrows the guard.
bool boxes_meet(std::uint64_t high, std::uint64_t low) { return (((high | kGuard) - low) & kGuard) == kGuard; }

}  // namespace

void CrossingFinder::make_keys() {
  const double per_quantum = (kQuanta - 2) / soup_.lattice.span;
  // Monotone; one quantum more at the upper end covers the rounding of the coordinates. A span that is minute or huge, so that the
  // factor is not a number of use, leaves all boxes meeting.
  const auto quantum = [&](double v) { return std::isfinite(per_quantum) ? std::clamp(static_cast<int>(v * per_quantum), 0, kQuanta - 1) : 0; };
  const auto word = [](int a, int b, int c, int d) {
    return static_cast<std::uint64_t>(a) | static_cast<std::uint64_t>(b) << 16 | static_cast<std::uint64_t>(c) << 32 |
           static_cast<std::uint64_t>(d) << 48;
  };
  keys_.resize(soup_.size());
  for (std::size_t s = 0; s < soup_.size(); ++s) {
    const SoupBox& b = soup_.boxes[s];
    const int x0 = quantum(std::min(b.ax, b.bx)), y0 = quantum(std::min(b.ay, b.by));
    const int x1 = quantum(std::max(b.ax, b.bx)) + 1, y1 = quantum(std::max(b.ay, b.by)) + 1;
    keys_[s] = {word(x0, y0, kQuanta - x1, kQuanta - y1), word(x1, y1, kQuanta - x0, kQuanta - y0)};
  }
}

void CrossingFinder::all_pairs() {
  const std::uint32_t n = static_cast<std::uint32_t>(soup_.size());
  make_keys();
  near_.resize(n);
  for (std::uint32_t i = 0; i < n && !stopped; ++i) {
    if (poll != nullptr && i % 256 == 255 && !(*poll)(double(i) / n)) stopped = true;
    const std::uint64_t high = keys_[i].high;
    std::uint32_t* near = near_.data();
    for (std::uint32_t j = i + 1; j < n; ++j) {
      *near = j;
      near += boxes_meet(high, keys_[j].low);
    }
    for (const std::uint32_t* j = near_.data(); j != near; ++j) test(i, *j);
  }
  out_.pair_tests = std::uint64_t(n) * (n - (n > 0)) / 2;
  peak_bytes_ = keys_.capacity() * sizeof(BoxKey) + near_.capacity() * 4;
  finish();
}

void CrossingFinder::pairs(std::span<const std::array<std::uint32_t, 2>> list) {
  for (const auto& [i, j] : list) test(i, j);
  out_.pair_tests = list.size();
  finish();
}

void CrossingFinder::test(std::uint32_t i, std::uint32_t j) {
  const SoupBox &a = soup_.boxes[i], &b = soup_.boxes[j];
  const double a_dx = soup_.dx(i), a_dy = soup_.dy(i), b_dx = soup_.dx(j), b_dy = soup_.dy(j);
  if (chain_ != nullptr && (chain_->next(i) == j || chain_->next(j) == i)) {
    // Neighbours in a chain that do not fold back meet in their common end only.
    const double u = a_dx * b_dy, v = a_dy * b_dx;
    if (std::abs(u - v) > 0x1p-49 * (std::abs(u) + std::abs(v)) + 0x1p-1000) return;
  }
  const double a_error = soup_.side_error * (std::abs(a_dx) + std::abs(a_dy));
  const double b_error = soup_.side_error * (std::abs(b_dx) + std::abs(b_dy));
  const double o1 = a_dx * (b.ay - a.ay) - a_dy * (b.ax - a.ax);
  const double o2 = a_dx * (b.by - a.ay) - a_dy * (b.bx - a.ax);
  if ((o1 > a_error && o2 > a_error) || (o1 < -a_error && o2 < -a_error)) return;
  const double o3 = b_dx * (a.ay - b.ay) - b_dy * (a.ax - b.ax);
  const double o4 = b_dx * (a.by - b.ay) - b_dy * (a.bx - b.ax);
  if ((o3 > b_error && o4 > b_error) || (o3 < -b_error && o4 < -b_error)) return;
  if (std::abs(o1) > a_error && std::abs(o2) > a_error && std::abs(o3) > b_error && std::abs(o4) > b_error)
    return add_crossing(i, j, o3, o4, o1, o2);
  if (soup_.end(i) == soup_.start(j) || soup_.end(j) == soup_.start(i)) {
    // So do others that share an end.
    const double u = a_dx * b_dy, v = a_dy * b_dx;
    if (std::abs(u - v) > 0x1p-49 * (std::abs(u) + std::abs(v)) + 0x1p-1000 && i < first_unchained && j < first_unchained)
      return;
  }
  exact_test(i, j);
}

// a_start, a_end: the sides of a's ends with respect to b, of opposite signs.
void CrossingFinder::add_crossing(std::uint32_t i, std::uint32_t j, double a_start, double a_end, double b_start, double b_end) {
  Crossing c;
  c.a = i;
  c.b = j;
  // Numerator and denominator err by at most 1.5 and 3 side errors; t is at most 1, its quotient rounded three times.
  const double per_a = 1 / (a_start - a_end);
  c.ta = a_start * per_a;
  c.ea = static_cast<float>(8 * soup_.error(j) * std::abs(per_a) + 0x1p-50);
  bool ambiguous = false;
  if (grid_ != nullptr) {
    // The crossing belongs to the cell that holds it; near a border every cell reports it and duplicates are dropped later.
    const SoupBox& a = soup_.boxes[i];
    const double dx = soup_.dx(i), dy = soup_.dy(i);
    const double x = (a.ax + c.ta * dx) * grid_->per_cell, y = (a.ay + c.ta * dy) * grid_->per_cell;
    const double error = kReach / 2 + c.ea * (std::abs(dx) + std::abs(dy)) * grid_->per_cell;
    const double fx = x - column_, fy = y - row_;
    if (fx < -error || fx > 1 + error || fy < -error || fy > 1 + error) return;
    ambiguous = !(fx > error && fx < 1 - error && fy > error && fy < 1 - error);
  }
  const double per_b = 1 / (b_start - b_end);
  c.tb = b_start * per_b;
  c.eb = static_cast<float>(8 * soup_.error(i) * std::abs(per_b) + 0x1p-50);
  // b's ends go from b_start to b_end across a: d_a x d_b has the sign of b_end.
  c.sign = b_end > b_start ? 1 : -1;
  auto& list = ambiguous ? ambiguous_ : out_.crossings;
  if (list.size() == list.capacity()) list.reserve(64 + list.size() + list.size() / 3);  // the largest array of all: little slack
  list.push_back(c);
}

void CrossingFinder::add_touch(std::uint32_t segment, WalkPair pair) {
  const SoupBox& s = soup_.boxes[segment];
  const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
  const double x = p.x[pair.p] + q.x[pair.q], y = p.y[pair.p] + q.y[pair.q];
  const double dx = soup_.dx(segment), dy = soup_.dy(segment);
  const bool by_x = std::abs(dx) > std::abs(dy);
  const double t = by_x ? (x - s.ax) / dx : (y - s.ay) / dy;
  const double error = 4 * soup_.point_error / std::max(std::abs(dx), std::abs(dy)) + 0x1p-50;
  out_.touches.push_back({segment, pair, std::clamp(t, 0.0, 1.0), static_cast<float>(error)});
}

// At least one side is zero or too small for doubles.
void CrossingFinder::exact_test(std::uint32_t i, std::uint32_t j) {
  const SoupBox &a = soup_.boxes[i], &b = soup_.boxes[j];
  const WalkPair a0 = soup_.start(i), a1 = soup_.end(i), b0 = soup_.start(j), b1 = soup_.end(j);
  const bool in_chains = i < first_unchained && j < first_unchained;
  const bool chained = in_chains && (a1 == b0 || b1 == a0 || a0 == b0 || a1 == b1 ||
                                     (chain_ != nullptr && (chain_->next(i) == j || chain_->next(j) == i)));
  // Segments of one chain share an end; they meet elsewhere only when they fold back onto each other.
  if (chained && soup_.cross(i, j) != 0) return;
  const Segment sa = soup_.exact(i), sb = soup_.exact(j);
  const Lattice& l = soup_.lattice;
  if (a.ax == b.ax && a.ay == b.ay && a.bx == b.bx && a.by == b.by && l.same(soup_.exact(a0), soup_.exact(b0)) &&
      l.same(soup_.exact(a1), soup_.exact(b1))) {
    // The same segment twice, which is everywhere in P + P.
    if (!in_chains || !(a0 == b0)) out_.same.emplace_back(a0, b0);
    if (!in_chains || !(a1 == b1)) out_.same.emplace_back(a1, b1);
    return;
  }
  const int s1 = l.side(sa, soup_.exact(b0)), s2 = l.side(sa, soup_.exact(b1));
  out_.exact_signs += 4;
  if (s1 * s2 > 0) return;
  const int s3 = l.side(sb, soup_.exact(a0)), s4 = l.side(sb, soup_.exact(a1));
  if (s3 * s4 > 0) return;
  if (s1 != 0 && s2 != 0 && s3 != 0 && s4 != 0) {
    // Opposite on both: the crossing parameters come from doubles that may be smaller than their error; keep t in [0, 1].
    const double a_dx = soup_.dx(i), a_dy = soup_.dy(i), b_dx = soup_.dx(j), b_dy = soup_.dy(j);
    const double o1 = a_dx * (b.ay - a.ay) - a_dy * (b.ax - a.ax), o2 = a_dx * (b.by - a.ay) - a_dy * (b.bx - a.ax);
    const double o3 = b_dx * (a.ay - b.ay) - b_dy * (a.ax - b.ax), o4 = b_dx * (a.by - b.ay) - b_dy * (a.bx - b.ax);
    const auto signed_magnitude = [](double o, int s, double error) { return s * std::max(std::abs(o), error * 0.5); };
    const double a_error = soup_.error(i) + 0x1p-1000, b_error = soup_.error(j) + 0x1p-1000;
    add_crossing(i, j, signed_magnitude(o3, s3, b_error), signed_magnitude(o4, s4, b_error), signed_magnitude(o1, s1, a_error),
                 signed_magnitude(o2, s2, a_error));
    return;
  }
  const auto within = [&](std::uint32_t s, const Segment& e, WalkPair from, WalkPair to, WalkPair v) {
    // v lies on the line of s: register it if it lies on s.
    const Pair x = soup_.exact(v);
    if (l.same(x, soup_.exact(from))) {
      if (!in_chains || !(v == from)) out_.same.emplace_back(v, from);
    } else if (l.same(x, soup_.exact(to))) {
      if (!in_chains || !(v == to)) out_.same.emplace_back(v, to);
    } else if (l.along(e, x) > 0 && l.along({{e.edge.op, e.edge.to, e.edge.from}, e.vertex}, x) > 0) {
      add_touch(s, v);
    }
  };
  if (s1 == 0) within(i, sa, a0, a1, b0);
  if (s2 == 0) within(i, sa, a0, a1, b1);
  if (s3 == 0) within(j, sb, b0, b1, a0);
  if (s4 == 0) within(j, sb, b0, b1, a1);
}

void CrossingFinder::test_cell(std::span<const std::uint32_t> ids) {
  const std::size_t n = ids.size();
  if (cell_.size() < n) {
    cell_.resize(2 * n);
    near_.resize(2 * n);
  }
  for (std::size_t k = 0; k < n; ++k) cell_[k] = keys_[ids[k]].low;
  out_.pair_tests += n * (n - 1) / 2;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const std::uint64_t high = keys_[ids[i]].high;
    std::uint32_t* near = near_.data();
    for (std::size_t j = i + 1; j < n; ++j) {
      *near = ids[j];
      near += boxes_meet(high, cell_[j]);
    }
    for (const std::uint32_t* j = near_.data(); j != near; ++j) test(ids[i], *j);
  }
}

void CrossingFinder::grid(const Grid& grid, const InteriorMask* mask, Array<DeadMark>& dead_marks) {
  grid_ = &grid;
  mask_ = mask;
  make_keys();
  struct Item {
    std::uint32_t cell, segment;
  };
  Array<Item> items(soup_.memory);
  items.reserve(soup_.size() * 3 / 2);
  const std::uint32_t columns = static_cast<std::uint32_t>(grid.columns);
  Array<std::uint32_t> start(std::size_t(grid.rows) * columns + 1, 0, soup_.memory);
  for (std::uint32_t s = 0; s < soup_.size(); ++s) {
    const SoupBox& b = soup_.boxes[s];
    for_each_cell_run(grid, b.ax, b.ay, b.bx, b.by, [&](int row, int c0, int c1) {
      std::uint32_t cell = static_cast<std::uint32_t>(row) * columns + static_cast<std::uint32_t>(c0);
      for (int c = c0; c <= c1; ++c, ++cell) {
        if (mask != nullptr && mask->dead(row, c)) {
          if (c > c0 && mask->dead(row, c - 1)) continue;
          // A point of the segment near the centre of the cell, by the slower-changing coordinate's inverse.
          const double dx = b.bx - b.ax, dy = b.by - b.ay;
          const double x_low = std::max(c * grid.cell, std::min(b.ax, b.bx));
          const double x_high = std::min((c + 1) * grid.cell, std::max(b.ax, b.bx));
          const double y_low = std::max(row * grid.cell, std::min(b.ay, b.by));
          const double y_high = std::min((row + 1) * grid.cell, std::max(b.ay, b.by));
          double t0 = 0, t1 = 1;
          if (std::abs(dx) > 0) {
            const double u = (x_low - b.ax) / dx, v = (x_high - b.ax) / dx;
            t0 = std::max(t0, std::min(u, v));
            t1 = std::min(t1, std::max(u, v));
          }
          if (std::abs(dy) > 0) {
            const double u = (y_low - b.ay) / dy, v = (y_high - b.ay) / dy;
            t0 = std::max(t0, std::min(u, v));
            t1 = std::min(t1, std::max(u, v));
          }
          // Only where the segment certainly passes through the cell, not just within reach of it.
          if (t1 > t0) dead_marks.push_back({s, 0.5 * (t0 + t1)});
          continue;
        }
        items.push_back({cell, s});
        ++start[cell + 1];
      }
    });
  }
  out_.cell_entries = items.size();
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  Array<std::uint32_t> ids(items.size(), soup_.memory);
  {
    Array<std::uint32_t> at(start.begin(), start.end() - 1, soup_.memory);
    for (const Item& item : items) ids[at[item.cell]++] = item.segment;
    peak_bytes_ = items.capacity() * sizeof(Item) + start.size() * 8 + ids.size() * 4 + keys_.capacity() * sizeof(BoxKey);
  }
  items = Array<Item>(soup_.memory);
  for (int r = 0; r < grid.rows && !stopped; ++r) {
    if (poll != nullptr && !(*poll)(double(r) / grid.rows)) stopped = true;
    for (int c = 0; c < grid.columns; ++c) {
      const std::size_t cell = std::size_t(r) * columns + c;
      const std::uint32_t from = start[cell], to = start[cell + 1];
      if (to - from < 2) continue;
      row_ = r;
      column_ = c;
      test_cell({ids.data() + from, to - from});
    }
  }
  finish();
}

// Drops what several cells have reported.
void CrossingFinder::finish() {
  const auto by_segments = [](const Crossing& a, const Crossing& b) { return std::tie(a.a, a.b) < std::tie(b.a, b.b); };
  for (Crossing& c : ambiguous_)
    if (c.a > c.b) {
      std::swap(c.a, c.b);
      std::swap(c.ta, c.tb);
      std::swap(c.ea, c.eb);
      c.sign = -c.sign;
    }
  std::sort(ambiguous_.begin(), ambiguous_.end(), by_segments);
  for (std::size_t i = 0; i < ambiguous_.size(); ++i)
    if (i == 0 || by_segments(ambiguous_[i - 1], ambiguous_[i])) out_.crossings.push_back(ambiguous_[i]);
  const auto touch_key = [](const Touch& t) { return std::tie(t.segment, t.pair.p, t.pair.q); };
  std::sort(out_.touches.begin(), out_.touches.end(),
            [&](const Touch& a, const Touch& b) { return touch_key(a) < touch_key(b); });
  out_.touches.erase(std::unique(out_.touches.begin(), out_.touches.end(),
                                 [&](const Touch& a, const Touch& b) { return touch_key(a) == touch_key(b); }),
                     out_.touches.end());
}

}  // namespace dymsum::planar
