// The verb path: keys, exit codes, files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "process.h"

namespace dymsum::cli_test {
namespace {

using Json = nlohmann::json;

class PathCli : public testing::Test {
 protected:
  PathCli() {
    work.write("square.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\n");
    // Two rooms and a slot of width 1 between them, from y = 0 to y = 1.
    work.write("rooms.wkt",
               "POLYGON ((-12 -6, 12 -6, 12 6, -12 6, -12 -6), (-11 -5, -11 5, -1 5, -1 1, 1 1, 1 5, 11 5, 11 -5, 1 -5, 1 0, -1 0, "
               "-1 -5, -11 -5))\n");
  }
  Json json(const std::string& command, int code = 0) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return Json::parse(outcome.out);
  }
  Workplace work;
};

TEST_F(PathCli, PrintsEveryKeyAndWritesFiles) {
  const Json report = json("dymsum path square.wkt rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 --json -o path.svg -o path.json");
  for (const char* key : {"inputs", "tier", "time_ms", "found", "waypoints",
      "reason"}) EXPECT_TRUE(report.contains(key)) << key;
  EXPECT_TRUE(report["found"].get<bool>());
  EXPECT_TRUE(report["reason"].is_null());
  ASSERT_GT(report["waypoints"].size(), 3u);
  for (const char* key : {"x", "y", "theta", "tan_half", "move"}) EXPECT_TRUE(report["waypoints"][0].contains(key))
      << key;
  EXPECT_EQ(report["waypoints"][0]["move"], "start");
  EXPECT_EQ(report["waypoints"][0]["tan_half"].get<std::string>().find("inf"), std::string::npos);
  EXPECT_EQ(report["waypoints"].back()["x"], 5);
  EXPECT_NE(work.read("path.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(Json::parse(work.read("path.json"))["waypoints"], report["waypoints"]);
}

TEST_F(PathCli, NoPathEndsWithFourAndSaysWhy) {
  const Json strict = json("dymsum path square.wkt rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 --strict --json", 4);
  EXPECT_FALSE(strict["found"].get<bool>());
  EXPECT_EQ(strict["reason"]["kind"], "separated");
  EXPECT_TRUE(strict["waypoints"].empty());
  EXPECT_EQ(strict["reason"]["start"][0]["unbounded"], false);
  const Outcome overlap = work.run("dymsum path square.wkt rooms.wkt --from -11.5,0,0 --to 5,0,0");
  EXPECT_EQ(overlap.code, 4);
  EXPECT_NE(overlap.out.find("overlaps"), std::string::npos);
}

// A ladder in corridors of width 1, 1.7 % shorter than the longest one that goes round the corner.
TEST_F(PathCli, UndecidedEndsWithFiveAndSaysWhere) {
  work.write("ladder.wkt", "POLYGON ((0 0, 2.75 0, 2.75 .015625, 0 .015625, 0 0))\n");
  work.write("corner.wkt", "POLYGON ((-1 -1, 19 -1, 19 19, -1 19, -1 -1), (0 0, 18 0, 18 1, 1 1, 1 18, 0 18, 0 0))\n");
  const std::string command = "dymsum path ladder.wkt corner.wkt --from 2,.5,0 --to .5,17,-1.5707963267948966";
  EXPECT_EQ(work.run(command).code, 0);
  const Json stopped = json(command + " --time-limit 0 --json", 5);
  EXPECT_FALSE(stopped["found"].get<bool>());
  EXPECT_EQ(stopped["reason"]["kind"], "undecided");
  EXPECT_EQ(stopped["reason"]["limit"]["seconds"], 0);
  EXPECT_EQ(stopped["reason"]["limit"]["passage"]["angles"].size(), 2u);
  EXPECT_NE(stopped["reason"]["text"].get<std::string>().find("time limit"), std::string::npos);
}

TEST_F(PathCli, WrongOptionsAreUsageErrors) {
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt --from 0,0 --to 5,0,0").code, 1);
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt --from 0,0,0,0 --to 5,0,0").code, 1);
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt --from 0,0,0").code, 1);
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt --from 0,0,0 --to 5,0,0 -o path.png").code, 1);
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt --from 0,0,0 --to 5,0,0 --time-limit -1").code, 1);
}

}  // namespace
}  // namespace dymsum::cli_test
