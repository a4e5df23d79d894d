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
      {"slice cube.off wedge.off --z 0.5 --reflect", {"solids", {{"z", "0.5"}, {"reflect", true}}}},
      {"depth cube.off wedge.off --move 0.5,0,0", {"solids", {{"move", "0.5,0,0"}}}},
      {"depth peg.wkt slot.wkt", {"sum", Json::object()}},
      {"features slot.wkt --alpha 1/2 --tau 1/10", {"discs", {{"alpha", "1/2"}, {"tau", "1/10"}}}},
      {"decompose slot.wkt --tau 1/10", {"discs", {{"tau", "1/10"}}}}};
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
    EXPECT_GE(data["inputs"].size(), verb == "features" || verb == "decompose" ? 1U : 2U) << command;
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

TEST_F(ViewerPage, WithoutAViewerOwnPagesAreWrittenOrTheCommandSaysWhatIsMissing) {
  for (const char* own :
       {"scale peg.wkt slot.wkt --sweep 1:2:1", "rotate cube.off wedge.off --steps 2", "features slot.wkt"}) {
    EXPECT_EQ(work.run("rm -f x.html; dymsum " + std::string(own) + " -o x.html").code, 0) << own;
    EXPECT_EQ(work.read("x.html").find("dymsum-data"), std::string::npos) << own;
  }
  for (const char* none :
       {"sum peg.wkt slot.wkt", "cspace peg.wkt slot.wkt", "depth peg.wkt slot.wkt", "decompose slot.wkt"}) {
    const Outcome outcome = work.run("rm -f x.html; dymsum " + std::string(none) + " -o x.html");
    EXPECT_EQ(outcome.code, 2) << none;
    EXPECT_NE(outcome.err.find("`./run web` builds it"), std::string::npos) << none << outcome.err;
    EXPECT_EQ(outcome.out, "") << none;
    EXPECT_FALSE(work.exists("x.html")) << none;
  }
}

TEST_F(ViewerPage, WhatTheViewerDoesNotShowIsRefused) {
  const auto wrong = [&](const std::string& command, const std::string& named) {
    refused("DYMSUM_VIEWER=viewer.html dymsum " + command + " -o x.html", named);
    EXPECT_FALSE(work.exists("x.html")) << command;
  };
  work.write("copies.txt", "1 0 0\n3/2 9 0\n");
  wrong("sum cube.off cube.off cube.off", "the viewer shows no sum of more than two operands");
  wrong("erode slot.wkt peg.wkt", "x.html");
  wrong("scale slot.wkt peg.wkt --copies copies.txt", "the viewer shows no scale of regions");
  refused("DYMSUM_VIEWER=viewer.html dymsum depth cube.off cube.off -o rows.csv", "-o without --track writes .html");
}

}  // namespace
}  // namespace dymsum::cli_test
