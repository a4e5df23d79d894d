#include "shape/complex/thin_contacts.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "dymsum/planar_sum.h"
#include "exact/orient.h"

namespace dymsum::shape {
namespace {

/// A segment or, with equal ends, a point. Segments `k` and `k + 1` of one chain share an end.
struct ChainSegment {
  Point a, b;
  std::uint32_t chain = 0, k = 0;
  bool thin = false;
};

struct Chains {
  std::vector<ChainSegment> segments;
  std::vector<std::uint32_t> closed_at;  ///< per chain: its last segment, where that ends at the first one's start
};

constexpr std::uint32_t kOpen = 0xffffffff;

void add_chain(Chains& out, const std::vector<Point>& chain, bool ring) {
  const auto n = static_cast<std::uint32_t>(chain.size()), name = static_cast<std::uint32_t>(out.closed_at.size());
  const std::uint32_t count = ring ? n : n - 1;
  for (std::uint32_t i = 0; i < count; ++i)
    out.segments.push_back({chain[i], chain[i + 1 == n ? 0 : i + 1], name, i, !ring});
  if (n == 1) out.segments.push_back({chain[0], chain[0], name, 0, true});
  const bool closed = ring || (n > 2 && chain.front() == chain.back());
  out.closed_at.push_back(closed ? count - 1 : kOpen);
}

bool spans(const ChainSegment& s, Point p) {
  return std::min(s.a.x, s.b.x) <= p.x && p.x <= std::max(s.a.x, s.b.x) && std::min(s.a.y, s.b.y) <= p.y &&
         p.y <= std::max(s.a.y, s.b.y);
}

/// p lies on s, an end counts.
bool lies_on(const ChainSegment& s, Point p) {
  return spans(s, p) && (s.a == s.b || exact::orient_sign(s.a, s.b, p) == 0);
}

bool cross(const ChainSegment& s, const ChainSegment& t) {
  if (s.a == s.b || t.a == t.b) return false;
  return exact::orient_sign(s.a, s.b, t.a) * exact::orient_sign(s.a, s.b, t.b) < 0 &&
         exact::orient_sign(t.a, t.b, s.a) * exact::orient_sign(t.a, t.b, s.b) < 0;
}

/// Neighbours of a chain meet at the end of the first and otherwise only where they run back along each other.
bool follows(const Chains& chains, const ChainSegment& s, const ChainSegment& t) {
  if (s.chain != t.chain) return false;
  return s.k + 1 == t.k || (chains.closed_at[s.chain] == s.k && t.k == 0);
}

bool folds(const ChainSegment& s, const ChainSegment& t) {
  return exact::orient_sign(s.a, s.b, t.b) == 0 && exact::dot_sign(s.b, s.a, s.b, t.b) > 0;
}

bool meet(const Chains& chains, const ChainSegment& s, const ChainSegment& t) {
  if (follows(chains, s, t)) return folds(s, t);
  if (follows(chains, t, s)) return folds(t, s);
  return lies_on(s, t.a) || lies_on(s, t.b) || lies_on(t, s.a) || lies_on(t, s.b) || cross(s, t);
}

Error refusal(Point at) {
  Error error{ErrorCode::unsupported_operand,
              "a polyline or point touches another piece of the region, or itself: discs want them apart",
              {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

}  // namespace

std::optional<Error> thin_contact(const Region& region) {
  if (region.polylines().empty() && region.points().empty()) return std::nullopt;
  Chains chains;
  for (const Part& part : region.parts()) {
    add_chain(chains, part.outer, true);
    for (const Ring& hole : part.holes) add_chain(chains, hole, true);
  }
  for (const Polyline& line : region.polylines()) add_chain(chains, line, false);
  for (const Point& p : region.points()) add_chain(chains, {p}, false);

  // By smallest x; those that reach the one at hand are looked at.
  std::vector<ChainSegment>& all = chains.segments;
  const auto low = [](const ChainSegment& s) { return std::min(s.a.x, s.b.x); };
  std::sort(all.begin(), all.end(), [&](const ChainSegment& s, const ChainSegment& t) {
    return std::tuple(low(s), s.chain, s.k) < std::tuple(low(t), t.chain, t.k);
  });
  std::vector<const ChainSegment*> open;
  for (const ChainSegment& s : all) {
    std::erase_if(open, [&](const ChainSegment* o) { return std::max(o->a.x, o->b.x) < low(s); });
    for (const ChainSegment* o : open) {
      if ((s.thin || o->thin) && meet(chains, *o, s)) return refusal(s.thin ? s.a : o->a);
    }
    open.push_back(&s);
  }

  // What touches nothing lies inside a part or outside with its first point.
  if (region.parts().empty()) return std::nullopt;
  const Result<Region> parts = Region::create({region.parts(), {}, {}}), origin = Region::create({{}, {}, {{0, 0}}});
  std::vector<Point> firsts = region.points();
  for (const Polyline& line : region.polylines()) firsts.push_back(line[0]);
  for (const Point& p : firsts)
    if (contains(*parts, *origin, p)) return refusal(p);
  return std::nullopt;
}

}  // namespace dymsum::shape
