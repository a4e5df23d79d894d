// Pictures and the JSON of sums, from sums built by hand.
#include <algorithm>
#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "dymsum/shapes.h"
#include "io/picture/picture.h"
#include "io/reading.h"
#include "oracles/snapped_shapes.h"
#include "planar/position/exact_source.h"

namespace dymsum::io_test {
namespace {

/// Positions are what the vertices say, so that a sum can be built by hand.
class RoundedPositions : public ExactSource {
 public:
  Position position(const SumVertex& v) const override { return {v.at.x, v.at.y}; }
};

SumVertex vertex(double x, double y) {
  SumVertex v;
  v.at = {x, y};
  v.in = {Contact::Kind::edge_of_p, 1, 2};
  v.out = {Contact::Kind::edge_of_q, 3, 4};
  return v;
}

/// A square with a square hole, a segment and a point beside it, and tight features.
PlanarSum hand_made_sum() {
  PlanarSum sum;
  exact_source(sum) = std::make_shared<RoundedPositions>();
  SumPart part;
  part.outer.vertices = {vertex(0, 0), vertex(10, 0), vertex(10, 10), vertex(0, 10)};
  part.outer.vertices[0].corner_p = 7;
  part.outer.vertices[0].corner_q = 8;
  part.holes.push_back({{vertex(4, 4), vertex(4, 6.5), vertex(6, 6), vertex(6, 4)}});
  sum.parts.push_back(part);
  sum.segments.push_back({vertex(12, 0), vertex(14, 0)});
  sum.points.push_back(vertex(12, 5));
  sum.tight_segments.push_back({vertex(1, 1), vertex(3, 3)});
  sum.tight_points = {vertex(2, 8), vertex(8, 2)};
  return sum;
}

PlanarTrace hand_made_trace() {
  PlanarTrace trace;
  trace.convolution = {{{0, 0}, {10, 0}, true}, {{10, 0}, {10, 10}, false}, {{10, 10}, {0, 0}, false}};
  trace.masked_cells = {{{4, 4}, {6, 5}}};
  trace.crossings = {{5, 5}};
  trace.kept_loops = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  trace.dropped_loops = {{{1, 1}, {2, 1}, {1, 2}}};
  return trace;
}

pugi::xml_document parse(const std::string& svg) {
  pugi::xml_document document;
  const auto result = document.load_string(svg.c_str());
  EXPECT_TRUE(result) << result.description();
  EXPECT_STREQ(document.document_element().name(), "svg");
  return document;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Pictures, a_region_is_drawn_inside_its_canvas_with_y_up) {
  const std::string svg = draw_region(shapes::rectangle(100, 1000, 200, 1050));
  const auto document = parse(svg);
  const auto root = document.document_element();
  const auto group = root.child("g");
  double a = 0, d = 0, e = 0, f = 0;
  ASSERT_EQ(std::sscanf(group.attribute("transform").value(), "matrix(%lf 0 0 %lf %lf %lf)", &a, &d, &e, &f), 4);
  EXPECT_GT(a, 0);
  EXPECT_EQ(d, -a);
  const double left = a * 100 + e, right = a * 200 + e, bottom = d * 1000 + f, top = d * 1050 + f;
  EXPECT_LT(top, bottom);
  EXPECT_GE(std::min(left, top), 0);
  EXPECT_LE(right, root.attribute("width").as_double());
  EXPECT_LE(bottom, root.attribute("height").as_double());
  EXPECT_NE(svg.find("evenodd"), std::string::npos);
  EXPECT_NE(svg.find("4 vertices"), std::string::npos);
}

TEST(Pictures, empty_and_flat_regions_have_pictures) {
  for (const RegionData& data : {RegionData{}, RegionData{{}, {}, {{1, 2}}}, RegionData{{}, {{{0, 0}, {0, 5}}}, {}},
                                 RegionData{{}, {{{-1e308, 0}, {1e308, 0}}}, {}}}) {
    const auto region = Region::create(data);
    ASSERT_TRUE(region.ok());
    const std::string svg = draw_region(*region);
    parse(svg);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(read_one(svg, RegionFormat::svg), data);
    PlanarSum sum;
    parse(draw_sum(*region, *region, sum));
    parse(draw_trace(*region, *region, sum));
  }
}

TEST(Pictures, the_picture_of_a_sum_reads_back_as_the_rounded_sum) {
  const PlanarSum sum = hand_made_sum();
  const std::string svg = draw_sum(shapes::grate(3, 2, 0.5, 5), snapped_shapes::disc(12, 1), sum);
  parse(svg);
  const RegionData data = read_one(svg, RegionFormat::svg);
  EXPECT_EQ(data, io::rounded_data(sum));
  EXPECT_EQ(data.parts.at(0).holes.size(), 1u);
  EXPECT_EQ(data.polylines, (std::vector<Polyline>{{{12, 0}, {14, 0}}}));
  EXPECT_EQ(data.points, (std::vector<Point>{{12, 5}}));
}

TEST(Pictures, tight_features_are_drawn_and_counted) {
  const std::string red(io::palette::kTight);
  PlanarSum sum = hand_made_sum();
  const Region p = shapes::rectangle(0, 0, 1, 1);
  const std::string with = draw_sum(p, p, sum);
  EXPECT_NE(with.find("1 tight segment, 2 tight points"), std::string::npos);
  EXPECT_EQ(occurrences(with, "stroke=\"" + red + "\""), 3u);  // lines, dots, legend
  sum.tight_segments.clear();
  sum.tight_points.clear();
  EXPECT_EQ(occurrences(draw_sum(p, p, sum), red), 0u);
}

TEST(Pictures, a_trace_has_a_panel_for_every_stage) {
  PlanarSum sum = hand_made_sum();
  const Region p = shapes::rectangle(0, 0, 1, 1);
  EXPECT_EQ(occurrences(draw_trace(p, p, sum), "font-weight=\"600\""), 2u);
  sum.trace = hand_made_trace();
  const std::string svg = draw_trace(p, p, sum);
  const auto document = parse(svg);
  EXPECT_EQ(occurrences(svg, "font-weight=\"600\""), 6u);
  for (const char* words : {"3 segments: 1 edges of P (amber), 2 edges of Q (green)", "1 run of cells",
                            "1 crossing between", "1 kept (blue), 1 dropped (grey)"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
}

TEST(Pictures, a_trace_of_sixteen_thousand_segments_stays_small) {
  PlanarSum sum;
  sum.trace.emplace();
  for (int k = 0; k < 16000; ++k) {
    const double t = k * 0.7853981634;
    sum.trace->convolution.push_back({{t - k, k / 3.0}, {t - k + 1.23456, k / 3.0 + 2.34567}, k % 2 == 0});
  }
  const Region p = shapes::rectangle(0, 0, 1, 1);
  const std::string svg = draw_trace(p, p, sum);
  parse(svg);
  EXPECT_LT(svg.size(), 16000u * 30);
}

TEST(SumJson, holds_positions_and_provenance) {
  const auto json = nlohmann::json::parse(sum_to_json(hand_made_sum()));
  ASSERT_EQ(json["parts"].size(), 1u);
  const auto& outer = json["parts"][0]["outer"]["vertices"];
  ASSERT_EQ(outer.size(), 4u);
  EXPECT_EQ(outer[0]["corner"], nlohmann::json::array({7, 8}));
  EXPECT_TRUE(outer[1]["corner"].is_null());
  EXPECT_EQ(outer[1]["x"], 10.0);
  EXPECT_EQ(outer[1]["x_exact"], "10/1");
  EXPECT_EQ(outer[1]["in"], (nlohmann::json{{"edge_of", "P"}, {"p", 1}, {"q", 2}}));
  EXPECT_EQ(outer[1]["out"], (nlohmann::json{{"edge_of", "Q"}, {"p", 3}, {"q", 4}}));
  const auto& hole = json["parts"][0]["holes"][0]["vertices"];
  EXPECT_EQ(hole[1]["y"], 6.5);
  EXPECT_EQ(hole[1]["y_exact"], "13/2");
  EXPECT_EQ(json["segments"][0]["to"]["x"], 14.0);
  EXPECT_EQ(json["points"][0]["y"], 5.0);
  EXPECT_EQ(json["tight_segments"].size(), 1u);
  EXPECT_EQ(json["tight_points"].size(), 2u);
}

TEST(SumJson, of_the_empty_sum) {
  const auto json = nlohmann::json::parse(sum_to_json(PlanarSum{}));
  for (const char* key : {"parts", "segments", "points", "tight_segments", "tight_points"})
    EXPECT_TRUE(json.at(key).empty()) << key;
}

}  // namespace
}  // namespace dymsum::io_test
