// -o FILE.html: the viewer with the inputs and options of a command inside.
#include <map>

#include "cli_fixture.h"
#include "served.h"

namespace dymsum::cli_test {
namespace {

class ViewerPage : public CliTest {
 protected:
  ViewerPage() {
    work.write("viewer.html", kViewer);
    work.write("slot.wkt", kSlot);
    work.write("peg.wkt", kPeg);
    work.write("bow.wkt", kBow);
    work.write("small.wkt", "POLYGON ((0 0, 0.5 0, 0.5 0.25, 0 0.25, 0 0))\n");
    work.write("twice.wkt", "POLYGON ((0 0, 0 0, 2 0, 2 1, 0 0))\n");
    work.write("cube.off", kCube);
    work.write("wedge.off", kTetrahedron);
  }
  Outcome run(const std::string& command) const { return work.run("export DYMSUM_VIEWER=viewer.html; " + command); }
  /// What the page of a command is told.
  Json told(const std::string& command, int code = 0) const {
    const Outcome outcome = run(command + " -o x.html");
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return work.exists("x.html") ? data_of(work.read("x.html")) : Json();
  }
};

struct Told {
  std::string page;
  Json parameters;
  std::size_t inputs = 2;
};

TEST_F(ViewerPage, EveryVerbTellsItsPageInputsAndOptions) {
  const std::map<std::string, Told> commands = {
      {"sum peg.wkt slot.wkt --semantics open --repeat 2 --json", {"sum", {{"semantics", "open"}}}},
      {"sum cube.off wedge.off", {"solids", Json::object()}},
      {"nfp slot.wkt peg.wkt", {"nesting", Json::object()}},
      {"scale peg.wkt slot.wkt --sweep 1:2:50% --robot", {"sum", {{"sweep", "1:2:50%"}, {"robot", true}}}},
      {"scale peg.wkt slot.wkt --at 1,3/2 --at 2", {"sum", {{"at", {"1,3/2", "2"}}}}},
      {"scale cube.off wedge.off --sweep 1:2:1", {"solids", {{"sweep", "1:2:1"}}}},
      {"rotate peg.wkt slot.wkt --steps 4", {"sum", {{"steps", "4"}}}},
      {"rotate cube.off wedge.off --steps 2 --axis 1,2,3", {"solids", {{"steps", "2"}, {"axis", "1,2,3"}}}},
      {"cspace peg.wkt slot.wkt", {"obstacle", Json::object()}},
      {"slice peg.wkt slot.wkt --tan-half 1/3", {"obstacle", {{"tan-half", "1/3"}}}},
      {"slice peg.wkt slot.wkt --degrees 30 --error 0.01", {"obstacle", {{"tan-half", "3/11"}}}},
      {"slice cube.off wedge.off --z 0.5 --reflect", {"solids", {{"z", "0.5"}, {"reflect", true}}}},
      {"depth cube.off wedge.off --move 0.5,0,0", {"solids", {{"move", "0.5,0,0"}}}},
      {"depth peg.wkt slot.wkt", {"sum", Json::object()}},
      {"erode slot.wkt small.wkt --semantics open", {"sum", {{"semantics", "open"}}}},
      {"erode cube.off wedge.off", {"solids", Json::object()}},
      {"scale peg.wkt slot.wkt --range 1:2", {"sum", {{"range", "1:2"}}}},
      {"rotate cube.off wedge.off --steps 2 --events --frame 1",
       {"solids", {{"steps", "2"}, {"events", true}, {"frame", "1"}}}},
      {"local-sum peg.wkt slot.wkt --disc 0,3,1", {"sum", {{"disc", "0,3,1"}}}},
      {"local-sum cube.off wedge.off --ball 0,0,0,1", {"solids", {{"ball", "0,0,0,1"}}}},
      {"path peg.wkt slot.wkt --from 1,6,0 --to 3,8,90deg --strict",
       {"obstacle", {{"from", "1,6,0"}, {"to", "3,8,90deg"}, {"strict", true}}}},
      {"features slot.wkt --alpha 1/2 --tau 1/10", {"discs", {{"alpha", "1/2"}, {"tau", "1/10"}}, 1}},
      {"decompose slot.wkt --tau 1/10", {"discs", {{"tau", "1/10"}}, 1}},
      {"disc slot.wkt --radius 3/2 --set closing", {"discs", {{"radius", "3/2"}, {"set", "closing"}}, 1}},
      {"info peg.wkt", {"sum", Json::object(), 1}},
      {"info cube.off", {"solids", Json::object(), 1}}};
  for (const auto& [command, expected] : commands) {
    const Json data = told("dymsum " + command);
    Json parameters = expected.parameters;
    const std::string verb = command.substr(0, command.find(' '));
    parameters["verb"] = verb;
    EXPECT_EQ(data["page"], expected.page) << command;
    EXPECT_EQ(data["parameters"], parameters) << command;
    EXPECT_EQ(data["live"], false) << command;
    EXPECT_EQ(data["format"], 1) << command;
    std::istringstream words(command.substr(verb.size()));
    for (const Json& input : data["inputs"]) {
      std::string operand;
      words >> operand;
      EXPECT_EQ(input, Json({{"name", operand}, {"text", work.read(operand)}})) << command;
    }
    EXPECT_EQ(data["inputs"].size(), expected.inputs) << command;
  }
}

TEST_F(ViewerPage, OtherOutputsAreWrittenBesides) {
  const Json data = told("dymsum sum peg.wkt slot.wkt -o sum.wkt -o y.html -o sum.svg");
  EXPECT_EQ(data["page"], "sum");
  EXPECT_EQ(work.read("x.html"), work.read("y.html"));
  EXPECT_TRUE(work.exists("sum.wkt") && work.exists("sum.svg"));
}

TEST_F(ViewerPage, AnAnswerOfNoIsShown) {
  work.write("far.wkt", "POLYGON ((9 9, 10 9, 10 10, 9 9))\n");
  EXPECT_EQ(told("dymsum depth peg.wkt far.wkt", 4)["page"], "sum");
  EXPECT_EQ(told("dymsum erode peg.wkt slot.wkt", 4)["page"], "sum");
  EXPECT_EQ(told("dymsum disc slot.wkt --set erosion --radius 9", 4)["page"], "discs");
  EXPECT_EQ(told("dymsum path peg.wkt slot.wkt --from 1,2,0 --to 3,8,0 --strict", 4)["page"], "obstacle");
}

// What a verb makes is shown as it is written to a file: .off of solids, .wkt of regions.
TEST_F(ViewerPage, VerbsOfOneShapeShowTheirResult) {
  const std::map<std::string, std::string> results = {{"offset cube.off --by 0.5 -o", "offset of cube.off"},
                                                      {"opening cube.off wedge.off -o", "opening of cube.off"},
                                                      {"closing cube.off wedge.off -o", "closing of cube.off"},
                                                      {"hull points.off", "hull of points.off"},
                                                      {"convert cube.off", "cube.off"},
                                                      {"convert cube.off --triangulate", "cube.off"},
                                                      {"convert twice.wkt --repair --canonical", "twice.wkt"}};
  work.write("points.off", "OFF\n5 0 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 1\n");
  for (const auto& [command, name] : results) {
    const std::string file = name.ends_with(".off") ? "made.off" : "made.wkt";
    ASSERT_EQ(run("dymsum " + command + " " + file).code, 0) << command;
    ASSERT_EQ(run("dymsum " + command + " x.html").code, 0) << command;
    const Json data = data_of(work.read("x.html"));
    EXPECT_EQ(data["page"], name.ends_with(".off") ? "solids" : "sum") << command;
    EXPECT_EQ(data["inputs"], Json::array({{{"name", name}, {"text", work.read(file)}}})) << command;
    EXPECT_EQ(data["parameters"]["verb"], command.substr(0, command.find(' '))) << command;
  }
}

TEST_F(ViewerPage, NothingIsShownOfNothing) {
  const Outcome opening = run("dymsum opening wedge.off cube.off -o x.html");
  EXPECT_EQ(opening.code, 4);
  EXPECT_EQ(opening.err, "x.html: nothing is left to show, and no page is written\n");
  EXPECT_EQ(run("dymsum offset cube.off --by -2 -o x.html -o left.json").code, 4);
  EXPECT_TRUE(work.exists("left.json"));
  work.write("empty.wkt", "POLYGON EMPTY\n");
  const Outcome empty = run("dymsum convert empty.wkt x.html");
  EXPECT_EQ(empty.code, 2);
  EXPECT_EQ(empty.err, "x.html: this has no area or volume that the viewer could show\n");
  EXPECT_FALSE(work.exists("x.html"));
}

// The page plans with what the command planned with, and finds the same path.
TEST_F(ViewerPage, APathIsShownOfTheRobotAndObstacleThatWereComputedWith) {
  ASSERT_EQ(run("dymsum cspace peg.wkt slot.wkt -o room.obstacle").code, 0);
  const Json read = told("dymsum path --obstacle room.obstacle --from 1,6,0 --to 3,8,0");
  EXPECT_EQ(read["parameters"], Json({{"verb", "path"}, {"from", "1,6,0"}, {"to", "3,8,0"}}));
  EXPECT_EQ(
      read["inputs"],
      Json::array({{{"name", "room robot.wkt"}, {"text", "POLYGON ((0 0,2 0,2 1,0 1,0 0))\n"}},
                   {{"name", "room obstacle.wkt"}, {"text", "POLYGON ((0 0,4 0,4 4,3 4,3 1,1 1,1 4,0 4,0 0))\n"}}}));
  const Json kept = told("dymsum path peg.wkt slot.wkt --from 1,6,0 --to 3,8,0 --margin 0.25");
  EXPECT_EQ(kept["parameters"], read["parameters"]);
  EXPECT_EQ(kept["inputs"][0]["name"], "peg with margin.wkt");
  EXPECT_EQ(kept["inputs"][1]["text"], kSlot);
  work.write("grown.wkt", kept["inputs"][0]["text"].get<std::string>());
  EXPECT_NEAR(json("dymsum info grown.wkt --json")["shapes"][0]["bounds"][0].get<double>(), -0.25, 1e-9);
}

// It is bad input that is reported, by info too, whose answer it is.
TEST_F(ViewerPage, AFileThatIsNotValidOrHoldsSeveralShapesIsNotShown) {
  EXPECT_TRUE(told("dymsum info bow.wkt", 2).is_null());
  work.write("two.json", R"({"items":[{"id":7,"shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1]]}},
                                      {"id":8,"shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]}}]})");
  EXPECT_TRUE(told("dymsum info two.json", 1).is_null());
  EXPECT_EQ(told("dymsum info two.json#8")["inputs"][0]["name"], "two 8.wkt");
}

TEST_F(ViewerPage, AFailedCommandWritesNone) {
  EXPECT_TRUE(told("dymsum sum peg.wkt bow.wkt", 2).is_null());
  EXPECT_TRUE(told("dymsum sum peg.wkt absent.wkt", 2).is_null());
  EXPECT_FALSE(told("dymsum sum peg.wkt twice.wkt --repair").is_null());
}

TEST_F(ViewerPage, InputsFromElsewhereHaveNamesToo) {
  EXPECT_EQ(told("dymsum sum - peg.wkt < slot.wkt")["inputs"][0], Json({{"name", "input.wkt"}, {"text", kSlot}}));
  EXPECT_EQ(told("dymsum sum - cube.off < cube.off")["inputs"][0], Json({{"name", "input.off"}, {"text", kCube}}));
  EXPECT_EQ(told("dymsum cspace '[[0,0],[1,0],[0,1]]' slot.wkt")["inputs"][0],
            Json({{"name", "footprint.json"}, {"text", "[[0,0],[1,0],[0,1]]"}}));
  EXPECT_EQ(work.run("mkdir folder").code, 0);
  const std::string two = R"({"items":[{"id":7,"shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1]]}},
                                      {"id":8,"shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]}}]})";
  work.write("folder/two.json", two);
  EXPECT_EQ(told("dymsum sum 'folder/two.json#8' peg.wkt")["inputs"][0],
            Json({{"name", "two 8.wkt"}, {"text", "POLYGON ((0 0,1 0,0 1,0 0))\n"}}));
}

TEST_F(ViewerPage, WhatIsRepairedIsGivenAsItWasTaken) {
  const Outcome outcome = run("dymsum sum twice.wkt peg.wkt --repair -o x.html");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, work.run("dymsum sum twice.wkt peg.wkt --repair").err) << "told once";
  const Json data = data_of(work.read("x.html"));
  EXPECT_EQ(data["parameters"], Json({{"verb", "sum"}}));
  EXPECT_EQ(data["inputs"][0]["name"], "twice.wkt");
  work.write("mended.wkt", data["inputs"][0]["text"].get<std::string>());
  EXPECT_EQ(work.run("dymsum convert twice.wkt mended2.wkt --repair && cmp mended.wkt mended2.wkt").code, 0);
  work.write("points.off", "OFF\n5 0 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 1 1\n");
  const Json solid = told("dymsum sum points.off cube.off --hull")["inputs"][0];
  EXPECT_EQ(solid["name"], "points.off");
  work.write("hull.off", solid["text"].get<std::string>());
  EXPECT_EQ(json("dymsum info hull.off --json")["vertices"], 4);
}

// A map lies in two files; the page is given the region they hold.
TEST_F(ViewerPage, AMapIsGivenAsARegion) {
  work.write("room.pgm", "P2\n2 1\n255\n0 254\n");
  work.write("room.yaml",
             "image: room.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
             "free_thresh: 0.196\n");
  const Json input = told("dymsum sum room.yaml peg.wkt")["inputs"][0];
  EXPECT_EQ(input["name"], "room.wkt");
  work.write("room.wkt", input["text"].get<std::string>());
  EXPECT_EQ(work.run("dymsum convert room.yaml room2.wkt && cmp room.wkt room2.wkt").code, 0);
}

TEST_F(ViewerPage, WithoutAViewerTheCommandSaysWhatIsMissingAndWritesNothing) {
  for (const char* command :
       {"sum peg.wkt slot.wkt -o", "scale peg.wkt slot.wkt --sweep 1:2:1 -o", "rotate cube.off wedge.off --steps 2 -o",
        "cspace peg.wkt slot.wkt -o", "depth peg.wkt slot.wkt -o", "features slot.wkt -o", "decompose slot.wkt -o",
        "disc slot.wkt --radius 1 -o", "path peg.wkt slot.wkt --from 1,6,0 --to 3,8,0 -o", "info cube.off -o",
        "offset cube.off --by 1 -o left.off -o", "opening cube.off wedge.off -o left.off -o", "convert peg.wkt",
        "convert cube.off", "hull cube.off", "local-sum peg.wkt slot.wkt --box 0,0,1,1 -o left.json -o"}) {
    const Outcome outcome = work.run("dymsum " + std::string(command) + " x.html");
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_NE(outcome.err.find("`./run web` builds it"), std::string::npos) << command << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
    for (const char* file : {"x.html", "left.off", "left.json"}) EXPECT_FALSE(work.exists(file)) << command;
  }
}

TEST_F(ViewerPage, WhatTheViewerDoesNotShowIsRefused) {
  const auto wrong = [&](const std::string& command, const std::string& named) {
    refused("DYMSUM_VIEWER=viewer.html dymsum " + command + " -o x.html", named);
    EXPECT_FALSE(work.exists("x.html")) << command;
  };
  work.write("copies.txt", "1 0 0\n3/2 9 0\n");
  wrong("sum cube.off cube.off cube.off", "the viewer shows no sum of more than two operands");
  wrong("scale slot.wkt peg.wkt --copies copies.txt", "-o with --copies writes .svg");
  wrong("path peg.wkt slot.wkt --from 1,6,0 --to 3,8,0 --to 1,9,0", "shows one path: give one --to");
  wrong("path peg.wkt slot.wkt --check-path poses.txt", "-o does not apply to --check-path");
  wrong("depth cube.off cube.off --track poses.txt", "-o writes depth along a motion as .csv, .svg or .json: x.html");
  wrong("nfp-table parts.json", "the viewer shows no table: nfp shows a pair of items");
  for (const std::string answers : {"scale-range peg.wkt slot.wkt --path 9,9", "contains peg.wkt slot.wkt --at 1,1",
                                    "clearance peg.wkt slot.wkt --at 1,9,0", "angles peg.wkt slot.wkt --at 1,9"})
    wrong(answers, "has no option -o: it prints its answer, and writes neither files nor pages");
  refused("DYMSUM_VIEWER=viewer.html dymsum depth cube.off cube.off -o rows.csv", "-o without --track writes .html");
}

}  // namespace
}  // namespace dymsum::cli_test
