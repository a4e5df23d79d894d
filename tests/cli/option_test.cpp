// Options mean the same for every verb: angles, sweeps, numbers, and what does not apply is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class OptionCli : public CliTest {
 protected:
  OptionCli() {
    work.write("peg.wkt", kPeg);
    work.write("slot.wkt", kSlot);
    work.write("cube.off", kCube);
  }
  Json json(const std::string& command) const { return CliTest::json(command + " --json"); }
};

TEST_F(OptionCli, AnglesAreRadiansOrDegreesForEveryVerb) {
  for (const char* angle : {"--tan-half 1", "--angle 1.5707963267948966", "--angle 90deg", "--degrees 90",
                            "--degrees -270", "--angle 3690deg"})
    EXPECT_EQ(json(std::string("dymsum slice peg.wkt slot.wkt ") + angle)["orientation"]["tan_half"], "1/1") << angle;
  for (const char* angle : {"--degrees 90", "--angle 90deg", "--angle 1.5707963267948966"}) {
    const Json frames = json(std::string("dymsum rotate peg.wkt slot.wkt --steps 1 ") + angle)["frames"];
    EXPECT_EQ(frames.back()["tan_half"], "1/1") << angle;
    EXPECT_EQ(json(std::string("dymsum rotate cube.off cube.off --steps 1 ") + angle)["frames"].back()["volume_exact"],
              "64/1");
    EXPECT_EQ(json(std::string("dymsum depth cube.off cube.off --move 1.5,0.25,0 --axis 0,0,1 ") + angle)["depth"], 0.5)
        << angle;
  }
  const Json radians = json("dymsum clearance peg.wkt slot.wkt --at 1,6,1.5707963267948966"),
             degrees = json("dymsum clearance peg.wkt slot.wkt --at 1,6,90deg");
  EXPECT_EQ(radians["answers"], degrees["answers"]);
  EXPECT_EQ(json("dymsum path peg.wkt slot.wkt --from 1,6,90deg --to 1,9,450deg")["waypoints"][0]["tan_half"], "1/1");
}

TEST_F(OptionCli, SweepsAndTurnsEndAtTheirEnd) {
  const Json even = json("dymsum scale peg.wkt slot.wkt --sweep 1:1.5:0.01")["frames"];
  ASSERT_EQ(even.size(), 51u);
  EXPECT_EQ(even.back()["s"], "3/2");
  const Json odd = json("dymsum scale peg.wkt slot.wkt --sweep 1:1.5:0.2")["frames"];
  ASSERT_EQ(odd.size(), 4u);
  EXPECT_EQ(odd[2]["s"], "7/5");
  EXPECT_EQ(odd[3]["s"], "3/2");
  EXPECT_EQ(json("dymsum scale peg.wkt slot.wkt --sweep 1:2:10%")["frames"].back()["s"], "2/1");
  const Json down = json("dymsum scale cube.off cube.off --sweep 2:1/2:30%")["frames"];
  EXPECT_EQ(down.back()["volume_exact"], "27/1");
  const Json quarter = json("dymsum rotate peg.wkt slot.wkt --steps 3 --degrees 90")["frames"];
  ASSERT_EQ(quarter.size(), 4u);
  EXPECT_EQ(quarter.back()["tan_half"], "1/1");
  EXPECT_EQ(json("dymsum rotate peg.wkt slot.wkt --steps 3")["frames"].size(), 3u)
      << "the end of a whole turn is its beginning";
  EXPECT_EQ(json("dymsum rotate cube.off cube.off --steps 3 --degrees -720")["frames"].size(), 3u);
}

TEST_F(OptionCli, WhatIsNoNumberIsWrongUsage) {
  for (const char* sweep :
       {"1", "1:2", "1:2:3:4", "a:2:1", "1:nan:1", "1:2:0", "1:2:-1", "1:2:x%", "0:1:1", "1:inf:1", "1:2:1e-18%"}) {
    refused(std::string("dymsum scale peg.wkt slot.wkt --sweep=") + sweep, "--sweep");
    refused(std::string("dymsum scale cube.off cube.off --sweep=") + sweep, "--sweep");
  }
  for (const char* at : {"0", "-1", "nan", "1,x", "1e30"}) {
    refused(std::string("dymsum scale peg.wkt slot.wkt --at=") + at, "--at");
    refused(std::string("dymsum scale cube.off cube.off --at=") + at, "--at");
  }
  for (const char* at : {"1:2", "1:2:0", "1:2:3:4"})
    refused(std::string("dymsum scale cube.off cube.off --at=") + at, "--at");
  for (const char* path : {"nan,0", "0,0 1", "0,0 1,", "0,0 1,2,3", "0,0x", "1e999,0"})
    refused(std::string("dymsum scale-range peg.wkt slot.wkt --path '") + path + "'", "--path wants x,y");
  for (const char* position : {"0", "nan,0", "1,2,3", "1,2 3,4"})
    refused(std::string("dymsum scale-range peg.wkt slot.wkt --inside --place '") + position + "'",
            "--place wants x,y");
  for (const char* q : {"0,0", "0,0,0,0", "nan,0,0", "0,0,90degrees", "0,0,deg", "0,,0", "0,0,inf"}) {
    refused(std::string("dymsum clearance peg.wkt slot.wkt --at=") + q, "--at wants x,y,theta");
    refused(std::string("dymsum path peg.wkt slot.wkt --to 0,0,0 --from=") + q, "--from wants x,y,theta");
  }
  for (const char* verb : {"slice peg.wkt slot.wkt", "rotate peg.wkt slot.wkt --steps 2",
                           "rotate cube.off cube.off --steps 2", "depth cube.off cube.off --axis 0,0,1"}) {
    for (const char* angle : {"--angle nan", "--angle 1rad", "--degrees 90deg", "--degrees x", "--angle 1 --degrees 1"})
      refused(std::string("dymsum ") + verb + " " + angle, angle[2] == 'a' ? "--angle" : "--degrees");
  }
  refused("dymsum rotate cube.off cube.off --steps 2 --axis 0,0,0", "--axis");
  refused("dymsum depth cube.off cube.off --axis 0,0,0 --degrees 9", "--axis");
  refused("dymsum depth cube.off cube.off --move 1,2", "--move");
}

TEST_F(OptionCli, WhatDoesNotApplyIsRefused) {
  for (const auto& [command, option] : std::vector<std::pair<std::string, std::string>>{
           {"sum peg.wkt slot.wkt --thin", "--thin"},
           {"nfp cube.off cube.off --round-repair", "--round-repair"},
           {"scale cube.off cube.off --at 1 --semantics open", "--semantics"},
           {"scale cube.off cube.off --at 1 --mode window", "--mode"},
           {"scale cube.off cube.off --at 1:2:1 --events", "--events"},
           {"rotate cube.off cube.off --steps 2 --semantics closed", "--semantics"},
           {"rotate cube.off cube.off --steps 2 --error 1e-3", "--error"},
           {"rotate peg.wkt slot.wkt --steps 2 --axis 0,0,1", "--axis"},
           {"sum peg.wkt slot.wkt --to poly", "--to"},
           {"slice peg.wkt slot.wkt --tan-half 1 --error 1", "--error"},
           {"convert peg.wkt x.poly --to poly", "--to"},
           {"sum peg.wkt slot.wkt --from wkt", "--from"},
           {"info peg.wkt --from wkt", "--from"},
           {"convert peg.wkt x.poly --from wkt", "--from"},
           {"scale peg.wkt slot.wkt --at 1 --from wkt", "--from"},
           {"cspace peg.wkt slot.wkt --slices 4", "--slices"},
           {"cspace peg.wkt slot.wkt --tolerance 0.5 -o x.svg", "--tolerance"},
           {"clearance cube.off cube.off --at 0,0,0", "planar"},
           {"path cube.off cube.off --from 0,0,0 --to 1,0,0", "planar"}})
    refused("dymsum " + command, option);
  EXPECT_EQ(work.file_count(), 3u) << "and nothing is written";
}

TEST_F(OptionCli, HelpNamesTheOperandsAndTheirOrder) {
  const std::string nfp = work.run("dymsum nfp --help").out, slice = work.run("dymsum slice --help").out;
  EXPECT_NE(nfp.find("FIXED MOVING"), std::string::npos) << nfp;
  EXPECT_NE(nfp.find("The shape that stays comes first"), std::string::npos) << nfp;
  EXPECT_NE(slice.find("ROBOT OBSTACLE"), std::string::npos) << slice;
  EXPECT_NE(slice.find("The robot comes first"), std::string::npos) << slice;
  EXPECT_EQ(work.run("dymsum nfp slot.wkt").err,
            "dymsum: MOVING is required\nUsage: dymsum nfp FIXED MOVING [options]; dymsum nfp --help says more\n");
  EXPECT_EQ(json("dymsum nfp slot.wkt peg.wkt")["area_exact"],
            json("dymsum slice peg.wkt slot.wkt --tan-half 0")["area_exact"]);
}

}  // namespace
}  // namespace dymsum::cli_test
