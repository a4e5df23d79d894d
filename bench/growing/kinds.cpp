#include "growing/kinds.h"

#include "dymsum/growing_disc.h"
#include "dymsum/shapes.h"
#include "off_grid.h"
#include "shape/complex/complex.h"
#include "versus/rival.h"
#include "versus/segment_delaunay.h"

namespace dymsum::bench {
namespace {

using shape::Side;

shape::Complex complex_of(const Region& region, Side side, shape::Engine engine = shape::Engine::fast) {
  return make_complex(region, side, engine, 1).value();
}

/// The same nodes in the same order, from all pairs of sites.
bool as_by_brute(const Region& region, Side side) {
  const shape::Complex fast = complex_of(region, side), brute = complex_of(region, side, shape::Engine::brute);
  const auto same = [](const shape::Node& a, const shape::Node& b) {
    return a.kind == b.kind && a.rank == b.rank && a.centre == b.centre && a.radius == b.radius;
  };
  return fast.edges.size() == brute.edges.size() &&
         std::equal(fast.nodes.begin(), fast.nodes.end(), brute.nodes.begin(), brute.nodes.end(), same);
}

OffGridCase complex_case(const std::string& name, const Region& region) {
  return off_grid_case(name, region, region, [](const Region& made, const Region&) {
    OffGridWork work;
    work.run = [made] {
      return complex_of(made, Side::outside).nodes.size() + complex_of(made, Side::inside).nodes.size();
    };
    work.compare = [made] {
      constexpr std::size_t kLargestByBrute = 200;
      Compared compared;
      if (made.vertex_count() <= kLargestByBrute) {
        compared.wrong = !as_by_brute(made, Side::outside) || !as_by_brute(made, Side::inside);
        compared.verdict = compared.wrong ? "DIFFERENT" : "equal";
      } else {
        compared.wrong =
            !complex_of(made, Side::outside).work.certified || !complex_of(made, Side::inside).work.certified;
        compared.verdict = compared.wrong ? "not certified" : "certified";
      }
      const SegmentDelaunay rival(made.data());
      Times times;
      for (int k = 0; k < 5; ++k) times.ms.push_back(rival.build().ms);
      compared.rival_ms = times.median();
      return compared;
    };
    return work;
  });
}

/// From what is kept.
OffGridCase frames_case(const std::string& name, const Region& region) {
  return off_grid_case(name, region, region, [](const Region& made, const Region&) {
    constexpr int kFrames = 20;
    const auto box = bounds(made);
    const double top = std::max(box[2] - box[0], box[3] - box[1]) / 4;
    std::vector<Rational> radii;
    for (int k = 1; k <= kFrames; ++k) radii.push_back(Rational::of(top * k / kFrames).value());
    const GrowingDisc disc(made);
    disc.events(DiscSide::outside).value();
    OffGridWork work;
    work.run = [=] {
      std::size_t pieces = 0;
      for (const Rational& r : radii) pieces += disc.sum_at(r).value().piece_count();
      return pieces;
    };
    work.compare = [=] {
      bool wrong = false;
      for (const Rational& r : radii) {
        const DiscSet anew = GrowingDisc(made).sum_at(r).value(), kept = disc.sum_at(r).value();
        wrong = wrong || anew.parts.size() != kept.parts.size() || anew.hole_count() != kept.hole_count() ||
                anew.piece_count() != kept.piece_count() || bounds(anew) != bounds(kept);
      }
      return Compared{wrong ? "DIFFERENT" : "equal", wrong, 0};
    };
    return work;
  });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const Region star = shapes::noisy_star(100, 0.3, 1), comb = shapes::comb(25, 2, 1, 3),
               gear = shapes::gear(30, 8, 10, shapes::demo_snap(10));
  return off_grid_table(
      {"growing",
       "The complex of growing discs on both sides of a boundary, on one thread; frames: 20 radii from what "
       "is kept.",
       "node", "CGAL",
       "CGAL: its segment Delaunay graph, which is less (it stores no discs and does not order them). Compared: small "
       "complexes with those of all pairs of sites, large ones by their certificate; frames with those from nothing by "
       "parts, holes, pieces and bounds."},
      {complex_case("star 100", star), complex_case("comb 100", comb), complex_case("gear 30", gear),
       complex_case("star 1000", shapes::noisy_star(1000, 0.3, 1)),
       complex_case("grate 1000", shapes::grate(225, 2, 1, 3)), frames_case("frames, star 100", star),
       frames_case("frames, gear 30", gear)},
      folder);
}

}  // namespace dymsum::bench
