#include "planar/arrangement/live_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planar/arrangement/crossing_cover.h"
#include "planar/mask/segment_clip.h"

namespace dymsum::planar {
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
