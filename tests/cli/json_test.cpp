// Every verb's --json follows docs/guide/report.schema.json, which knows every key, and docs/guide/json.md speaks of
// each.
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli_fixture.h"
#include "json_schema.h"

namespace dymsum::cli_test {
namespace {

const std::filesystem::path kGuide = std::filesystem::path(DYMSUM_SOURCE_DIR) / "docs/guide";

/// A command, its exit code and the definition that its report follows.
struct Case {
  std::string name, command;
  int code = 0;
};

const std::vector<Case> kCases = {
    {"planar_sum", "sum frame.wkt square.wkt --repeat 2"},
    {"planar_sum", "sum frame.wkt square.wkt --engine winding --semantics open"},
    {"planar_sum", "nfp slot.wkt peg.wkt"},
    {"planar_sum", "erode square.wkt peg.wkt", 4},
    {"planar_sum", "sum frame.wkt square.wkt peg.wkt"},
    {"robustness", "robustness square.wkt peg.wkt --at 9,1/3"},
    {"robustness", "robustness square.wkt peg.wkt", 4},
    {"robustness", "robustness [[0,0],[9,0],[9,9],[0,9]] peg.wkt --fit"},
    {"robustness", "robustness square.wkt peg.wkt --fit", 4},
    {"stack", "stack [[0,0],[9,0],[9,9],[0,9]] peg.wkt --tolerance 0.125,+0.1/0"},
    {"stack", "stack square.wkt peg.wkt", 4},
    {"uncertain_sum", "sum frame.wkt square.wkt --tolerance +0.1/-0.2,0"},
    {"uncertain_sum", "nfp frame.wkt square.wkt --variants peg.wkt --first-variants slot.wkt"},
    {"uncertain_sum", "erode slot.wkt peg.wkt --fuzz 1"},
    {"uncertain_sum", "erode square.wkt peg.wkt --fuzz 0,1", 4},
    {"uncertain_contains", "contains frame.wkt square.wkt --at 2,2 --at 1/3,2 --tolerance 0.25"},
    {"uncertain_contains", "contains frame.wkt square.wkt --at 99,2 --variants peg.wkt", 4},
    {"uncertain_depth", "depth frame.wkt square.wkt --tolerance 0.25,0"},
    {"uncertain_depth", "depth frame.wkt square.wkt --move 9,9 --variants peg.wkt", 4},
    {"uncertain_depth", "depth frame.wkt square.wkt --move 9,9 --tolerance 0,0/-0.6", 4},
    {"planar_sum", "opening slot.wkt square.wkt"},
    {"planar_sum", "closing slot.wkt square.wkt"},
    {"planar_boolean", "union slot.wkt peg.wkt square.wkt"},
    {"planar_boolean", "intersect slot.wkt slot.wkt"},
    {"planar_boolean", "subtract peg.wkt peg.wkt", 4},
    {"solid_sum", "union cube.off cube.off"},
    {"planar_sum", "erode slot.wkt square.wkt -o out.wkt"},
    {"planar_sum", "slice peg.wkt slot.wkt --tan-half inf"},
    {"planar_sum", "slice peg.wkt slot.wkt --degrees 30 --error 1e-3"},
    {"solid_sum", "sum cube.off cube.off"},
    {"solid_sum", "nfp cube.off cube.off --engine brute"},
    {"solid_sum", "nfp ell.off cube.off"},
    {"solid_sum", "erode ell.off cube.off"},
    {"solid_sum", "erode cube.off ell.off", 4},
    {"solid_sum", "opening ell.off small.off"},
    {"solid_sum", "opening ell.off ell.off"},
    {"solid_sum", "closing ell.off cube.off"},
    {"solid_sum", "offset ell.off --by -0.25"},
    {"solid_slice", "slice ell.off cube.off --z 0.5"},
    {"solid_slice", "slice ell.off cube.off --z 9 --exact"},
    {"scale", "scale frame.wkt square.wkt --sweep 1:2:1/3 --events"},
    {"scale", "scale frame.wkt square.wkt --at 1,2 --robot --scaled q --semantics open"},
    {"scale_copies", "scale frame.wkt square.wkt --copies copies.txt --robot"},
    {"family", "family frame.wkt square.wkt --scale 1/2:2 --at 1,3/2 --changes --lifetimes --exact"},
    {"family", "family slot.wkt peg.wkt --scale 1/2:2 --ratio 2 --robot --scaled q --outer 1:2 --inner 1:3/2"},
    {"solid_scale", "scale cube.off cube.off --at 1,1:2:3"},
    {"solid_rotate", "rotate cube.off cube.off --steps 3 --axis 1,2,3"},
    {"solid_rotate", "rotate ell.off cube.off --steps 3 --axis 1,2,3"},
    {"solid_turn_events", "rotate cube.off cube.off --events --range 30deg:95deg"},
    {"solid_turn_events", "rotate cube.off cube.off --next-topology --range 30deg:40deg --axis 1,2,3", 4},
    {"solid_scale", "scale ell.off cube.off --at 1,1:2:3"},
    {"rotate", "rotate peg.wkt slot.wkt --steps 4"},
    {"solid_scale", "scale ell.off cube.off --range 1/2:2"},
    {"solid_scale", "scale ell.off cube.off --range 1/2:2 --next topology", 4},
    {"solid_scale_range", "scale-range cube.off ell.off --path '9,9,9 -9,9,9'"},
    {"solid_scale_range", "scale-range cube.off ell.off --inside"},
    {"scale_range", "scale-range square.wkt slot.wkt --path '9,9 6,9'"},
    {"scale_range", "scale-range square.wkt frame.wkt --inside --place 0,0"},
    {"scale_range", "scale-range square.wkt slot.wkt --path 2.25,0.25", 4},
    {"cspace", "cspace peg.wkt slot.wkt"},
    {"cspace", "cspace peg.wkt frame.wkt -o out.glb"},
    {"clearance", "clearance peg.wkt slot.wkt --at 1,6,0 --at 1,1,90deg"},
    {"clearance", "clearance peg.wkt slot.wkt --at 1,6,0 --weight inf"},
    {"angles", "angles peg.wkt slot.wkt --at 1,6 --at 1,2 --at 2,2"},
    {"nfp_table", "nfp-table parts.json --cache answers"},
    {"check", "check layout.json", 4},
    {"check", "check layout.json --margin 1", 4},
    {"check", "check layout.json --faults 0", 4},
    {"check_set", "check-sum peg.wkt slot.wkt frame.wkt --exact", 4},
    {"check_set", "check-nfp square.wkt peg.wkt square.wkt --within 100"},
    {"check_set", "check-fit frame.wkt peg.wkt frame.wkt --semantics closed", 4},
    {"check_solid_offset", "check-offset cube.off ell.off --radius 1/2", 4},
    {"check_solid_set", "check-sum ell.off cube.off cube.off", 4},
    {"check_solid_set", "check-nfp cube.off cube.off cube.off --within 9 --exact"},
    {"check_mesh", "check-mesh cube.off"},
    {"check_mesh", "check-mesh open.off", 4},
    {"check_offset", "check-offset square.wkt frame.wkt --radius 1/2", 4},
    {"check_offset", "check-offset square.wkt square.wkt --radius -0.5 --within 1", 4},
    {"path", "path peg.wkt slot.wkt --from 1,6,0 --to 1,1,0"},
    {"path", "path peg.wkt slot.wkt --from 1,6,0 --to 1,1,0 --strict", 4},
    {"path", "path square.wkt frame.wkt --from 1.5,1.5,0 --to 9,9,0", 4},
    {"path", "path peg.wkt slot.wkt --from 1,6,0 --to 1,9,90deg --margin 0.25"},
    {"paths", "path peg.wkt slot.wkt --from 1,6,0 --to 1,1,0 --to 1,9,90deg"},
    {"checked_path", "path peg.wkt slot.wkt --check-path poses.txt"},
    {"checked_path", "path peg.wkt slot.wkt --strict --check-path poses.txt", 4},
    {"contains", "contains peg.wkt slot.wkt --at 1,1"},
    {"contains", "contains peg.wkt slot.wkt --at 9,9,90deg", 4},
    {"solid_contains", "contains ell.off cube.off --at 1,1,1/3 --at 9,9,9"},
    {"solid_contains", "contains ell.off cube.off --at 9,9,9 --semantics open", 4},
    {"depth", "depth cube.off cube.off --move 0.5,0,0"},
    {"depth", "depth cube.off cube.off --move 9,0,0", 4},
    {"depth", "depth ell.off cube.off --move 1,1,0 --along 1,0,0"},
    {"depth", "depth cube.off cube.off --axis 0,0,1 --degrees 9"},
    {"depth", "depth ell.off cube.off --track motion.csv --smoothing 1"},
    {"depth", "depth peg.wkt slot.wkt --move 9,9", 4},
    {"depth", "depth square.wkt frame.wkt"},
    {"local_sum", "local-sum ell.off cube.off --ball 6,6,4,0.5"},
    {"planar_local_sum", "local-sum frame.wkt square.wkt --disc 0,1,0.5"},
    {"planar_local_sum", "local-sum frame.wkt peg.wkt --box 0,0,1,1 --engine brute --degrees 30"},
    {"local_sum", "local-sum ell.off cube.off --box 1,1,1,2,2,2 --engine hierarchy"},
    {"edit", "edit slot.wkt peg.wkt edits.txt --keep-going", 4},
    {"edit_replay", "edit --replay session.json"},
    {"solid_edit", "edit cube.off ell.off solid_edits.txt --keep-going", 4},
    {"solid_edit_replay", "edit --replay solid_session.json"},
    {"info", "info two.wkt"},
    {"info", "info bow.wkt", 2},
    {"solid_info", "info cube.off"},
    {"solid_info", "info open.off", 2},
    {"solid_info", "info solid_sum.json"},
    {"info", "info sum.json"},
    {"disc", "disc slot.wkt --radius 1/3 --events"},
    {"disc", "disc slot.wkt --radius 100 --set erosion", 4},
    {"features", "features slot.wkt --alpha 1/2 --exact"},
    {"features", "features frame.wkt --tau 1 --concavity hybrid1"},
    {"decompose", "decompose frame.wkt"},
    {"convert", "convert frame.wkt out.geojson"},
    {"solid_convert", "convert cube.off out.obj"},
    {"solid_convert", "hull cube.off out.off"},
    {"failure", "sum bow.wkt square.wkt", 2},
    {"failure", "sum cube.off open.off", 2},
    {"failure", "info cut.off", 2},
    {"failure", "sum square.wkt absent.wkt", 2},
    {"failure", "scale square.wkt square.wkt --at 0", 1},
    {"failure", "rotate square.wkt square.wkt", 1},
    {"failure", "glue", 1},
};

class JsonReports : public CliTest {
 protected:
  JsonReports() : schema(Json::parse(read_text(kGuide / "report.schema.json"))) {
    work.write("square.wkt", kSquare);
    work.write("peg.wkt", kPeg);
    work.write("slot.wkt", kSlot);
    work.write("frame.wkt", kFrame);
    work.write("two.wkt", "POINT (1 2)\nPOLYGON ((0 0, 1 0, 0 1, 0 0))\n");
    work.write("bow.wkt", kBow);
    work.write(
        "parts.json",
        R"({"items":[{"allowed_orientations":[0,9],"shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]}}]})");
    work.write(
        "layout.json",
        R"({"items":[{"id":0,"shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1],[0,2]]}}],"strip_height":9,)"
        R"("solution":{"strip_width":3,"layout":{"placed_items":)"
        R"([{"item_id":0,"transformation":{"rotation":0,"translation":[0,0]}},)"
        R"({"item_id":0,"transformation":{"rotation":90,"translation":["7/2","1"]}}]}}})");
    std::filesystem::create_directories(work.folder() / "work" / "answers");
    work.write("answers/damaged.nfpt", "not one of ours");
    work.write("poses.txt", "1,6,0\n1,1,0\n");
    work.write("motion.csv", "1,1,0\n2,1,0\n");
    work.write("copies.txt", "1 0 0\n3/2 9 0\n");
    work.write("cube.off", kCube);
    work.write("small.off",
               "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 0 3 2 1\n4 4 5 6 7\n"
               "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
    work.write(
        "ell.off",
        "OFF\n12 8 0\n0 0 0\n6 0 0\n6 3 0\n3 3 0\n3 6 0\n0 6 0\n0 0 4\n6 0 4\n6 3 4\n3 3 4\n3 6 4\n0 6 4\n"
        "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n");
    work.write("open.off", kOpen);
    work.write("cut.off", "OFF\n8 6 12\n0 0 0\n");
    work.write("edits.txt", "q move 0 0.125 0\n{\np remove 0\np move 0 -9 4\n}\nundo\nundo\nundo\n");
    work.write("solid_edits.txt", "p extrude 0 by 0 0 -0.5\np move 0 9 9 9\nundo\nredo\n");
    work.run("dymsum edit cube.off ell.off solid_edits.txt --keep-going --record solid_session.json");
    work.run("dymsum sum square.wkt peg.wkt -o sum.json");
    work.run("dymsum edit square.wkt peg.wkt edits.txt --keep-going --record session.json");
    work.run("dymsum sum ell.off cube.off -o solid_sum.json");
  }
  Json schema;
};

TEST_F(JsonReports, FollowTheSchema) {
  std::set<std::string> verbs, names, known;
  std::istringstream told(work.run("dymsum ?").err);
  for (std::string line; std::getline(told, line);) {
    std::istringstream words(line.starts_with("The verbs are ") ? line.substr(14) : "");
    for (std::string verb; words >> verb;) known.insert(verb);
  }
  known.erase("view");  // serves until it is stopped, and reports nothing
  for (const Case& c : kCases) {
    if (c.name != "failure" && !known.contains(c.command.substr(0, c.command.find(' ')))) continue;
    const Outcome outcome = work.run("dymsum " + c.command + " --json");
    ASSERT_EQ(outcome.code, c.code) << c.command << "\n" << outcome.err;
    const Json report = Json::parse(outcome.out);
    for (const std::string& wrong : violations(schema, c.name, report)) ADD_FAILURE() << c.command << ": " << wrong;
    const std::string verb = c.command.substr(0, c.command.find(' '));
    EXPECT_EQ(report["verb"], verb);
    verbs.insert(verb);
    names.insert(c.name);
  }
  for (const Json& each : schema["oneOf"])
    EXPECT_TRUE(names.contains(each["$ref"].get<std::string>().substr(8))) << each;
  EXPECT_GE(known.size(), 14u);
  for (const std::string& verb : known) EXPECT_TRUE(verbs.contains(verb)) << verb << " has no case";
}

TEST_F(JsonReports, TheValidatorFindsWhatIsWrong) {
  Json report = Json::parse(work.run("dymsum sum square.wkt square.wkt --json").out);
  EXPECT_TRUE(violations(schema, "planar_sum", report).empty());
  EXPECT_FALSE(violations(schema, "solid_sum", report).empty());
  for (const auto& [key, value] : report.items()) {
    Json less = report, other = report, more = report;
    less.erase(key);
    EXPECT_EQ(violations(schema, "planar_sum", less).size(), 1u) << key;
    other[key] = Json::array({false});
    EXPECT_FALSE(violations(schema, "planar_sum", other).empty()) << key;
    more[key + "s"] = value;
    EXPECT_EQ(violations(schema, "planar_sum", more).size(), 1u) << key;
  }
  report["time_ms"]["stages"]["a"] = -1;
  EXPECT_EQ(violations(schema, "planar_sum", report), std::vector<std::string>{"/time_ms/stages/a: is too small"});
}

void collect_keys(const Json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties"))
    for (const auto& [key, rule] : schema["properties"].items()) keys.insert(key);
  for (const auto& inner : schema)
    if (inner.is_structured()) collect_keys(inner, keys);
}

TEST_F(JsonReports, TheGuideSpeaksOfEveryKey) {
  const std::string guide = read_text(kGuide / "json.md");
  std::set<std::string> keys;
  collect_keys(schema["$defs"], keys);
  EXPECT_GT(keys.size(), 80u);
  for (const std::string& key : keys) EXPECT_NE(guide.find("`" + key + "`"), std::string::npos) << key;
}

}  // namespace
}  // namespace dymsum::cli_test
