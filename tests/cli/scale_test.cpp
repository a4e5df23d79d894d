// The verbs scale and scale-range: keys, exit codes, files.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class ScaleCli : public CliTest {
 protected:
  ScaleCli() {
    work.write("plate.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 3 2, 3 1, 1 1))\n");
    work.write("peg.wkt", "POLYGON ((-1 -0.5, 0 -0.5, 0 0, -1 0, -1 -0.5))\n");
    work.write("part.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1, -1 -1))\n");
    work.write("wall.wkt", "POLYGON ((5 -10, 6 -10, 6 10, 5 10, 5 -10))\n");
  }
};

TEST_F(ScaleCli, ScalePrintsEveryKeyOfTheContract) {
  const Json report = json("dymsum scale plate.wkt peg.wkt --scaled q --at 1,3/2,2,2.5 --events --json");
  for (const char* key : {"inputs", "tier", "time_ms", "frames", "static_ms", "update_ms", "events"})
    EXPECT_TRUE(report.contains(key)) << key;
  ASSERT_EQ(report["frames"].size(), 4u);
  for (const char* key : {"s", "outer", "holes", "vertices", "area_exact", "update_ms"})
    EXPECT_TRUE(report["frames"][0].contains(key)) << key;
  EXPECT_EQ(report["frames"][1]["s"], "3/2");
  EXPECT_EQ(report["frames"][1]["holes"], 1);
  EXPECT_EQ(report["frames"][2]["holes"], 0);
  EXPECT_EQ(report["frames"][2]["tight"]["points"], 1);
  EXPECT_EQ(report["frames"][3]["tight"]["points"], 0);
  bool found = false;
  for (const Json& e : report["events"]) found |= e["s"] == "2/1" && e["topology"] == true;
  EXPECT_TRUE(found);
}

TEST_F(ScaleCli, ThreadsChangeNoFrame) {
  const auto frames = [&](const std::string& command) {
    Json list = json(command)["frames"];
    for (Json& frame : list) frame.erase("update_ms");
    return list;
  };
  for (const std::string command : {"dymsum scale plate.wkt peg.wkt --sweep 1:1.3:0.5% --exact --json",
                                    "dymsum rotate plate.wkt peg.wkt --steps 300 --exact --json"}) {
    const Json one = frames(command);
    EXPECT_GT(one.size(), 50u);
    EXPECT_EQ(frames(command + " --threads 2"), one) << command;
  }
}

TEST_F(ScaleCli, SweepsAreExactAndPicturesAreWritten) {
  const Json report = json("dymsum scale plate.wkt peg.wkt --scaled q --sweep 1:2:1/3 -o strip.svg --json");
  ASSERT_EQ(report["frames"].size(), 4u);
  EXPECT_EQ(report["frames"][2]["s"], "5/3");
  EXPECT_EQ(report["frames"][3]["s"], "2/1");
  EXPECT_NE(work.read("strip.svg").find("<svg"), std::string::npos);
}

TEST_F(ScaleCli, AnAnimationShowsEveryFrameInItsTurnAndTheFirstOneWithoutAnimation) {
  ASSERT_EQ(work.run("dymsum scale plate.wkt peg.wkt --scaled q --at 1,3/2,2,2.5 -o x.anim.svg").code, 0);
  const std::string svg = work.read("x.anim.svg");
  const auto count = [&](const std::string& what) { return CliTest::count("x.anim.svg", what); };
  EXPECT_EQ(count("class=\"frame\""), 4u);
  EXPECT_EQ(count("class=\"frame\" visibility=\"visible\""), 1u);
  EXPECT_LT(svg.find("visibility=\"visible\""), svg.find("visibility=\"hidden\""));
  EXPECT_EQ(count("<animate attributeName=\"visibility\""), 4u);
  EXPECT_EQ(count("values=\"visible;hidden\" keyTimes=\"0;0.25\""), 1u);
  EXPECT_EQ(count("values=\"hidden;visible;hidden\" keyTimes=\"0;0.25;0.5\""), 1u);
  EXPECT_EQ(count("values=\"hidden;visible\" keyTimes=\"0;0.75\""), 1u);
  EXPECT_EQ(count("<script"), 0u);
  EXPECT_EQ(count("<circle"), 1u) << "the tight point at s = 2";
  // One frame has nothing to animate.
  ASSERT_EQ(work.run("dymsum scale plate.wkt peg.wkt --at 1 -o one.anim.svg").code, 0);
  EXPECT_EQ(work.read("one.anim.svg").find("<animate"), std::string::npos);
}

TEST_F(ScaleCli, CopiesOfAMasterShapeEqualTheirOwnSums) {
  work.write("copies.txt", "# scale x y\n2 0 0\n\n3/2 10 -0.5 # the second\n2 20 1e1\n");
  const Json report = json("dymsum scale plate.wkt peg.wkt --copies copies.txt --robot --json -o copies.svg");
  for (const char* key : {"inputs", "tier", "time_ms", "copies", "static_ms", "update_ms", "robot"})
    EXPECT_TRUE(report.contains(key)) << key;
  ASSERT_EQ(report["copies"].size(), 3u);
  EXPECT_EQ(report["copies"][1]["s"], "3/2");
  EXPECT_EQ(report["copies"][1]["at"], Json::array({10, -0.5}));
  EXPECT_EQ(report["copies"][2]["at"], Json::array({20, 10}));
  // The plate at these scales, and the no-fit polygon by the verb for it.
  work.write("plate2.wkt", "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 2 4, 6 4, 6 2, 2 2))\n");
  work.write("plate15.wkt", "POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0), (1.5 1.5, 1.5 3, 4.5 3, 4.5 1.5, 1.5 1.5))\n");
  for (const auto& [k, file] : {std::pair{0, "plate2.wkt"}, std::pair{1, "plate15.wkt"}, std::pair{2, "plate2.wkt"}}) {
    const Json own = json(std::string("dymsum nfp ") + file + " peg.wkt --json");
    for (const char* key : {"outer", "holes", "vertices", "area_exact"})
      EXPECT_EQ(report["copies"][k][key], own[key]) << k << " " << key;
  }
  const std::string svg = work.read("copies.svg");
  for (const char* what : {"obstacles", "reference point", "#e8a33d", "#9ecae1"})
    EXPECT_NE(svg.find(what), std::string::npos) << what;
  // Without --robot the operand is summed as it is.
  EXPECT_EQ(json("dymsum scale plate.wkt peg.wkt --copies copies.txt --json")["copies"][0]["area_exact"],
            json("dymsum sum plate2.wkt peg.wkt --json")["area_exact"]);
}

TEST_F(ScaleCli, BadFilesOfCopiesAreRefusedWithTheirLine) {
  const auto refused = [&](const std::string& text, const std::string& where) {
    work.write("bad.txt", text);
    const Outcome outcome = work.run("dymsum scale plate.wkt peg.wkt --copies bad.txt");
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_EQ(outcome.err.find(where), 0u) << outcome.err;
  };
  refused("1 0 0\n2 0\n", "bad.txt:2: a copy is a line");
  refused("1 0 0 0\n", "bad.txt:1: a copy is a line");
  refused("1 0 x\n", "bad.txt:1: a copy is a line");
  refused("1 0 inf\n", "bad.txt:1: a copy is a line");
  refused("\n# none\n1 0 0\n0 1 1\n", "bad.txt:4: a scale of zero");
  refused("one 0 0\n", "bad.txt:1: not a scale");
  refused("# none\n", "bad.txt: the file lists no copies");
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt --copies nowhere.txt").code, 2);
  work.write("good.txt", "1 0 0\n");
  for (const char* more : {"--at 1", "--sweep 1:2:1", "--events", "--scaled q", "-o x.html"})
    EXPECT_EQ(work.run(std::string("dymsum scale plate.wkt peg.wkt --copies good.txt ") + more).code, 1) << more;
}

TEST_F(ScaleCli, StepsAreToldAsSteps) {
  const auto told = [&](const char* step) {
    return work.run(std::string("dymsum scale plate.wkt peg.wkt --sweep=1:2:") + step);
  };
  EXPECT_EQ(told("0").code, 1);
  EXPECT_NE(told("0").err.find("a step of zero"), std::string::npos);
  EXPECT_NE(told("0%").err.find("a step of zero"), std::string::npos);
  EXPECT_NE(told("-1").err.find("a step has to be positive"), std::string::npos);
  EXPECT_NE(work.run("dymsum scale plate.wkt peg.wkt --sweep=0:2:1").err.find("a scale of zero"), std::string::npos);
}

TEST_F(ScaleCli, WholeNumbersArePlainInTextAndFractionsInJson) {
  const std::string text = work.run("dymsum scale-range part.wkt wall.wkt --path \"0,0 2,0\"").out;
  EXPECT_NE(text.find("(0, 3]"), std::string::npos) << text;
  EXPECT_EQ(text.find("/1"), std::string::npos) << text;
  EXPECT_NE(work.run("dymsum scale plate.wkt peg.wkt --at 2").out.find("at s = 2:"), std::string::npos);
}

TEST_F(ScaleCli, AFitAnywhereNamesWhatHoldsThePart) {
  work.write("room.wkt", "POLYGON ((0 0, 7 0, 7 3, 0 3, 0 0))\n");
  const Json free = json("dymsum scale-range peg.wkt room.wkt --inside --json")["free"];
  ASSERT_EQ(free.size(), 1u);
  EXPECT_EQ(free[0]["high"], "6/1");
  ASSERT_EQ(free[0]["at_high"].size(), 4u);
  EXPECT_EQ(free[0]["at_high"][0]["kind"], "vertex_on_edge");
  const std::string text = work.run("dymsum scale-range peg.wkt room.wkt --inside").out;
  EXPECT_NE(text.find("above: vertex 0 of the part on edge 0, part at (6, 3)"), std::string::npos) << text;
  work.write("nothing.wkt", "POLYGON EMPTY\n");
  EXPECT_NE(work.run("dymsum scale-range nothing.wkt room.wkt --inside").err.find("the part is empty"),
            std::string::npos);
}

TEST_F(ScaleCli, AxesMayScaleByDifferentFactors) {
  const auto frames = [&](const std::string& options) {
    Json list = json("dymsum scale plate.wkt peg.wkt --scaled q --exact --json " + options)["frames"];
    for (Json& frame : list) frame.erase("update_ms");
    return list;
  };
  const Json swept = frames("--sweep 1:2:1/4 --ratio 2/3");
  ASSERT_EQ(swept.size(), 5u);
  EXPECT_EQ(swept[2]["s"], Json::array({"3/2", "1/1"}));
  EXPECT_EQ(swept[2]["pose"], "s = 3/2:1");
  EXPECT_EQ(frames("--at 1:2/3,5/4:5/6,3/2:1,7/4:7/6,2:4/3"), swept);
  EXPECT_EQ(frames("--at 1,5/4,3/2,7/4,2 --ratio 2/3 --mode rebuild"), swept);
  // The peg is 1.5 wide and 0.5 high there.
  work.write("peg15.wkt", "POLYGON ((-1.5 -0.5, 0 -0.5, 0 0, -1.5 0, -1.5 -0.5))\n");
  EXPECT_EQ(swept[2]["area_exact"], json("dymsum sum plate.wkt peg15.wkt --json")["area_exact"]);
  EXPECT_EQ(frames("--at 3/2 --ratio 1")[0]["s"], "3/2");
  ASSERT_EQ(work.run("dymsum scale plate.wkt peg.wkt --sweep 1:2:1/4 --ratio 2 -o strip.svg").code, 0);
  for (const char* wrong : {"--at 1:2:3", "--at 1:2 --ratio 2", "--at 1 --ratio 0", "--at 1 --ratio x",
                            "--at 1e10 --ratio 1e10", "--at 1:2 --events", "--sweep 1:2:1 --ratio 2 --events"})
    EXPECT_EQ(work.run(std::string("dymsum scale plate.wkt peg.wkt ") + wrong).code, 1) << wrong;
}

// A sum that is where it was asked to be makes no frame: it says nothing of what one from scratch takes.
TEST_F(ScaleCli, FramesFromScratchAreTimedWhereverTheyAreAndHoweverOften) {
  for (const char* motion : {"scale plate.wkt peg.wkt --at 1", "scale plate.wkt peg.wkt --sweep 1:2:1/4 --repeat 5",
                             "rotate plate.wkt peg.wkt --steps 1", "rotate plate.wkt peg.wkt --steps 8 --repeat 5"})
    EXPECT_GT(json(std::string("dymsum ") + motion + " --json")["static_ms"], 0) << motion;
}

TEST_F(ScaleCli, BadScalesAndUsageHaveTheirExitCodes) {
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt").code, 1);
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt --sweep 1:2").code, 1);
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt --at 1 -o sum.wkt").code, 1);
  for (const char* s : {"0", "-1", "nan", "1e30", "1e-30", "x"}) {
    const Outcome outcome = work.run(std::string("dymsum scale plate.wkt peg.wkt --at=") + s);
    EXPECT_EQ(outcome.code, 1) << s;
    EXPECT_NE(outcome.err, "") << s;
  }
}

TEST_F(ScaleCli, ScaleRangeNamesWhatBlocks) {
  const Json report = json("dymsum scale-range part.wkt wall.wkt --path \"0,0 2,0\" --json");
  ASSERT_EQ(report["free"].size(), 1u);
  EXPECT_TRUE(report["free"][0]["low"].is_null());
  EXPECT_EQ(report["free"][0]["high"], "3/1");
  EXPECT_EQ(report["trap"], "3/1");
  ASSERT_FALSE(report["free"][0]["at_high"].empty());
  EXPECT_EQ(report["free"][0]["at_high"][0]["kind"], "vertex_on_edge");
  EXPECT_EQ(json("dymsum scale-range part.wkt wall.wkt --path \"0,0 9,0\" --json", 4)["free"].size(), 0u);
  EXPECT_EQ(json("dymsum scale-range peg.wkt plate.wkt --inside --json")["free"].size(), 1u);
  EXPECT_EQ(work.run("dymsum scale-range part.wkt wall.wkt").code, 1);
  EXPECT_EQ(work.run("dymsum scale-range part.wkt wall.wkt --path nowhere.wkt").code, 2);
}

}  // namespace
}  // namespace dymsum::cli_test
