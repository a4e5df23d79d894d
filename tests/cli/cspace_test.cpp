// The verbs slice and cspace, and rotate with planar operands: keys, exit codes, files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class CspaceCli : public CliTest {
 protected:
  CspaceCli() {
    work.write("peg.wkt", kPeg);
    work.write("slot.wkt", kSlot);
    work.write("rod.wkt", "POLYGON ((-1 -0.25, 1 -0.25, 1 0.25, -1 0.25, -1 -0.25))\n");
    work.write("cage.wkt", "POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0), (1 1, 1 5, 5 5, 5 1, 1 1))\n");
    work.write("line.wkt", "LINESTRING(0 0,1 1,2 0)\n");
    work.write("none.wkt", "POLYGON EMPTY\n");
    work.write("bad.wkt", "POLYGON ((0 0, 1 0\n");
    work.write("cube.off", kTetrahedron);
  }
};

TEST_F(CspaceCli, SliceIsASumWithItsOrientation) {
  const Json slice = json("dymsum slice peg.wkt slot.wkt --tan-half 0 --json");
  const Json nfp = json("dymsum nfp slot.wkt peg.wkt --json");
  for (const auto& [key, value] : nfp.items()) EXPECT_TRUE(slice.contains(key)) << key;
  for (const char* key : {"outer", "holes", "vertices", "area_exact", "tight", "convolution"})
    EXPECT_EQ(slice[key], nfp[key]) << key;
  EXPECT_EQ(slice["inputs"][0]["file"], "peg.wkt");
  EXPECT_EQ(slice["orientation"]["tan_half"], "0/1");
  EXPECT_EQ(slice["tight"]["segments"], 1) << "the peg is as wide as the slot";
  EXPECT_EQ(json("dymsum slice peg.wkt slot.wkt --tan-half 0 --semantics regular --json")["tight"]["segments"], 0);
  const Json third = json("dymsum slice peg.wkt slot.wkt --tan-half 1/3 --json");
  EXPECT_EQ(third["area_exact"], "1353/40");
  EXPECT_NEAR(third["orientation"]["theta"].get<double>(), 2 * std::atan(1.0 / 3), 1e-15);
  const Json half = json("dymsum slice peg.wkt slot.wkt --tan-half inf --json");
  EXPECT_EQ(half["orientation"]["tan_half"], "inf");
}

TEST_F(CspaceCli, EveryEngineGivesTheSameSlice) {
  const Json fast = json("dymsum slice rod.wkt cage.wkt --tan-half 2/7 --json");
  EXPECT_EQ(fast["holes"], 1);
  for (const char* engine : {"brute", "winding"}) {
    const Json other = json(std::string("dymsum slice rod.wkt cage.wkt --tan-half 2/7 --json --engine ") + engine);
    EXPECT_EQ(other["area_exact"], fast["area_exact"]) << engine;
  }
}

TEST_F(CspaceCli, AnAngleIsMetWithinItsError) {
  const Json close = json("dymsum slice peg.wkt slot.wkt --angle 0.5 --json");
  const Json rough = json("dymsum slice peg.wkt slot.wkt --angle 0.5 --error 1e-2 --json");
  EXPECT_NEAR(close["orientation"]["theta"].get<double>(), 0.5, 1e-15);
  EXPECT_NEAR(rough["orientation"]["theta"].get<double>(), 0.5, 1e-2);
  EXPECT_LT(rough["orientation"]["tan_half"].get<std::string>().size(), 8u);
}

TEST_F(CspaceCli, SliceWritesWhatSumWrites) {
  const std::string files = " -o s.svg -o stages.svg -o s.json -o s.wkt -o s.poly -o s.geojson";
  ASSERT_EQ(work.run("dymsum slice rod.wkt cage.wkt --tan-half 1/2" + files).code, 0);
  EXPECT_EQ(Json::parse(work.read("s.json"))["parts"].size(), 1u);
  EXPECT_EQ(json("dymsum info s.wkt --json")["shapes"][0]["holes"], 1);
  const Outcome out = work.run("dymsum slice rod.wkt cage.wkt --tan-half 1/2 -o - --to wkt");
  EXPECT_EQ(out.out, work.read("s.wkt"));
}

TEST_F(CspaceCli, CspacePrintsEveryKeyOfTheContract) {
  const Json report = json("dymsum cspace rod.wkt cage.wkt --repeat 2 --json");
  for (const char* key :
       {"inputs", "tier", "time_ms", "patches_before_trim", "patches", "shells", "angles", "events", "free_components"})
    EXPECT_TRUE(report.contains(key)) << key;
  for (const char* key : {"alignment", "vertex_on_segment", "three_segments", "tight"})
    EXPECT_TRUE(report["events"].contains(key)) << key;
  ASSERT_EQ(report["shells"].size(), 2u);
  int cavities = 0;
  for (const Json& shell : report["shells"]) {
    for (const char* key : {"kind", "patches", "euler", "component"}) EXPECT_TRUE(shell.contains(key)) << key;
    EXPECT_EQ(shell["euler"], 0) << "a torus: the turn closes";
    cavities += shell["kind"] == "cavity";
  }
  EXPECT_EQ(cavities, 1);
  EXPECT_EQ(report["free_components"], 2);
  EXPECT_EQ(report["angles"], 4);
  EXPECT_FALSE(report.contains("mesh")) << "no mesh was asked for";
  EXPECT_NE(work.run("dymsum cspace rod.wkt cage.wkt").out.find("1 outer shell, 1 cavity"), std::string::npos);
}

TEST_F(CspaceCli, CspaceFilesHoldPatchesSlicesAndAClosedMesh) {
  const Json report = json("dymsum cspace rod.wkt cage.wkt -o c.json -o c.svg -o c.glb --slices 7 --json");
  EXPECT_EQ(report["mesh"]["watertight"], true);
  EXPECT_EQ(report["mesh"]["open_edges"], 0);
  const Json file = Json::parse(work.read("c.json"));
  EXPECT_EQ(file["patches"].size(), report["patches"]);
  EXPECT_EQ(file["angles"].size(), report["angles"]);
  std::size_t events = 0;
  for (const auto& [kind, n] : report["events"].items()) events += n.get<std::size_t>();
  EXPECT_EQ(file["events"].size(), events);
  EXPECT_EQ(file["angles"][3]["tan_half"], "inf") << "half a turn is an alignment";
  for (const Json& p : file["patches"]) {
    for (const char* key : {"contact", "left", "right", "theta0", "theta1", "shell"})
      ASSERT_TRUE(p.contains(key)) << key;
    EXPECT_LE(p["theta0"]["low"], p["theta0"]["theta"]);
    EXPECT_TRUE(p["contact"]["kind"] == "vertex_on_edge" || p["contact"]["kind"] == "edge_on_vertex");
  }
  EXPECT_EQ(count("c.svg", "<path"), 7u);
  EXPECT_EQ(count("c.svg", "tan θ/2 = "), 7u);
}

/// The corners of all triangles of a GLB file, their colours, and what is noted in it.
struct Glb {
  Json json;
  std::vector<std::array<float, 3>> corners, lights;
};

Glb read_glb(const std::string& bytes) {
  Glb glb;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  glb.json = Json::parse(bytes.substr(20, length));
  const auto start = [&](std::size_t accessor) {
    return 28 + length +
           glb.json["bufferViews"][glb.json["accessors"][accessor]["bufferView"].get<std::size_t>()]["byteOffset"]
               .get<std::size_t>();
  };
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  const std::size_t indices = primitive["indices"];
  for (std::size_t k = 0; k < glb.json["accessors"][indices]["count"]; ++k) {
    std::uint32_t index = 0;
    std::memcpy(&index, bytes.data() + start(indices) + 4 * k, 4);
    for (const auto& [list, name] : {std::pair{&glb.corners, "POSITION"}, std::pair{&glb.lights, "COLOR_0"}}) {
      list->emplace_back();
      std::memcpy(list->back().data(), bytes.data() + start(primitive["attributes"][name]) + 12 * index, 12);
    }
  }
  return glb;
}

using Corner = std::array<float, 3>;
std::map<std::pair<Corner, Corner>, int> edge_uses(const Glb& glb) {
  std::map<std::pair<Corner, Corner>, int> uses;
  for (std::size_t k = 0; k < glb.corners.size(); ++k) {
    const Corner &a = glb.corners[k], &b = glb.corners[k % 3 == 2 ? k - 2 : k + 1];
    if (a != b) ++uses[{a, b}];
  }
  return uses;
}

TEST_F(CspaceCli, TheGlbIsClosedBitByBitAndSaysHowToReadIt) {
  ASSERT_EQ(work.run("dymsum cspace rod.wkt cage.wkt -o c.glb --tolerance 0.01").code, 0);
  const Glb glb = read_glb(work.read("c.glb"));
  for (const char* note : {"z", "planes", "colours", "error", "closed"})
    EXPECT_TRUE(glb.json["asset"]["extras"].contains(note)) << note;
  EXPECT_EQ(glb.json["asset"]["extras"]["closed"], "yes");
  EXPECT_EQ(glb.json["materials"][0]["doubleSided"], true);
  const std::set<Corner> lights(glb.lights.begin(), glb.lights.end());
  EXPECT_EQ(lights.size(), 4u) << "two kinds outside, one in the cavity, and the caps";
  float low = 0, high = 0;
  double cap = 0;
  for (std::size_t k = 0; k < glb.corners.size(); k += 3) {
    const Corner &a = glb.corners[k], &b = glb.corners[k + 1], &c = glb.corners[k + 2];
    low = std::min(low, a[2]), high = std::max(high, a[2]);
    if (a[2] == b[2] && a[2] == c[2] && a[2] > 3)
      cap += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  EXPECT_FLOAT_EQ(high - low, 6 + 2 * std::hypot(1.0f, 0.25f)) << "as high as wide";
  EXPECT_NEAR(cap, json("dymsum slice rod.wkt cage.wkt --tan-half inf --json")["area"], 1e-4) << "the cap is the slice";
  const auto uses = edge_uses(glb);
  for (const auto& [edge, n] : uses) {
    ASSERT_EQ(n, 1) << "an edge is used twice in a direction";
    ASSERT_TRUE(uses.contains({edge.second, edge.first})) << "an edge is open";
  }
}

TEST_F(CspaceCli, OpenLeavesTheCapsOut) {
  ASSERT_EQ(work.run("dymsum cspace rod.wkt cage.wkt -o c.glb --tolerance 0.01 && dymsum cspace rod.wkt cage.wkt -o "
                     "o.glb --tolerance 0.01 --open")
                .code,
            0);
  const Glb closed = read_glb(work.read("c.glb")), open = read_glb(work.read("o.glb"));
  EXPECT_LT(open.corners.size(), closed.corners.size());
  const auto uses = edge_uses(open);
  EXPECT_TRUE(std::any_of(uses.begin(), uses.end(), [&](const auto& use) {
    return !uses.contains({use.first.second, use.first.first});
  }));
}

TEST_F(CspaceCli, RotateFollowsPlanarOperands) {
  const Json report = json("dymsum rotate peg.wkt slot.wkt --steps 8 --json -o r.svg -o r.anim.svg");
  for (const char* key : {"inputs", "tier", "time_ms", "frames", "static_ms", "update_ms"})
    EXPECT_TRUE(report.contains(key)) << key;
  ASSERT_EQ(report["frames"].size(), 8u);
  for (const char* key : {"theta", "tan_half", "outer", "holes", "vertices", "area_exact", "update_ms"})
    EXPECT_TRUE(report["frames"][0].contains(key)) << key;
  for (int k = 0; k < 8; ++k) {
    const double theta = report["frames"][k]["theta"];
    EXPECT_LE(std::abs(std::remainder(theta - k * std::acos(-1.0) / 4, 2 * std::acos(-1.0))), 1e-6) << k;
  }
  EXPECT_EQ(report["frames"][0]["area_exact"], json("dymsum sum peg.wkt slot.wkt --json")["area_exact"]);
  EXPECT_EQ(report["frames"][2]["tan_half"], "1/1") << "a quarter turn is exact";
  EXPECT_EQ(report["frames"][4]["tan_half"], "inf");
  EXPECT_EQ(count("r.svg", "fill=\"#9ecae1\""), 8u);
  EXPECT_EQ(count("r.anim.svg", "class=\"frame\""), 8u);
  const std::string more = " --error 1e-3 --semantics regular --json";
  const Json quarter = json("dymsum rotate peg.wkt slot.wkt --steps 2 --degrees 180" + more);
  EXPECT_EQ(quarter["frames"][1]["tan_half"], "1/1");
  EXPECT_EQ(quarter["frames"][0]["tight"]["segments"], 0);
}

TEST_F(CspaceCli, WrongUsageIsTold) {
  all_refused({"dymsum slice peg.wkt slot.wkt", "dymsum slice peg.wkt slot.wkt --tan-half 1 --angle 1",
               "dymsum slice peg.wkt slot.wkt --tan-half one", "dymsum slice peg.wkt slot.wkt --tan-half 0/0",
               "dymsum slice peg.wkt slot.wkt --angle nan", "dymsum slice peg.wkt slot.wkt --angle 1 --error 0",
               "dymsum slice peg.wkt slot.wkt --tan-half 1 --error 1e-3", "dymsum slice cube.off cube.off --tan-half 1",
               "dymsum slice peg.wkt cube.off --tan-half 1", "dymsum cspace peg.wkt",
               "dymsum cspace peg.wkt slot.wkt --tolerance 0", "dymsum cspace peg.wkt slot.wkt --slices 0",
               "dymsum cspace cube.off cube.off", "dymsum rotate peg.wkt slot.wkt",
               "dymsum rotate peg.wkt slot.wkt --steps 4 --axis 0,0,1",
               "dymsum rotate peg.wkt slot.wkt --steps 4 --error 0",
               "dymsum rotate peg.wkt slot.wkt --steps 4 -o last.glb",
               "dymsum rotate cube.off cube.off --steps 4 --error 1e-3", "dymsum cspace peg.wkt slot.wkt -o c.off"});
}

TEST_F(CspaceCli, BadInputNamesItsFileAndLeavesNoOutput) {
  work.write("c.glb", "older\n");
  const std::size_t files = work.file_count();
  for (const auto& [command, named] : std::vector<std::pair<std::string, std::string>>{
           {"dymsum cspace line.wkt line.wkt -o c.glb", "line.wkt"},
           {"dymsum cspace rod.wkt none.wkt -o c.glb", "none.wkt"},
           {"dymsum cspace rod.wkt missing.wkt -o c.glb", "missing.wkt"},
           {"dymsum cspace bad.wkt cage.wkt -o c.json -o c.glb", "bad.wkt"},
           {"dymsum slice bad.wkt cage.wkt --tan-half 1 -o s.svg", "bad.wkt"},
           {"dymsum rotate bad.wkt cage.wkt --steps 3 -o r.svg", "bad.wkt"},
           {"dymsum cspace rod.wkt cage.wkt -o nowhere/c.glb", "nowhere"}}) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, 2) << command << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
  }
  EXPECT_EQ(work.read("c.glb"), "older\n");
  EXPECT_EQ(work.file_count(), files) << "no half-written and no temporary files";
}

TEST_F(CspaceCli, CtrlCEndsWith130AndLeavesNoFile) {
  const Outcome outcome = work.run(
      "timeout --foreground --preserve-status -s INT 0.5 dymsum cspace rod.wkt cage.wkt --repeat 10000000 -o c.glb "
      "-o c.svg");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(outcome.err, "dymsum: interrupted\n");
  EXPECT_FALSE(work.exists("c.glb") || work.exists("c.svg"));
}

}  // namespace
}  // namespace dymsum::cli_test
