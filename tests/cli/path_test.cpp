// The verb path: keys, exit codes, files.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class PathCli : public CliTest {
 protected:
  PathCli() {
    work.write("square.wkt", kSquare);
    // Two rooms and a slot of width 1 between them, from y = 0 to y = 1.
    work.write("rooms.wkt",
               "POLYGON ((-12 -6, 12 -6, 12 6, -12 6, -12 -6), (-11 -5, -11 5, -1 5, -1 1, 1 1, 1 5, 11 5, 11 -5, 1 "
               "-5, 1 0, -1 0, "
               "-1 -5, -11 -5))\n");
  }
};

TEST_F(PathCli, PrintsEveryKeyAndWritesFiles) {
  const Json report =
      json("dymsum path square.wkt rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 --json -o path.svg -o path.json");
  for (const char* key : {"inputs", "tier", "time_ms", "found", "waypoints", "reason"})
    EXPECT_TRUE(report.contains(key)) << key;
  EXPECT_TRUE(report["found"].get<bool>());
  EXPECT_TRUE(report["reason"].is_null());
  ASSERT_GT(report["waypoints"].size(), 3u);
  for (const char* key : {"x", "y", "theta", "tan_half", "move"})
    EXPECT_TRUE(report["waypoints"][0].contains(key)) << key;
  EXPECT_EQ(report["waypoints"][0]["move"], "start");
  EXPECT_EQ(report["waypoints"][0]["tan_half"].get<std::string>().find("inf"), std::string::npos);
  EXPECT_EQ(report["waypoints"].back()["x"], 5);
  EXPECT_NE(work.read("path.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(Json::parse(work.read("path.json"))["waypoints"], report["waypoints"]);
}

TEST_F(PathCli, PlansToSeveralGoalsOfOneObstacleFromAFile) {
  ASSERT_EQ(work.run("dymsum cspace square.wkt rooms.wkt -o rooms.obstacle").code, 0);
  const Json one = json("dymsum path square.wkt rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 --json");
  const Json several = json("dymsum path --obstacle rooms.obstacle --from -5,1.5,0.25 --to 5,-2,2 --to -5,-2,1 --json");
  ASSERT_EQ(several["paths"].size(), 2u);
  EXPECT_EQ(several["paths"][0]["waypoints"], one["waypoints"]);
  EXPECT_TRUE(several["found"].get<bool>());
  EXPECT_EQ(json("dymsum path --obstacle rooms.obstacle --from -5,1.5,0.25 --to 5,-2,2 --json")["waypoints"],
            one["waypoints"]);
  const Json no = json("dymsum path --obstacle rooms.obstacle --from -5,1.5,0.25 --to -5,-2,1 --to 11.5,0,0 --json", 4);
  EXPECT_TRUE(no["paths"][0]["found"].get<bool>());
  EXPECT_EQ(no["paths"][1]["reason"]["kind"], "goal_not_free");
  EXPECT_EQ(
      work.run("dymsum path --obstacle rooms.obstacle --from -5,1.5,0.25 --to 5,-2,2 --to -5,-2,1 -o path.svg").code,
      1);
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
  EXPECT_TRUE(stopped["reason"]["limit"]["passage"].is_null());
  EXPECT_NE(stopped["reason"]["text"].get<std::string>().find("while the obstacle of all angles was made"),
            std::string::npos);
  EXPECT_NE(stopped["reason"]["text"].get<std::string>().find("time limit"), std::string::npos);
}

TEST_F(PathCli, MarginsAreKeptAndReported) {
  const std::string command = "dymsum path square.wkt wide.wkt --from -5,1.5,0.25 --to 5,-2,2 --json";
  work.write("wide.wkt",
             "POLYGON ((-12 -6, 12 -6, 12 6, -12 6, -12 -6), (-11 -5, -11 5, -1 5, -1 1.5, 1 1.5, 1 5, 11 5, 11 -5, "
             "1 -5, 1 0, -1 0, -1 -5, -11 -5))\n");
  const Json kept = json(command + " --margin 0.2 -o kept.json");
  EXPECT_TRUE(kept["found"].get<bool>());
  EXPECT_EQ(kept["margin"]["kept"], 0.2);
  EXPECT_GT(kept["margin"]["at_most"], 0.2);
  EXPECT_LT(kept["margin"]["at_most"], 0.205);
  EXPECT_EQ(json("dymsum path square.wkt wide.wkt --check-path kept.json --margin 0.2 --json")["checked"]["outcome"],
            "free");
  const Json none = json(command + " --margin 0.26", 4);
  EXPECT_EQ(none["reason"]["kind"], "separated");
}

TEST_F(PathCli, ChecksWholeTurnsOfPosesInDegrees) {
  // A rod beside a post: a quarter turn is free, a whole turn and a quarter is not.
  work.write("rod.wkt", "POLYGON((0 0,3 0,3 0.125,0 0.125,0 0))");
  work.write("post.wkt", "POLYGON((-2 -0.5,-1 -0.5,-1 0.5,-2 0.5,-2 -0.5))");
  const std::string check = "dymsum path rod.wkt post.wkt --check-path poses.txt --json";
  work.write("poses.txt", "0,0,0\n0,0,90deg\n");
  EXPECT_EQ(json(check)["checked"]["outcome"], "free");
  work.write("poses.txt", "0,0,0\n0,0,450deg\n");
  EXPECT_EQ(json(check, 4)["checked"]["outcome"], "blocked");
  work.write("poses.txt", "5,0,170deg\n5,0,190deg\n");
  EXPECT_EQ(json(check)["checked"]["outcome"], "free");
  work.write("poses.txt", "0,0,140deg\n0,0,220deg\n");
  EXPECT_EQ(json(check, 4)["checked"]["outcome"], "blocked");
}

TEST_F(PathCli, ChecksAPathThatIsGiven) {
  work.run("dymsum path square.wkt rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 -o path.json");
  const std::string check = "dymsum path square.wkt rooms.wkt --check-path ";
  const Json free = json(check + "path.json --json");
  EXPECT_EQ(free["checked"]["outcome"], "free");
  EXPECT_TRUE(free["checked"]["first"].is_null());
  // The slot is passed by touching alone.
  const Json strict = json(check + "path.json --strict --json", 4);
  EXPECT_EQ(strict["checked"]["outcome"], "blocked");
  EXPECT_EQ(strict["checked"]["first"]["kind"], "translation");
  work.write("poses.txt", "# x, y, theta\n-5, 0, 0\n-3,0,0deg\n\n-3,0,90deg # in place\n-3,4.5,90deg\n");
  const Outcome wall = work.run(check + "poses.txt");
  EXPECT_EQ(wall.code, 4);
  EXPECT_EQ(wall.out,
            "blocked: piece 2, a translation, at (-3, 4), theta = 1.570796327, 88.88888889 % of it: edge 5 "
            "of the obstacle and vertex 1 of the robot\n");
  work.write("poses.json", "[[-5,0,0],[-4,1,1]]");
  EXPECT_EQ(json(check + "poses.json --json")["checked"]["pieces"], 1);
  work.write("touch.json", "[[-5,-5,0],[-4,0,1]]");
  EXPECT_EQ(json(check + "touch.json --json", 5)["checked"]["first"]["kind"], "both");
  for (const char* wrong : {"1,2\n", "[[1,2]]", "[[1,2,\"a\"]]", "{}", "", "{\"waypoints\":[{\"move\":\"jump\"}]}"}) {
    work.write("wrong.txt", wrong);
    EXPECT_EQ(work.run(check + "wrong.txt").code, 2) << wrong;
  }
  EXPECT_EQ(work.run(check + "absent.txt").code, 2);
  EXPECT_EQ(work.run(check + "poses.txt --from 0,0,0").code, 1);
  EXPECT_EQ(work.run(check + "poses.txt -o a.json").code, 1);
  EXPECT_EQ(work.run("dymsum path square.wkt rooms.wkt").code, 1);
}

// As robots' footprints are written: either way round.
TEST_F(PathCli, FootprintsAreOperands) {
  const Json turned = json("dymsum path \"[[0,0],[0,1],[1,1],[1,0]]\" rooms.wkt --from -5,1.5,0.25 --to 5,-2,2 --json");
  EXPECT_EQ(turned["inputs"][0]["vertices"], 4);
  EXPECT_TRUE(turned["found"].get<bool>());
  work.write("robot.json", "{\"footprint\": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]}");
  EXPECT_EQ(json("dymsum info robot.json --json")["shapes"][0]["vertices"], 4);
  EXPECT_EQ(work.run("dymsum info \"[[0,0],[0,1],[1,]]\"").code, 2);
}

TEST_F(PathCli, MapsAreObstacles) {
  work.write("room.pgm", "P2 6 3 255\n254 254 254 254 254 254\n254 254 0 0 254 254\n254 254 254 0 254 254\n");
  work.write("room.yaml",
             "image: room.pgm\nresolution: 0.5\norigin: [-1, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
             "free_thresh: 0.196\n");
  work.write("corner.map", "type octile\nheight 2\nwidth 3\nmap\n..@\n...\n");
  const std::string robot = "\"[[-0.125,-0.125],[0.125,-0.125],[0.125,0.125],[-0.125,0.125]]\" ";
  const Json over =
      json("dymsum path " + robot + "room.yaml --from -0.5,0.25,0 --to 1.5,0.25,90deg --margin 0.05 --json");
  EXPECT_TRUE(over["found"].get<bool>());
  EXPECT_EQ(json("dymsum path " + robot + "room.yaml --from 0.25,0.25,0 --to 5,5,0 --json", 4)["reason"]["kind"],
            "separated");
  EXPECT_EQ(json("dymsum info corner.map#free --json")["shapes"][0]["area"], 5);
  for (const char* verb : {"cspace ", "sum "})
    EXPECT_EQ(work.run("dymsum " + std::string(verb) + robot + "corner.map").code, 0) << verb;
  EXPECT_EQ(work.run("dymsum clearance " + robot + "room.yaml --at 0.25,0.25,0").code, 0);
  EXPECT_EQ(work.run("dymsum convert room.yaml room.wkt").code, 0);
  EXPECT_EQ(json("dymsum info room.wkt --json")["shapes"][0]["area"], 8 * 5 * 0.25 - 18 * 0.25 + 3 * 0.25);
  EXPECT_EQ(work.run("dymsum info corner.map#walls").code, 2);
  EXPECT_EQ(work.run("dymsum convert room.wkt room.map").code, 1);
}

TEST_F(PathCli, WrongOptionsAreUsageErrors) {
  const std::string verb = "dymsum path square.wkt rooms.wkt --from 0,0";
  all_refused({verb + " --to 5,0,0", verb + ",0,0 --to 5,0,0", verb + ",0", verb + ",0 --to 5,0,0 -o path.png",
               verb + ",0 --to 5,0,0 --time-limit -1", verb + ",0 --to 5,0,0 --margin -1"});
}

}  // namespace
}  // namespace dymsum::cli_test
