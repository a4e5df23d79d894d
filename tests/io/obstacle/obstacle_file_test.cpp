// Obstacles in files: what is read equals what was written, and anything else is refused.
#include "dymsum/obstacle_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "dymsum/obstacle_queries.h"
#include "dymsum/shapes.h"
#include "io/obstacle/obstacle_text.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

Region polygon(Ring outer, std::vector<Ring> holes = {}) {
  RegionData data;
  data.parts.push_back({std::move(outer), std::move(holes)});
  return *Region::create(std::move(data));
}
Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

CspaceObstacle peg_in_slot() {
  const Region slot = polygon({{-3, -2}, {6, -2}, {6, 4}, {3, 4}, {3, 0}, {1, 0}, {1, 4}, {-3, 4}});
  return CspaceObstacle::create(polygon(box(0, 0, 2, 3)), slot).value();
}

// General and convex pairs, tight events, no event at all in a disc-like pair, touching rings, coordinates of all bits.
std::vector<std::pair<Region, Region>> pairs() {
  RegionData touching;
  touching.parts = {{box(0, 0, 1, 1), {}}, {box(1, 1, 3, 2), {}}};
  return {{polygon(box(0, 0, 2, 3)), peg_in_slot().obstacle()},
          {snapped_shapes::star(5, 0.4, 1), shapes::noisy_star(12, 0.5, 1)},
          {shapes::rectangle(0, 0, 0.1, 0.3), snapped_shapes::disc(7, 1.0 / 3)},
          {polygon(box(-1, -1, 1, 1)), polygon(box(-5, -5, 5, 5), {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}})},
          {shapes::letter_l(2, 2, 0.5), *Region::create(touching)}};
}

TEST(ObstacleFile, what_is_read_is_what_was_written) {
  for (const auto& [robot, obstacle] : pairs()) {
    const CspaceObstacle made = CspaceObstacle::create(robot, obstacle).value();
    const std::string text = format_obstacle(made);
    const Result<CspaceObstacle> read = parse_obstacle(text, "memory");
    ASSERT_TRUE(read.ok()) << read.error().to_string();
    EXPECT_TRUE(read->robot() == made.robot() && read->obstacle() == made.obstacle());
    ASSERT_EQ(read->angles().size(), made.angles().size());
    for (std::uint32_t k = 0; k < made.angles().size(); ++k) {
      EXPECT_EQ(read->angles()[k].theta, made.angles()[k].theta);
      EXPECT_EQ(read->angles()[k].low, made.angles()[k].low);
      EXPECT_EQ(read->angles()[k].high, made.angles()[k].high);
      EXPECT_EQ(read->angles()[k].exact.has_value(), made.angles()[k].exact.has_value());
      EXPECT_EQ(read->loops(k), made.loops(k));
      EXPECT_EQ(read->inside(k), made.inside(k));
      for (const auto& loop : made.loops(k))
        for (const std::uint32_t p : loop) EXPECT_EQ(read->free_cell(k, p), made.free_cell(k, p));
    }
    EXPECT_EQ(read->events().size(), made.events().size());
    EXPECT_EQ(read->tight(), made.tight());
    EXPECT_EQ(read->may_have_tight_curves(), made.may_have_tight_curves());
    EXPECT_EQ(read->shells().size(), made.shells().size());
    const ObstacleQueries queried(*read), queries(made);
    for (const Configuration q : {Configuration{0, 0, 0}, {0.25, 1.5, 1}, {-3, 2, -2}, {5, 5, 3}}) {
      EXPECT_EQ(queried.clearance(q, 1).distance, queries.clearance(q, 1).distance);
      const Orientation theta = *Orientation::nearest(q.theta);
      EXPECT_EQ(read->contains(q.x, q.y, theta), made.contains(q.x, q.y, theta));
    }
  }
}

TEST(ObstacleFile, a_file_that_ends_too_early_is_refused) {
  const std::string text = format_obstacle(peg_in_slot());
  for (std::size_t n = 0; n + 2 < text.size(); n += n < 200 ? 1 : 97) {
    const Result<CspaceObstacle> read = parse_obstacle(std::string_view(text).substr(0, n), "cut.obstacle");
    ASSERT_FALSE(read.ok()) << n;
    EXPECT_EQ(read.error().code, ErrorCode::truncated) << n << ": " << read.error().to_string();
    EXPECT_EQ(read.error().evidence.file, "cut.obstacle");
  }
}

// Another digit, letter or sign anywhere.
TEST(ObstacleFile, a_changed_file_is_refused) {
  const std::string text = format_obstacle(peg_in_slot());
  for (std::size_t k = 0; k < text.size(); k += 7) {
    if (text[k] == '\n' || text[k] == ' ') continue;
    std::string changed = text;
    changed[k] = text[k] == '1' ? '2' : '1';
    EXPECT_FALSE(parse_obstacle(changed, "changed").ok()) << k << " " << text.substr(k, 20);
  }
}

// Indices, lists and roots are looked at even where the checksum is that of the changed content.
TEST(ObstacleFile, an_index_that_names_nothing_is_refused) {
  using Json = nlohmann::json;
  const Json file = Json::parse(format_obstacle(peg_in_slot()));
  const auto changed = [&](const char* at, const Json& value) {
    Json other = file;
    other["content"][Json::json_pointer(at)] = value;
    other["checksum"] = io::checksum(other["content"]);
    return parse_obstacle(other.dump(), "f");
  };
  EXPECT_TRUE(changed("/work/15", 1.5).ok());
  const std::vector<std::pair<const char*, Json>> changes = {
      {"/patches/0/1", 8},
      {"/patches/0/2", 4},
      {"/patches/0/0", 2},
      {"/patches/3/13", 99},
      {"/patches/0/11", -1},
      {"/patches/1/12", Patch::kNone},
      {"/patches/0", Json::array()},
      {"/patch_cells", Json::array()},
      {"/patch_cells/0", Json::array()},
      {"/patch_cells/0/1", 1000},
      {"/free_cells/0/0", 500},
      {"/shells/0/3", 77},
      {"/events/0/1", 1000},
      {"/events/0/0", 4},
      {"/events/0/2", "x"},
      {"/angles/0/4/0", "1x"},
      {"/angles/0/4/0", ""},
      {"/angles/0/4", Json::array({"1"})},
      {"/angles/0/1", 2},
      {"/angles/0/0", 2},
      {"/angles/0/5", 9},
      {"/robot", Json::array()},
      {"/robot/0/0/0", nullptr},
      {"/robot", 3},
      {"/touching_cells", Json::array({1})},
      {"/tight", 1},
      {"/tight", Json::array({Json::array({1000, 0, 0, 0, 0, 0})})},
      {"/always_concurrent", 2},
      {"/work", Json::array()},
      {"/work/0", -1}};
  for (const auto& [at, value] : changes) EXPECT_FALSE(changed(at, value).ok()) << at << " " << value;
  Json reversed = file["content"]["angles"];
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_FALSE(changed("/angles", reversed).ok());
  Json less = file;
  less["content"].erase("shells");
  less["checksum"] = io::checksum(less["content"]);
  EXPECT_FALSE(parse_obstacle(less.dump(), "f").ok());
}

TEST(ObstacleFile, other_texts_and_versions_are_refused) {
  for (const char* blank : {"", "\n\n \t\r\n"})
    EXPECT_EQ(parse_obstacle(blank, "f").error().code, ErrorCode::truncated);
  EXPECT_EQ(parse_obstacle("\n\n{\"format\"\n\n", "f").error().code, ErrorCode::truncated);
  EXPECT_EQ(parse_obstacle("\n\n{\"format\" 7}\n\n", "f").error().evidence.line, 3);
  EXPECT_TRUE(parse_obstacle("\n " + format_obstacle(peg_in_slot()) + "\n\n", "f").ok());
  for (const char* text : {"[]", "7", "{}", "null", R"({"format":"dymsum obstacle","version":2,"content":{}})",
                           R"({"format":"dymsum obstacle","version":1,"checksum":"","content":{}})",
                           R"({"format":"something","version":1})", "POLYGON ((0 0, 1 0, 1 1))"}) {
    const Result<CspaceObstacle> read = parse_obstacle(text, "f");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().code, ErrorCode::malformed) << text;
  }
  EXPECT_NE(parse_obstacle(R"({"format":"dymsum obstacle","version":2})", "f").error().message.find("version 2"),
            std::string::npos);
  EXPECT_EQ(read_obstacle("/no/such/file").error().code, ErrorCode::cannot_open);
}

}  // namespace
}  // namespace dymsum
