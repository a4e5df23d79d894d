#include "planar/window/rotating_window.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "planar/window/rotation_mask.h"

namespace dymsum::planar {

// Where the extent is minute or huge the factor is not a number of use: then all boxes meet.
BoxPairs::BoxPairs(double extent, Scratch* memory) : memory_(memory), boxes_(memory), pairs_(memory), sides_(memory) {
  const double factor = (kBoxQuanta - 1) / extent;
  per_unit_ = factor <= std::numeric_limits<double>::max() ? factor : 0;
}

// There are as many strips that boxes mostly lie in one, and that each holds enough of them to fill the lanes.
int BoxPairs::strips() const {
  constexpr std::size_t kBoxes = 96, kMost = 32;
  constexpr long kHeights = 4;
  if (boxes_.size() < 2 * kBoxes) return 1;
  long heights = 0;
  for (const Box& b : boxes_) heights += b.y1 - b.y0 + 1;
  const long mean = heights / static_cast<long>(boxes_.size()) + 1;
  return static_cast<int>(
      std::clamp<long>(kBoxQuanta / (kHeights * mean), 1, static_cast<long>(std::min(kMost, boxes_.size() / kBoxes))));
}

Array<BoxPairs::Pair> BoxPairs::find(std::size_t most, const base::StopToken& stop) {
  const int n = strips(), height = kBoxQuanta / n + 1;
  std::vector<Array<std::uint64_t>> of(static_cast<std::size_t>(n), Array<std::uint64_t>(memory_));
  for (std::uint32_t i = 0; i < boxes_.size(); ++i)
    for (int k = boxes_[i].y0 / height, last = boxes_[i].y1 / height; k <= last; ++k)
      of[static_cast<std::size_t>(k)].push_back(left_order(boxes_[i].x0, i));
  pairs_.resize(4 * boxes_.size() + 4 * kLanes);
  count_ = 0;
  for (int k = 0; k < n && count_ <= most && !stop.stop_requested(); ++k)
    sweep(of[static_cast<std::size_t>(k)], static_cast<std::int16_t>(k * height), most);
  pairs_.resize(count_);
  return std::move(pairs_);
}

// Lists the pairs of a strip whose common part begins in it: it begins in one of the strips. After the last box lie
// some that start to the right of everything and meet nothing. Which of eight boxes meet cannot be predicted: all are
// listed and the position moves on for those that do.
void BoxPairs::sweep(Array<std::uint64_t>& order, std::int16_t strip, std::size_t most) {
  sort_by_left(order);
  const std::size_t n = order.size(), padded = n + 2 * kLanes;
  sides_.resize(3 * padded);
  std::int16_t *x0 = sides_.data(), *y0 = x0 + padded, *y1 = y0 + padded;
  for (std::size_t k = 0; k < padded; ++k) {
    constexpr std::int16_t kLast = std::numeric_limits<std::int16_t>::max();
    const Box b = k < n ? boxes_[static_cast<std::uint32_t>(order[k])] : Box{kLast, kLast, kLast, -1};
    x0[k] = b.x0;
    y0[k] = b.y0;
    y1[k] = b.y1;
  }
  order.resize(padded);
  for (std::size_t i = 0; i < n && count_ <= most; ++i) {
    const auto s = static_cast<std::uint32_t>(order[i]);
    const std::int16_t right = boxes_[s].x1, least = y0[i] >= strip ? std::int16_t{0} : strip;
    const Lanes low = Lanes{} + y0[i], high = Lanes{} + y1[i], far = Lanes{} + right, first = Lanes{} + least;
    for (std::size_t j = i + 1; x0[j] <= right; j += kLanes) {
      const Lanes begins = load_lanes(y0 + j);
      const Lanes meets =
          (begins <= high) & (begins >= first) & (load_lanes(y1 + j) >= low) & (load_lanes(x0 + j) <= far);
      std::array<std::int16_t, kLanes> hits;
      std::array<std::uint64_t, 2> halves;
      std::memcpy(&hits, &meets, sizeof hits);
      std::memcpy(&halves, &meets, sizeof halves);
      if ((halves[0] | halves[1]) == 0) continue;
      if (count_ + kLanes > pairs_.size()) pairs_.resize(2 * pairs_.size());
      Pair* to = pairs_.data() + count_;
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        const auto t = static_cast<std::uint32_t>(order[j + k]);
        *to = {std::min(s, t), std::max(s, t)};
        to -= hits[k];
      }
      count_ = static_cast<std::size_t>(to - pairs_.data());
    }
  }
}

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

namespace {

constexpr std::uint32_t kFewOfTurn = 12;  // segments of a vertex that are looked through one by one
constexpr double kCutFrom = 2.5;          // cells at least so many times as wide as points move are looked at for cuts

}  // namespace

struct RotatingWindow::Making {
  std::size_t most_pairs;
  const base::StopToken& stop;
  Scratch memory{};
  Array<Point> moved{&memory};  ///< how far a position with each turning vertex moves from the midpoint
  Array<RotatingSegment> segments{&memory};
  Array<Swept> swept{&memory};  ///< of segments
  Array<RotatingPiece> pieces{&memory};
  Array<double> cuts{&memory};
  Array<Box> boxes{&memory};  ///< of pieces
  Array<RotationCandidate> candidates{&memory};
};

RotatingWindow::RotatingWindow(const RotationGrid& grid, const RotationCatalog& catalog, double mid, double h,
                               bool mask, std::size_t most_pairs, const base::StopToken& stop)
    : midpoint(mid),
      half(h * exact::kOutwards + kAngleSlack),
      heading(Heading::of(mid)),
      forms_(grid.forms),
      catalog_(catalog),
      shift_(grid.forms.reach()),
      masked_(mask) {
  Making making{most_pairs, stop};
  turned.reserve(forms_.points(1).size());
  making.moved.reserve(forms_.points(1).size());
  for (std::uint32_t v = 0; v < forms_.size(1); ++v) {
    const Point& p = forms_.points(1)[v];
    turned.push_back({heading.c * p.x - heading.s * p.y, heading.s * p.x + heading.c * p.y});
    making.moved.push_back(farther_by(moved_by(turned.back(), half), kSweptPosition * forms_.span()));
  }
  const CoveredCells dead =
      mask ? covered_cells(grid, turned, half) : CoveredCells(grid.grid.whole, CoveredCells::Counts::left_out);
  if (mask) cells = static_cast<std::uint64_t>(dead.grid().rows) * static_cast<std::uint64_t>(dead.grid().columns);
  complete = !stop.stop_requested();
  if (complete) add_segments(dead, making);
  if (complete) find_candidates(dead, making);
  if (!complete) return;
  find_next();
  index(candidates, pieces.size());
  find_dead_tails();
  find_runs();
  find_rounds();
}

std::size_t RotatingWindow::bytes() const {
  return bytes_of(turned, segments, pieces, candidates, turns_[0], turns_[1], first_of, of, changing, rounds, circles);
}

std::uint32_t RotatingWindow::find(const WalkSegment& s) const {
  const Turn& t = turns_[s.side][s.vertex];
  if (t.last - t.first > kFewOfTurn) return find_in_order(s);
  for (std::uint32_t i = t.first; i < t.last; ++i)
    if (segments[i].edge == s.edge) return i;
  return kNone;
}

// The order of the edges finds it, from the first live one round.
std::uint32_t RotatingWindow::find_in_order(const WalkSegment& s) const {
  const Turn& t = turns_[s.side][s.vertex];
  const auto position = [&](std::uint32_t edge) { return catalog_.position(s.side, edge, s.vertex); };
  const std::uint32_t size = catalog_.list_size(s.side, s.vertex), from = position(segments[t.first].edge);
  if (position(s.edge) == kNone) return kNone;
  const auto after = [&](std::uint32_t edge) {
    return position(edge) >= from ? position(edge) - from : position(edge) + size - from;
  };
  const auto first = segments.begin() + t.first, last = segments.begin() + t.last;
  const auto found = std::lower_bound(first, last, after(s.edge), [&](const RotatingSegment& u, std::uint32_t wanted) {
    return after(u.edge) < wanted;
  });
  return found != last && found->edge == s.edge ? static_cast<std::uint32_t>(found - segments.begin()) : kNone;
}

RotatingWindow::Swept RotatingWindow::swept(const WalkSegment& s, const Making& making) const {
  const Pair from = TurningForms::start(s);
  const std::uint32_t to = forms_.operand(s.side).next[s.edge];
  Swept w;
  w.fixed = forms_.points(0)[from.p];
  w.turning = turned[from.q];
  const Point &a = s.side == 0 ? w.fixed : w.turning, &b = s.side == 0 ? forms_.points(0)[to] : turned[to];
  w.d = {b.x - a.x, b.y - a.y};
  w.reach = s.side == 0 ? making.moved[from.q] : farther(making.moved[from.q], making.moved[to]);
  w.side = s.side;
  return w;
}

void RotatingWindow::add_segments(const CoveredCells& dead, Making& making) {
  for (std::uint32_t side = 0; side < 2; ++side) turns_[side].assign(forms_.size(1 - side), {});
  const std::size_t usual =
      4 * (std::size_t{forms_.size(0)} + forms_.size(1));  // convolutions are a few times as large as the operands
  making.segments.reserve(usual);
  making.swept.reserve(usual);
  making.pieces.reserve(usual);
  const EdgeCells near(forms_, dead, turned, making.moved);
  catalog_.for_each_turn(
      midpoint - half, midpoint + half,
      [&](std::uint32_t side, std::uint32_t vertex, const auto& edges, std::size_t at, std::size_t count) {
        const std::size_t first = making.segments.size();
        for (std::size_t k = 0; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1)
          if (!near.covered(side, edges[at].edge, vertex)) add_segment({side, edges[at].edge, vertex}, dead, making);
        turns_[side][vertex] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(making.segments.size())};
        all_segments += count;
      });
  segments.assign(making.segments.begin(), making.segments.end());
  pieces.assign(making.pieces.begin(), making.pieces.end());
  for (std::uint32_t i = 0; i < segments.size(); ++i)
    if (!segments[i].throughout) changing.push_back(i);
}

// Unless nothing of it is live.
void RotatingWindow::add_segment(const WalkSegment& walk, const CoveredCells& dead, Making& making) const {
  const Swept w = swept(walk, making);
  RotatingSegment s{walk};
  s.first_piece = static_cast<std::uint32_t>(making.pieces.size());
  add_pieces(w, dead, making);
  s.last_piece = static_cast<std::uint32_t>(making.pieces.size());
  if (s.first_piece == s.last_piece) return;
  s.span = catalog_.span(walk, midpoint);
  s.throughout = s.span.from < -half - 2 * kAngleSlack && s.span.to > half + 2 * kAngleSlack;
  s.end = forms_.end(walk);
  making.segments.push_back(s);
  making.swept.push_back(w);
}

// Shares of points of a segment that lie farther inside a dead cell than `reach`: of one or two points for each cell
// that the segment passes.
void RotatingWindow::find_cuts(Point start, Point d, Point reach, const CoveredCells& dead, Array<double>& cuts) const {
  const Grid& g = dead.grid();
  const double u = start.x * g.per_cell, v = start.y * g.per_cell, du = d.x * g.per_cell, dv = d.y * g.per_cell;
  const double rim_u = reach.x * g.per_cell, rim_v = reach.y * g.per_cell;
  const int points = 1 + static_cast<int>(1.5 * std::max(std::abs(du), std::abs(dv)));
  const double step = 1.0 / points;
  int last_row = -1, last_column = -1;
  for (int k = 0; k < points; ++k) {
    const double t = (k + 0.5) * step, at_u = u + t * du, at_v = v + t * dv;
    const int column = static_cast<int>(at_u), row = static_cast<int>(at_v);
    const double in_u = at_u - column, in_v = at_v - row;
    if (!((in_u > rim_u) & (in_u < 1 - rim_u) & (in_v > rim_v) & (in_v < 1 - rim_v))) continue;
    if ((row == last_row && column == last_column) || !dead.covered(row, column)) continue;
    last_row = row;
    last_column = column;
    cuts.push_back(t);
  }
}

// Cut where a point of the segment stays in one dead cell throughout: at the midpoint it lies farther inside than it
// moves.
void RotatingWindow::add_pieces(const Swept& w, const CoveredCells& dead, Making& making) const {
  const Grid& g = dead.grid();
  const double x = w.x() + shift_, y = w.y() + shift_;
  const Point reach = farther_by(w.reach, 2 * kReach * g.cell);
  const auto live_near = [&](double from, double to) {
    const double u = x + from * w.d.x, v = x + to * w.d.x, a = y + from * w.d.y, b = y + to * w.d.y;
    return dead.any_live(g.row(std::min(a, b) - reach.y), g.column(std::min(u, v) - reach.x),
                         g.row(std::max(a, b) + reach.y), g.column(std::max(u, v) + reach.x));
  };
  Array<double>& cuts = making.cuts;
  cuts.clear();
  if (masked_ && kCutFrom * std::max(reach.x, reach.y) < g.cell) find_cuts({x, y}, w.d, reach, dead, cuts);
  for (std::size_t k = 0; k <= cuts.size(); ++k) {
    RotatingPiece p;
    p.segment = static_cast<std::uint32_t>(making.segments.size());
    p.head_cut = k > 0;
    p.tail_cut = p.tail_dead = k < cuts.size();
    if (p.head_cut) p.head = cuts[k - 1];
    if (p.tail_cut) p.tail = cuts[k];
    if (!cuts.empty() && !live_near(p.head, p.tail)) continue;
    making.pieces.push_back(p);
  }
}

RotatingWindow::Box RotatingWindow::box_of(const RotatingPiece& p, const Swept& w, double reach) const {
  const double x = w.x() + shift_, y = w.y() + shift_;
  const Point by = farther_by(w.reach, reach);
  const double ax = x + p.head * w.d.x, ay = y + p.head * w.d.y, bx = x + p.tail * w.d.x, cy = y + p.tail * w.d.y;
  return {std::min(ax, bx) - by.x, std::min(ay, cy) - by.y, std::max(ax, bx) + by.x, std::max(ay, cy) + by.y};
}

// Pairs of pieces whose boxes meet, less those that stay apart. Without branches that cannot be predicted: every pair
// is listed, and the position moves on for those that stay.
Array<std::array<std::uint32_t, 2>> RotatingWindow::near_pairs(Making& making) {
  BoxPairs pairs(forms_.span(), &making.memory);
  PieceLines lines(forms_.span(), half, &making.memory);
  pairs.reserve(pieces.size());
  lines.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Box& box = making.boxes[i];
    pairs.add(box.x0, box.y0, box.x1, box.y1);
    const Swept& w = making.swept[pieces[i].segment];
    lines.add(w.side, w.fixed, w.turning, w.d, pieces[i].head, pieces[i].tail);
  }
  Array<BoxPairs::Pair> near = pairs.find(making.most_pairs, making.stop);
  const std::size_t count = near.size();
  pair_tests = count;
  complete = count <= making.most_pairs && !making.stop.stop_requested();
  if (!complete) return near;
  near.resize((count + 3) / 4 * 4, {0, 0});
  std::size_t n = 0;
  for (std::size_t k = 0; k < near.size(); k += 4) {
    const std::array four{near[k], near[k + 1], near[k + 2], near[k + 3]};
    const std::uint32_t apart =
        lines.apart({four[0][0], four[1][0], four[2][0], four[3][0]}, {four[0][1], four[1][1], four[2][1], four[3][1]});
    for (std::size_t i = 0; i < 4; ++i) {
      near[n] = four[i];
      n += static_cast<std::size_t>((apart >> i & 1) == 0 && k + i < count);
    }
  }
  near.resize(n);
  return near;
}

// Less those that are never there at once, those with a vertex in common, beside which they do not meet, and those that
// meet in dead cells only: what does is covered.
void RotatingWindow::find_candidates(const CoveredCells& dead, Making& making) {
  const Grid& g = dead.grid();
  const double reach = kReach * g.cell;
  making.boxes.reserve(pieces.size());
  for (const RotatingPiece& p : pieces) making.boxes.push_back(box_of(p, making.swept[p.segment], reach));
  const Array<std::array<std::uint32_t, 2>> near = near_pairs(making);
  if (!complete) return;
  making.candidates.reserve(near.size());
  constexpr double kSlack = 4 * kAngleSlack;  // of two spans, either within two of them
  for (const auto [i, j] : near) {
    const RotatingSegment &s = segments[pieces[i].segment], &t = segments[pieces[j].segment];
    const Pair from = s.start(), other_from = t.start();
    if ((s.span.from > t.span.to + kSlack) | (t.span.from > s.span.to + kSlack) | (from == other_from) |
        (from == t.end) | (s.end == other_from) | (s.end == t.end))
      continue;
    const Box &u = making.boxes[i], &v = making.boxes[j];
    if (masked_ && !dead.any_live(g.row(std::max(u.y0, v.y0)), g.column(std::max(u.x0, v.x0)),
                                  g.row(std::min(u.y1, v.y1)), g.column(std::min(u.x1, v.x1))))
      continue;
    making.candidates.push_back({i, j});
  }
  candidates.assign(making.candidates.begin(), making.candidates.end());
}

// As at most one of the two exists at a time, one that exists throughout is the only one.
void RotatingWindow::find_next() {
  for (RotatingSegment& s : segments) {
    s.next = {find({0, s.end.p, s.end.q}), find({1, s.end.q, s.end.p})};
    for (const std::uint32_t k : {0u, 1u})
      if (s.next[k] != kNone && segments[s.next[k]].throughout) s.next = {s.next[k], kNone};
  }
}

// A tail is dead when it is cut, when nothing live can continue it, or only whole segments that meet nothing and have
// dead tails themselves.
void RotatingWindow::find_dead_tails() {
  const std::size_t n = segments.size();
  std::vector<std::uint8_t> ways(n, 0);
  std::vector<std::uint32_t> dead;
  const auto kill = [&](std::uint32_t s) {
    pieces[segments[s].last_piece - 1].tail_dead = true;
    dead.push_back(s);
  };
  for (std::uint32_t s = 0; s < n; ++s) {
    if (!pieces[segments[s].last_piece - 1].tail_cut)
      for (const std::uint32_t to : segments[s].next)
        ways[s] += to != kNone && !pieces[segments[to].first_piece].head_cut;
    if (ways[s] == 0) kill(s);
  }
  for (std::size_t k = 0; k < dead.size(); ++k) {
    const RotatingSegment& s = segments[dead[k]];
    const std::uint32_t p = s.first_piece;
    if (s.last_piece != p + 1 || pieces[p].head_cut || first_of[p] != first_of[p + 1]) continue;
    const Pair start = s.start();
    const std::uint32_t f = forms_.operand(0).prev[start.p], t = forms_.operand(1).prev[start.q];
    for (const std::uint32_t from : {find({0, f, start.q}), find({1, t, start.p})})
      if (from != kNone && ways[from] > 0 && --ways[from] == 0) kill(from);
  }
}

// Quiet pieces one after the other at every angle: walks leap over them. A quiet one follows one quiet one only, so
// followers lead to an end or back to the first.
void RotatingWindow::find_runs() {
  const auto n = static_cast<std::uint32_t>(pieces.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    RotatingPiece& p = pieces[i];
    p.quiet = !p.head_cut && !p.tail_cut && first_of[i] == first_of[i + 1] && segments[p.segment].throughout;
  }
  for (RotatingPiece& p : pieces) {
    const std::uint32_t next = segments[p.segment].next[0];
    if (p.tail_cut || next == kNone || !pieces[segments[next].first_piece].quiet) continue;
    p.follower = segments[next].first_piece;
  }
  std::vector<std::uint32_t> run;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!pieces[i].quiet || pieces[i].run_last != kNone) continue;
    run.assign(1, i);
    std::uint32_t next = pieces[i].follower;
    for (; next != kNone && next != i && pieces[next].run_last == kNone; next = pieces[next].follower)
      run.push_back(next);
    if (next == i) circles.push_back(i);
    const std::uint32_t last = next == kNone || next == i ? run.back() : pieces[next].run_last;
    for (const std::uint32_t k : run) pieces[k].run_last = last;
  }
}

// What nothing whole leads to is on no cycle of whole segments; nor is what only that leads to.
void RotatingWindow::find_rounds() {
  const auto whole = [&](std::uint32_t s) {
    const RotatingSegment& t = segments[s];
    return t.last_piece == t.first_piece + 1 && !pieces[t.first_piece].head_cut && !pieces[t.first_piece].tail_dead;
  };
  std::vector<std::uint32_t> arriving(segments.size(), 0), removed;
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    for (const std::uint32_t to : segments[s].next)
      if (to != kNone && whole(s)) ++arriving[to];
  std::vector<std::uint8_t> gone(segments.size(), 0);
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    gone[s] = !whole(s) || arriving[s] == 0;
    if (gone[s] && whole(s)) removed.push_back(s);
  }
  for (std::size_t k = 0; k < removed.size(); ++k)
    for (const std::uint32_t to : segments[removed[k]].next)
      if (to != kNone && --arriving[to] == 0 && !gone[to]) {
        gone[to] = 1;
        removed.push_back(to);
      }
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    if (!gone[s] && !pieces[segments[s].first_piece].quiet) rounds.push_back(segments[s].first_piece);
}

}  // namespace dymsum::planar
