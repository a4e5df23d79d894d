#include "planar/arrangement/live_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planar/mask/interior_mask.h"

namespace dymsum::planar {
namespace {

/// Sides nearer than this to zero, times |edge|_1 and the span, say nothing: far more than they err by.
constexpr double kProved = 0x1p-44;
static_assert(kProved >= 4 * kSumSide);

/// A position on a segment, start + t d.
struct Line {
  double x, y, dx, dy;
};

/// One edge of either operand.
struct EdgePair {
  std::uint32_t e = 0, f = 0;
};

/// Finds edges that cross at a position, and how far along a line they do.
class Crossings {
 public:
  explicit Crossings(const Soup& soup)
      : p_(*soup.operands[0]), q_(*soup.operands[1]), proved_(kProved * soup.lattice.span) {}

  /// The longest part of the span around t along which a pair of edges that crosses at t crosses; empty where none is
  /// found.
  Span around(const Line& line, double t, Span span) {
    const double x = line.x + t * line.dx, y = line.y + t * line.dy;
    for (std::size_t k = 0; k < known_; ++k)
      if (crosses(recent_[k], x, y)) {
        std::rotate(recent_.begin(), recent_.begin() + static_cast<std::ptrdiff_t>(k),
                    recent_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        return along(recent_[0], line, t, span);
      }
    const std::optional<EdgePair> found = search(x, y);
    if (!found) return {1, 0};
    known_ = std::min(known_ + 1, recent_.size());
    std::rotate(recent_.begin(), recent_.end() - 1, recent_.end());
    recent_[0] = *found;
    return along(*found, line, t, span);
  }

 private:
  /// d x (x - a), the first with the slope of x along a line.
  struct Side {
    double at, slope;
  };
  // The four sides that tell: of both ends of f beside e, and of both ends of e beside f.
  std::array<Side, 4> sides(EdgePair pair, const Line& line) const {
    const auto of = [&](const Operand& o, std::uint32_t e, const Operand& other, std::uint32_t v) {
      const double ex = o.ex[e], ey = o.ey[e];
      return Side{ex * (line.y - (o.y[e] + other.y[v])) - ey * (line.x - (o.x[e] + other.x[v])),
                  ex * line.dy - ey * line.dx};
    };
    return {of(p_, pair.e, q_, pair.f), of(p_, pair.e, q_, q_.next[pair.f]), of(q_, pair.f, p_, pair.e),
            of(q_, pair.f, p_, p_.next[pair.e])};
  }
  std::array<double, 2> bounds(EdgePair pair) const {
    return {proved_ * (std::abs(p_.ex[pair.e]) + std::abs(p_.ey[pair.e])),
            proved_ * (std::abs(q_.ex[pair.f]) + std::abs(q_.ey[pair.f]))};
  }
  static bool opposite(double s, double t, double bound) {
    return (s > bound && t < -bound) || (s < -bound && t > bound);
  }
  bool crosses(EdgePair pair, double x, double y) const {
    const std::array<Side, 4> s = sides(pair, {x, y, 0, 0});
    const std::array<double, 2> bound = bounds(pair);
    return opposite(s[0].at, s[1].at, bound[0]) && opposite(s[2].at, s[3].at, bound[1]);
  }

  // Sides change linearly: each ends the part where it comes to its bound. They are looked at again at both ends.
  Span along(EdgePair pair, const Line& line, double t, Span span) const {
    const std::array<Side, 4> all = sides(pair, line);
    const std::array<double, 2> bound = bounds(pair);
    Span part = span;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [at, slope] = all[k];
      const double edge = at + t * slope > 0 ? 2 * bound[k / 2] : -2 * bound[k / 2];
      if (slope == 0) continue;
      const double end = (edge - at) / slope;
      if (end <= t) part.low = std::max(part.low, end);
      else part.high = std::min(part.high, end);
    }
    if (!(part.low <= t && t <= part.high)) return {1, 0};
    for (const double u : {part.low, part.high})
      if (!opposite(all[0].at + u * all[0].slope, all[1].at + u * all[1].slope, bound[0]) ||
          !opposite(all[2].at + u * all[2].slope, all[3].at + u * all[3].slope, bound[1]))
        return {1, 0};
    return part;
  }

  std::optional<EdgePair> search(double x, double y) {
    std::optional<EdgePair> found;
    const auto apart = [&](const EdgeTree::Node& m, const EdgeTree::Node& n) {
      return m.x1 < x - n.x1 || m.x0 > x - n.x0 || m.y1 < y - n.y1 || m.y0 > y - n.y0;
    };
    const auto leaves = [&](const EdgeTree::Node& m, const EdgeTree::Node& n) {
      for (std::uint32_t e = m.first; e < m.last; ++e)
        for (std::uint32_t f = n.first; f < n.last; ++f)
          if (crosses({e, f}, x, y)) {
            found = EdgePair{e, f};
            return true;
          }
      return false;
    };
    for (const EdgeTree& a : p_.trees())
      for (const EdgeTree& b : q_.trees())
        if (any_pair_of_leaves(a.nodes, 0, b.nodes, 0, apart, leaves)) return found;
    return std::nullopt;
  }

  const Operand &p_, &q_;
  double proved_;
  std::array<EdgePair, 8> recent_{};
  std::size_t known_ = 0;
};

/// What is left of one piece after another.
class Cutter {
 public:
  Cutter(const Soup& soup, double reach) : soup_(soup), crossings_(soup), reach_(reach) {}

  /// The spans that are left, in order; valid until the next call.
  const std::vector<Span>& rest_of(const SegmentPiece& piece) {
    const SoupBox& b = soup_.boxes[piece.segment];
    line_ = {b.ax, b.ay, b.dx, b.dy};
    rim_ = reach_ / std::max(std::abs(b.dx), std::abs(b.dy));
    steps_ = 0;
    rest_.clear();
    cut({piece.low, piece.high}, 0);
    return rest_;
  }

 private:
  static constexpr int kMostHalvings = 1, kMostSteps = 64;

  void keep(Span part) {
    if (!rest_.empty() && rest_.back().high >= part.low) rest_.back().high = part.high;
    else rest_.push_back(part);
  }
  void cut(Span part, int halvings) {
    if (part.high - part.low <= 4 * rim_ || ++steps_ > kMostSteps) return keep(part);
    const double midpoint = 0.5 * (part.low + part.high);
    Span covered = crossings_.around(line_, midpoint, part);
    if (covered.low > covered.high) {
      if (halvings == kMostHalvings) return keep(part);
      cut({part.low, midpoint}, halvings + 1);
      cut({midpoint, part.high}, halvings + 1);
      return;
    }
    // Beyond the ends of the part nothing is left in any case.
    if (covered.low > part.low) covered.low += rim_;
    if (covered.high < part.high) covered.high -= rim_;
    if (covered.low >= covered.high) return keep(part);
    if (covered.low > part.low) cut({part.low, covered.low}, halvings);
    if (covered.high < part.high) cut({covered.high, part.high}, halvings);
  }

  const Soup& soup_;
  Crossings crossings_;
  double reach_, rim_ = 0;
  Line line_{};
  int steps_ = 0;
  std::vector<Span> rest_;
};

/// Boxes of pieces, and whether two cross properly, in doubles.
struct Part {
  double ax, ay, bx, by;
  bool crosses(const Part& o) const {
    if (std::max(ax, bx) < std::min(o.ax, o.bx) || std::max(o.ax, o.bx) < std::min(ax, bx) ||
        std::max(ay, by) < std::min(o.ay, o.by) || std::max(o.ay, o.by) < std::min(ay, by))
      return false;
    const auto side = [](const Part& s, double x, double y) {
      return (s.bx - s.ax) * (y - s.ay) - (s.by - s.ay) * (x - s.ax);
    };
    return side(*this, o.ax, o.ay) * side(*this, o.bx, o.by) < 0 && side(o, ax, ay) * side(o, bx, by) < 0;
  }
};

}  // namespace

double crossings_each(const Soup& soup, const LivePieces& live, const Poll& poll) {
  constexpr std::size_t kSample = 64;
  const std::size_t n = live.pieces.size(), step = n / kSample + 1;
  const auto part = [&](const SegmentPiece& piece) {
    const SoupBox& b = soup.boxes[piece.segment];
    return Part{b.ax + piece.low * b.dx, b.ay + piece.low * b.dy, b.ax + piece.high * b.dx, b.ay + piece.high * b.dy};
  };
  std::vector<Part> sample;
  for (std::size_t k = 0; k < n; k += step) sample.push_back(part(live.pieces[k]));
  std::uint64_t crossings = 0;
  for (std::size_t k = 0; k < n; ++k) {
    poll.at(k, n);
    const Part own = part(live.pieces[k]);
    for (const Part& s : sample) crossings += own.crosses(s);
  }
  return sample.empty() ? 0 : static_cast<double>(crossings) / static_cast<double>(sample.size());
}

LivePieces uncrossed_pieces(const Soup& soup, const LivePieces& live, double reach, const Poll& poll) {
  LivePieces out(soup.memory);
  Cutter cutter(soup, reach);
  const std::size_t n = live.pieces.size();
  for (std::size_t k = 0; k < n;) {
    const std::uint32_t s = live.pieces[k].segment;
    double end = 0;  // of what has been looked at
    for (; k < n && live.pieces[k].segment == s; ++k) {
      poll.at_test(k, n);
      for (const Span& t : cutter.rest_of(live.pieces[k])) {
        if (t.low > end) out.marks.push_back({s, 0.5 * (end + t.low)});
        out.pieces.push_back({s, t.low, t.high});
        end = t.high;
      }
    }
    if (end > 0 && end < 1) out.marks.push_back({s, 0.5 * (end + 1)});
  }
  return out;
}

namespace {

// The parameters of a segment for which it passes a box of cells, or comes within kReach cells of it. The bounds err by
// less than what kReach moves them: both shift a side of the box, one by 2^-50 of the grid's extent, the other by 2^-14
// of a cell.
class Passage {
 public:
  Passage(const SoupBox& b, const Grid& grid)
      : clip_(b.ax, b.ay, b.dx, b.dy), cell_(grid.cell), reach_(kReach * grid.cell) {}
  Span through(int row0, int column0, int row1, int column1) const {
    const SegmentClip::Part part = clip_.within(column0 * cell_ - reach_, row0 * cell_ - reach_,
                                                (column1 + 1) * cell_ + reach_, (row1 + 1) * cell_ + reach_);
    return {part.from, part.to};
  }

 private:
  SegmentClip clip_;
  double cell_, reach_;
};

// The box of a part of a segment, for cells: its vector is that of the whole.
SoupBox part_of(const SoupBox& b, Span t) {
  SoupBox part = b;
  if (t.low > 0) {
    part.ax = b.ax + t.low * b.dx;
    part.ay = b.ay + t.low * b.dy;
  }
  if (t.high < 1) {
    part.bx = b.ax + t.high * b.dx;
    part.by = b.ay + t.high * b.dy;
  }
  return part;
}

// The intervals of one segment, found in no order.
class LiveIntervals {
 public:
  LiveIntervals(const FineCells& cells, Scratch* memory) : cells_(cells), found_(memory) {}

  /// The spans in the segment's order, disjoint.
  const Array<Span>& of(const SoupBox& b, Span span) {
    found_.clear();
    span_ = span;
    if (span.low > span.high) return found_;
    const Grid &coarse = cells_.mask().grid(), &fine = cells_.grid();
    const Passage in_coarse(b, coarse), in_fine(b, fine);
    const SoupBox part = part_of(b, span);
    for_each_cell_run(coarse, part.ax, part.ay, part.bx, part.by, [&](int row, int first, int last) {
      for (int c = first; c <= last; ++c) {
        const std::uint64_t live = cells_.live(row, c);
        if (live == 0) continue;
        if (live == ~std::uint64_t{0}) add(in_coarse.through(row, c, row, c));
        else add_fine(in_fine, live, row * kBrick, c * kBrick);
      }
    });
    std::sort(found_.begin(), found_.end(), [](const Span& s, const Span& t) { return s.low < t.low; });
    std::size_t n = 0;
    for (const Span& t : found_) {
      if (n > 0 && t.low <= found_[n - 1].high) found_[n - 1].high = std::max(found_[n - 1].high, t.high);
      else found_[n++] = t;
    }
    found_.resize(n);
    return found_;
  }

 private:
  void add(Span t) {
    t = {std::max(t.low, span_.low), std::min(t.high, span_.high)};
    if (t.low <= t.high) found_.push_back(t);
  }
  // The runs of live cells in the rows of a brick.
  void add_fine(const Passage& passage, std::uint64_t live, int row0, int column0) {
    for (int r = 0; r < kBrick; ++r) {
      auto bits = static_cast<std::uint32_t>(live >> (8 * r)) & 0xff;
      while (bits != 0) {
        const int first = std::countr_zero(bits), last = first + std::countr_one(bits >> first) - 1;
        add(passage.through(row0 + r, column0 + first, row0 + r, column0 + last));
        bits &= ~0u << (last + 1);
      }
    }
  }

  const FineCells& cells_;
  Span span_;
  Array<Span> found_;
};

}  // namespace

CellVisits count_visits(const Soup& soup, const Array<Span>& spans, const InteriorMask& mask, const Poll& poll) {
  const Grid& g = mask.grid();
  const auto columns = static_cast<std::size_t>(g.columns);
  CellVisits visits{Array<std::uint32_t>(static_cast<std::size_t>(g.rows) * columns, 0, soup.memory)};
  for (std::size_t s = 0; s < soup.size(); ++s) {
    poll.at(s, soup.size());
    if (!spans.empty() && spans[s].low > spans[s].high) continue;
    const SoupBox b = spans.empty() ? soup.boxes[s] : part_of(soup.boxes[s], spans[s]);
    for_each_cell_run(g, b.ax, b.ay, b.bx, b.by, [&](int row, int first, int last) {
      std::uint32_t* const at = &visits.count[static_cast<std::size_t>(row) * columns];
      for (int c = first; c <= last; ++c) ++at[c];
    });
  }
  for (std::size_t at = 0; at < visits.count.size(); ++at) {
    std::uint32_t& k = visits.count[at];
    if (mask.covered(static_cast<int>(at / columns), static_cast<int>(at % columns))) k = 0;
    visits.pairs += std::uint64_t{k} * (k - (k > 0)) / 2;
  }
  return visits;
}

bool refine_crowded(FineCells& cells, const CellVisits& visits, std::uint32_t crowd, const Poll& poll) {
  constexpr std::size_t kSample = 512, kSmallGain = 16;  // at least one in so many fine cells of the sample
  const auto columns = static_cast<std::size_t>(cells.mask().grid().columns);
  Array<std::uint32_t> crowded(visits.count.get_allocator().scratch());
  for (std::size_t at = 0; at < visits.count.size(); ++at)
    if (visits.count[at] >= crowd) crowded.push_back(static_cast<std::uint32_t>(at));
  const auto refine = [&](std::size_t at) {
    return cells.refine(static_cast<int>(at / columns), static_cast<int>(at % columns));
  };
  const std::size_t step = crowded.size() / kSample + 1;
  std::size_t sampled = 0, covered = 0;
  for (std::size_t k = 0; k < crowded.size(); k += step, ++sampled) covered += refine(crowded[k]);
  if (covered * kSmallGain < sampled * kBrick * kBrick) return false;
  for (std::size_t k = 0; k < crowded.size(); ++k) {
    poll.at(k, crowded.size());
    if (k % step != 0) refine(crowded[k]);
  }
  return true;
}

LivePieces live_pieces(const Soup& soup, const Array<Span>& spans, const FineCells& cells, const Poll& poll) {
  LivePieces out(soup.memory);
  LiveIntervals live(cells, soup.memory);
  for (std::uint32_t s = 0; s < soup.size(); ++s) {
    poll.at(s, soup.size());
    double end = 0;  // of what has been looked at
    const auto gap = [&](double to) {
      if (to > end) out.marks.push_back({s, 0.5 * (end + to)});
    };
    for (const Span& t : live.of(soup.boxes[s], spans.empty() ? Span{} : spans[s])) {
      gap(t.low);
      out.pieces.push_back({s, t.low, t.high});
      end = t.high;
    }
    if (end > 0) gap(1);
  }
  return out;
}

void drop_covered(Soup& soup, Array<std::uint32_t>& live, LivePieces& pieces) {
  Array<std::uint32_t> to(soup.size(), kNone, soup.memory);
  std::uint32_t n = 0;
  for (SegmentPiece& piece : pieces.pieces) {
    const std::uint32_t s = piece.segment;
    if (to[s] == kNone) {
      soup.segments[n] = soup.segments[s];
      soup.boxes[n] = soup.boxes[s];
      to[s] = n++;
    }
    piece.segment = to[s];
  }
  soup.segments.resize(n);
  soup.boxes.resize(n);
  for (CoveredMark& mark : pieces.marks) mark.segment = to[mark.segment];
  for (std::uint32_t& s : live)
    if (s != kNone) s = to[s];
}

std::optional<Refined> refine(const Operand& p, const Operand& q, InteriorMask& mask, Soup& soup,
                              Array<std::uint32_t>& live, Refine when, const Poll& poll) {
  // Below these counts finding out costs more than the crossings. Rasters of fine cells cost more than covered
  // translates.
  constexpr std::size_t kFew = 16384, kPairsEach = 64, kFewWithMany = 2048, kPairsEachWithMany = 8, kTranslates = 64;
  constexpr double kCrossingsEach = 16;
  constexpr std::uint32_t kCrowd = 8;
  const bool always = when == Refine::always;
  const bool many = std::min(p.boxes.size(), q.boxes.size()) * kTranslates <= soup.size();
  if (!always && soup.size() < (many ? kFewWithMany : kFew)) return std::nullopt;
  CellVisits visits = count_visits(soup, Array<Span>(soup.memory), mask, poll);
  if (!always && visits.pairs < (many ? kPairsEachWithMany : kPairsEach) * soup.size()) return std::nullopt;
  const std::uint64_t pairs = visits.pairs;
  const double reach = kReach * mask.grid().cell / kBrick;  // twice that of the sweep over pieces
  const Array<Span> spans =
      many || always ? uncovered_spans(soup, reach, always ? 1 : kTranslates, poll) : Array<Span>(soup.memory);
  if (!spans.empty()) visits = count_visits(soup, spans, mask, poll);
  const bool fine = always || (soup.size() >= kFew && visits.pairs >= kPairsEach * soup.size());
  std::optional<Refined> refined =
      Refined{fine ? FineCells(p, q, mask) : FineCells(mask), LivePieces(soup.memory), fine};
  const bool pays = fine && refine_crowded(refined->cells, visits, always ? 1 : kCrowd, poll);
  const bool gains = always || pays || 2 * visits.pairs <= pairs;
  const bool queries = soup.size() >= kFew && visits.pairs >= kPairsEach * soup.size();
  if (!gains && !queries) return std::nullopt;
  refined->live = live_pieces(soup, spans, refined->cells, poll);
  const bool areas = !has_component_without_area(p) && !has_component_without_area(q);
  const bool crowded = queries && areas && crossings_each(soup, refined->live, poll) >= kCrossingsEach;
  if (!gains && !crowded) return std::nullopt;
  if ((always && areas) || crowded) refined->live = uncrossed_pieces(soup, refined->live, reach, poll);
  drop_covered(soup, live, refined->live);
  return refined;
}

}  // namespace dymsum::planar
