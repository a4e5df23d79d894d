// What may meet in a window: degrees of the polynomials, and nothing that samples show is missing.
#include "spatial/events/rotation_candidates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "oracles/coordinate_kinds.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using namespace spatial;
using moving_cases::mesh_of;

std::size_t degree(const RotatingPair& pair, const exact::RootValue& v) {
  exact::Terms terms = v.terms();
  while (terms.size() > 1 && exact::divide_exactly(terms, pair.circle.divisor())) continue;
  return terms.empty() ? 0 : terms.size() - 1;
}

TEST(RotationCandidates, PolynomialsHaveTheDegreesOfTheDesignPage) {
  for (const TurnAxis& axis : {TurnAxis{0, 0, 1}, TurnAxis{2, -1, 3}})
    for (const int chart : {0, 1}) {
      const RotatingPair pair(mesh_of(moving_cases::bumpy(1, 3)), mesh_of(moving_cases::bumpy(1, 8)), axis, 0);
      const GaussMaps maps(pair);
      const std::vector<WindowFacet> facets = maps.facets(0.4, 0.3);
      const PolynomialFrame frame(pair, chart);
      const RotationSigns<PolynomialFrame> signs(frame);
      std::mt19937_64 random(17);
      const auto any = [&]() -> const WindowFacet& { return facets[random() % facets.size()]; };
      std::array<std::size_t, 5> most{};
      const auto note = [&](int kind, const exact::RootValue& v) {
        most[kind] = std::max(most[kind], degree(pair, v));
      };
      for (int k = 0; k < 400; ++k) {
        const WindowFacet &f = any(), &g = any(), &h = any(), &i = any();
        if (!f.unsure.empty()) {
          const SlantCondition& c = f.unsure[0];
          note(0, signs.slant(c.op, pair.operand(c.op).triangles[c.triangle], c.direction));
        }
        note(1, signs.side(signs.plane(f.plane), g.facet.corner[0]));
        note(2, signs.twist(f.facet_edge(0), g.facet_edge(1)));
        note(3, signs.order(f.facet_edge(1), signs.plane(g.plane), signs.plane(h.plane)));
        note(4, signs.height(signs.plane(f.plane), signs.plane(g.plane), signs.plane(h.plane), signs.plane(i.plane)));
      }
      EXPECT_EQ(most, (std::array<std::size_t, 5>{2, 2, 2, 4, 6}));
    }
}

/// A sign in pairs of doubles is that of the exact form at the ends of its window and between them. Near an angle at
/// which all nearly coincides doubles leave most signs open, and these do not.
TEST(RotationCandidates, FineSignsAreThoseOfPolynomials) {
  std::mt19937_64 random(23);
  const auto turned_solid = [&](int seed) {
    return mesh_of(of_kind(moving_cases::bumpy(1, seed), CoordinateKind::turned, random));
  };
  const Mesh p = turned_solid(3), q = turned_solid(8);
  std::size_t fine_signs = 0, left_open = 0, by_doubles = 0, fine_near_zero = 0;
  for (const bool itself : {false, true})
    for (const TurnAxis& axis : {TurnAxis{0, 0, 1}, TurnAxis{2, -1, 3}})
      for (const int chart : {0, 1}) {
        if (itself && chart == 1) continue;
        const RotatingPair pair(p, itself ? p : q, axis, chart);
        const GaussMaps maps(pair);
        for (int k = 20; k < 72; k += 3) {
          const exact::BigRational width = exact::exact_value(std::ldexp(1.0, -k)),
                                   low = itself
                                             ? exact::BigRational(3 * width)
                                             : exact::exact_value(std::ldexp(static_cast<double>(random() % 999), -12)),
                                   high = low + width, between = low + width / 3;
          const double midpoint = pair.circle.radians(chart, exact::round_to_double(between));
          const std::vector<WindowFacet> facets = maps.facets(midpoint, 0x1p-20);
          const FineFrame frame(pair, chart, low, high);
          const RotationSigns<FineFrame> fine(frame);
          const JetFrame jets_frame(pair, midpoint, exact::round_to_double(width) * pair.circle.length() + 0x1p-44);
          const RotationSigns<JetFrame> jets(jets_frame);
          std::vector<PolynomialFrame> frames;
          for (const exact::BigRational& t : {low, between, high}) frames.emplace_back(pair, chart, t);
          const auto any = [&]() -> const WindowFacet& { return facets[random() % facets.size()]; };
          const auto check = [&](auto form) {
            const int s = form(fine).sign();
            ++(s == 0 ? left_open : fine_signs);
            by_doubles += form(jets).sign() != 0, fine_near_zero += itself && s != 0;
            if (s == 0) return;
            for (const PolynomialFrame& at : frames)
              ASSERT_EQ(sign(form(RotationSigns<PolynomialFrame>(at))), s) << k << ", chart " << chart;
          };
          for (int n = 0; n < 12; ++n) {
            const WindowFacet &f = any(), &g = any(), &h = any(), &i = any();
            if (!f.unsure.empty()) {
              const SlantCondition& c = f.unsure[0];
              check(
                  [&](const auto& s) { return s.slant(c.op, pair.operand(c.op).triangles[c.triangle], c.direction); });
            }
            const auto plane = [](const WindowFacet& of) { return [&](const auto& s) { return s.plane(of.plane); }; };
            check([&](const auto& s) { return s.side(plane(f)(s), g.facet.corner[0]); });
            check([&](const auto& s) { return s.twist(f.facet_edge(0), g.facet_edge(1)); });
            check([&](const auto& s) { return s.order(f.facet_edge(1), plane(g)(s), plane(h)(s)); });
            check([&](const auto& s) { return s.height(plane(f)(s), plane(g)(s), plane(h)(s), plane(i)(s)); });
          }
        }
      }
  std::cout << fine_signs << " signs, " << by_doubles << " by doubles, " << left_open << " open, " << fine_near_zero
            << " of a solid with itself" << std::endl;
  EXPECT_GT(fine_signs, by_doubles + 200);
  EXPECT_GT(fine_near_zero, 500u);
}

/// Signs at one angle, in doubles from turned vertices alone.
struct Sample {
  const std::vector<WindowFacet>& facets;
  std::array<std::vector<Vec3>, 2> at;
  std::vector<bool> exists;
  std::vector<Vec3> normals;

  Sample(const RotatingPair& pair, const std::vector<WindowFacet>& all, double theta)
      : facets(all), at(pair.positions) {
    const Vec3 a = (1 / pair.circle.length()) * Vec3{static_cast<double>(pair.circle.axis()[0]),
                                                     static_cast<double>(pair.circle.axis()[1]),
                                                     static_cast<double>(pair.circle.axis()[2])};
    for (Vec3& v : at[pair.turning])  // Rodrigues
      v = std::cos(theta) * v + std::sin(theta) * cross(a, v) + ((1 - std::cos(theta)) * dot(a, v)) * a;
    for (const WindowFacet& f : facets) {
      bool holds = true;
      for (const SlantCondition& c : f.unsure) {
        const Triangle& t = pair.operand(c.op).triangles[c.triangle];
        const std::vector<Vec3>& own = at[c.op];
        const Vec3 n = cross(own[t[1]] - own[t[0]], own[t[2]] - own[t[0]]);
        holds = holds && c.sense * dot(n, at[1 - c.op][c.direction.to] - at[1 - c.op][c.direction.from]) < -1e-9;
      }
      exists.push_back(holds);
      const Vec3 x = of(f.facet.corner[0]), y = of(f.facet.corner[1]), z = of(f.facet.corner[2]);
      normals.push_back(cross(y - x, z - x));
    }
  }
  Vec3 of(SumPoint v) const { return at[0][v.p] + at[1][v.q]; }
  bool inside(std::uint32_t f, Vec3 x) const {
    for (int k = 0; k < facets[f].facet.corners; ++k) {
      const SumEdge e = facets[f].facet_edge(k);
      if (dot(normals[f], cross(of(e.to) - of(e.from), x - of(e.from))) < 1e-7) return false;
    }
    return true;
  }
  double side(std::uint32_t f, Vec3 x) const { return dot(normals[f], x - of(facets[f].facet.corner[0])); }
  bool cross_well(std::uint32_t f, std::uint32_t g, std::uint32_t h) const {
    const double sizes = length(normals[f]) * length(normals[g]) * length(normals[h]);
    return std::abs(dot(normals[f], cross(normals[g], normals[h]))) > 1e-6 * sizes;
  }
  Vec3 point(std::uint32_t f, std::uint32_t g, std::uint32_t h) const {
    const Vec3 ab = cross(normals[f], normals[g]), bc = cross(normals[g], normals[h]),
               ca = cross(normals[h], normals[f]);
    const double w = dot(normals[f], bc);
    const auto offset = [&](std::uint32_t i) { return dot(normals[i], of(facets[i].facet.corner[0])); };
    return (1 / w) * (offset(f) * bc + offset(g) * ca + offset(h) * ab);
  }
};

/// Samples of all vertices with all facets, and of all quadruples of facets: where a sign changes while the features
/// meet well inside each other at both samples, the window has a root between them.
TEST(RotationCandidates, HaveAllThatSamplesShow) {
  std::mt19937_64 random(5);
  std::map<Meeting::Kind, int> shown;
  for (int round = 0; round < 9; ++round) {
    const Mesh p = round < 4 ? random_solids::valid_polyhedron(random) : mesh_of(moving_cases::bumpy(2, round)),
               q = round < 4 ? random_solids::valid_polyhedron(random) : mesh_of(moving_cases::bumpy(2, 9 + round));
    const TurnAxis axis = round % 2 == 0 ? TurnAxis{0, 0, 1} : TurnAxis{1, -2, 2};
    const RotatingPair pair(p, q, axis, round % 2);
    const GaussMaps maps(pair);
    const exact::BigRational low(round - 2, 16), high = low + exact::BigRational(1, 24);
    const RotationWindow window(pair, maps, {0, low, high});
    SolidRotationWork work;
    const WindowMeetings found = meetings_in(pair, window, work, [] {});
    std::vector<double> t;
    std::vector<Sample> samples;
    for (int k = 1; k < 24; ++k) {
      t.push_back((round - 2) / 16.0 + k / 24.0 / 24);
      samples.emplace_back(pair, window.facets, pair.circle.radians(0, t.back()));
    }
    for (std::size_t s = 0; s + 1 < samples.size(); ++s) {
      const Sample &a = samples[s], &b = samples[s + 1];
      const auto has = [&](auto match) {
        return std::any_of(found.meetings.begin(), found.meetings.end(), [&](const RootMeeting& m) {
          const exact::AlgebraicRoot& root = found.angles[m.angle];
          return root.high() > t[s] && root.low() < t[s + 1] && match(m.meeting);
        });
      };
      const auto n = static_cast<std::uint32_t>(window.facets.size());
      for (std::uint32_t f = 0; f < n; ++f) {
        if (!a.exists[f] || !b.exists[f]) continue;
        for (const SumPoint v : window.graph.corners.all()) {
          if (window.facets[f].has_corner(v) || !a.inside(f, a.of(v)) || !b.inside(f, b.of(v))) continue;
          if (!(a.side(f, a.of(v)) * b.side(f, b.of(v)) < -1e-18)) continue;
          const auto around = window.graph.corners.around(window.graph.corners.index(v));
          if (std::none_of(around.begin(), around.end(), [&](std::uint32_t g) { return a.exists[g] || b.exists[g]; }))
            continue;  // no vertex of the sum's facets there
          ++shown[Meeting::Kind::vertex_on_facet];
          EXPECT_TRUE(has([&](const Meeting& m) {
            return m.kind == Meeting::Kind::vertex_on_facet && m.vertex == v && m.facets[0] == f;
          })) << round;
        }
      }
      std::vector<std::array<std::uint32_t, 3>> points;
      std::vector<std::vector<std::uint32_t>> near(n);
      for (std::uint32_t f = 0; f < n; ++f)
        for (std::uint32_t g = f + 1; g < n; ++g)
          if (a.exists[f] && b.exists[f] && a.exists[g] && b.exists[g] &&
              overlap(window.facets[f].box, window.facets[g].box))
            near[f].push_back(g);
      for (std::uint32_t f = 0; f < n; ++f)
        for (const std::uint32_t g : near[f])
          for (const std::uint32_t h : near[g]) {
            if (!std::binary_search(near[f].begin(), near[f].end(), h)) continue;
            if (!a.cross_well(f, g, h) || !b.cross_well(f, g, h)) continue;
            const Vec3 x = a.point(f, g, h), y = b.point(f, g, h);
            if (!a.inside(f, x) || !a.inside(g, x) || !a.inside(h, x) || !b.inside(f, y) || !b.inside(g, y) ||
                !b.inside(h, y))
              continue;
            for (const std::uint32_t k : near[h]) {
              if (!a.inside(k, x) || !b.inside(k, y)) continue;
              if (!(a.side(k, x) * b.side(k, y) < -1e-18)) continue;
              ++shown[Meeting::Kind::four_facets];
              EXPECT_TRUE(has([&](const Meeting& m) {
                std::array<std::uint32_t, 4> of = m.facets;
                std::sort(of.begin(), of.end());
                return m.kind == Meeting::Kind::four_facets && of == std::array{f, g, h, k};
              })) << round;
            }
          }
    }
  }
  std::cout << shown[Meeting::Kind::vertex_on_facet] << " vertices, " << shown[Meeting::Kind::four_facets]
            << " fours of facets" << std::endl;
  EXPECT_GT(shown[Meeting::Kind::vertex_on_facet], 20);
  EXPECT_GT(shown[Meeting::Kind::four_facets], 0);
}

}  // namespace
}  // namespace dymsum
