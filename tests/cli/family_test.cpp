// The verb family: what is made, written and read answers alike, and as scale does.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"

namespace dymsum::cli_test {
namespace {

class FamilyCli : public CliTest {
 protected:
  FamilyCli() {
    work.write("plate.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 3 2, 3 1, 1 1))\n");
    work.write("peg.wkt", "POLYGON ((0 0, 1 0, 1 0.5, 0 0.5, 0 0))\n");
    work.write("turned.wkt", "POLYGON ((0 0, 0.9 0.1, 0.7 1.3, -0.1 0.8, 0 0))\n");
    work.write("gear.wkt", format_region(shapes::gear(9, 3, 4), RegionFormat::wkt));
    work.write("star.wkt", format_region(shapes::star(7, 1, 2), RegionFormat::wkt));
  }
  Json answers(const std::string& command) {
    Json report = json(command + " --exact --json");
    for (const char* key : {"inputs", "time_ms"}) report.erase(key);
    for (Json& sum : report["sums"]) sum.erase("update_ms");
    for (const char* key : {"outer", "inner"})
      if (report[key].is_object()) report[key].erase("ms");
    return report;
  }
  const std::string robot = "dymsum family plate.wkt peg.wkt --robot --scaled q --scale 1/2:4";
};

TEST_F(FamilyCli, AFileAnswersAsTheFamilyThatWasMade) {
  const std::string questions = " --at 1,1.5,2 --at 7/3 --changes topology --lifetimes --outer 1:3/2 --inner 1:3";
  const Json made = answers(robot + questions + " -o x.family -o y.family.gz");
  EXPECT_EQ(made["changes"].size(), 1u);
  EXPECT_EQ(made["changes"][0]["s"], "2/1");
  EXPECT_EQ(made["sums"].size(), 4u);
  EXPECT_EQ(made["sums"][2]["tight"]["points"], 1);
  EXPECT_EQ(made["outer"]["area_exact"], "26/1");
  EXPECT_EQ(made["inner"]["area_exact"], "22/1");
  EXPECT_EQ(answers("dymsum family x.family" + questions), made);
  EXPECT_EQ(answers("dymsum family y.family.gz" + questions), made);
  EXPECT_EQ(answers("dymsum family - " + questions + " < x.family"), made);
  EXPECT_EQ(work.run("dymsum family y.family.gz -o z.family").code, 0);
  EXPECT_EQ(work.read("z.family"), work.read("x.family"));
}

TEST_F(FamilyCli, SumsAndEventsAreThoseOfScale) {
  for (const std::string pair : {"star.wkt gear.wkt", "turned.wkt gear.wkt --scaled q --semantics open"}) {
    Json frames = json("dymsum scale " + pair + " --at 1/2,1,7/5,3 --exact --json")["frames"];
    for (Json& frame : frames) frame.erase("update_ms");
    const Json family = answers("dymsum family " + pair + " --scale 1/2:3 --at 1/2,1,7/5,3 --changes");
    EXPECT_EQ(family["sums"], frames) << pair;
    EXPECT_EQ(family["events"], json("dymsum scale " + pair + " --range 1/2:3 --json")["events"]) << pair;
    EXPECT_GT(family["changes"].size(), 2u) << pair;
    EXPECT_EQ(family["cells"], family["events"].size() + 1);
  }
  const Json tall = answers("dymsum family plate.wkt turned.wkt --scale 1/2:3 --ratio 2/3 --at 3/2")["sums"];
  EXPECT_EQ(tall[0]["area_exact"],
            json("dymsum scale plate.wkt turned.wkt --at 3/2:1 --exact --json")["frames"][0]["area_exact"]);
}

TEST_F(FamilyCli, WritesSumsAndPictures) {
  ASSERT_EQ(work.run(robot + " -o lives.svg -o x.family").code, 0);
  const std::string lives = work.read("lives.svg");
  for (const char* text : {"<title>s = 2, the topology changes</title>", "<title>hole 2: 1/2 to 2</title>", "</svg>"})
    EXPECT_NE(lives.find(text), std::string::npos) << text;
  ASSERT_EQ(work.run("dymsum family x.family --at 3/2 -o sum.wkt -o sum.json -o sum.svg").code, 0);
  EXPECT_EQ(work.run("dymsum family x.family --at 3/2 -o -").out, work.read("sum.wkt"));
  EXPECT_NE(work.read("sum.svg").find("s = 3/2"), std::string::npos);
  EXPECT_EQ(json("dymsum union sum.json sum.wkt --json")["area_exact"], "26/1");
  ASSERT_EQ(work.run("dymsum family x.family --at 1,2 --inner 1:3 -o strip.svg").code, 0);
  EXPECT_NE(work.read("strip.svg").find("all s in [1, 3]"), std::string::npos);
  const std::string text = work.run("dymsum family x.family --lifetimes").out;
  EXPECT_NE(text.find("hole  1/2 to 2  2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("vertex  1/2 to 2  vertex 4 of P + vertex 0 of Q\n"), std::string::npos) << text;
}

TEST_F(FamilyCli, PicturesShowFamiliesOfOneScaleAndOfNothing) {
  work.write("empty.wkt", "POLYGON EMPTY\n");
  for (const char* pair : {"plate.wkt peg.wkt", "empty.wkt peg.wkt"}) {
    const Outcome outcome = work.run(std::string("dymsum family ") + pair + " --scale 1:1 --lifetimes -o one.svg");
    EXPECT_EQ(outcome.code, 0) << pair << ": " << outcome.err;
    EXPECT_EQ(work.read("one.svg").find("nan"), std::string::npos) << pair;
  }
}

TEST_F(FamilyCli, WrongUsageSaysWhatIsWanted) {
  ASSERT_EQ(work.run(robot + " -o x.family").code, 0);
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = work.run("dymsum family " + arguments);
    EXPECT_EQ(outcome.code, 1) << arguments << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << arguments << ": " << outcome.err;
  };
  refused("", "family wants P, Q and --scale A:B, or one file that it wrote: FILE.family");
  refused("plate.wkt", "or one file that it wrote: FILE.family");
  refused("plate.wkt peg.wkt", "family wants --scale A:B");
  refused("plate.wkt peg.wkt --scale 1", "--scale wants A:B, such as 1:3/2, not '1'");
  refused("plate.wkt peg.wkt --scale 2:1", "--scale begins after its end: 2:1");
  refused("x.family peg.wkt", "x.family is a family, which stands alone");
  refused("x.family --scale 1:2", "--scale is for making a family");
  refused("x.family --at 9", "--at: the scale 9/1 is outside of the family's interval, 1/2 to 4/1");
  refused("x.family --inner 1:9", "--inner: the scale 9/1 is outside");
  refused("x.family --changes all", "--changes");
  refused("x.family --at 1,2 -o sum.wkt", "holds one sum");
  refused("x.family -o sum.wkt", "holds one sum");
  refused("x.family -o sum.html", "the viewer shows no family");
  refused("x.family --at 1 --lifetimes -o sum.svg", "would show lifetimes or sums");
  refused("x.family --at 1 --json -o -", "both want standard output");
}

TEST_F(FamilyCli, DamagedFilesAndLittleMemoryAreSaid) {
  ASSERT_EQ(work.run(robot + " -o x.family").code, 0);
  std::string text = work.read("x.family");
  text.replace(text.find("\"4/1\""), 5, "\"5/1\"");
  work.write("bad.family", text);
  const Outcome damaged = work.run("dymsum family bad.family --at 1");
  EXPECT_EQ(damaged.code, 2);
  EXPECT_NE(damaged.err.find("bad.family: not a file of a family that can be read: the checksum differs"),
            std::string::npos)
      << damaged.err;
  EXPECT_EQ(work.run("dymsum family absent.family").code, 2);
  work.write("large.wkt", format_region(shapes::noisy_star(400, 0.6, 3), RegionFormat::wkt));
  const Outcome little = work.run("dymsum family large.wkt large.wkt --scale 1:1.001 --memory 2");
  EXPECT_EQ(little.code, 2);
  EXPECT_NE(little.err.find("memory"), std::string::npos) << little.err;
}

}  // namespace
}  // namespace dymsum::cli_test
