// info and convert for solid files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dymsum/dymsum.h"
#include "process.h"

namespace dymsum::cli_test {
namespace {

using Json = nlohmann::json;

class SolidCli : public testing::Test {
 protected:
  SolidCli() {
    work.write("box.off", format_mesh(solids::box(0, 0, 0, 1, 2, 3), MeshFormat::off));
    work.write("cube.obj", format_mesh(solids::tessellated_cube(2, 3), MeshFormat::obj));
  }
  Json json(const std::string& command, int code = 0) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return Json::parse(outcome.out);
  }
  Workplace work;
};

TEST_F(SolidCli, InfoTellsEverything) {
  const Json report = json("dymsum info box.off --json");
  EXPECT_EQ(report["inputs"][0], (Json{{"file", "box.off"}, {"vertices", 8}, {"faces", 6}, {"shells", 1}}));
  EXPECT_EQ(report["tier"], 26);
  EXPECT_EQ(report["bits"], 2);
  EXPECT_TRUE(report["time_ms"].contains("median"));
  EXPECT_EQ(report["valid"], true);
  EXPECT_EQ(report["shells"], 1);
  EXPECT_EQ(report["vertices"], 8);
  EXPECT_EQ(report["edges"], 12);
  EXPECT_EQ(report["faces"], 6);
  EXPECT_EQ(report["triangles"], 12);
  EXPECT_EQ(report["convex"], true);
  EXPECT_FALSE(report.contains("not_convex"));
  EXPECT_EQ(report["volume"], 6.0);
  EXPECT_EQ(report["area"], 22.0);
  EXPECT_EQ(report["bounds"], (std::vector<double>{0, 0, 0, 1, 2, 3}));
  const Outcome human = work.run("dymsum info box.off -o box.glb");
  EXPECT_EQ(human.code, 0) << human.err;
  EXPECT_EQ(human.out,
            "valid, 1 shell, 8 vertices, 12 edges, 6 faces\n  convex\n  bounds [0, 1] x [0, 2] x [0, 3]\n"
            "  volume 6, surface 22\n  2 bits per coordinate, 26-bit integers\n");
  EXPECT_EQ(work.read("box.glb"), format_mesh(solids::box(0, 0, 0, 1, 2, 3), MeshFormat::glb));
}

TEST_F(SolidCli, TierFollowsTheGrid) {
  struct Case {
    double size;
    int bits, tier;
  };
  // the sides are 1, 1 and `size`: 2^-24 and 1 + 2^-52 are units of their own
  for (const Case& c : {Case{0x1p-24, 24, 26}, {0x1p-26, 26, 26}, {0x1p-27, 27, 54}, {1 + 0x1p-52, 53, 54},
                        {0x1p-54, 54, 54}, {0x1p-55, 55, 0}, {1e-30, 147, 0}, {2, 1, 26}}) {
    const Mesh mesh = *scaled(solids::box(0, 0, 0, 1, 1, 1), 1, 1, c.size);
    work.write("x.off", format_mesh(mesh, MeshFormat::off));
    const Json report = json("dymsum info x.off --json");
    EXPECT_EQ(report["bits"], c.bits) << c.size;
    EXPECT_EQ(report["tier"], c.tier) << c.size;
  }
}

TEST_F(SolidCli, WhyASolidIsNotConvex) {
  const Mesh two = *Mesh::create([] {
    MeshData data = solids::box(0, 0, 0, 1, 1, 1).data();
    const MeshData other = solids::box(2, 0, 0, 3, 1, 1).data();
    data.vertices.insert(data.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Face face : other.faces) {
      for (std::uint32_t& v : face) v += 8;
      data.faces.push_back(face);
    }
    return data;
  }());
  work.write("two.ply", format_mesh(two, MeshFormat::ply));
  const Json report = json("dymsum info two.ply --json");
  EXPECT_EQ(report["convex"], false);
  EXPECT_EQ(report["shells"], 2);
  EXPECT_NE(report["not_convex"].get<std::string>().find("several shells"), std::string::npos);
  EXPECT_NE(work.run("dymsum info two.ply").out.find("not convex: face 6: "), std::string::npos);
}

TEST_F(SolidCli, ConvertChainsThroughEveryFormat) {
  const Outcome chain = work.run("dymsum convert cube.obj a.off && dymsum convert a.off b.ply && "
                                 "dymsum convert b.ply c.stl && dymsum convert c.stl d.obj && dymsum convert d.obj e.glb");
  ASSERT_EQ(chain.code, 0) << chain.err;
  const auto mesh = [&](const std::string& file, MeshFormat format) {
    return *Mesh::create(*parse_mesh(work.read(file), format, file));
  };
  EXPECT_EQ(mesh("b.ply", MeshFormat::ply).data(), solids::tessellated_cube(2, 3).data());
  EXPECT_EQ(mesh("d.obj", MeshFormat::obj).faces().size(), 108u);
  EXPECT_EQ(work.read("e.glb").substr(0, 4), "glTF");
  const Json report = json("dymsum convert cube.obj canonical.off --canonical --json");
  EXPECT_EQ(report["faces"], 6);
  EXPECT_EQ(report["output"], "canonical.off");
  EXPECT_EQ(mesh("canonical.off", MeshFormat::off).data(), solids::box(-1, -1, -1, 1, 1, 1).canonical().data());
  EXPECT_EQ(work.run("dymsum convert box.off - --to obj").out,
            format_mesh(solids::box(0, 0, 0, 1, 2, 3), MeshFormat::obj));
}

TEST_F(SolidCli, RepairIsAskedForAndReported) {
  std::string text = work.read("box.off");
  const std::size_t at = text.find("4 0 2 3 1");
  ASSERT_NE(at, std::string::npos);
  work.write("turned.off", text.replace(at, 9, "4 1 3 2 0"));
  const Outcome refused = work.run("dymsum info turned.off");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "not valid (wrong_orientation)\n");
  EXPECT_NE(refused.err.find("turned.off: face 0"), std::string::npos) << refused.err;
  const Json invalid = json("dymsum info turned.off --json", 2);
  EXPECT_EQ(invalid["valid"], false);
  EXPECT_EQ(invalid["error"]["code"], "wrong_orientation");
  const Outcome mended = work.run("dymsum convert turned.off right.off --repair");
  EXPECT_EQ(mended.code, 0);
  EXPECT_EQ(mended.err, "turned.off: repaired: 1 face turned over\n");
  EXPECT_EQ(json("dymsum info right.off --json")["volume"], 6.0);
}

TEST_F(SolidCli, BadFilesAndUsage) {
  work.write("cut.off", "OFF\n8 6 12\n0 0 0\n");
  const Outcome cut = work.run("dymsum info cut.off");
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find("cut.off:3: "), std::string::npos) << cut.err;
  EXPECT_EQ(work.run("dymsum info none.stl").code, 2);
  EXPECT_EQ(work.run("dymsum convert cut.off x.obj").code, 2);
  EXPECT_FALSE(work.exists("x.obj"));
  EXPECT_EQ(work.run("dymsum convert box.off x.wkt").code, 2);
  EXPECT_EQ(work.run("dymsum convert box.off -").code, 2);  // wkt is no format of solids
  EXPECT_EQ(work.run("dymsum info box.off -o box.svg").code, 1);
  EXPECT_EQ(work.run("dymsum info box.glb").code, 2);
}

}  // namespace
}  // namespace dymsum::cli_test
