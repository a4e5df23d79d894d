// The verb clearance: known distances of a square beside a wall, keys, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class ClearanceCli : public CliTest {
 protected:
  ClearanceCli() {
    work.write("square.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1, -1 -1))\n");
    work.write("wall.wkt", "POLYGON ((0 -50, 10 -50, 10 50, 0 50, 0 -50))\n");
  }
};

TEST_F(ClearanceCli, KnowsTheDistanceOfASquareFromAWall) {
  const Outcome outcome = work.run("dymsum clearance square.wkt wall.wkt --at -4,0,0 --at 0.5,0,0 --weight inf --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out);
  for (const char* key : {"inputs", "tier", "time_ms", "weight", "answers"}) EXPECT_TRUE(report.contains(key)) << key;
  const Json &free = report["answers"][0], &inside = report["answers"][1];
  EXPECT_TRUE(free["free"].get<bool>());
  EXPECT_NEAR(free["distance"].get<double>(), 3, 1e-8);
  EXPECT_FALSE(inside["free"].get<bool>());
  EXPECT_NEAR(inside["distance"].get<double>(), -1.5, 1e-8);
  EXPECT_EQ(free["free_angles"].size(), 1u);
}

// The square fills its room: it is jammed at four placements.
TEST_F(ClearanceCli, AJammedRobotHasNoClearance) {
  work.write("room.wkt", "POLYGON ((-3 -3, 3 -3, 3 3, -3 3, -3 -3), (-1 -1, 1 -1, 1 1, -1 1, -1 -1))\n");
  const Outcome text = work.run("dymsum clearance square.wkt room.wkt --at 0,0,0 --at 0.25,0,0 --weight inf");
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("free, clearance 0 (by translation alone 0)"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("overlaps, depth 0.25 "), std::string::npos) << text.out;
  const Json jammed = Json::parse(work.run("dymsum clearance square.wkt room.wkt --at 0,0,0 --json").out)["answers"][0];
  EXPECT_EQ(jammed["distance"], 0);
  EXPECT_EQ(jammed["error"], 0);
  ASSERT_EQ(jammed["free_angles"].size(), 4u);
  for (const Json& f : jammed["free_angles"]) EXPECT_EQ(f["begin"], f["end"]);
  const Json strict = Json::parse(
      work.run("dymsum clearance square.wkt room.wkt --at 0,0,0 --strict --weight inf --json").out)["answers"][0];
  EXPECT_EQ(strict["distance"], -4);
  EXPECT_FALSE(strict["free"].get<bool>());
}

TEST_F(ClearanceCli, ShowsErrorsThatAreNotNegligible) {
  const Outcome wide = work.run("dymsum clearance square.wkt wall.wkt --at -4,0,0 --weight 1e12");
  ASSERT_EQ(wide.code, 0) << wide.err;
  EXPECT_NE(wide.out.find(" +- "), std::string::npos) << wide.out;
  EXPECT_EQ(work.run("dymsum clearance square.wkt wall.wkt --at -4,0,0 --weight inf").out.find(" +- "),
            std::string::npos);
  for (const char* weight : {"1e20", "1e300"}) {
    const Outcome refused =
        work.run(std::string("dymsum clearance square.wkt wall.wkt --at -4,0,0 --weight ") + weight);
    EXPECT_EQ(refused.code, 1);
    EXPECT_NE(refused.err.find("inf counts translations only"), std::string::npos) << refused.err;
  }
}

TEST_F(ClearanceCli, FewerRadiansCountMore) {
  const auto distance = [&](const std::string& weight) {
    return Json::parse(work.run("dymsum clearance square.wkt wall.wkt --at -1.2,0,0 --json --weight " + weight)
                           .out)["answers"][0]["distance"]
        .get<double>();
  };
  // Turning by 0.15 or so brings a corner to the wall.
  EXPECT_LT(distance("0.1"), distance("1"));
  EXPECT_LE(distance("1"), distance("inf"));
  EXPECT_NEAR(distance("inf"), 0.2, 1e-8);
}

TEST_F(ClearanceCli, QueriesAnObstacleFromAFileWithoutComputingIt) {
  ASSERT_EQ(work.run("dymsum cspace square.wkt wall.wkt -o wall.obstacle").code, 0);
  work.write("at.txt", "# x, y, theta\n-4, 0, 0\n\n0.5,0,90deg  # inside\n");
  const Json made =
      Json::parse(work.run("dymsum clearance square.wkt wall.wkt --at -4,0,0 --at 0.5,0,90deg --json").out);
  const Outcome outcome = work.run("dymsum clearance --obstacle wall.obstacle --at-file at.txt --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json read = Json::parse(outcome.out);
  EXPECT_EQ(read["answers"], made["answers"]);
  EXPECT_EQ(read["weight"], made["weight"]);
  EXPECT_EQ(read["inputs"][0]["file"], "wall.obstacle#robot");
}

TEST_F(ClearanceCli, SaysWhatIsWrongWithFilesOfObstaclesAndConfigurations) {
  ASSERT_EQ(work.run("dymsum cspace square.wkt wall.wkt -o wall.obstacle").code, 0);
  const std::string text = work.read("wall.obstacle");
  work.write("cut.obstacle", text.substr(0, text.size() / 2));
  const Outcome cut = work.run("dymsum clearance --obstacle cut.obstacle --at 0,0,0");
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find("cut.obstacle"), std::string::npos) << cut.err;
  EXPECT_NE(cut.err.find("ends too early"), std::string::npos) << cut.err;
  work.write("at.txt", "0,0,0\n1,2\n");
  const Outcome line = work.run("dymsum clearance square.wkt wall.wkt --at-file at.txt");
  EXPECT_EQ(line.code, 2);
  EXPECT_NE(line.err.find("at.txt:2"), std::string::npos) << line.err;
  EXPECT_EQ(work.run("dymsum clearance square.wkt wall.wkt --at-file missing.txt").code, 2);
  EXPECT_EQ(work.run("dymsum clearance square.wkt wall.wkt --obstacle wall.obstacle --at 0,0,0").code, 1);
  EXPECT_EQ(work.run("dymsum clearance square.wkt --at 0,0,0").code, 1);
  EXPECT_EQ(work.run("dymsum clearance --obstacle wall.obstacle --repair --at 0,0,0").code, 1);
}

TEST_F(ClearanceCli, WrongOptionsAreUsageErrors) {
  const std::string verb = "dymsum clearance square.wkt wall.wkt";
  all_refused({verb, verb + " --at 0,0", verb + " --at 0,0,0 --weight -1", verb + " --at 0,0,0 --weight x"});
  refused(verb + " --at 1e300,0,0", "2^400");
}

}  // namespace
}  // namespace dymsum::cli_test
