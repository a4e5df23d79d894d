#include "planar/arrangement/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <tuple>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "planar/mask/interior_mask.h"

namespace dymsum::planar {
namespace {

// The top bit of each 16-bit field; bounds stay below it.
constexpr std::uint64_t kGuard = 0x8000800080008000;

// Fields of `low`: x0, y0, -x1, -y1; of `high`: x1, y1, -x0, -y0, negated ones counted from the top. Boxes meet when no
// field of one's low exceeds that of the other's high, that is, when no field of the difference borrows the guard.
bool boxes_meet(std::uint64_t high, std::uint64_t low) { return (((high | kGuard) - low) & kGuard) == kGuard; }

}  // namespace

// Zero where the span is minute or huge, so that the factor is not a number of use: then all boxes meet.
double CrossingFinder::quanta_per_unit() const {
  const double factor = (kBoxQuanta - 3) / soup_.lattice.span;
  return factor <= std::numeric_limits<double>::max() ? factor : 0;
}

void CrossingFinder::make_keys() {
  const double per_quantum = quanta_per_unit();
  const auto word = [](int a, int b, int c, int d) {
    return static_cast<std::uint64_t>(a) | static_cast<std::uint64_t>(b) << 16 | static_cast<std::uint64_t>(c) << 32 |
           static_cast<std::uint64_t>(d) << 48;
  };
  keys_.resize(soup_.size());
  for (std::uint32_t s = 0; s < soup_.size(); ++s) {
    const BoxQuanta b = quanta(soup_.boxes[s], per_quantum);
    keys_[s] = {word(b.x0, b.y0, kBoxQuanta - b.x1, kBoxQuanta - b.y1),
                word(b.x1, b.y1, kBoxQuanta - b.x0, kBoxQuanta - b.y0)};
  }
}

// What all tests of one segment share.
struct CrossingFinder::Probe {
  std::uint32_t segment, next;
  const SoupBox& box;
  double error;  // of the side of a point
};

inline CrossingFinder::Probe CrossingFinder::probe(std::uint32_t s) const {
  const SoupBox& b = soup_.boxes[s];
  return {s, next_.empty() ? kNone : next_[s], b, soup_.error(b)};
}

namespace {

// Two opposite sides of a line, both proved.
inline bool opposite(double s, double t, double error) {
  return (s > error && t < -error) || (s < -error && t > error);
}

// The same side for both, provably.
inline bool one_side(double s, double t, double error) { return std::min(s, t) > error || std::max(s, t) < -error; }

// Two cross products' difference: perhaps zero.
inline bool near_parallel(double u, double v) {
  return std::abs(u - v) <= kScaledEdgeCross * (std::abs(u) + std::abs(v)) + exact::kUnderflow;
}

#ifdef __SSE2__
inline std::uint32_t zero_bytes(const ByteLanes& lanes) {
  return ~static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(lanes))) & 0xffff;
}
#else
inline std::uint32_t zero_bytes(const ByteLanes& lanes) {
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < kByteLanes; ++k) bits |= static_cast<std::uint32_t>(lanes[k] == 0) << k;
  return bits;
}
#endif

// The lower and the upper ends of sides between a and b, in bytes; a quantum more at the upper end as in quanta().
inline void low_bytes(const std::int16_t* a, const std::int16_t* b, std::uint32_t n, std::int8_t* to) {
  for (std::uint32_t s = 0; s < n; ++s) to[s] = byte_quantum(std::min(a[s], b[s]));
}
inline void high_bytes(const std::int16_t* a, const std::int16_t* b, std::uint32_t n, std::int8_t* to) {
  for (std::uint32_t s = 0; s < n; ++s) to[s] = byte_quantum(static_cast<std::int16_t>(std::max(a[s], b[s]) + 1));
}

// Up to here comparing each box with all others is cheaper than sorting them. A left side and a number fit into kSmall
// bits.
constexpr std::uint32_t kNumberBits = 7, kUnsorted = 1 << kNumberBits, kSmall = 15 + kNumberBits;

// What a parameter that is not rough errs by besides kFractionRoundings.
constexpr double kFine = Meetings::kApart / 4;
static_assert(kFine + kFractionRoundings <= Meetings::kApart / 2);

}  // namespace

// Doubles decide, for segments that are no neighbours in a chain. True when they do not: then it takes an exact test.
inline bool CrossingFinder::undecided_strangers(const Probe& i, std::uint32_t j) {
  const SoupBox &a = i.box, &b = soup_.boxes[j];
  const double o1 = a.dx * (b.ay - a.ay) - a.dy * (b.ax - a.ax);
  const double o2 = a.dx * (b.by - a.ay) - a.dy * (b.bx - a.ax);
  if (one_side(o1, o2, i.error)) return false;
  const double b_error = soup_.error(b);
  const double o3 = b.dx * (a.ay - b.ay) - b.dy * (a.ax - b.ax);
  const double o4 = b.dx * (a.by - b.ay) - b.dy * (a.bx - b.ax);
  if (one_side(o3, o4, b_error)) return false;
  const double u = a.dx * b.dy, v = a.dy * b.dx;
  if (opposite(o1, o2, i.error) && opposite(o3, o4, b_error)) {
    if (!(kCrossingFractions * std::max(i.error, b_error) < kFine * std::abs(u - v))) out_.rough = true;
    add_crossing(i.segment, j, o3, o4, o1, o2);
    return false;
  }
  // Others that share an end.
  const bool in_chains = i.segment < first_unchained_ && j < first_unchained_;
  return !(in_chains && !near_parallel(u, v) &&
           (soup_.end(i.segment) == soup_.start(j) || soup_.end(j) == soup_.start(i.segment)));
}

// The same for any segments.
inline bool CrossingFinder::undecided(const Probe& i, std::uint32_t j) {
  const SoupBox &a = i.box, &b = soup_.boxes[j];
  // Neighbours in a chain that do not fold back meet in their common end only.
  if (i.next == j || (!next_.empty() && next_[j] == i.segment)) {
    if (!near_parallel(a.dx * b.dy, a.dy * b.dx)) return false;
  }
  return undecided_strangers(i, j);
}

inline void CrossingFinder::test(const Probe& i, std::uint32_t j) {
  if (undecided(i, j)) exact_test(i.segment, j);
}

void CrossingFinder::all_pairs() {
  const std::uint32_t n = static_cast<std::uint32_t>(soup_.size());
  make_keys();
  near_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    query(i, n);
    const std::uint64_t high = keys_[i].high;
    std::uint32_t* near = near_.data();
    for (std::uint32_t j = i + 1; j < n; ++j) {
      *near = j;
      near += boxes_meet(high, keys_[j].low);
    }
    const Probe of_i = probe(i);
    for (const std::uint32_t* j = near_.data(); j != near; ++j) test(of_i, *j);
  }
  out_.pair_tests = std::uint64_t(n) * (n - (n > 0)) / 2;
  finish();
}

// The segment that continues each one and meets it in their common end only: none where it folds back.
void CrossingFinder::find_followers(std::uint32_t* follower) const {
  const auto n = static_cast<std::uint32_t>(soup_.size());
  const SoupBox* const boxes = soup_.boxes.data();
  if (next_.empty()) {
    std::fill_n(follower, n, kNone);
    return;
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = next_[i];
    follower[i] = k == kNone || near_parallel(boxes[i].dx * boxes[k].dy, boxes[i].dy * boxes[k].dx) ? kNone : k;
  }
}

// Few boxes in bytes.
struct CrossingFinder::ByteBoxes {
  ByteBoxes(std::span<const SoupBox> boxes, double per_quantum) {
    const auto n = static_cast<std::uint32_t>(boxes.size());
    std::array<std::array<std::int16_t, kUnsorted + kByteLanes>, 4> ends;
    auto& [ax, ay, bx, by] = ends;
    const auto quantum = [&](double v) { return static_cast<std::int16_t>(static_cast<int>(v * per_quantum)); };
    for (std::uint32_t s = 0; s < n; ++s) {
      ax[s] = quantum(boxes[s].ax);
      ay[s] = quantum(boxes[s].ay);
      bx[s] = quantum(boxes[s].bx);
      by[s] = quantum(boxes[s].by);
    }
    const std::uint32_t padded = (n + kByteLanes - 1) / kByteLanes * kByteLanes;
    for (auto& end : ends) std::memset(&end[n], 0, kByteLanes * sizeof end[n]);
    for (std::uint32_t s = 0; s < padded; ++s) left[s] = std::min(ax[s], bx[s]);
    low_bytes(ax.data(), bx.data(), padded, sides[0].data());
    low_bytes(ay.data(), by.data(), padded, sides[1].data());
    high_bytes(ax.data(), bx.data(), padded, sides[2].data());
    high_bytes(ay.data(), by.data(), padded, sides[3].data());
    // After the last box lie some that start to the right of everything and meet nothing.
    for (auto& side : sides) std::memset(&side[n], kBeyond, kByteLanes);
  }
  std::array<std::int16_t, kUnsorted> left;                              // in the finer quanta
  std::array<std::array<std::int8_t, kUnsorted + kByteLanes>, 4> sides;  // x0, y0, x1, y1
};

// Few boxes: each with all behind it, sixteen at a time in bytes. What is found is put into the order of the sweep,
// because of several contacts at one position the first one is named. Loops without branches, as far as they go: which
// boxes meet is hard to foresee.
void CrossingFinder::compare_all() {
  const std::uint32_t n = static_cast<std::uint32_t>(soup_.size());
  const ByteBoxes bytes(soup_.boxes, quanta_per_unit());
  const auto& left = bytes.left;
  const auto& [x0, y0, x1, y1] = bytes.sides;
  // Pairs of segments as the sweep comes upon them.
  const auto pair_key = [&](std::uint32_t s, std::uint32_t t) {
    const std::uint64_t a = static_cast<std::uint64_t>(left[s]) << kNumberBits | s,
                        b = static_cast<std::uint64_t>(left[t]) << kNumberBits | t;
    return std::min(a, b) << kSmall | std::max(a, b);
  };
  Array<std::uint64_t> exact(soup_.memory);
  std::array<std::uint32_t, kUnsorted> follower;
  find_followers(follower.data());
  std::array<std::uint8_t, kUnsorted> near;
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    const ByteLanes low_x = all_bytes(x0[i]), low_y = all_bytes(y0[i]), high_x = all_bytes(x1[i]),
                    high_y = all_bytes(y1[i]);
    const std::uint32_t next = follower[i];
    std::uint32_t count = 0;
    for (std::uint32_t j = i + 1; j < n; j += kByteLanes) {
      const ByteLanes apart = (load_bytes(&x0[j]) > high_x) | (low_x > load_bytes(&x1[j])) |
                              (load_bytes(&y0[j]) > high_y) | (low_y > load_bytes(&y1[j]));
      for (std::uint32_t hits = zero_bytes(apart); hits != 0; hits &= hits - 1) {
        const std::uint32_t k = j + static_cast<std::uint32_t>(std::countr_zero(hits));
        near[count] = static_cast<std::uint8_t>(k);
        count += static_cast<std::uint32_t>(k != next) & static_cast<std::uint32_t>(follower[k] != i);
      }
    }
    const Probe of_i = probe(i);
    for (std::uint32_t m = 0; m < count; ++m)
      if (const std::uint32_t k = near[m]; undecided_strangers(of_i, k)) exact.push_back(pair_key(i, k));
  }
  std::sort(exact.begin(), exact.end());
  for (const std::uint64_t pair : exact) exact_test(pair >> kSmall & (kUnsorted - 1), pair & (kUnsorted - 1));
  if (out_.crossings.size() > 1)
    std::sort(out_.crossings.begin(), out_.crossings.end(),
              [&](const Crossing& c, const Crossing& d) { return pair_key(c.a, c.b) < pair_key(d.a, d.b); });
  out_.pair_tests = std::uint64_t(n) * (n - (n > 0)) / 2;
}

void CrossingFinder::sweep(const InteriorMask* mask) {
  mask_ = mask;
  const std::uint32_t n = static_cast<std::uint32_t>(soup_.size());
  if (n <= kUnsorted) {
    compare_all();
    return finish();
  }
  const double per_quantum = quanta_per_unit();
  Array<BoxQuanta> boxes(n, soup_.memory);
  for (std::uint32_t s = 0; s < n; ++s) boxes[s] = quanta(soup_.boxes[s], per_quantum);
  Array<std::uint32_t> follower(n, soup_.memory);
  find_followers(follower.data());
  out_.pair_tests += sweep_boxes(
      boxes, soup_.memory,
      [&](std::uint32_t s, std::uint32_t i) {
        query(i, n);
        return [s, next = follower[s], follows = follower.data()](std::uint32_t t) {
          return static_cast<std::uint32_t>(t != next) & static_cast<std::uint32_t>(follows[t] != s);
        };
      },
      [&](std::uint32_t s, std::span<const std::uint32_t> others) {
        const Probe of_s = probe(s);
        for (const std::uint32_t t : others)
          if (undecided_strangers(of_s, t)) exact_test(s, t);
      });
  finish();
}

// Here, where the tests can be inlined.
void CrossingFinder::meet_pieces(const SegmentPiece& piece, std::span<const std::uint32_t> others) {
  const Probe of_piece = probe(piece.segment);
  piece_ = &piece;
  for (const std::uint32_t k : others) {
    other_piece_ = &pieces_[k];
    if (undecided_strangers(of_piece, other_piece_->segment)) exact_test(piece.segment, other_piece_->segment);
  }
  piece_ = nullptr;
}

void CrossingFinder::pairs(std::span<const std::array<std::uint32_t, 2>> list) {
  for (const auto& [i, j] : list) test(probe(i), j);
  out_.pair_tests = list.size();
  finish();
}

// Whether the crossing of a and b, at parameter t of a, provably lies in a covered cell, which is in Mo with more
// around it than t errs.
bool CrossingFinder::in_covered_cell(std::uint32_t a, std::uint32_t b, double t) const {
  const Grid& g = mask_->grid();
  const double dx = soup_.dx(a), dy = soup_.dy(a);
  if (!mask_->covered(g.row(soup_.boxes[a].ay + t * dy), g.column(soup_.boxes[a].ax + t * dx))) return false;
  return soup_.parameter_error(a, b) * (std::abs(dx) + std::abs(dy)) * g.per_cell < kReach;
}

// Little slack for the largest array of all. Crossings are events, whose numbers have 31 bits.
void CrossingFinder::make_room(Array<Crossing>& list) {
  if (list.size() >= 0x7fffffff) throw std::length_error("more than 2^31 crossings");
  list.reserve(std::min<std::size_t>(0x7fffffff, 64 + list.size() + list.size() / 3));
}

// a_start, a_end: the sides of a's ends with respect to b, of opposite signs.
void CrossingFinder::add_crossing(std::uint32_t i, std::uint32_t j, double a_start, double a_end, double b_start,
                                  double b_end) {
  const double t = a_start / (a_start - a_end);
  const auto on_b = [&] { return b_start / (b_start - b_end); };
  bool ambiguous = false;
  if (grid_ != nullptr) {
    // The crossing belongs to the cell that holds it; near the edge of a cell every cell reports it and duplicates are
    // dropped later.
    const SoupBox& a = soup_.boxes[i];
    const double dx = soup_.dx(i), dy = soup_.dy(i);
    const double x = (a.ax + t * dx) * grid_->per_cell, y = (a.ay + t * dy) * grid_->per_cell;
    const double error = kReach / 2 + soup_.parameter_error(i, j) * (std::abs(dx) + std::abs(dy)) * grid_->per_cell;
    const double fx = x - column_, fy = y - row_;
    if (fx < -error || fx > 1 + error || fy < -error || fy > 1 + error) return;
    ambiguous = !(fx > error && fx < 1 - error && fy > error && fy < 1 - error);
  } else if (mask_ != nullptr && in_covered_cell(i, j, t)) {
    return;
  } else if (piece_ != nullptr) {
    const Owned owned = piece_->segment == i ? owned_by_pieces(i, j, t, on_b()) : owned_by_pieces(j, i, on_b(), t);
    if (owned == Owned::no) return;
    ambiguous = owned == Owned::unsure;
  }
  const double u = on_b();
  auto& list = ambiguous ? ambiguous_ : out_.crossings;
  if (list.size() == list.capacity()) make_room(list);
  // b's ends go from b_start to b_end across a: d_a x d_b has the sign of b_end.
  Crossing& c = list.emplace_back();
  const bool in_order = b_end > b_start;
  c.a = in_order ? i : j;
  c.b = in_order ? j : i;
  c.ta = in_order ? t : u;
  c.tb = in_order ? u : t;
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
    const Probe of_i = probe(ids[i]);
    for (const std::uint32_t* j = near_.data(); j != near; ++j) test(of_i, *j);
  }
}

namespace {

// What of a segment provably lies in a cell, not just within reach of it.
SegmentClip::Part inside_cell(const SoupBox& b, const Grid& grid, int row, int column) {
  const double h = grid.cell;
  return SegmentClip(b.ax, b.ay, b.bx - b.ax, b.by - b.ay).within(column * h, row * h, (column + 1) * h, (row + 1) * h);
}

}  // namespace

// The segments of every live cell, row by row: those of cell k are ids[start[k]], ... before ids[start[k + 1]].
struct CrossingFinder::CellLists {
  Array<std::uint32_t> start, ids;
};

CrossingFinder::CellLists CrossingFinder::list_cells(Array<CoveredMark>& covered_marks) const {
  const Grid& grid = *grid_;
  struct Item {
    std::uint32_t cell, segment;
  };
  Array<Item> items(soup_.memory);
  items.reserve(soup_.size() * 3 / 2);
  const std::uint32_t columns = static_cast<std::uint32_t>(grid.columns);
  CellLists lists{Array<std::uint32_t>(std::size_t(grid.rows) * columns + 1, 0, soup_.memory),
                  Array<std::uint32_t>(soup_.memory)};
  Array<std::uint32_t>& start = lists.start;
  for (std::uint32_t s = 0; s < soup_.size(); ++s) {
    const SoupBox& b = soup_.boxes[s];
    for_each_cell_run(grid, b.ax, b.ay, b.bx, b.by, [&](int row, int c0, int c1) {
      std::uint32_t cell = static_cast<std::uint32_t>(row) * columns + static_cast<std::uint32_t>(c0);
      for (int c = c0; c <= c1; ++c, ++cell) {
        if (mask_ != nullptr && mask_->covered(row, c)) {
          if (c > c0 && mask_->covered(row, c - 1)) continue;
          if (const SegmentClip::Part t = inside_cell(b, grid, row, c); t.to > t.from)
            covered_marks.push_back({s, t.midpoint()});
          continue;
        }
        items.push_back({cell, s});
        ++start[cell + 1];
      }
    });
  }
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  lists.ids.resize(items.size());
  Array<std::uint32_t> at(start.begin(), start.end() - 1, soup_.memory);
  for (const Item& item : items) lists.ids[at[item.cell]++] = item.segment;
  return lists;
}

void CrossingFinder::grid(const Grid& grid, const InteriorMask* mask, Array<CoveredMark>& covered_marks) {
  grid_ = &grid;
  mask_ = mask;
  make_keys();
  const CellLists lists = list_cells(covered_marks);
  out_.cell_entries = lists.ids.size();
  std::size_t cell = 0;
  for (int r = 0; r < grid.rows; ++r) {
    if (poll_ != nullptr) (*poll_)(double(r) / grid.rows);
    for (int c = 0; c < grid.columns; ++c, ++cell) {
      const std::uint32_t from = lists.start[cell], to = lists.start[cell + 1];
      if (to - from < 2) continue;
      row_ = r;
      column_ = c;
      test_cell({lists.ids.data() + from, to - from});
    }
  }
  finish();
}

// Drops what several cells have reported.
void CrossingFinder::finish() {
  if (ambiguous_.empty() && out_.touches.empty()) return;
  const auto by_segments = [](const Crossing& a, const Crossing& b) { return std::tie(a.a, a.b) < std::tie(b.a, b.b); };
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
