// sum, nfp, rotate, scale and depth with solid operands: keys, exit codes, files.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class SolidMotionCli : public CliTest {
 protected:
  SolidMotionCli() {
    work.write("cube.off", kCube);
    work.write("tetrahedron.off", kTetrahedron);
  }
};

const std::string kEllAtZero =
    "OFF\n12 8 0\n0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n"
    "0 0 2\n3 0 2\n3 1 2\n1 1 2\n1 3 2\n0 3 2\n"
    "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n"
    "4 5 0 6 11\n";

TEST_F(SolidMotionCli, SumPrintsEveryKeyOfTheContractAndWritesEveryFormat) {
  const Json report =
      json("dymsum sum cube.off tetrahedron.off --json -o s.off -o s.obj -o s.stl -o s.ply -o s.glb -o s.json");
  for (const char* key : {"inputs", "tier", "time_ms", "shells", "vertices", "faces", "volume", "volume_exact", "area",
                          "tight", "convolution"})
    EXPECT_TRUE(report.contains(key)) << key;
  EXPECT_EQ(report["shells"], 1);
  EXPECT_EQ(report["tier"], 26);
  // 8 + 4 * 3 (quarter prisms) ... the volume of a cube grown by a corner, from mixed volumes: 8 + 4 + ... checked
  // against the facets by the library.
  EXPECT_EQ(report["volume_exact"], json("dymsum sum tetrahedron.off cube.off --engine brute --json")["volume_exact"]);
  const Json exact = Json::parse(work.read("s.json"));
  EXPECT_EQ(exact["vertex_list"].size(), report["vertices"]);
  EXPECT_EQ(exact["face_list"].size(), report["faces"]);
  EXPECT_EQ(json("dymsum sum s.off cube.off --json")["shells"], 1) << "what was written can be read";
  EXPECT_EQ(work.read("s.glb").substr(0, 4), "glTF");
}

TEST_F(SolidMotionCli, NfpIsTheSumWithTheReflection) {
  EXPECT_EQ(json("dymsum nfp cube.off tetrahedron.off --json")["vertices"],
            json("dymsum sum cube.off tetrahedron.off --json")["vertices"]);
}

TEST_F(SolidMotionCli, RotateFollowsATurn) {
  const Json report = json("dymsum rotate cube.off cube.off --steps 8 --json -o last.glb");
  for (const char* key : {"inputs", "tier", "time_ms", "frames", "static_ms", "update_ms"})
    EXPECT_TRUE(report.contains(key)) << key;
  ASSERT_EQ(report["frames"].size(), 8u);
  EXPECT_EQ(report["frames"][0]["volume_exact"], "64/1");
  EXPECT_EQ(report["frames"][2]["volume_exact"], "64/1") << "a quarter turn is exact";
  EXPECT_GT(report["frames"][1]["changed"], 0);
  EXPECT_EQ(report["frames"][0]["faces"], 6) << "a cube: coplanar facets count once";
  EXPECT_EQ(report["frames"][1]["faces"], 10) << "an octagonal prism";
  EXPECT_EQ(report["frames"][2]["faces"], 6);
  EXPECT_LE(report["frames"][2]["changed"], 6) << "of these";
  EXPECT_NE(work.run("dymsum rotate cube.off cube.off --steps 4").out.find(" of 6 facets"), std::string::npos);
  EXPECT_EQ(work.read("last.glb").substr(0, 4), "glTF");
}

TEST_F(SolidMotionCli, SolidsOfAnyShapeTurnAndScale) {
  work.write("ell.off", kEllAtZero);
  const Json turn = json("dymsum rotate ell.off cube.off --steps 4 --json -o first.glb -o first.json --frame 0");
  ASSERT_EQ(turn["frames"].size(), 4u);
  const Json still = json("dymsum sum ell.off cube.off --json");
  for (const char* key : {"faces", "vertices", "shells", "volume_exact", "tight"})
    EXPECT_EQ(turn["frames"][0][key], still[key]) << key;
  for (const Json& frame : turn["frames"]) EXPECT_EQ(frame["volume_exact"], still["volume_exact"]) << "a quarter turn";
  EXPECT_EQ(Json::parse(work.read("first.json"))["vertices"], still["vertices"]);
  EXPECT_GT(turn["static_ms"], 0);
  const Json scaled = json("dymsum scale ell.off cube.off --at 1,2:1:1/2 --json");
  EXPECT_EQ(scaled["frames"][0]["volume_exact"], still["volume_exact"]);
  EXPECT_NE(scaled["frames"][1]["volume_exact"], still["volume_exact"]);
  const Json alike = json("dymsum scale ell.off cube.off --at 1,1.01,1.02 --json");
  for (const Json& frame : alike["frames"]) EXPECT_EQ(frame["changed"], 0) << "the same faces of coplanar facets";
  EXPECT_NE(work.run("dymsum rotate ell.off cube.off --steps 4").out.find("from scratch"), std::string::npos);
  all_refused({"dymsum rotate ell.off cube.off --steps 4 -o stages.glb",
               "dymsum rotate ell.off cube.off --steps 4 -o a.glb --frame 4"});
}

TEST_F(SolidMotionCli, ScaleTakesOneFactorOrThree) {
  const Json report = json("dymsum scale cube.off cube.off --at 1,2,3:1:1/2 --json");
  ASSERT_EQ(report["frames"].size(), 3u);
  EXPECT_EQ(report["frames"][1]["volume_exact"], "216/1");
  EXPECT_EQ(report["frames"][2]["volume_exact"], "96/1");
  EXPECT_EQ(json("dymsum scale cube.off cube.off --sweep 1:2:1/2 --json")["frames"].size(), 3u);
}

TEST_F(SolidMotionCli, DepthTellsTheShortestWayOut) {
  const Json report = json("dymsum depth cube.off cube.off --move 1.5,0.25,0 --json");
  EXPECT_EQ(report["depth"], 0.5);
  EXPECT_EQ(report["depth_squared_exact"], "1/4");
  EXPECT_EQ(report["direction"], Json::array({1.0, 0.0, 0.0}));
  EXPECT_EQ(json("dymsum depth cube.off cube.off --move 2,0,0 --json", 4)["inside"], false);
  EXPECT_EQ(work.run("dymsum depth cube.off cube.off --axis 0,0,1 --degrees 45").code, 0);
}

TEST_F(SolidMotionCli, DepthTellsWhatItDidNotDecideOrTake) {
  const Outcome late = work.run("dymsum depth cube.off cube.off --move 0.5,0.25,0 --time 1e-9");
  EXPECT_EQ(late.code, 5);
  EXPECT_NE(late.out.find("the time was over: they overlap, and the depth is at least"), std::string::npos) << late.out;
  work.write("speck.off",
             "OFF\n4 4 0\n0 0 0\n1e-300 0 0\n0 1e-300 0\n0 0 1e-300\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_EQ(work.run("dymsum depth cube.off speck.off").code, 0) << "coordinates of 1,050 bits";
  work.write("ell.off", kEllAtZero);
  EXPECT_EQ(work.run("dymsum rotate ell.off speck.off --steps 2").code, 0);
  EXPECT_EQ(work.run("dymsum sum ell.off speck.off -o sum.json").code, 0);
  EXPECT_EQ(work.run("dymsum depth cube.off speck.off --axis 0,0,1 --degrees 0").code, 0);
  const Json past = json("dymsum depth cube.off cube.off --along 5e-324,0,0 --json");
  EXPECT_TRUE(past["along"].is_null());
  all_refused({"dymsum depth cube.off cube.off --threads 2", "dymsum rotate cube.off cube.off --steps 2 --frame -1"});
}

TEST_F(SolidMotionCli, WrongUsageAndBadSolidsAreTold) {
  work.write("open.off", kOpen);
  work.write("dent.off", "OFF\n5 6 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n1/2 1 1\n");
  work.write("flat.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 0))");
  all_refused({"dymsum sum cube.off flat.wkt", "dymsum erode cube.off flat.wkt",
               "dymsum sum cube.off cube.off -o s.svg", "dymsum sum cube.off cube.off --engine winding",
               "dymsum rotate cube.off cube.off", "dymsum rotate cube.off cube.off --steps 0",
               "dymsum rotate cube.off cube.off --steps 4 --axis 1,2", "dymsum rotate flat.wkt cube.off --steps 4",
               "dymsum depth flat.wkt flat.wkt --move 1,2,3", "dymsum depth flat.wkt cube.off",
               "dymsum depth cube.off cube.off --axis 0,0,1", "dymsum depth cube.off cube.off --move 1,nan,0",
               "dymsum scale cube.off cube.off --at 1:2", "dymsum scale cube.off cube.off",
               "dymsum rotate cube.off cube.off --steps 4 -o turn.svg",
               "dymsum rotate cube.off cube.off --steps 4 --axis 0,0,0", "dymsum scale cube.off cube.off --at 0"});
  for (const char* command :
       {"dymsum sum cube.off open.off", "dymsum sum cube.off dent.off", "dymsum sum cube.off missing.off"}) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, 2) << command << "\n" << outcome.err;
    EXPECT_FALSE(outcome.err.empty()) << command;
  }
  EXPECT_NE(work.run("dymsum sum cube.off open.off").err.find("open.off"), std::string::npos);
}

}  // namespace
}  // namespace dymsum::cli_test
