// Scales at which paths are free and parts fit, against membership in the static engine's sums and against shapes done
// by hand.
#include "dymsum/scale_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "planar/frame/scaling_same.h"

namespace dymsum {
namespace {

using namespace scaling_tests;

Region ring(Ring r) { return Region::create({{{std::move(r), {}}}, {}, {}}).value(); }

std::string text(const ScaleRange& range) {
  std::string s;
  for (const ScaleInterval& i : range.free)
    s += (i.low ? "[" + i.low->to_string() : std::string("(0")) + ", " +
         (i.high ? i.high->to_string() + "]" : std::string("inf)")) + " ";
  return s;
}

/// Contacts without their positions.
std::vector<std::string> decided(const std::vector<ScaleContact>& contacts) {
  std::vector<std::string> list;
  for (const ScaleContact& c : contacts) {
    const std::string part = std::to_string(c.part), obstacle = std::to_string(c.obstacle);
    list.push_back(c.kind == ScaleContact::Kind::vertex_on_edge   ? "vertex " + part + " on edge " + obstacle
                   : c.kind == ScaleContact::Kind::edge_on_vertex ? "edge " + part + " on vertex " + obstacle
                                                                  : "vertex " + part + " on vertex " + obstacle);
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Vertices by number, and the end of the edge that starts there.
struct Numbered {
  explicit Numbered(const Region& region) {
    const auto add = [&](const Ring& r) {
      for (std::size_t k = 0; k < r.size(); ++k) {
        start.push_back(r[k]);
        end.push_back(r[(k + 1) % r.size()]);
      }
    };
    for (const Part& part : region.parts()) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
    }
  }
  std::vector<Point> start, end;
};

/// What touches when the part stands at (x, y) at scale s, by looking at all pairs.
std::vector<std::string> touching(const Region& part, const Region& container, const exact::BigRational& s,
                                  const RationalPoint& at) {
  using exact::BigRational;
  struct Position {
    BigRational x, y;
  };
  const Numbered p(part), c(container);
  const auto of_part = [&](Point v) {
    return Position{BigRational(exact::exact_value(at.x) + s * exact::exact_value(v.x)),
                    BigRational(exact::exact_value(at.y) + s * exact::exact_value(v.y))};
  };
  const auto of_container = [](Point v) { return Position{exact::exact_value(v.x), exact::exact_value(v.y)}; };
  const auto same = [](const Position& a, const Position& b) { return a.x == b.x && a.y == b.y; };
  const auto inside = [&](const Position& a, const Position& b, const Position& v) {
    const BigRational cross = (b.x - a.x) * (v.y - a.y) - (b.y - a.y) * (v.x - a.x),
                      along = (b.x - a.x) * (v.x - a.x) + (b.y - a.y) * (v.y - a.y);
    const BigRational length = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    return cross == 0 && along > 0 && along < length;
  };
  std::vector<std::string> list;
  for (std::size_t i = 0; i < p.start.size(); ++i)
    for (std::size_t k = 0; k < c.start.size(); ++k) {
      const Position v = of_part(p.start[i]), w = of_part(p.end[i]), a = of_container(c.start[k]),
                     b = of_container(c.end[k]);
      const std::string part_index = std::to_string(i), number = std::to_string(k);
      if (same(v, a)) list.push_back("vertex " + part_index + " on vertex " + number);
      if (inside(a, b, v)) list.push_back("vertex " + part_index + " on edge " + number);
      if (inside(v, w, a)) list.push_back("edge " + part_index + " on vertex " + number);
    }
  std::sort(list.begin(), list.end());
  return list;
}

TEST(ScaleRange, a_c_around_a_post_is_free_at_several_scales) {
  // A C, open to the right, about the origin; the post is the square [2, 3] x [-1/2, 1/2]: inside the C's mouth at
  // large scales, beyond it at small ones, in its arms never, but in its back in between.
  const Region c = ring({{-1, -2}, {2, -2}, {2, -1}, {0, -1}, {0, 1}, {2, 1}, {2, 2}, {-1, 2}});
  const Region post = shapes::rectangle(-3, -0.5, -2, 0.5);
  const ScaleRange range = scale_range(c, {{0, 0}}, post).value();
  // The back spans [-s, 0] around x in [-3, -2]: free while -s >= -2; never again, as its inner side stays at 0.
  EXPECT_EQ(text(range), "(0, 2/1] ");
  // About a reference point to the right of its back, the C passes over the post.
  const Region shifted = ring({{-2, -2}, {2, -2}, {2, -1}, {-1, -1}, {-1, 1}, {2, 1}, {2, 2}, {-2, 2}});
  EXPECT_EQ(text(scale_range(shifted, {{0, 0}}, post).value()), "(0, 1/1] [3/1, inf) ");
}

TEST(ScaleRange, contacts_at_the_ends_name_what_touches_and_where) {
  const Region part = shapes::rectangle(-1, -1, 1, 1), wall = shapes::rectangle(5, -10, 6, 10);
  const ScaleRange range = scale_range(part, {{0, 0}, {2, 0}}, wall).value();
  ASSERT_EQ(text(range), "(0, 3/1] ");
  ASSERT_FALSE(range.free[0].at_high.empty());
  EXPECT_EQ(range.trap()->to_string(), "3/1");
  for (const ScaleContact& c : range.free[0].at_high) {
    EXPECT_EQ(c.kind, ScaleContact::Kind::vertex_on_edge);
    EXPECT_TRUE(c.part == 1 || c.part == 2) << c.part;  // the right corners
    EXPECT_EQ(c.obstacle, 3u);                          // the wall's left side
    EXPECT_EQ(c.leg, 0u);
    EXPECT_EQ(c.along.to_string(), "1/1");
    EXPECT_EQ(c.at.x.to_string(), "2/1");
  }
}

TEST(ScaleRange, an_exact_fit_is_an_interval_of_one_point) {
  // A square peg pushed along a corridor as wide as itself at s = 2, where its reference point is off centre: larger
  // and smaller ones hit.
  const Region part = shapes::rectangle(1, 1, 2, 2);
  RegionData walls;
  walls.parts.push_back({{{0, 0}, {10, 0}, {10, 2}, {0, 2}}, {}});
  walls.parts.push_back({{{0, 4}, {10, 4}, {10, 6}, {0, 6}}, {}});
  const ScaleRange range = scale_range(part, {{0, 0}, {4, 0}}, Region::create(walls).value()).value();
  EXPECT_EQ(text(range), "[2/1, 2/1] [6/1, inf) ");
  EXPECT_FALSE(range.free[0].at_low.empty());
  EXPECT_TRUE(range.contains(scale_of(2, 1)));
  EXPECT_FALSE(range.contains(Scale::of(2 + 0x1p-40).value()));
}

TEST(ScaleRange, never_and_always) {
  const Region part = shapes::rectangle(-1, -1, 1, 1);
  const ScaleRange never = scale_range(part, {{0, 0}, {10, 0}}, shapes::rectangle(4, -1, 5, 1)).value();
  EXPECT_TRUE(never.free.empty());
  EXPECT_EQ(never.trap()->to_string(), "0/1");
  const Region upper = ring({{-1, 0}, {1, 0}, {0, 1}});
  const ScaleRange always = scale_range(upper, {{0, 0}, {10, 0}}, shapes::rectangle(-50, -2, 50, 0)).value();
  EXPECT_EQ(text(always), "(0, inf) ");
  EXPECT_FALSE(always.trap().has_value());
}

TEST(ScaleRange, random_paths_agree_with_membership_at_many_scales) {
  int several = 0, blocked = 0, free = 0;
  for (int round = 0; round < 200; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const auto point = [&](int size, int shift) {
      return Point{double(random.below(size) - shift), double(random.below(size) - shift)};
    };
    // A triangle anywhere about its reference point; two triangles as obstacles.
    const auto triangle = [&](int size, int shift) {
      for (;;) {
        Ring r{point(size, shift), point(size, shift), point(size, shift)};
        const double area = (r[1].x - r[0].x) * (r[2].y - r[0].y) - (r[1].y - r[0].y) * (r[2].x - r[0].x);
        if (area == 0) continue;
        if (area < 0) std::swap(r[1], r[2]);
        return r;
      }
    };
    const Region part = ring(triangle(9, 4));
    const Region one = ring(triangle(20, 10)), two = ring(triangle(20, 10));
    std::vector<Point> path;
    for (int k = 0; k < 3; ++k) path.push_back(point(30, 15));
    const std::vector<Region> obstacles{one, two};
    const Region both = union_of(obstacles).value().rounded_with_repair().value().region;
    if (both.parts().size() != 2) continue;  // overlapping triangles: their union is rounded
    const ScaleRange range = scale_range(part, path, both).value();
    several += range.free.size() > 1;
    const auto is_free = [&](long a, long b) {
      // The convex part swept along a leg is the hull of both placements: the sum of a triangle and a segment, an
      // integer region.
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        RegionData leg;
        const auto scaled = [b](Point p) { return Point{p.x * double(b), p.y * double(b)}; };
        leg.polylines.push_back({scaled(path[k]), scaled(path[k + 1])});
        if (path[k] == path[k + 1]) leg = {{}, {}, {scaled(path[k])}};
        const Region swept = minkowski_sum(multiplied(part, double(a), double(a)), Region::create(leg).value())
                                 .value()
                                 .rounded()
                                 .value();
        if (contains(multiplied(both, double(b), double(b)), negated(swept), {0, 0}, Semantics::open)) return false;
      }
      return true;
    };
    for (int k = 1; k <= 48; ++k) {
      const bool expected = is_free(k, 16);
      (expected ? free : blocked)++;
      ASSERT_EQ(range.contains(scale_of(k, 16)), expected)
          << "round " << round << ", s = " << k << "/16; free: " << text(range);
    }
    for (const ScaleInterval& i : range.free)
      for (const auto& [end, direction] : {std::pair{i.low, -1}, std::pair{i.high, 1}}) {
        if (!end) continue;
        const long a = std::stol(end->numerator()), b = std::stol(end->denominator());
        EXPECT_TRUE(is_free(a, b)) << "round " << round << ": " << end->to_string();
        const long fine = 1024;
        EXPECT_FALSE(is_free(a * fine + direction, b * fine) &&
                     !range.contains(scale_of(a * fine + direction, b * fine)))
            << "round " << round << ": beyond " << end->to_string();
        EXPECT_FALSE((direction < 0 ? i.at_low : i.at_high).empty());
      }
  }
  EXPECT_GT(several, 3);
  EXPECT_GT(free, 100);
  EXPECT_GT(blocked, 100);
}

TEST(FitRange, a_placement_inside_a_container) {
  const Region part = shapes::rectangle(-1, -1, 2, 1), room = shapes::rectangle(0, 0, 10, 10);
  const ScaleRange range = fit_range(part, room, {4, 5}).value();
  EXPECT_EQ(text(range), "(0, 3/1] ");
  EXPECT_FALSE(range.free[0].at_high.empty());
  EXPECT_TRUE(fit_range(part, room, {-1, 5}).value().free.empty());
  // On the facet edge: every scale sticks out.
  EXPECT_TRUE(fit_range(part, room, {0, 5}).value().free.empty());
}

TEST(FitRange, the_largest_scale_anywhere_is_exact) {
  EXPECT_EQ(text(fit_range(shapes::rectangle(3, 5, 5, 6), shapes::rectangle(0, 0, 7, 3)).value()), "(0, 3/1] ");
  // An L in an L: the same shape fits up to its own size.
  const Region l = shapes::letter_l(8, 6, 2);
  const ScaleRange same = fit_range(l, l).value();
  ASSERT_FALSE(same.free.empty());
  EXPECT_EQ(same.free.back().high->to_string(), "1/1");
  for (int k = 1; k <= 40; ++k) {
    const bool fits = [&] {
      const PlanarSum room = erode(multiplied(l, 32, 32), multiplied(l, k, k)).value();
      return !room.parts.empty() || !room.segments.empty() || !room.points.empty();
    }();
    EXPECT_EQ(same.contains(scale_of(k, 32)), fits) << k;
  }
}

TEST(FitRange, random_containers_agree_with_erosions) {
  for (int round = 0; round < 6; ++round) {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    const Region container = on_integers(shapes::random_polygon(14, 1, seed), 400),
                 part = on_integers(shapes::noisy_star(7, 0.5, seed), 60);
    const ScaleRange range = fit_range(part, container).value();
    for (int k = 1; k <= 60; ++k) {
      const PlanarSum room = erode(multiplied(container, 16, 16), multiplied(part, k, k)).value();
      EXPECT_EQ(range.contains(scale_of(k, 16)), !room.parts.empty() || !room.segments.empty() || !room.points.empty())
          << round << " " << k << " " << text(range);
    }
  }
}

TEST(FitRange, contacts_of_any_placement_name_what_holds_the_part) {
  // A peg as high as the room slides along it.
  const ScaleRange slides = fit_range(shapes::rectangle(3, 5, 5, 6), shapes::rectangle(0, 0, 7, 3)).value();
  ASSERT_EQ(text(slides), "(0, 3/1] ");
  EXPECT_EQ(decided(slides.free[0].at_high), (std::vector<std::string>{"vertex 0 on edge 0", "vertex 1 on edge 0",
                                                                       "vertex 2 on edge 2", "vertex 3 on edge 2"}));
  for (const ScaleContact& c : slides.free[0].at_high)
    EXPECT_EQ(c.at, (RationalPoint{*Rational::of(-9, 1), *Rational::of(-15, 1)}));
  // A triangle in itself.
  const Region t = ring({{-1, -1}, {1, -1}, {0, 1}});
  const ScaleRange same = fit_range(t, t).value();
  ASSERT_EQ(text(same), "(0, 1/1] ");
  EXPECT_EQ(decided(same.free[0].at_high),
            (std::vector<std::string>{"vertex 0 on vertex 0", "vertex 1 on vertex 1", "vertex 2 on vertex 2"}));
}

TEST(FitRange, a_c_in_a_ring_is_held_from_inside_at_the_low_end_and_from_outside_at_the_high_one) {
  RegionData frame;
  frame.parts.push_back({{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, {{{-8, -8}, {-8, 8}, {8, 8}, {8, -8}}}});
  const Region container = Region::create(frame).value();
  const Region c = ring({{-9.5, -9.5},
                         {9.5, -9.5},
                         {9.5, -1},
                         {8.5, -1},
                         {8.5, -8.5},
                         {-8.5, -8.5},
                         {-8.5, 8.5},
                         {8.5, 8.5},
                         {8.5, 1},
                         {9.5, 1},
                         {9.5, 9.5},
                         {-9.5, 9.5}});
  const ScaleRange range = fit_range(c, container).value();
  ASSERT_FALSE(range.free.empty());
  const ScaleInterval& around = range.free.back();
  ASSERT_TRUE(around.low.has_value());
  EXPECT_EQ(around.low->to_string(), "16/17");
  EXPECT_EQ(around.high->to_string(), "20/19");
  EXPECT_EQ(decided(around.at_low),
            (std::vector<std::string>{"vertex 3 on edge 6", "vertex 4 on vertex 7", "vertex 5 on vertex 4",
                                      "vertex 6 on vertex 5", "vertex 7 on vertex 6", "vertex 8 on edge 6"}));
  EXPECT_EQ(decided(around.at_high),
            (std::vector<std::string>{"vertex 0 on vertex 0", "vertex 1 on vertex 1", "vertex 10 on vertex 2",
                                      "vertex 11 on vertex 3", "vertex 2 on edge 1", "vertex 9 on edge 1"}));
}

TEST(FitRange, contacts_of_random_fits_are_all_that_touch) {
  int points = 0;
  for (int round = 0; round < 6; ++round) {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    const Region container = on_integers(shapes::random_polygon(14, 1, seed), 400),
                 part = on_integers(shapes::noisy_star(7, 0.5, seed), 60);
    const ScaleRange range = fit_range(part, container).value();
    for (const ScaleInterval& i : range.free)
      for (const auto& [end, contacts] : {std::pair{i.low, i.at_low}, std::pair{i.high, i.at_high}}) {
        if (!end) {
          EXPECT_TRUE(contacts.empty());
          continue;
        }
        // Something has to hold it from at least two sides.
        EXPECT_GE(contacts.size(), 2u) << round;
        for (const ScaleContact& c : contacts) {
          std::vector<ScaleContact> here;
          for (const ScaleContact& other : contacts)
            if (other.at == c.at) here.push_back(other);
          EXPECT_EQ(decided(here), touching(part, container, exact::exact_value(*end), c.at))
              << "round " << round << ", s = " << end->to_string();
          ++points;
        }
      }
  }
  EXPECT_GT(points, 10);
}

TEST(ScaleRange, inputs_without_an_answer_give_errors) {
  const Region square = shapes::rectangle(0, 0, 1, 1);
  RegionData line;
  line.polylines.push_back({{0, 0}, {1, 0}});
  const Region thin = Region::create(line).value();
  EXPECT_EQ(scale_range(square, std::vector<Point>{}, square).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(scale_range(thin, {{0, 0}}, square).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(scale_range(square, {{0, 0}}, Region()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(scale_range(Region(), {{0, 0}}, square).error().message, "the part is empty");
  EXPECT_EQ(fit_range(Region(), square).error().message, "the part is empty");
  EXPECT_EQ(fit_range(square, Region()).error().message, "the region of obstacles, or the container, is empty");
  EXPECT_NE(fit_range(thin, square).error().message, "the part is empty");
  const Error nan = scale_range(square, {{0, 0}, {NAN, 0}}, square).error();
  EXPECT_EQ(nan.code, ErrorCode::not_finite);
  EXPECT_EQ(nan.evidence.vertex, 1);
  EXPECT_EQ(fit_range(square, thin).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(fit_range(square, square, {INFINITY, 0}).error().code, ErrorCode::not_finite);
  const auto stop = [](std::string_view, double) { return false; };
  EXPECT_EQ(scale_range(square, {{3, 3}}, square, stop).error().code, ErrorCode::cancelled);
  EXPECT_EQ(fit_range(square, square, stop).error().code, ErrorCode::cancelled);
}

// Whatever it asks first: all of the work may take long.
TEST(ScaleRange, is_stopped_wherever_it_asks) {
  const Region part = snapped_shapes::star(5, 0.5, 1), container = snapped_shapes::gear(8, 3, 4);
  const auto of_path = [&](const Progress& progress) {
    return scale_range(part, {{0, 0}, {1, 0.5}}, container, progress);
  };
  const auto of_fit = [&](const Progress& progress) { return fit_range(part, container, progress); };
  const auto check = [](auto&& work, std::size_t least) {
    std::size_t all = 0;
    std::set<std::string, std::less<>> stages;
    ASSERT_TRUE(work([&](std::string_view stage, double fraction) {
                  stages.emplace(stage);
                  EXPECT_TRUE(fraction >= 0 && fraction <= 1);
                  return ++all > 0;
                }).ok());
    EXPECT_GE(all, least);
    EXPECT_GE(stages.size(), 2u);
    for (std::size_t queried = 1; queried <= all; queried += 1 + all / 9) {
      std::size_t left = queried;
      EXPECT_EQ(work([&](std::string_view, double) { return --left > 0; }).error().code, ErrorCode::cancelled);
    }
  };
  check(of_path, 150);
  check(of_fit, 100);
}

}  // namespace
}  // namespace dymsum
