// Layouts: planted faults are found with their exact depth, right ones pass, and every verdict is that by definition.
#include "dymsum/layout_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

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

TEST(LayoutCheck, MeasuresTheDeepestOverlaps) {
  Random random(20261130);
  Layout layout;
  for (int k = 0; k < 5; ++k) layout.shapes.push_back(*Region::create(random_parts(random, 6)));
  for (std::uint32_t k = 0; k < 60; ++k) {
    layout.parts.push_back(part(k % 5, random.below(40) / 4.0, random.below(40) / 4.0));
    layout.parts.back().orientation = *Orientation::of(random.below(7) - 3, 1 + random.below(4));
  }
  const auto faults_of = [&](std::size_t measured) {
    LayoutCheckOptions options;
    options.measured = measured;
    return check_layout(layout, options)->faults;
  };
  const std::vector<LayoutFault> all = faults_of(100'000);
  ASSERT_GT(all.size(), 200u);
  for (const LayoutFault& f : all) EXPECT_TRUE(f.measured);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> depths;
  for (const LayoutFault& f : all) depths[{f.part, f.other}] = f.distance;
  for (const std::size_t measured : {std::size_t{0}, std::size_t{1}, std::size_t{17}}) {
    const std::vector<LayoutFault> some = faults_of(measured);
    ASSERT_EQ(some.size(), all.size());
    for (std::size_t k = 0; k < some.size(); ++k) {
      EXPECT_EQ(some[k].measured, k < measured);
      if (k < measured) {
        EXPECT_EQ(some[k].squared, all[k].squared);
      }
      const auto depth = depths.find({some[k].part, some[k].other});
      ASSERT_NE(depth, depths.end());
      EXPECT_LE(depth->second, some[k].at_most);
    }
  }
}

TEST(LayoutCheck, ManyOverlapsTakeSeconds) {
  Layout layout;
  layout.shapes = {square(1)};
  for (int k = 0; k < rounds(1000); ++k) layout.parts.push_back(part(0, 0, 0));
  const LayoutCheck check = *check_layout(layout);
  EXPECT_EQ(check.faults.size(), layout.parts.size() * (layout.parts.size() - 1) / 2);
  EXPECT_EQ(check.faults[99].squared, Rational(1));
  EXPECT_FALSE(check.faults[100].measured);
}

std::string svg_of(const std::string& inside) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg">)" + inside + "</svg>";
}
std::vector<Layout> svg_layouts(const std::string& inside, const LayoutReadOptions& options = {}) {
  return *parse_layouts(svg_of(inside), "nested.svg", options, LayoutFormat::svg);
}

TEST(LayoutFiles, SvgnestGroupsArePartsOfTheirBin) {
  const std::string bin = R"x(<rect class="bin" width="10" height="6"/>)x",
                    ring = R"x(<g transform="translate(0 0)"><polygon points="0,0 5,0 5,5 0,5"/>)x"
                           R"x(<polygon class="part hole" points="1,1 4,1 4,4 1,4"/></g>)x",
                    peg = R"x(<g transform="translate(4 1) rotate(90)"><polygon points="0,0 3,0 3,3 0,3"/></g>)x";
  const std::vector<Layout> one = svg_layouts(bin + ring + peg);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].parts.size(), 2u);
  EXPECT_EQ(area(one[0].shapes[0]), 16);
  EXPECT_TRUE(check_layout(one[0])->valid());  // the peg fits the hole exactly
  const std::vector<Layout> two = svg_layouts("<g>" + bin + ring + peg + R"x(</g><g transform="translate(0 20)">)x" +
                                              bin + R"x(<rect width="11" height="1"/></g>)x");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_TRUE(check_layout(two[0])->valid());
  const LayoutCheck wide = *check_layout(two[1]);
  ASSERT_EQ(wide.faults.size(), 1u);
  EXPECT_EQ(wide.faults[0].kind, LayoutFault::Kind::outside);
  EXPECT_TRUE(std::isinf(wide.faults[0].distance));
}

TEST(LayoutFiles, ContainersOfSvgAreTheLargestOrNamed) {
  const std::string shapes = R"(<rect id="sheet" width="10" height="6"/><rect id="a" width="4" height="4"/>)"
                             R"(<rect id="b" x="3" width="4" height="4"/>)";
  for (const std::string container : {"", "largest", "sheet"}) {
    LayoutReadOptions options;
    options.container = container;
    const Layout layout = svg_layouts(shapes, options).at(0);
    EXPECT_EQ(layout.parts.size(), 2u);
    EXPECT_EQ(area(*layout.container), 60);
    const LayoutCheck check = *check_layout(layout);
    ASSERT_EQ(check.faults.size(), 1u);
    EXPECT_EQ(check.faults[0].squared, Rational(1));
  }
  LayoutReadOptions options;
  options.container = "none";
  EXPECT_EQ(svg_layouts(shapes, options).at(0).parts.size(), 3u);
  options.container = "absent";
  EXPECT_EQ(parse_layouts(svg_of(shapes), "x.svg", options, LayoutFormat::svg).error().code, ErrorCode::malformed);
  EXPECT_EQ(parse_layouts(svg_of("<line x2='1'/>"), "x.svg", {}, LayoutFormat::svg).error().code, ErrorCode::malformed);
  EXPECT_EQ(parse_layouts("<svg><g>", "x.svg", {}, LayoutFormat::svg).error().code, ErrorCode::malformed);
  EXPECT_FALSE(parse_layouts("no drawing", "x.svg", {}, LayoutFormat::svg).ok());
}

std::string dxf_ring(const Ring& ring, const std::string& layer) {
  std::string text = "0\nLWPOLYLINE\n8\n" + layer + "\n90\n" + std::to_string(ring.size()) + "\n70\n1\n";
  for (const Point& p : ring) text += "10\n" + std::to_string(p.x) + "\n20\n" + std::to_string(p.y) + "\n";
  return text;
}
std::string dxf_of(const std::string& entities) {
  return "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}
Ring corners(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

TEST(LayoutFiles, RingsOfDxfArePartsWithHoles) {
  const std::string sheet = dxf_ring(corners(0, 0, 20, 9), "SHEET"), plate = dxf_ring(corners(1, 1, 7, 7), "CUT"),
                    hole = dxf_ring(corners(6, 2, 2, 6), "CUT"), peg = dxf_ring(corners(3, 3, 5, 5), "CUT"),
                    other = dxf_ring(corners(6.5, 1, 12, 5), "CUT");
  for (const std::string container : {"", "largest", "SHEET"}) {
    LayoutReadOptions options;
    options.container = container;
    const Layout layout =
        parse_layouts(dxf_of(plate + sheet + hole + peg + other), "cut.dxf", options, LayoutFormat::dxf)->at(0);
    ASSERT_EQ(layout.parts.size(), 3u);
    EXPECT_EQ(area(*layout.container), 180);
    double all = 0;
    for (const Region& shape : layout.shapes) all += area(shape);
    EXPECT_EQ(all, 36 - 16 + 4 + 22);
    const LayoutCheck check = *check_layout(layout);
    ASSERT_EQ(check.faults.size(), 1u);
    EXPECT_EQ(check.faults[0].distance, 0.5);
  }
  LayoutReadOptions options;
  options.container = "CUT";
  EXPECT_EQ(parse_layouts(dxf_of(plate + sheet + other), "cut.dxf", options, LayoutFormat::dxf).error().code,
            ErrorCode::malformed);
  options.container = "none";
  const std::string huge = dxf_ring(corners(0, 0, 1e305, 1e305), "CUT");
  EXPECT_EQ(parse_layouts(dxf_of(huge + plate), "cut.dxf", options, LayoutFormat::dxf).error().code,
            ErrorCode::unsupported_operand);
  EXPECT_EQ(parse_layouts(dxf_of(plate + plate), "cut.dxf", options, LayoutFormat::dxf)->at(0).parts.size(), 2u);
}

TEST(LayoutFiles, ClockwiseShapesAreTakenWithRepair) {
  const std::string text =
      R"({"items":[{"id":0,"shape":{"type":"simple_polygon","data":[[0,0],[0,2],[2,2],[2,0]]}}],"strip_height":2,)"
      R"("solution":{"strip_width":4,"layout":{"placed_items":[)"
      R"({"item_id":0,"transformation":{"rotation":0,"translation":["4/3",0]}}]}}})";
  EXPECT_EQ(parse_layouts(text, "l.json").error().code, ErrorCode::wrong_orientation);
  LayoutReadOptions options;
  options.repair = true;
  const Layout layout = parse_layouts(text, "l.json", options)->at(0);
  EXPECT_EQ(layout.notes.size(), 1u);
  EXPECT_EQ(layout.parts[0].at.x, *Rational::of(4, 3));
  EXPECT_TRUE(check_layout(layout)->valid());
  options.container = "none";
  EXPECT_EQ(parse_layouts(text, "l.json", options).error().code, ErrorCode::unsupported_operand);
}

TEST(LayoutFiles, OurOwnJsonComesBackExactly) {
  const Region ring =
      Region::create({{{{{-1, -1}, {4, -1}, {4, 4}, {-1, 4}}, {{{0, 0}, {0, 3}, {3, 3}, {3, 0}}}}}, {}, {}}).value();
  const Region pieces =
      Region::create(
          {{{{{0, 0}, {1, 0}, {0, 1}}, {}}, {{{5, 5}, {6, 5}, {5, 6}}, {}}}, {{{7, 7}, {8, 8}}}, {{0.1, 0.2}}})
          .value();
  Layout layout;
  layout.shapes = {ring, shapes::rectangle(0, 0, 1, 1), pieces};
  layout.parts = {{"a \"ring\"", 0, Orientation::of(1, 3).value(), {Rational::of(1, 3).value(), Rational(0)}},
                  {"", 1, Orientation::half_turn(), {Rational::of(0.1).value(), Rational(-7)}},
                  {"again", 1, Orientation::of(-12345, 99991).value(), {Rational(2), Rational::of(-5, 7).value()}},
                  {"2", 2, {}, {}}};
  const auto compare = [&] {
    const std::vector<Layout> all = parse_layouts(layout_to_json(layout), "ours").value();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].shapes, layout.shapes);
    EXPECT_EQ(all[0].container, layout.container);
    ASSERT_EQ(all[0].parts.size(), layout.parts.size());
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
      EXPECT_EQ(all[0].parts[k].name, layout.parts[k].name);
      EXPECT_EQ(all[0].parts[k].shape, layout.parts[k].shape);
      EXPECT_EQ(all[0].parts[k].orientation, layout.parts[k].orientation);
      EXPECT_EQ(all[0].parts[k].at, layout.parts[k].at);
    }
    EXPECT_EQ(layout_to_json(all[0]), layout_to_json(layout));
  };
  compare();
  layout.container = ring;
  compare();
  layout.parts.clear();
  compare();
  layout = {};
  compare();
}

TEST(LayoutFiles, TangentsThatAreNoneAreErrors) {
  for (const char* tangent : {"1", "\"1/0\"", "\"x\"", "null"}) {
    const std::string text =
        R"({"items":[{"shape":{"type":"simple_polygon","data":[[0,0],[2,0],[2,2]]}}],"solution":{"layout":{"placed_items":[)"
        R"({"item_id":0,"transformation":{"tan_half":)" +
        std::string(tangent) + R"(,"translation":[0,0]}}]}}})";
    EXPECT_EQ(parse_layouts(text, "ours").error().code, ErrorCode::malformed) << tangent;
  }
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
