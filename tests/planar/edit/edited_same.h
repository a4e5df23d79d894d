// Random edits, and whether the edited sum is the sum from scratch.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dymsum/editable_sum.h"
#include "oracles/provenance.h"
#include "oracles/random.h"

namespace dymsum::edit_tests {

inline PlanarSum fresh_sum(const Region& p, const Region& q, const EditOptions& options) {
  SumOptions from_scratch;
  from_scratch.semantics = options.semantics;
  from_scratch.forced_tier = options.forced_tier;
  const Region again_p = Region::create(p.data()).value(), again_q = Region::create(q.data()).value();
  return options.reflect_q ? nfp(again_p, again_q, from_scratch).value()
                           : minkowski_sum(again_p, again_q, from_scratch).value();
}

/// The first difference, bit for bit: positions, names, features; or nothing. `names`: contacts are compared too, which
/// is right where no two contacts along one line carry a vertex.
inline std::string difference(const PlanarSum& a, const PlanarSum& b, bool names) {
  if (!(a == b)) return "other sets";
  if (names && a.at_error != b.at_error)
    return "other errors: " + std::to_string(a.at_error) + " " + std::to_string(b.at_error);
  std::string found;
  const auto vertex = [&](const SumVertex& v, const SumVertex& w) {
    if (!found.empty()) return;
    if (names && !(v.at == w.at)) found = "other doubles";
    if (names && (!(v.in == w.in) || !(v.out == w.out) || v.corner_p != w.corner_p || v.corner_q != w.corner_q))
      found = "other names";
  };
  const auto ring = [&](const SumRing& r, const SumRing& s) {
    for (std::size_t i = 0; i < r.vertices.size(); ++i) vertex(r.vertices[i], s.vertices[i]);
  };
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    ring(a.parts[i].outer, b.parts[i].outer);
    for (std::size_t h = 0; h < a.parts[i].holes.size(); ++h) ring(a.parts[i].holes[h], b.parts[i].holes[h]);
  }
  return found;
}

/// A vertex of the region, by index.
inline Point vertex_at(const Region& region, std::uint32_t index) {
  std::uint32_t first = 0;
  for (const Part& part : region.parts()) {
    const auto find = [&](const Ring& ring) -> const Point* {
      const auto n = static_cast<std::uint32_t>(ring.size());
      const Point* at = index < first + n ? &ring[index - first] : nullptr;
      first += n;
      return at;
    };
    if (const Point* at = find(part.outer)) return *at;
    for (const Ring& hole : part.holes)
      if (const Point* at = find(hole)) return *at;
  }
  return {};
}

/// How far random edits reach, and on which numbers: coordinates are multiples of `grid`, or doubles where it is 0.
struct Reach {
  double length = 1, grid = 0;
};

inline double near(oracles::Random& random, const Reach& reach, double x) {
  const double moved = x + reach.length * random.signed_unit();
  return reach.grid > 0 ? std::nearbyint(moved / reach.grid) * reach.grid : moved;
}
inline Point near(oracles::Random& random, const Reach& reach, Point at) {
  const double x = near(random, reach, at.x);
  return {x, near(random, reach, at.y)};
}

/// Any edit of an operand; many are refused.
inline Edit random_edit(oracles::Random& random, const EditableSum& sum, const Reach& reach) {
  const MovingOperand operand = random.chance(50) ? MovingOperand::p : MovingOperand::q;
  const Region& region = operand == MovingOperand::p ? sum.p() : sum.q();
  const auto n = static_cast<int>(region.vertex_count());
  if (n == 0) return Edit::move(operand, 0, {});
  const auto v = static_cast<std::uint32_t>(random.below(n));
  const Point at = vertex_at(region, v);
  const auto part = static_cast<std::uint32_t>(random.below(static_cast<int>(region.parts().size())));
  const int kind = random.below(100);
  if (kind < 50) return Edit::move(operand, v, near(random, reach, at));
  if (kind < 62) return Edit::insert(operand, v, near(random, reach, at));
  if (kind < 74) return Edit::remove(operand, v);
  if (kind < 82)
    return Edit::extrude(operand, v, static_cast<std::uint32_t>(random.below(n)), near(random, reach, {0, 0}));
  if (kind < 88) return Edit::invert(operand, v);
  const Point a = near(random, reach, at), b = near(random, reach, at), c = near(random, reach, at);
  const bool left = (b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x);
  if (kind < 91) return Edit::add_hole(operand, part, left ? Ring{a, c, b} : Ring{a, b, c});
  if (kind < 94) return Edit::remove_hole(operand, part, static_cast<std::uint32_t>(random.below(3)));
  if (kind < 98) return Edit::add_part(operand, {left ? Ring{a, b, c} : Ring{a, c, b}, {}});
  return Edit::remove_part(operand, part);
}

}  // namespace dymsum::edit_tests
