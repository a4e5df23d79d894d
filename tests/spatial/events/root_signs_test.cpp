// Signs at algebraic angles: what intervals of seventy digits find is what polynomials at the root have.
#include <gtest/gtest.h>

#include <iostream>

#include "exact/algebraic_root.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/events/rotation_candidates.h"

namespace dymsum {
namespace {

using namespace spatial;
using exact::AlgebraicRoot;
using exact::RootValue;

/// An L of height 1: all of its faces are several triangles, which rounding turns out of their planes.
MeshData triangulated_ell() {
  MeshData m;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {0.0, 3.0}})
      m.vertices.push_back({x, y, z});
  for (std::uint32_t k = 1; k + 1 < 6; ++k) m.faces.push_back({0, k + 1, k}), m.faces.push_back({6, 6 + k, 7 + k});
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    m.faces.push_back({i, j, j + 6}), m.faces.push_back({i, j + 6, i + 6});
  }
  return m;
}

struct Counts {
  int queried = 0, decided = 0, zeros = 0;
};

/// At one root: forms in fixed point, and the signs of a space of sums, against polynomials.
class AtRoot {
 public:
  AtRoot(const RotatingPair& pair, const AlgebraicRoot& root, const std::vector<WindowFacet>& facets)
      : pair_(pair), facets_(facets), point_(root), exact_frame_(pair, 0, &point_), exact_(exact_frame_) {
    exact::RootBracket bracket = root.bracket();
    if (!bracket.is_point()) bracket.refine_to(264);
    wide_frame_.emplace(pair, 0, bracket.low().value(), bracket.high().value());
    std::array<std::vector<exact::Vector3<RootValue>>, 2> positions;
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t v = 0; v < pair.operand(op).vertices.size(); ++v)
        positions[op].push_back(exact_frame_.placed(op, pair.grid(op).position<exact::Big>(v), true));
    const double weight = exact::to_double(exact_frame_.weight());
    space_ = make_root_space(std::move(positions[0]), std::move(positions[1]),
                             std::max(pair.pair.p_positions.bits, pair.pair.q_positions.bits) + 2 + std::ilogb(weight));
  }

  void compare(std::mt19937_64& random, Counts& counts) {
    std::array<const WindowFacet*, 4> f{};
    for (const WindowFacet*& any : f) any = &facets_[random() % facets_.size()];
    const SumEdge edge = f[0]->facet_edge(static_cast<int>(random() % 3));
    const SumPoint v = f[1]->facet.corner[random() % 3];
    std::array<PlaneSource, 4> sources{f[0]->plane, f[1]->plane, f[2]->plane, f[3]->plane};
    const PlaneId first = space_->add_planes(sources);
    const EdgeId e = space_->add_edges({&edge, 1});
    const auto plane = [&](const auto& s, int k) { return s.plane(f[k]->plane); };
    const auto exact_sign = [&](auto form) { return exact::sign(form(exact_)); };
    const auto check = [&](auto form) {
      const int wanted = exact_sign(form);
      const std::optional<int> s = sign_of(form(RotationSigns<WideFrame>(*wide_frame_)));
      ++counts.queried, counts.decided += s.has_value(), counts.zeros += wanted == 0;
      EXPECT_EQ(s.value_or(wanted), wanted);
      return wanted;
    };
    const int side = check([&](const auto& s) { return s.side(plane(s, 0), v); });
    EXPECT_EQ(space_->exact_side(first, v), side);
    const int rise = check([&](const auto& s) { return s.rise(plane(s, 1), edge); });
    const int order = check([&](const auto& s) { return s.order(edge, plane(s, 1), plane(s, 2)); });
    if (rise != 0) {
      const PointSource at{PointSource::Kind::edge, e, first + 1, 0};
      EXPECT_EQ(space_->exact_side(first + 2, at), -order * rise);
    }
    const int spread = check([&](const auto& s) { return s.spread(plane(s, 0), plane(s, 1), plane(s, 2)); });
    EXPECT_EQ(space_->exact_det(first, first + 1, first + 2), spread);
    const int height =
        check([&](const auto& s) { return s.height(plane(s, 0), plane(s, 1), plane(s, 2), plane(s, 3)); });
    if (spread != 0) {
      const PointSource at{PointSource::Kind::planes, first, first + 1, first + 2};
      EXPECT_EQ(space_->exact_side(first + 3, at), height * spread);
    }
  }
  exact::RungCounts signs() const { return space_->signs(); }

 private:
  const RotatingPair& pair_;
  const std::vector<WindowFacet>& facets_;
  exact::RootPoint point_;
  PolynomialFrame exact_frame_;
  RotationSigns<PolynomialFrame> exact_;
  std::optional<WideFrame> wide_frame_;
  std::unique_ptr<SumSpace> space_;
};

TEST(RootSigns, FixedPointFindsThoseOfPolynomials) {
  std::mt19937_64 random(5150);
  std::uint64_t wide = 0, exact = 0;
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    const Mesh p = Mesh::create(of_kind(triangulated_ell(), kind, random)).value();
    const RotatingPair pair(p, p, {1, 2, 3}, 0);
    const GaussMaps maps(pair);
    const std::vector<WindowFacet> facets = maps.facets(0, 1e-3);
    const PolynomialFrame frame(pair, 0);
    const RotationSigns<PolynomialFrame> signs(frame);
    Counts counts;
    std::uint64_t wide_here = 0;
    int roots = 0;
    for (int tries = 0; tries < 4000 && roots < 25; ++tries) {
      const auto any = [&]() { return signs.plane(facets[random() % facets.size()].plane); };
      const auto f = any(), g = any(), h = any(), k = any();
      exact::Terms form = signs.height(f, g, h, k).terms();
      while (form.size() > 3 && exact::divide_exactly(form, pair.circle.divisor())) continue;
      std::vector<exact::Big> c;
      for (exact::BigInteger& term : form) c.emplace_back(std::move(term));
      const exact::Polynomial polynomial = exact::primitive_part(exact::Polynomial(std::move(c)));
      // As near to the angle where all coincides as there is one: with rounding far below 1e-3.
      const std::vector<AlgebraicRoot> found = exact::roots_in(polynomial, 0, 1e-3);
      if (found.empty() || exact::rational_value(found[0])) continue;
      ++roots;
      AtRoot at(pair, found[0], facets);
      for (int n = 0; n < 20; ++n) at.compare(random, counts);
      wide_here += at.signs().at(exact::Rung::integers), exact += at.signs().at(exact::Rung::big);
    }
    std::cout << name_of(kind) << ": " << roots << " roots, " << counts.decided << " of " << counts.queried << " told, "
              << counts.zeros << " zeros, " << wide_here << " of the space" << std::endl;
    // Far from the origin, from where events move operands back, edges are short: products of nine are below a unit.
    if (kind != CoordinateKind::turned_far) {
      EXPECT_GE(counts.decided + counts.zeros, counts.queried) << "all but zeros";
    }
    if (kind == CoordinateKind::turned) {
      EXPECT_GT(wide_here, 100u);
    }
    wide += wide_here;
  }
  EXPECT_GT(wide, 100u);
  EXPECT_GT(exact, 0u) << "zeros";
}

}  // namespace
}  // namespace dymsum
