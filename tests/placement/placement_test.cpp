// Positions that are left for a part: against membership by definition, Boolean operations, and placements from
// scratch.
#include "dymsum/placement.h"

#include <gtest/gtest.h>

#include <random>

#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/shapes.h"
#include "dymsum/sum_locator.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/membership.h"
#include "oracles/pair_text.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"
#include "planar/position/exact_source.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kSeed = 20261130;

Region valid(const RegionData& data) { return Region::create(data).value(); }
Region box(double x0, double y0, double x1, double y1) { return shapes::rectangle(x0, y0, x1, y1); }
RationalPoint at(double x, double y) { return {*Rational::of(x), *Rational::of(y)}; }
Big big(const Rational& r) { return from_digits<Big>(r.numerator(), r.denominator()); }
Rational rational(const Big& v) { return *Rational::parse(numerator_of(v).str() + "/" + denominator_of(v).str()); }
Pt<Big> big(const RationalPoint& p) { return {big(p.x), big(p.y)}; }

/// What is placed, and what feasible sets are by definition.
class Definition {
 public:
  Definition(Region container, std::vector<Region> shapes)
      : container_(std::move(container)), shapes_(std::move(shapes)) {
    for (const Region& moving : shapes_) {
      holds_.emplace_back(container_.data(), moving.data());
      for (const Region& placed : shapes_) overlaps_.emplace_back(placed.data(), negated(moving).data());
    }
  }
  bool is_free(const std::vector<PlacedPart>& parts, std::size_t shape, const Pt<Big>& z) const {
    if (!holds_[shape].holds(z)) return false;
    for (const PlacedPart& part : parts)
      if (overlaps_[shape * shapes_.size() + part.shape].overlaps(z - big(part.at))) return false;
    return true;
  }
  const std::vector<Region>& shapes() const { return shapes_; }
  Placement placement() const {
    Placement placement = *Placement::create(container_);
    for (const Region& shape : shapes_) EXPECT_TRUE(placement.add_shape(shape).ok());
    return placement;
  }

 private:
  Region container_;
  std::vector<Region> shapes_;
  std::vector<Membership<Big>> holds_, overlaps_;
};

using Edges = std::vector<Seg<Big>>;

void add_edges(const PlanarSum& sum, const Pt<Big>& move, Edges& edges) {
  const auto point = [&](const SumVertex& v) { return big(sum.exact(v)) + move; };
  const auto add_ring = [&](const SumRing& ring) {
    for (std::size_t k = 0; k < ring.vertices.size(); ++k)
      edges.push_back({point(ring.vertices[k]), point(ring.vertices[(k + 1) % ring.vertices.size()])});
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  for (const SumSegment& s : sum.tight_segments) edges.push_back({point(s.from), point(s.to)});
}

/// Positions at which something may change: some crossings of the boundaries of all no-fit polygons.
std::vector<Pt<Big>> crossings(const Definition& definition, const std::vector<PlacedPart>& parts, std::size_t shape,
                               Random& random, int count) {
  Edges edges;
  for (const PlacedPart& part : parts)
    add_edges(*nfp(definition.shapes()[part.shape], definition.shapes()[shape]), big(part.at), edges);
  std::vector<Pt<Big>> positions;
  for (int k = 0; k < count && !edges.empty(); ++k) {
    const Seg<Big>&f = edges[static_cast<std::size_t>(random.below(static_cast<int>(edges.size())))],
          &g = edges[static_cast<std::size_t>(random.below(static_cast<int>(edges.size())))];
    const Pt<Big> u = f.b - f.a, v = g.b - g.a;
    const Big w = cross(u, v);
    if (w == 0) continue;
    const Big t = cross(g.a - f.a, v) / w;
    positions.push_back({f.a.x + t * u.x, f.a.y + t * u.y});
  }
  return positions;
}

/// Why a feasible set is not what it is by definition, or "".
std::string fault_of(const Definition& definition, Placement& placement, std::uint32_t shape, int reach,
                     Random& random) {
  const FeasiblePositions feasible = *placement.feasible(shape);
  const std::vector<PlacedPart> parts = placement.parts();
  const SumLocator locator(feasible.set);
  std::vector<Pt<Big>> positions = crossings(definition, parts, shape, random, 60);
  for (int x = -2; x <= 2 * reach + 2; ++x)
    for (int y = -2; y <= 2 * reach + 2; ++y) positions.push_back({Big(x) / 2, Big(y) / 2});
  for (const CandidatePosition& c : feasible.candidates) {
    const Pt<Big> z = big(feasible.set.exact(c.vertex));
    if (!definition.is_free(parts, shape, z)) return "a candidate that is not free";
    if (c.touches.empty()) return "a candidate that touches nothing";
    if (!positions.empty()) positions.push_back({(z.x + positions.back().x) / 2, (z.y + positions.back().y) / 2});
    positions.push_back(z);
  }
  for (const Pt<Big>& z : positions) {
    const RationalPoint p{rational(z.x), rational(z.y)};
    const bool free = definition.is_free(parts, shape, z);
    if (locator.contains_rational(p) != free)
      return (free ? "missed " : "not free ") + p.x.to_string() + " " + p.y.to_string();
    if (*placement.is_free(shape, p) != free) return "is_free is wrong at " + p.x.to_string() + " " + p.y.to_string();
  }
  return "";
}

std::string text_of(const Definition& definition, const Placement& placement) {
  std::string text;
  for (const Region& shape : definition.shapes()) text += to_wkt(shape.data()) + "\n";
  for (const PlacedPart& part : placement.parts())
    text += std::to_string(part.shape) + " at " + part.at.x.to_string() + " " + part.at.y.to_string() + "\n";
  return text;
}

/// A random part, beside others where it fits or anywhere.
void stand_some(Placement& placement, Random& random, int reach, int shapes) {
  const auto shape = static_cast<std::uint32_t>(random.below(shapes));
  const FeasiblePositions feasible = *placement.feasible(shape);
  if (random.chance(60) && !feasible.candidates.empty()) {
    const auto k = static_cast<std::size_t>(random.below(static_cast<int>(feasible.candidates.size())));
    ASSERT_TRUE(placement.add_part(shape, feasible.set.exact(feasible.candidates[k].vertex)).ok());
  } else {
    const double x = random.below(2 * reach) / 2.0, y = random.below(2 * reach) / 2.0;
    ASSERT_TRUE(placement.add_part(shape, at(x, y)).ok());
  }
}

TEST(Placement, HoldsExactlyTheFreePositionsOnTinyGrids) {
  Random random(kSeed);
  for (int round = 0; round < rounds(40); ++round) {
    SCOPED_TRACE(round);
    const int grid = 2 + random.below(3), reach = grid * 2;
    const RegionData outside = random.chance(50) ? box(0, 0, reach, reach).data() : random_parts(random, reach);
    std::vector<Region> shapes;
    for (int k = 0; k < 2; ++k)
      shapes.push_back(valid(random.chance(80) ? random_parts(random, grid) : random_region(random, grid)));
    const Definition definition(valid(outside), shapes);
    Placement placement = definition.placement();
    for (int k = 0; k < 4; ++k) {
      for (std::uint32_t shape = 0; shape < 2; ++shape) {
        const std::string fault = fault_of(definition, placement, shape, reach, random);
        ASSERT_EQ(fault, "") << to_wkt(outside) << "\n" << text_of(definition, placement) << "for " << shape;
      }
      stand_some(placement, random, reach, 2);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Placement, KeepsExactFits) {
  // A peg that fills a slot between two parts, and a square that has one position.
  Placement placement = *Placement::create(box(0, 0, 10, 4));
  const std::uint32_t wide = *placement.add_shape(box(0, 0, 4, 4)), peg = *placement.add_shape(box(0, 0, 2, 1)),
                      square = *placement.add_shape(box(0, 0, 2, 4));
  const std::uint32_t first = *placement.add_part(wide, at(0, 0)), second = *placement.add_part(wide, at(6, 0));
  const FeasiblePositions slot = *placement.feasible(peg), only = *placement.feasible(square);
  EXPECT_TRUE(slot.set.parts.empty());
  ASSERT_EQ(slot.set.segments.size(), 1u);
  EXPECT_EQ(slot.set.exact(slot.set.segments[0].from), at(4, 0));
  EXPECT_EQ(slot.set.exact(slot.set.segments[0].to), at(4, 3));
  ASSERT_EQ(slot.candidates.size(), 2u);
  EXPECT_EQ(slot.candidates[0].kind, CandidatePosition::Kind::segment);
  EXPECT_EQ(slot.candidates[0].touches, (std::vector{first, second, CandidatePosition::kContainer}));
  ASSERT_EQ(only.set.points.size(), 1u);
  EXPECT_EQ(only.candidates[0].kind, CandidatePosition::Kind::point);
  EXPECT_EQ(only.set.exact(only.set.points[0]), at(4, 0));
  const FeasiblePositions around = *placement.feasible(*placement.add_shape(box(0, 0, 1, 1)));
  ASSERT_EQ(around.candidates.size(), 4u);
  EXPECT_EQ(around.candidates[0].vertex.in, around.set.parts[0].outer.vertices[0].in);
  EXPECT_TRUE(*placement.is_free(square, at(4, 0)));
  EXPECT_FALSE(*placement.is_free(square, {*Rational::parse("4000000000000000000001/1000000000000000000000"), 0}));
}

/// What lies in the inner fit and in no no-fit polygon of parts at positions that are doubles.
PlanarSum by_boolean(const Region& container, const std::vector<Region>& placed, const Region& moving) {
  SumOptions regular;
  regular.semantics = Semantics::regular;
  std::vector<PlanarSum> sums;
  for (const Region& part : placed) sums.push_back(*nfp(part, moving));
  std::vector<PlanarOperand> operands(sums.begin(), sums.end());
  const PlanarSum fit = *erode(container, moving), covered = *united(operands, regular);
  return *difference(fit, covered, regular);
}

/// Rings that do not touch, so that moving their vertices a little keeps them valid.
RegionData apart(Random& random, int grid) { return {{{random_polygon(random, grid, 9), {}}}, {}, {}}; }

PlanarSum parts_of(const PlanarSum& sum) {
  PlanarSum parts;
  parts.parts = sum.parts;
  exact_source(parts) = exact_source(sum);
  return parts;
}

TEST(Placement, EqualsBooleanOperationsOffTheGrid) {
  Random random(kSeed);
  std::mt19937_64 noise(kSeed);
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int round = 0; round < rounds(2, 2); ++round) {
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(round));
      const auto of = [&](const RegionData& data) { return Region::create(of_kind(data, kind, noise)).value(); };
      const Region container = of(box(0, 0, 24, 24).data()), moving = of(apart(random, 5));
      std::vector<Region> placed;
      Placement placement = *Placement::create(container);
      const std::uint32_t shape = *placement.add_shape(moving);
      for (int k = 0; k < 6; ++k) {
        placed.push_back(of(apart(random, 7)));
        const double x = random.below(16), y = random.below(16);
        ASSERT_TRUE(placement.add_part(*placement.add_shape(placed.back()), at(x, y)).ok());
        Result<Region> moved = translated(placed.back(), x, y);
        // Rounding is to move nothing: else the part stands where it was made.
        if (moved && *translated(*moved, -x, -y) == placed.back()) placed.back() = *moved;
        else ASSERT_TRUE(placement.move_part(placement.parts().back().part, at(0, 0)).ok());
      }
      const FeasiblePositions feasible = *placement.feasible(shape);
      const PlanarSum expected = by_boolean(container, placed, moving);
      EXPECT_TRUE(parts_of(feasible.set) == parts_of(expected));
    }
}

TEST(Placement, UpdatedEqualsMadeAnew) {
  Random random(kSeed);
  const std::vector<Region> shapes{shapes::letter_l(4, 4, 2), shapes::letter_u(4, 3, 1), box(-1, -1, 1, 1),
                                   shapes::gear(5, 1, 2, 0x1p-8)};
  Placement placement = *Placement::create(shapes::letter_l(20, 20, 12));
  for (const Region& shape : shapes) ASSERT_TRUE(placement.add_shape(shape).ok());
  ASSERT_TRUE(placement.add_shape(shapes[0], *Orientation::of(1, 3)).ok());
  for (int step = 0; step < rounds(60); ++step) {
    SCOPED_TRACE(step);
    const std::vector<PlacedPart> parts = placement.parts();
    if (parts.size() > 8 || (parts.size() > 3 && random.chance(40))) {
      const std::uint32_t part = parts[static_cast<std::size_t>(random.below(static_cast<int>(parts.size())))].part;
      if (random.chance(50)) ASSERT_TRUE(placement.remove_part(part).ok());
      else ASSERT_TRUE(placement.move_part(part, at(random.below(16), random.below(16))).ok());
    } else {
      stand_some(placement, random, 12, 5);
    }
    Placement anew = *Placement::create(shapes::letter_l(20, 20, 12));
    for (const Region& shape : shapes) ASSERT_TRUE(anew.add_shape(shape).ok());
    ASSERT_TRUE(anew.add_shape(shapes[0], *Orientation::of(1, 3)).ok());
    for (const PlacedPart& part : placement.parts()) ASSERT_TRUE(anew.add_part(part.shape, part.at).ok());
    const auto shape = static_cast<std::uint32_t>(random.below(5));
    const FeasiblePositions updated = *placement.feasible(shape), made = *anew.feasible(shape);
    EXPECT_TRUE(updated.set == made.set);
    ASSERT_EQ(updated.candidates.size(), made.candidates.size());
    for (std::size_t k = 0; k < made.candidates.size(); ++k) {
      EXPECT_EQ(updated.set.exact(updated.candidates[k].vertex), made.set.exact(made.candidates[k].vertex));
      EXPECT_EQ(updated.candidates[k].touches.size(), made.candidates[k].touches.size());
    }
  }
}

TEST(Placement, CopiesAreIndependent) {
  Placement placement = *Placement::create(box(0, 0, 8, 8));
  const std::uint32_t shape = *placement.add_shape(box(0, 0, 4, 4));
  ASSERT_TRUE(placement.add_part(shape, at(0, 0)).ok());
  const PlanarSum before = placement.feasible(shape)->set;
  Placement copy = placement;
  ASSERT_TRUE(copy.add_part(shape, at(4, 0)).ok());
  EXPECT_FALSE(copy.feasible(shape)->set == before);
  EXPECT_TRUE(placement.feasible(shape)->set == before);
}

/// Of a position from a set, or 0 inside.
Big squared_distance(const PlanarSum& set, const RationalPoint& position) {
  if (SumLocator(set).contains_rational(position)) return 0;
  Edges edges;
  add_edges(set, {0, 0}, edges);
  const Pt<Big> z = big(position);
  const auto dot = [](const Pt<Big>& u, const Pt<Big>& v) { return Big(u.x * v.x + u.y * v.y); };
  Big least = -1;
  for (const Seg<Big>& s : edges) {
    const Pt<Big> d = s.b - s.a;
    const Big t = std::clamp<Big>(dot(z - s.a, d) / dot(d, d), 0, 1);
    const Pt<Big> to_z = z - Pt<Big>{s.a.x + t * d.x, s.a.y + t * d.y};
    const Big squared = dot(to_z, to_z);
    if (least < 0 || squared < least) least = squared;
  }
  return least;
}

TEST(Placement, KeepsSpacingAndMargin) {
  Random random(kSeed);
  const double spacing = 0.3, margin = 0.7;
  const Region container = valid({{{box(0, 0, 14, 12).parts()[0].outer, {{{6, 5}, {6, 7}, {8, 7}, {8, 5}}}}}, {}, {}});
  const std::vector<Region> shapes{shapes::letter_u(3, 3, 0.7), shapes::star(5, 0.5, 1.1), box(-0.5, -0.5, 0.5, 0.5)};
  PlacementOptions options;
  options.spacing = spacing;
  options.margin = margin;
  Placement placement = *Placement::create(container, options);
  for (const Region& shape : shapes) ASSERT_TRUE(placement.add_shape(shape, *Orientation::of(1, 2)).ok());
  for (int k = 0; k < 12; ++k) {
    const auto shape = static_cast<std::uint32_t>(random.below(3));
    const FeasiblePositions feasible = *placement.feasible(shape);
    if (feasible.candidates.empty()) continue;
    const auto c = static_cast<std::size_t>(random.below(static_cast<int>(feasible.candidates.size())));
    ASSERT_TRUE(placement.add_part(shape, feasible.set.exact(feasible.candidates[c].vertex)).ok());
  }
  const Big least = from_double<Big>(spacing) * from_double<Big>(spacing),
            edge = from_double<Big>(margin) * from_double<Big>(margin);
  std::vector<PlanarSum> turned;
  for (const Region& shape : shapes)
    turned.push_back(*rotated_sum(shape, valid({{}, {}, {{0, 0}}}), *Orientation::of(1, 2)));
  const Region outside = valid({{{box(-20, -20, 40, 40).parts()[0].outer, {}}}, {}, {}});
  const PlanarSum around = *difference(outside, container);
  const std::vector<PlacedPart> parts = placement.parts();
  ASSERT_GE(parts.size(), 5u);
  int near = 0;
  for (const PlacedPart& a : parts) {
    EXPECT_GE(squared_distance(*nfp(around, turned[a.shape]), a.at), edge);
    for (const PlacedPart& b : parts) {
      if (a.part >= b.part) continue;
      const Big squared = squared_distance(*nfp(turned[a.shape], turned[b.shape]), {b.at.x - a.at.x, b.at.y - a.at.y});
      EXPECT_GE(squared, least);
      near += squared < least * Big(103, 100);
    }
  }
  EXPECT_GT(near, 2);
}

TEST(Placement, RefusesWhatItCannotTake) {
  EXPECT_EQ(Placement::create(Region()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(Placement::create(valid({{}, {}, {{0, 0}}})).error().code, ErrorCode::unsupported_operand);
  for (const double wrong : {-1.0, std::nan(""), 1e300}) {
    PlacementOptions options;
    options.spacing = wrong;
    EXPECT_EQ(Placement::create(box(0, 0, 1, 1), options).error().code, ErrorCode::out_of_range);
  }
  Placement placement = *Placement::create(box(0, 0, 1, 1));
  EXPECT_EQ(placement.add_shape(Region()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(placement.feasible(0).error().code, ErrorCode::bad_index);
  EXPECT_EQ(placement.add_part(0, at(0, 0)).error().code, ErrorCode::bad_index);
  EXPECT_EQ(placement.move_part(0, at(0, 0)).error().code, ErrorCode::bad_index);
  EXPECT_EQ(placement.remove_part(0).error().code, ErrorCode::bad_index);
  const std::uint32_t shape = *placement.add_shape(box(0, 0, 2, 2));
  EXPECT_TRUE(placement.feasible(shape)->candidates.empty());
  EXPECT_EQ(placement.free_beside(shape, at(0, 0), 3).error().code, ErrorCode::out_of_range);
  EXPECT_FALSE(placement.free_beside(shape, at(0, 0), 1)->has_value());
}

}  // namespace
}  // namespace dymsum::oracles
