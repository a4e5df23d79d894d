// Layouts: planted faults are found with their exact depth, right ones pass, and every verdict is that by definition.
#include "dymsum/layout_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/penetration_depth.h"
#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {
namespace {

Region square(double size) { return shapes::rectangle(0, 0, size, size); }
RationalPoint position(double x, double y) { return {*Rational::of(x), *Rational::of(y)}; }
LayoutPart part(std::uint32_t shape, double x, double y) { return {"", shape, {}, position(x, y)}; }

TEST(LayoutCheck, FindsPlantedFaultsTheWorstFirst) {
  Layout layout;
  layout.shapes = {square(4), square(1)};
  layout.container = square(12);
  layout.parts = {part(0, 0, 0), part(0, 4, 0), part(0, 7, 1), part(1, 11.5, 8), part(1, 5, 5), part(1, 5, 5)};
  const LayoutCheck check = *check_layout(layout);
  ASSERT_EQ(check.faults.size(), 3u);
  EXPECT_EQ(check.faults[0].kind, LayoutFault::Kind::overlap);
  EXPECT_EQ(std::pair(check.faults[0].part, check.faults[0].other), std::pair(2u, 1u));
  EXPECT_EQ(check.faults[0].squared, Rational(1));
  EXPECT_EQ(check.faults[0].move, position(1, 0));
  EXPECT_EQ(std::pair(check.faults[1].part, check.faults[1].other), std::pair(5u, 4u));  // the same thing twice
  EXPECT_EQ(check.faults[1].distance, 1);
  EXPECT_EQ(check.faults[2].kind, LayoutFault::Kind::outside);
  EXPECT_EQ(check.faults[2].squared, *Rational::of(1, 4));
  EXPECT_EQ(check.faults[2].move, position(-0.5, 0));
  EXPECT_DOUBLE_EQ(check.density, 51 / 144.0);
}

TEST(LayoutCheck, KeepsDistancesExactly) {
  Layout layout;
  layout.shapes = {square(4)};
  layout.container = square(12);
  layout.parts = {part(0, 1, 1), part(0, 5.5, 6.25)};
  LayoutCheckOptions options;
  options.spacing = std::hypot(0.5, 1.25);
  // The corners are that far apart, exactly the root of 1.8125, and its double is above or below.
  const bool above = *Rational::of(options.spacing) * *Rational::of(options.spacing) > *Rational::of(1.8125);
  EXPECT_EQ(check_layout(layout, options)->valid(), !above);
  options.spacing = above ? std::nextafter(options.spacing, 0) : std::nextafter(options.spacing, 2);
  EXPECT_EQ(check_layout(layout, options)->valid(), above);
  options.spacing = 0;
  options.margin = 1;
  EXPECT_TRUE(check_layout(layout, options)->valid());
  options.margin = std::nextafter(1, 2);
  const LayoutCheck near = *check_layout(layout, options);
  ASSERT_EQ(near.faults.size(), 1u);
  EXPECT_EQ(near.faults[0].kind, LayoutFault::Kind::too_near);
  EXPECT_EQ(near.faults[0].squared, Rational(1));
}

TEST(LayoutCheck, SaysWherePartsFitNowhere) {
  Layout layout;
  layout.shapes = {square(4)};
  layout.container = square(3);
  layout.parts = {part(0, 0, 0)};
  EXPECT_TRUE(std::isinf(check_layout(layout)->faults.at(0).distance));
  layout.container = std::nullopt;
  EXPECT_TRUE(check_layout(layout)->valid());
  EXPECT_TRUE(check_layout({})->valid());
}

TEST(LayoutCheck, AgreesWithDefinitionsOnTinyGrids) {
  Random random(20261130);
  int wrong = 0;
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE(round);
    Layout layout;
    for (int k = 0; k < 3; ++k) layout.shapes.push_back(*Region::create(random_parts(random, 4)));
    layout.container = *Region::create(random_parts(random, 9));
    for (std::uint32_t k = 0; k < 4; ++k)
      layout.parts.push_back(
          part(static_cast<std::uint32_t>(random.below(3)), random.below(12) / 2.0, random.below(12) / 2.0));
    LayoutCheckOptions options;
    options.spacing = 0.75;
    const LayoutCheck check = *check_layout(layout, options);
    std::vector<std::string> expected, found;
    for (std::uint32_t a = 0; a < 4; ++a) {
      const LayoutPart& p = layout.parts[a];
      const Pt<Big> at{from_double<Big>(p.at.x.to_double()), from_double<Big>(p.at.y.to_double())};
      if (!holds_closed(layout.container->data(), layout.shapes[p.shape].data(), at))
        expected.push_back(std::to_string(a) + " outside");
      for (std::uint32_t b = 0; b < a; ++b) {
        const LayoutPart& q = layout.parts[b];
        const PlanarDistance distance = PlanarDepth::create(layout.shapes[q.shape], layout.shapes[p.shape])
                                            ->at(RationalPoint{p.at.x - q.at.x, p.at.y - q.at.y});
        const std::string pair = std::to_string(a) + " " + std::to_string(b);
        if (distance.meeting == Meeting::overlapping)
          expected.push_back(pair + " overlap " + distance.squared.to_string());
        else if (distance.squared < *Rational::of(0.5625))
          expected.push_back(pair + " near " + distance.squared.to_string());
      }
    }
    for (const LayoutFault& f : check.faults) {
      const std::string pair = std::to_string(f.part) + " " + std::to_string(f.other);
      if (f.kind == LayoutFault::Kind::outside) found.push_back(std::to_string(f.part) + " outside");
      else if (f.kind == LayoutFault::Kind::overlap) found.push_back(pair + " overlap " + f.squared.to_string());
      else found.push_back(pair + " near " + f.squared.to_string());
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    wrong += !check.valid();
  }
  EXPECT_GT(wrong, 10);
}

TEST(LayoutCheck, TenThousandPartsTakeSeconds) {
  Layout layout;
  layout.shapes = {shapes::letter_l(4, 4, 2), square(2)};
  for (int k = 0; k < 5000; ++k) {
    layout.parts.push_back(part(0, 4 * (k % 70), 4 * (k / 70)));
    layout.parts.push_back(part(1, 4 * (k % 70) + 2, 4 * (k / 70) + 2));
  }
  EXPECT_TRUE(check_layout(layout)->valid());
  layout.parts[777].at.x += *Rational::parse("1/1000000000000000000000");
  EXPECT_EQ(check_layout(layout)->faults.size(), 1u);
}

TEST(LayoutCheck, RefusesWhatIsNoLayout) {
  Layout layout;
  layout.parts = {part(0, 0, 0)};
  EXPECT_EQ(check_layout(layout).error().code, ErrorCode::bad_index);
  LayoutCheckOptions options;
  options.spacing = -1;
  EXPECT_EQ(check_layout({}, options).error().code, ErrorCode::out_of_range);
  options = {};
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(check_layout({}, options).error().code, ErrorCode::cancelled);
  EXPECT_EQ(read_layouts("no such file").error().code, ErrorCode::cannot_open);
  const std::string items =
      R"({"items": [{"id": 0, "shape": {"type": "simple_polygon", "data": [[0,0],[1,0],[0,1]]}}],)"
      R"( "strip_height": 1, "solution": )";
  const std::string placed = R"({"item_id": 0, "transformation": {"rotation": 90, "translation": ["4/3", "0"]}})";
  EXPECT_EQ(parse_layouts(items + R"({"layout": {"placed_items": []}}})", "x").error().code, ErrorCode::malformed);
  const auto text = [&](const std::string& item) {
    return items + R"({"strip_width": 2, "layout": {"placed_items": [)" + item + "]}}}";
  };
  const std::vector<Layout> layouts = *parse_layouts(text(placed), "x");
  EXPECT_EQ(layouts.at(0).parts.at(0).at.x, *Rational::of(4, 3));
  EXPECT_EQ(layouts[0].parts[0].orientation, *Orientation::of(1, 1));
  EXPECT_TRUE(check_layout(layouts[0])->valid());
  EXPECT_EQ(parse_layouts(text(R"({"item_id": 7})"), "x").error().code, ErrorCode::malformed);
}

}  // namespace
}  // namespace dymsum::oracles
