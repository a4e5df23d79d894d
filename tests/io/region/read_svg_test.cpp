#include "io/reading.h"

namespace dymsum::io_test {
namespace {

std::string svg(const std::string& body) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + body + "\n</svg>\n";
}

RegionData read(const std::string& body) { return read_one(svg(body), RegionFormat::svg); }

Evidence refused_svg(const std::string& body, ErrorCode code, std::int64_t line, std::string_view words) {
  return expect_refused(svg(body), RegionFormat::svg, code, line, words);
}

Ring ring_of(const std::string& body) {
  const RegionData data = read(body);
  return data.parts.size() == 1 && data.parts[0].holes.empty() ? data.parts[0].outer : Ring{};
}

TEST(ReadSvg, path_commands_absolute_and_relative) {
  const Ring square{{1, 2}, {5, 2}, {5, 6}, {1, 6}};
  EXPECT_EQ(ring_of("<path d='M1 2 L5 2 L5 6 L1 6 Z'/>"), square);
  EXPECT_EQ(ring_of("<path d='m1,2 4,0 0,4 -4,0z'/>"), square);
  EXPECT_EQ(ring_of("<path d='M1 2H5V6H1Z'/>"), square);
  EXPECT_EQ(ring_of("<path d='M1 2h4v4h-4V2z'/>"), square);
  EXPECT_EQ(ring_of("<path d='M1 2 5 2 5 6\n1 6 1 2Z'/>"), square);
  EXPECT_EQ(ring_of("<path d='M1 2 C1 2 5 2 5 2 Q5 2 5 6 A0 3 0 01 1 6Z'/>"), square);
  EXPECT_EQ(ring_of("<path d='M.5.5 1.5-.5e0L1 2z'/>"), (Ring{{.5, .5}, {1.5, -.5}, {1, 2}}));
}

TEST(ReadSvg, a_new_subpath_starts_where_the_last_one_closed) {
  const RegionData data = read("<path d='M1 1 L2 1 L1 2 Z l -5 0 l 0 -5 z m 20 20 l 1 0 l 0 1 z'/>");
  ASSERT_EQ(data.parts.size(), 3u);
  EXPECT_EQ(data.parts[1].outer, (Ring{{1, 1}, {-4, 1}, {-4, -4}}));
  EXPECT_EQ(data.parts[2].outer, (Ring{{21, 21}, {22, 21}, {22, 22}}));
}

TEST(ReadSvg, open_subpaths_polylines_and_lines_are_polylines) {
  const RegionData data =
      read("<path d='M0 0L1 1M2 2'/><polyline points='0,0 1,0 1,1'/><line x1='1' y1='2' x2='3px'/>");
  EXPECT_EQ(data, (RegionData{{}, {{{0, 0}, {1, 1}}, {{0, 0}, {1, 0}, {1, 1}}, {{1, 2}, {3, 0}}}, {}}));
}

TEST(ReadSvg, subpaths_nest_even_odd_whatever_their_orientation) {
  const RegionData data = read(
      "<path fill-rule='evenodd' d='M2 2L2 8L8 8L8 2Z M0 0L0 10L10 10L10 0Z M4 4L6 4L6 6L4 6Z M20 0L21 0L20 1Z M1 "
      "1L1.5 1L1 1.5Z'/>");
  const std::vector<Part> expected = {
      {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}, {{1, 1}, {1, 1.5}, {1.5, 1}}}},
      {{{4, 4}, {6, 4}, {6, 6}, {4, 6}}, {}},
      {{{20, 0}, {21, 0}, {20, 1}}, {}}};
  EXPECT_EQ(data.parts, expected);
}

TEST(ReadSvg, subpaths_enclose_what_their_fill_rule_fills) {
  const std::string same = " d='M0 0H9V9H0Z M2 2H4V4H2Z M6 2V4H8V2Z'/>";  // filled like the outer ring; a hole
  const Ring outer{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, left{{2, 2}, {2, 4}, {4, 4}, {4, 2}},
      right{{6, 2}, {6, 4}, {8, 4}, {8, 2}};
  const std::vector<Part> nonzero{{outer, {right}}}, even_odd{{outer, {left, right}}};
  EXPECT_EQ(read("<path" + same).parts, nonzero);
  EXPECT_EQ(read("<path fill-rule='nonzero'" + same).parts, nonzero);
  EXPECT_EQ(read("<g fill-rule='evenodd'><path fill-rule='nonzero'" + same + "</g>").parts, nonzero);
  EXPECT_EQ(read("<path fill-rule='evenodd'" + same).parts, even_odd);
  EXPECT_EQ(read("<g style='fill-rule:evenodd'><g fill-rule='inherit'><path" + same + "</g></g>").parts, even_odd);
  EXPECT_EQ(read("<path fill-rule='nonzero' style='fill-rule:evenodd'" + same).parts, even_odd);
  EXPECT_EQ(read("<g fill='none'><path" + same + "</g>").parts, even_odd) << "an outline";
  // All of it mirrored.
  EXPECT_EQ(read("<path transform='scale(-1 1)'" + same).parts[0].holes.size(), 1u);
  // A style sheet may say otherwise, where that makes a difference.
  refused_svg("<style>.a{fill-rule: evenodd}</style><path" + same, ErrorCode::malformed, 2, "depends on a style sheet");
  refused_svg("<defs><style>.a{fill : none}</style></defs><path" + same, ErrorCode::malformed, 2,
              "depends on a style sheet");
  EXPECT_EQ(read("<style>.a{fill-rule:evenodd}</style><path d='M0 0H9V9H0Z M6 2V4H8V2Z'/>").parts, nonzero);
  // Rings that cross are not left out, so that validation finds them.
  EXPECT_EQ(read("<path d='M0 0H4V4H0Z M1 1H5V3H1Z'/>").parts.size() +
                read("<path d='M0 0H4V4H0Z M1 1H5V3H1Z'/>").parts[0].holes.size(),
            2u);
}

TEST(ReadSvg, what_shows_a_part_only_is_refused) {
  const std::string rectangle = "<rect width='1' height='1'/>";
  refused_svg("<g clip-path='url(#c)'>" + rectangle + "</g>", ErrorCode::malformed, 2, "clip-path shows a part only");
  refused_svg("<rect width='1' height='1' style='mask: url(#m)'/>", ErrorCode::malformed, 2, "mask shows a part only");
  refused_svg("<defs><style>.a{clip-path:url(#c)}</style></defs>" + rectangle, ErrorCode::malformed, 2, "style sheet");
  refused_svg("<style>.a { mask : url(#c) }</style>" + rectangle, ErrorCode::malformed, 2, "style sheet");
  refused_svg("<style>.a{opacity:0.0}</style>" + rectangle, ErrorCode::malformed, 2, "style sheet");
  const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(ring_of("<style>.mask{opacity:0.5;clip-rule:evenodd}</style><g clip-path='none' mask='none'>" + rectangle +
                    "</g>"),
            square);
}

TEST(ReadSvg, what_is_transparent_is_not_read) {
  const std::string seen = "<rect width='1' height='1' opacity='.5'/>", unseen = "<rect x='5' width='2' height='2'/>";
  const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const std::string zero :
       {"opacity='0'", "opacity='0.0'", "style='opacity: 0%'", "opacity='-1'", "opacity='1' style='opacity:0'"})
    EXPECT_EQ(ring_of(seen + "<g " + zero + "><g>" + unseen + "</g></g>"), square) << zero;
  for (const std::string more : {"opacity='1'", "opacity='nan'", "opacity=''", "opacity='0x'", "fill-opacity='0'"})
    EXPECT_EQ(read(seen + "<g " + more + ">" + unseen + "</g>").parts.size(), 2u) << more;
}

TEST(ReadSvg, shapes_of_different_elements_do_not_nest) {
  const RegionData data = read("<rect x='0' y='0' width='10' height='10'/><polygon points='1,1 2,1 1,2 1,1'/>");
  ASSERT_EQ(data.parts.size(), 2u);
  EXPECT_EQ(data.parts[0].outer, (Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  EXPECT_EQ(data.parts[1].outer, (Ring{{1, 1}, {2, 1}, {1, 2}}));
}

TEST(ReadSvg, transforms_apply_from_the_outside_in) {
  EXPECT_EQ(ring_of("<g transform='translate(10 20)'><g transform='scale(2)'><polygon points='0,0 1,0 0,1'/></g></g>"),
            (Ring{{10, 20}, {12, 20}, {10, 22}}));
  EXPECT_EQ(ring_of("<polygon transform='scale(2, 4), translate(1)' points='0,0 1,0 0,1'/>"),
            (Ring{{2, 0}, {4, 0}, {2, 4}}));
  EXPECT_EQ(ring_of("<polygon transform='matrix(0 1 -1 0 5 6)' points='0,0 1,0 0,1'/>"),
            (Ring{{5, 6}, {5, 7}, {4, 6}}));
  // a reflection: the ring is oriented afterwards
  EXPECT_EQ(ring_of("<polygon transform='scale(1 -1)' points='0,0 1,0 0,1'/>"), (Ring{{0, 0}, {0, -1}, {1, 0}}));
  const RegionData data = read("<g transform='translate(1)'><g/></g><line x2='1'/>");
  EXPECT_EQ(data.polylines, (std::vector<Polyline>{{{0, 0}, {1, 0}}}));
}

TEST(ReadSvg, what_is_not_drawn_is_not_read) {
  EXPECT_EQ(read("<title>M0 0</title><defs><path d='M0 0C1 1 2 2 3 3'/></defs><clipPath><rect width='1' "
                 "height='1'/></clipPath><!-- <rect/> -->"),
            RegionData{});
}

TEST(ReadSvg, marked_files_read_back_without_their_transforms) {
  const RegionData data = read_one(
      "<svg data-dymsum='region'><rect width='9' height='9'/><g transform='matrix(2 0 0 -2 9 9)'>"
      "<path data-dymsum='part' d='M0 0L0 4L4 0ZM1 1L2 1L1 2Z'/><path data-dymsum='polylines' d='M0 0L1 1L0 0M2 2L3 "
      "3'/>"
      "<path data-dymsum='points' d='M5 5h0M6 6h0'/></g><path d='M0 0C1 1 2 2 3 3'/></svg>",
      RegionFormat::svg);
  EXPECT_EQ(data, (RegionData{{{{{0, 0}, {0, 4}, {4, 0}}, {{{1, 1}, {2, 1}, {1, 2}}}}},
                              {{{0, 0}, {1, 1}, {0, 0}}, {{2, 2}, {3, 3}}},
                              {{5, 5}, {6, 6}}}));
}

TEST(ReadSvg, curves_are_refused_by_name) {
  refused_svg("<path d='M0 0\nC1 1 2 2 3 3Z'/>", ErrorCode::malformed, 3, "command C");
  refused_svg("<path d='M0 0q1 1 2 0'/>", ErrorCode::malformed, 2, "command q");
  refused_svg("<path d='M0 0A1 1 0 0 1 2 2'/>", ErrorCode::malformed, 2, "command A");
  refused_svg("<path d='M0 0\n\nS1 1 2 2'/>", ErrorCode::malformed, 4, "command S");
  refused_svg("<path d='M0 0t1 1'/>", ErrorCode::malformed, 2, "command t");
  refused_svg("\n<circle r='3'/>", ErrorCode::malformed, 3, "'circle'");
  refused_svg("<ellipse rx='3' ry='2'/>", ErrorCode::malformed, 2, "'ellipse'");
  refused_svg("<rect width='3' height='3' rx='1'/>", ErrorCode::malformed, 2, "round corners");
  refused_svg("<use href='#a'/>", ErrorCode::malformed, 2, "'use'");
}

TEST(ReadSvg, refuses_what_does_not_follow_the_format) {
  refused_svg("<path d='L0 0'/>", ErrorCode::malformed, 2, "start with a move");
  refused_svg("<path id='d' class = \"a d='\"\n d='M0 0\nL1 x'/>", ErrorCode::malformed, 4, "expected a number at 'x'");
  refused_svg("<path d='M0 0 W 3'/>", ErrorCode::malformed, 2, "'W'");
  refused_svg("<path d='M0 0 L 3'/>", ErrorCode::malformed, 2, "attribute ends");
  refused_svg("<path d='M0 0 A 1 1 0 2 0 1 1'/>", ErrorCode::malformed, 2, "flag");
  refused_svg("<polygon points='1,2 3'/>", ErrorCode::malformed, 2, "attribute ends");
  refused_svg("<rect width='3em' height='3'/>", ErrorCode::malformed, 2, "'width'");
  refused_svg("<g transform='rotate(30)'/>\n<g transform='rotate(30)'><line x2='1'/></g>", ErrorCode::malformed, 3,
              "'rotate'");
  refused_svg("<line transform='scale(1 2 3)' x2='1'/>", ErrorCode::malformed, 2, "3 arguments");
  refused_svg("<line transform='scale 1' x2='1'/>", ErrorCode::malformed, 2, "a transform such as");
  refused_svg("<line transform='scale(1' x2='1'/>", ErrorCode::malformed, 2, "')'");
  expect_refused("<html>\n</html>", RegionFormat::svg, ErrorCode::malformed, 1, "not svg");
  expect_refused("<svg>\n<g>\n</svg>", RegionFormat::svg, ErrorCode::malformed, 3, "XML");
  expect_refused("<svg data-dymsum='trace'/>", RegionFormat::svg, ErrorCode::malformed, 1, "stages");
  expect_refused("<svg data-dymsum='region'>\n<path data-dymsum='part' d='M0 0L1 0'/></svg>", RegionFormat::svg,
                 ErrorCode::malformed, 2, "not closed");
  expect_refused("<svg data-dymsum='region'>\n<path data-dymsum='whole' d='M0 0L1 0'/></svg>", RegionFormat::svg,
                 ErrorCode::malformed, 2, "'whole'");
}

TEST(ReadSvg, coordinates_must_be_finite) {
  refused_svg("<path d='M0 0\nL1e999 0'/>", ErrorCode::not_finite, 3, "1e999");
  refused_svg("<path d='M0 0 L nan 0'/>", ErrorCode::not_finite, 2, "nan");
  refused_svg("<path d='M1e308 0l1e308 0'/>", ErrorCode::not_finite, 2, "double range");
  refused_svg("<line transform='scale(1e10)' x2='1e300'/>", ErrorCode::not_finite, 2, "double range");
}

TEST(ReadSvg, a_file_that_ends_early_is_truncated) {
  expect_refused("<svg>\n<g>\n<path d='M0 0", RegionFormat::svg, ErrorCode::truncated, 3, "XML");
  expect_refused("", RegionFormat::svg, ErrorCode::truncated, 1, "XML");
}

TEST(ReadSvg, deep_nesting_is_refused) {
  std::string body;
  for (int i = 0; i < 100000; ++i) body += "<g>";
  for (int i = 0; i < 100000; ++i) body += "</g>";
  refused_svg(body, ErrorCode::malformed, 2, "nested deeper than 200");
}

TEST(ReadSvg, very_many_rings_around_one_another_are_refused_in_time) {
  std::string path = "<path d='";
  for (int i = 0; i < 60000; ++i) path += "M0 0L9 0L0 9Z";
  refused_svg(path + "'/>", ErrorCode::malformed, 2, "too many rings");
}

TEST(ReadSvg, nested_svg_elements_place_their_content) {
  const std::string square = "<path d='M0 0L10 0L10 10L0 10Z'/></svg>";
  const auto at = [](double x0, double y0, double x1, double y1) {
    return Ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  EXPECT_EQ(ring_of("<svg x='5' y='-2'>" + square), at(5, -2, 15, 8));
  EXPECT_EQ(ring_of("<svg x='5' y='1' width='20' height='20' viewBox='0 0 10 10'>" + square), at(5, 1, 25, 21));
  EXPECT_EQ(ring_of("<svg width='10' height='10' viewBox='-4 2 10 10'>" + square), at(4, -2, 14, 8));
  // The smaller of both scales, in the middle unless it is said otherwise.
  const std::string wide = "<svg width='40' height='20' viewBox='0 0 10 10'";
  EXPECT_EQ(ring_of(wide + ">" + square), at(10, 0, 30, 20));
  EXPECT_EQ(ring_of(wide + " preserveAspectRatio='xMinYMid'>" + square), at(0, 0, 20, 20));
  EXPECT_EQ(ring_of(wide + " preserveAspectRatio='xMaxYMax meet'>" + square), at(20, 0, 40, 20));
  EXPECT_EQ(ring_of(wide + " preserveAspectRatio='none'>" + square), at(0, 0, 40, 20));
  EXPECT_EQ(ring_of("<g transform='scale(2)'><svg x='5'><svg y='1'>" + square + "</svg></g>"), at(10, 2, 30, 22));
  refused_svg("<svg width='9' height='9' viewBox='0 0 10'>" + square, ErrorCode::malformed, 2, "four numbers");
  refused_svg("<svg width='9' height='9' viewBox='0 0 10 0'>" + square, ErrorCode::malformed, 2,
              "positive width and height");
  refused_svg("<svg width='-9' height='9'>" + square, ErrorCode::malformed, 2, "negative width");
  refused_svg("<svg width='9' viewBox='0 0 10 10'>" + square, ErrorCode::malformed, 2, "needs its width and height");
  refused_svg(wide + " preserveAspectRatio='xMidYMid slice'>" + square, ErrorCode::malformed, 2, "cuts off");
}

TEST(ReadSvg, hidden_elements_are_not_read) {
  const std::string seen = "<rect width='1' height='1'/>", hidden = "<rect x='5' width='2' height='2'/>";
  const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(ring_of(seen + "<g display='none'>" + hidden + "</g>"), square);
  EXPECT_EQ(ring_of(seen + "<g style='fill:red; display : none !important'><g>" + hidden + "</g></g>"), square);
  EXPECT_EQ(ring_of(seen + "<g visibility='hidden'>" + hidden + "</g>"), square);
  EXPECT_EQ(ring_of("<g style='visibility:collapse'>" + hidden + "<g visibility='visible'>" + seen + "</g></g>"),
            square);
  EXPECT_EQ(ring_of(seen + "<rect display='none' width='2' height='2'/>"), square);
  // The element's own style comes before the attribute.
  EXPECT_EQ(ring_of("<rect display='none' style='display:inline' width='1' height='1'/>"), square);
  EXPECT_EQ(ring_of("<style>rect { fill: red }</style>" + seen), square);
  refused_svg("<style>.a { display: none }</style>" + seen, ErrorCode::malformed, 2, "style sheet");
  EXPECT_EQ(ring_of(seen + "<g style='DISPLAY:none'>" + hidden + "</g>"), square);
  refused_svg("<g style='/**/display:none'/>" + seen, ErrorCode::malformed, 2, "comments");
  EXPECT_EQ(ring_of(seen + "<svg width='0' height='9'>" + hidden + "</svg>"), square);
}

TEST(ReadSvg, styles_that_place_elements_are_refused) {
  refused_svg("<rect width='1' height='1' style='transform:rotate(45deg)'/>", ErrorCode::malformed, 2,
              "a style sets transform");
  refused_svg("<rect width='1' height='1' style='fill:red;WIDTH:3px'/>", ErrorCode::malformed, 2, "a style sets width");
  refused_svg("<rect width='3' height='3' style='rx:1'/>", ErrorCode::malformed, 2, "a style sets rx");
  refused_svg("<rect width='1' height='1' transform='scale(2)' transform-origin='1 1'/>", ErrorCode::malformed, 2,
              "transform-origin");
  refused_svg("<style>rect{TRANSFORM:scale(3)}</style><rect width='1' height='1'/>", ErrorCode::malformed, 2,
              "style sheet");
}

TEST(ReadSvg, negative_sizes_are_refused) {
  refused_svg("\n<rect width='-2' height='3'/>", ErrorCode::malformed, 3, "'rect' has a negative width");
  refused_svg("<rect width='2' height='-3'/>", ErrorCode::malformed, 2, "'rect' has a negative height");
}

}  // namespace
}  // namespace dymsum::io_test
