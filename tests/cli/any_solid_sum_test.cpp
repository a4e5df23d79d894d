// sum and nfp of solids that are not convex.
#include <cmath>
#include <sstream>

#include "cli_fixture.h"
#include "dymsum/rational.h"

namespace dymsum::cli_test {
namespace {

/// A block of 8 x 8 x 4 with a square tunnel of width 2 along z.
constexpr const char* kTunnel =
    "OFF\n16 16 0\n-4 -4 0\n4 -4 0\n4 4 0\n-4 4 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-4 -4 4\n4 -4 4\n4 4 4\n-4 4 4\n-1 "
    "-1 4\n"
    "1 -1 4\n1 1 4\n-1 1 4\n4 8 9 13 12\n4 1 0 4 5\n4 0 1 9 8\n4 5 4 12 13\n4 9 10 14 13\n4 2 1 5 6\n4 1 2 10 9\n4 6 5 "
    "13 14\n"
    "4 10 11 15 14\n4 3 2 6 7\n4 2 3 11 10\n4 7 6 14 15\n4 11 8 12 15\n4 0 3 7 4\n4 3 0 8 11\n4 4 7 15 12\n";

class AnySolidSum : public CliTest {
 protected:
  AnySolidSum() {
    work.write("tunnel.off", kTunnel);
    work.write("cube.off", kCube);
  }
};

/// The tunnel in coordinates of all digits, far away from the origin; of triangles, as four such corners lie in no
/// plane.
std::string free_tunnel(double a) {
  std::istringstream in(kTunnel);
  std::string head;
  std::getline(in, head);
  std::getline(in, head);
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n16 32 0\n";
  for (int k = 0; k < 16; ++k) {
    double x = 0, y = 0, z = 0;
    in >> x >> y >> z;
    out << 1e4 + x * std::cos(a) - y * std::sin(a) << " " << x * std::sin(a) + y * std::cos(a) + 0.3 * z << " " << z
        << "\n";
  }
  for (int n = 0, i = 0, j = 0, k = 0, l = 0; in >> n >> i >> j >> k >> l;)
    out << "3 " << i << " " << j << " " << k << "\n3 " << i << " " << k << " " << l << "\n";
  return out.str();
}

TEST_F(AnySolidSum, NumbersInJsonAreTheDoublesNearestToTheirFractions) {
  work.write("p.off", free_tunnel(0.3));
  work.write("q.off", free_tunnel(1.1));
  json("dymsum sum p.off q.off -o sum.json --json");
  const Json sum = Json::parse(work.read("sum.json"));
  std::size_t compared = 0;
  for (const Json& vertex : sum["vertex_list"])
    for (std::size_t axis = 0; axis < 3; ++axis, ++compared)
      EXPECT_EQ(vertex["at"][axis], Rational::parse(vertex["exact"][axis].get<std::string>()).value().to_double());
  EXPECT_GT(compared, 60u);
}

TEST_F(AnySolidSum, APegAsWideAsItsTunnelHasOneWayThrough) {
  const Json sum = json("dymsum nfp tunnel.off cube.off -o fit.json -o fit.glb -o fit.off --json");
  EXPECT_EQ(sum["volume_exact"], "600/1");
  EXPECT_EQ(sum["tier"], 26);
  EXPECT_EQ(sum["shells"], 1);
  EXPECT_EQ(sum["faces"], 6);
  EXPECT_EQ(sum["tight"], (Json{{"points", 0}, {"segments", 1}, {"faces", 0}}));
  const Json exact = Json::parse(work.read("fit.json"));
  const Json segment = exact["tight_list"]["segments"][0]["vertices"];
  EXPECT_EQ(exact["vertex_list"][segment[0].get<std::size_t>()]["exact"], (Json{"0/1", "0/1", "-1/1"}));
  EXPECT_EQ(exact["vertex_list"][segment[1].get<std::size_t>()]["exact"], (Json{"0/1", "0/1", "5/1"}));
  EXPECT_EQ(count("fit.glb", "BLEND"), 1u) << "the way through shows";
  EXPECT_EQ(json("dymsum info fit.off --json")["volume"], 600.0);
}

TEST_F(AnySolidSum, ASmallerPegLeavesATunnel) {
  const Json sum = json("dymsum sum tunnel.off cube.off --engine brute --json");
  EXPECT_EQ(sum["volume_exact"], "600/1") << "a cube is its own reflection";
  work.write("pin.off", "OFF\n4 4 0\n0 0 0\n0.5 0 0\n0 0.5 0\n0 0 0.5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Json open = json("dymsum nfp tunnel.off pin.off -o open.glb --json");
  EXPECT_EQ(open["tight"], (Json{{"points", 0}, {"segments", 0}, {"faces", 0}}));
  EXPECT_EQ(count("open.glb", "BLEND"), 0u);
  EXPECT_LT(open["volume"], 600);
  const Outcome text = work.run("dymsum nfp tunnel.off pin.off");
  EXPECT_EQ(text.out.find("tight"), std::string::npos) << text.out;
}

TEST_F(AnySolidSum, SumsThatTouchThemselvesAreWrittenAndReadBack) {
  // Beside two cubes that are 2 apart along both axes, a cube of width 2 leaves sums that touch in an edge.
  work.write("two.off",
             "OFF\n16 12 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n3 3 -1\n5 3 -1\n5 5 "
             "-1\n3 5 -1\n3 3 1\n"
             "5 3 1\n5 5 1\n3 5 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 8 11 10 9\n4 12 "
             "13 14 15\n"
             "4 8 9 13 12\n4 9 10 14 13\n4 10 11 15 14\n4 11 8 12 15\n");
  EXPECT_EQ(work.run("dymsum sum two.off cube.off -o sum.off -o sum.glb").code, 0);
  EXPECT_EQ(work.run("dymsum info sum.off").code, 0);
  // as an operand again, and of three in one run
  const std::string volume = json("dymsum sum sum.off cube.off --json")["volume_exact"];
  EXPECT_EQ(json("dymsum sum two.off cube.off cube.off --json")["volume_exact"], volume);
  EXPECT_EQ(json("dymsum sum cube.off two.off cube.off --json")["volume_exact"], volume);
}

TEST_F(AnySolidSum, OfThree) {
  EXPECT_EQ(json("dymsum sum tunnel.off cube.off cube.off --json")["volume_exact"], "1152/1");
  const Outcome text = work.run("dymsum sum tunnel.off cube.off cube.off");
  EXPECT_NE(text.out.find("tunnel.off, cube.off and cube.off"), std::string::npos) << text.out;
}

TEST_F(AnySolidSum, SemanticsSayWhetherTightFeaturesAreListed) {
  for (const char* semantics : {"closed", "open", "regular"}) {
    const Json report = json(std::string("dymsum sum tunnel.off cube.off --json --semantics ") + semantics);
    EXPECT_EQ(report["semantics"], semantics);
    EXPECT_EQ(report["volume_exact"], "600/1");
    EXPECT_EQ(report["tight"]["segments"], std::string(semantics) == "regular" ? 0 : 1);
  }
}

TEST_F(AnySolidSum, PartsWithoutVolumeAreTakenWhereAskedFor) {
  work.write("wire.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nl 1 2 3\n");
  work.write("point.obj", "v 1 2 3\np 1\n");
  work.write("sheet.off", "OFF\n4 1 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n");
  EXPECT_EQ(json("dymsum sum cube.off point.obj --thin --json")["volume_exact"], "8/1");
  EXPECT_EQ(json("dymsum sum cube.off wire.obj --thin --json")["volume_exact"], "24/1");
  EXPECT_EQ(json("dymsum nfp cube.off sheet.off --thin --json")["volume_exact"], "32/1");
  EXPECT_EQ(json("dymsum sum cube.off sheet.off wire.obj point.obj --thin --json")["volume_exact"], "64/1");
  const Outcome sheet = work.run("dymsum sum cube.off sheet.off"), wire = work.run("dymsum sum cube.off wire.obj");
  EXPECT_EQ(sheet.code, 2);
  EXPECT_NE(sheet.err.find("--thin"), std::string::npos) << sheet.err;
  EXPECT_EQ(wire.code, 2);
  EXPECT_NE(wire.err.find("--thin"), std::string::npos) << wire.err;
  const Json flat = json("dymsum sum sheet.off wire.obj --thin --json");  // an L, without volume
  EXPECT_EQ(flat["tight"]["faces"], 1);
  EXPECT_EQ(flat["vertices"], 6);
  EXPECT_EQ(flat["faces"], 0);
  EXPECT_EQ(work.run("dymsum info sheet.off").err.find("--thin"), std::string::npos);
}

TEST_F(AnySolidSum, WhatItDoesNotTakeIsRefused) {
  EXPECT_EQ(work.run("dymsum sum tunnel.off cube.off --engine winding").code, 1);
  EXPECT_EQ(work.run("dymsum depth tunnel.off cube.off --axis 0,0,1 --degrees 9").code, 2) << "only convex solids turn";
  // Two cubes that cross in one file.
  work.write("crossing.off",
             "OFF\n16 12 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n1 1 1\n3 1 1\n3 3 1\n1 3 1\n1 1 "
             "3\n3 1 3\n3 3 3\n1 3 3\n"
             "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 8 11 10 9\n4 12 13 14 15\n4 8 9 13 "
             "12\n4 9 10 14 13\n"
             "4 10 11 15 14\n4 11 8 12 15\n");
  const Json failure = json("dymsum sum tunnel.off crossing.off --json", 2);
  EXPECT_EQ(failure["error"]["code"], "faces_cross");
  EXPECT_TRUE(failure["error"]["evidence"].contains("other_face"));
  const std::string remedy = "(--repair=crossings repairs it: what crossed or overlapped united (6 new vertices))";
  EXPECT_NE(work.run("dymsum info crossing.off").err.find(remedy), std::string::npos)
      << work.run("dymsum info crossing.off").err;
  const Outcome repaired = work.run("dymsum convert crossing.off united.off --repair");
  EXPECT_EQ(repaired.err,
            "crossing.off: repaired: what crossed or overlapped united (6 new vertices)\ncrossing.off: repaired: "
            "crossings at (1, 1, 2), (2, 1, 2), (1, 2, 2) and more\n");
  EXPECT_EQ(json("dymsum info united.off --json")["volume"], 15);
  // The same with a body that shares half a face, and one that is turned inside out.
  EXPECT_EQ(json("dymsum sum crossing.off cube.off --repair --json")["volume_exact"],
            json("dymsum sum united.off cube.off --json")["volume_exact"]);
}

}  // namespace
}  // namespace dymsum::cli_test
