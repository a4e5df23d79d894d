#include "shape/complex/envelope.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace dymsum::shape {

Envelope::Envelope(Order& order, const Section& section)
    : order_(order), section_(section), on_edge_(order.walks().is_edge(section.site)) {
  functions_.push_back({});
  parts_.push_back(
      {order.mark(section, {.kind = Mark::Kind::start}), order.mark(section, {.kind = Mark::Kind::end}), 0});
}

void Envelope::insert(std::uint32_t j) {
  const Domain where = domain(order_, section_, j);
  if (where.count == 0) return;
  functions_.push_back({j, order_.near().function(section_, j)});
  for (int i = 0; i < where.count; ++i)
    insert_interval(static_cast<std::uint32_t>(functions_.size() - 1), where.intervals[static_cast<std::size_t>(i)]);
}

void Envelope::insert_interval(std::uint32_t slot, Interval s) {
  // The parts that it meets, and one on either side, which may be of the same function.
  auto first = std::partition_point(parts_.begin(), parts_.end(), [&](const Part& p) { return !less(s.low, p.to); });
  auto last = std::partition_point(first, parts_.end(), [&](const Part& p) { return less(p.from, s.high); });
  if (first != parts_.begin()) --first;
  if (last != parts_.end()) ++last;
  scratch_.clear();
  for (auto p = first; p != last; ++p) {
    const Part& part = *p;
    const bool from_inside = less(part.from, s.low), to_inside = less(s.high, part.to);
    const Mark &low = from_inside ? s.low : part.from, &high = to_inside ? s.high : part.to;
    if (!less(low, high)) {
      put(part.from, part.to, part.slot);
      continue;
    }
    if (from_inside) put(part.from, low, part.slot);
    compete(part, slot, low, high);
    if (to_inside) put(high, part.to, part.slot);
  }
  const auto kept = std::min<std::ptrdiff_t>(last - first, std::ssize(scratch_));
  const auto at = std::copy_n(scratch_.begin(), kept, first);
  parts_.insert(parts_.erase(at, last), scratch_.begin() + kept, scratch_.end());
}

/// The smaller disc, or greater curvature, of the part's function and another, from low to high.
void Envelope::compete(const Part& part, std::uint32_t slot, const Mark& low, const Mark& high) {
  const Function &f = functions_[slot], &g = functions_[part.slot];
  if (part.slot == 0 && on_edge_) return put(low, high, slot);
  // About a vertex, 1 / radius is (1 + n.w) / h for an edge: never negative.
  if (part.slot == 0 && order_.walks().is_edge(f.site)) return put(low, high, slot);
  const bool second = part.slot != 0 && f.site < g.site;
  const std::uint32_t i = part.slot == 0 ? f.site : second ? f.site : g.site;
  const std::uint32_t j = part.slot == 0 ? kNoIndex : second ? g.site : f.site;
  // f - g, or g - f if second; f wins where it is negative, times this
  const Quadratic<exact::Interval> h = part.slot == 0 ? f.near : second ? g.near - f.near : f.near - g.near;
  const int sense = (second ? -1 : 1) * (on_edge_ ? 1 : -1);
  const bool alone = part.slot == 0;
  const QuadraticSigns signs = alone ? order_.signs(section_, kNoIndex, i, h) : order_.signs(section_, i, j, h);
  const auto whole = [&](bool wins) { put(low, high, wins ? slot : part.slot); };
  if (signs.a == 0 && signs.b == 0) return whole(sense * signs.c < 0);
  if (signs.a != 0 && signs.discriminant <= 0) return whole(sense * signs.a < 0);
  const auto root = [&](int k) {
    return order_.mark(section_, {.kind = Mark::Kind::crossing,
                                  .root = static_cast<std::uint8_t>(k),
                                  .lead = static_cast<std::int8_t>(signs.a),
                                  .slope = static_cast<std::int8_t>(signs.b),
                                  .i = i,
                                  .j = j});
  };
  // The signs before the first root, between the roots, after the last.
  const int roots = signs.a == 0 ? 1 : 2;
  int sign = sense * (signs.a == 0 ? -signs.b : signs.a);
  Mark at = low;
  for (int k = 0; k < roots; ++k, sign = -sign) {
    const Mark x = root(k);
    if (!less(at, x)) continue;
    if (!less(x, high)) break;
    put(at, x, sign < 0 ? slot : part.slot);
    at = x;
  }
  put(at, high, sign < 0 ? slot : part.slot);
}

void Envelope::put(const Mark& from, const Mark& to, std::uint32_t slot) {
  if (!scratch_.empty() && scratch_.back().slot == slot) {
    scratch_.back().to = to;
  } else {
    scratch_.push_back({from, to, slot});
  }
}

std::vector<Piece> Envelope::pieces() const {
  std::vector<Piece> out;
  out.reserve(parts_.size());
  for (const Part& part : parts_) out.push_back({functions_[part.slot].site, part.from, part.to});
  return out;
}

std::vector<Section> sections_of(const Walks& walks, std::uint32_t site) {
  if (walks.is_edge(site)) return {{site, 0}};
  if (walks.is_isolated(site)) return {{site, 0}, {site, 2}};
  const SiteEnds& ends = walks.ends[site];
  const Site &in = walks.sites[ends.prev], &out = walks.sites[ends.next];
  const Point o{0, 0};
  constexpr std::array<Point, 4> kAxes{Point{1, 0}, Point{0, 1}, Point{-1, 0}, Point{0, -1}};
  for (std::uint8_t axis = 0; axis < 4; ++axis) {
    const Point back = kAxes[(axis + 2) % 4];
    if (exact::dot_sign(in.a, in.b, o, back) < 0 || exact::dot_sign(out.a, out.b, o, back) > 0) return {{site, axis}};
  }
  throw std::logic_error("a corner with all directions");
}

}  // namespace dymsum::shape
