#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "shape/decompose/sections.h"

namespace dymsum::shape {
namespace {

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

using Loop = std::vector<std::uint32_t>;

/// A loop that passes a point twice, as simple ones that touch there.
std::vector<Loop> simple_loops(const Loop& loop, std::vector<std::uint32_t>& position) {
  std::vector<Loop> made;
  Loop open;
  for (const std::uint32_t p : loop) {
    if (position[p] != kNowhere) {
      const auto first = open.begin() + position[p];
      for (auto q = first; q != open.end(); ++q) position[*q] = kNowhere;
      made.emplace_back(first, open.end());
      open.erase(first, open.end());
    }
    position[p] = std::uint32_t(open.size());
    open.push_back(p);
  }
  for (const std::uint32_t p : open) position[p] = kNowhere;
  made.push_back(std::move(open));
  return made;
}

class PieceMaker {
 public:
  explicit PieceMaker(const Sections& sections) : spots_(sections.spots) {}

  /// Takes the simple loops of one cycle: one of them, if any, is the outer ring of a piece, the others are its holes.
  void add_cycle(std::vector<Loop> loops) {
    std::optional<std::size_t> outer;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      begin_lowest(loops[i]);
      if (is_outer(loops[i])) outer = i;
    }
    std::vector<Loop>* holes = &loose_;
    if (outer) {
      pieces_.push_back({std::move(loops[*outer]), {}});
      holes = &pieces_.back().holes;
    }
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (!outer || i != *outer) holes->push_back(std::move(loops[i]));
  }

  std::vector<Piece> run(const Poll& poll) {
    std::vector<PlainBox> boxes;
    if (!loose_.empty())
      for (const LoopPiece& piece : pieces_) boxes.push_back(box_of(piece.outer));
    for (Loop& hole : loose_) {
      poll(0);
      holder_of(hole.front(), boxes).holes.push_back(std::move(hole));
    }
    for (LoopPiece& piece : pieces_)
      std::sort(piece.holes.begin(), piece.holes.end(), [this](const Loop& a, const Loop& b) { return before(a, b); });
    std::sort(pieces_.begin(), pieces_.end(),
              [this](const LoopPiece& a, const LoopPiece& b) { return before(a.outer, b.outer); });
    std::vector<Piece> made;
    for (const LoopPiece& piece : pieces_) {
      made.push_back({ring_of(piece.outer), {}});
      for (const Loop& hole : piece.holes) made.back().holes.push_back(ring_of(hole));
    }
    return made;
  }

 private:
  struct LoopPiece {
    Loop outer;
    std::vector<Loop> holes;
  };
  struct PlainBox {
    double x0, x1, y0, y1;
  };

  int compare(std::uint32_t p, std::uint32_t q) const {
    if (p == q) return 0;
    const int x = compare_x(spots_[p], spots_[q]);
    return x != 0 ? x : compare_y(spots_[p], spots_[q]);
  }
  /// The order of loops by their points, which are in lexicographic order.
  bool before(const Loop& a, const Loop& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [this](std::uint32_t p, std::uint32_t q) { return compare(p, q) < 0; });
  }
  void begin_lowest(Loop& loop) const {
    const auto lowest = std::min_element(loop.begin(), loop.end(),
                                         [this](std::uint32_t p, std::uint32_t q) { return compare(p, q) < 0; });
    std::rotate(loop.begin(), lowest, loop.end());
  }
  /// Counter-clockwise. The loop turns at its lowest point as it does as a whole, or not at all.
  bool is_outer(const Loop& loop) const {
    const Spot &before = spots_[loop.back()], &at = spots_[loop.front()], &after = spots_[loop[1]];
    return turn_sign(before, at, after) > 0;
  }
  RationalRing ring_of(const Loop& loop) const {
    RationalRing ring;
    for (const std::uint32_t p : loop) ring.push_back(spots_[p].at);
    return ring;
  }

  PlainBox box_of(const Loop& loop) const {
    const Spot& first = spots_[loop.front()];
    PlainBox box{first.x.low(), first.x.high(), first.y.low(), first.y.high()};
    for (const std::uint32_t p : loop) {
      const Spot& s = spots_[p];
      box = {std::min(box.x0, s.x.low()), std::max(box.x1, s.x.high()), std::min(box.y0, s.y.low()),
             std::max(box.y1, s.y.high())};
    }
    return box;
  }
  /// Whether a ray from p to the left crosses the loop an odd number of times.
  bool contains(const Loop& loop, std::uint32_t p) const {
    bool odd = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Spot &a = spots_[loop[i]], &b = spots_[loop[i + 1 == loop.size() ? 0 : i + 1]];
      if ((a.x.low() > spots_[p].x.high() && b.x.low() > spots_[p].x.high()) ||
          (a.y.high() < spots_[p].y.low() && b.y.high() < spots_[p].y.low()) ||
          (a.y.low() > spots_[p].y.high() && b.y.low() > spots_[p].y.high()))
        continue;
      const bool up = compare_y(a, spots_[p]) <= 0;
      if (up != (compare_y(b, spots_[p]) > 0)) continue;
      if (turn_sign(a, b, spots_[p]) == (up ? -1 : 1)) odd = !odd;
    }
    return odd;
  }
  bool smaller(const Loop& a, const Loop& b) const {
    const auto wide_area = [this](const Loop& loop) {
      exact::Interval sum;
      const Spot& o = spots_[loop.front()];
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Spot &p = spots_[loop[i]], &q = spots_[loop[i + 1]];
        sum += (p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y);
      }
      return sum;
    };
    if (const std::optional<int> sign = sign_of(wide_area(a) - wide_area(b))) return *sign < 0;
    return twice_area(ring_of(a)) < twice_area(ring_of(b));
  }
  /// The piece around the lowest point of a hole: pieces that touch the hole lie to the right of it. Of pieces inside
  /// each other the innermost, which lies in a hole of the other one.
  LoopPiece& holder_of(std::uint32_t p, const std::vector<PlainBox>& boxes) {
    LoopPiece* best = nullptr;
    const Spot& at = spots_[p];
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const PlainBox& box = boxes[i];
      if (at.x.high() < box.x0 || at.x.low() > box.x1 || at.y.high() < box.y0 || at.y.low() > box.y1) continue;
      if (!contains(pieces_[i].outer, p)) continue;
      if (best == nullptr || smaller(pieces_[i].outer, best->outer)) best = &pieces_[i];
    }
    return *best;
  }

  const std::vector<Spot>& spots_;
  std::vector<LoopPiece> pieces_;
  std::vector<Loop> loose_;  ///< holes of cycles without an outer ring
};

}  // namespace

std::vector<Piece> pieces_between(const RingTable& table, const std::vector<PlacedCut>& cuts, const Poll& poll) {
  const Sections sections = make_sections(table, cuts);
  const std::vector<std::uint32_t> next = following(sections);
  std::vector<bool> used(next.size(), false);
  std::vector<std::uint32_t> position(sections.spots.size(), kNowhere);
  PieceMaker pieces(sections);
  for (std::uint32_t h = 0; h < next.size(); ++h) {
    poll.at(h, next.size());
    if (used[h] || (h % 2 == 1 && sections.all[h / 2].wall < sections.edges)) continue;
    Loop loop;
    for (std::uint32_t g = h; !used[g]; g = next[g]) {
      used[g] = true;
      loop.push_back(g % 2 == 0 ? sections.all[g / 2].from : sections.all[g / 2].to);
    }
    pieces.add_cycle(simple_loops(loop, position));
  }
  return pieces.run(poll);
}

}  // namespace dymsum::shape
