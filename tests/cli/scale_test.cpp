// The verbs scale and scale-range: keys, exit codes, files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "process.h"

namespace dymsum::cli_test {
namespace {

using Json = nlohmann::json;

class ScaleCli : public testing::Test {
 protected:
  ScaleCli() {
    work.write("plate.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 3 2, 3 1, 1 1))\n");
    work.write("peg.wkt", "POLYGON ((-1 -0.5, 0 -0.5, 0 0, -1 0, -1 -0.5))\n");
    work.write("part.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1, -1 -1))\n");
    work.write("wall.wkt", "POLYGON ((5 -10, 6 -10, 6 10, 5 10, 5 -10))\n");
  }
  Json json(const std::string& command, int code = 0) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return Json::parse(outcome.out);
  }
  Workplace work;
};

TEST_F(ScaleCli, ScalePrintsEveryKeyOfTheContract) {
  const Json report = json("dymsum scale plate.wkt peg.wkt --scaled q --at 1,3/2,2,2.5 --events --json");
  for (const char* key : {"inputs", "tier", "time_ms", "frames", "static_ms", "update_ms", "events"}) EXPECT_TRUE(report.contains(key)) << key;
  ASSERT_EQ(report["frames"].size(), 4u);
  for (const char* key : {"s", "outer", "holes", "vertices", "area_exact", "update_ms"}) EXPECT_TRUE(report["frames"][0].contains(key)) << key;
  EXPECT_EQ(report["frames"][1]["s"], "3/2");
  EXPECT_EQ(report["frames"][1]["holes"], 1);
  EXPECT_EQ(report["frames"][2]["holes"], 0);
  EXPECT_EQ(report["frames"][2]["tight"]["points"], 1);
  EXPECT_EQ(report["frames"][3]["tight"]["points"], 0);
  bool found = false;
  for (const Json& e : report["events"]) found |= e["s"] == "2/1" && e["topology"] == true;
  EXPECT_TRUE(found);
}

TEST_F(ScaleCli, SweepsAreExactAndPicturesAreWritten) {
  const Json report = json("dymsum scale plate.wkt peg.wkt --scaled q --sweep 1:2:1/3 -o strip.svg -o page.html --json");
  ASSERT_EQ(report["frames"].size(), 4u);
  EXPECT_EQ(report["frames"][2]["s"], "5/3");
  EXPECT_EQ(report["frames"][3]["s"], "2/1");
  EXPECT_NE(work.read("strip.svg").find("<svg"), std::string::npos);
  EXPECT_NE(work.read("page.html").find("<script>"), std::string::npos);
}

TEST_F(ScaleCli, BadScalesAndUsageHaveTheirExitCodes) {
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt").code, 1);
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt --sweep 1:2").code, 1);
  EXPECT_EQ(work.run("dymsum scale plate.wkt peg.wkt --at 1 -o sum.wkt").code, 1);
  for (const char* s : {"0", "-1", "nan", "1e30", "1e-30", "x"}) {
    const Outcome outcome = work.run(std::string("dymsum scale plate.wkt peg.wkt --at=") + s);
    EXPECT_EQ(outcome.code, 2) << s;
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
