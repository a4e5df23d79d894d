// info and convert for solid files.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli_fixture.h"
#include "dymsum/dymsum.h"

namespace dymsum::cli_test {
namespace {

class SolidCli : public CliTest {
 protected:
  SolidCli() {
    work.write("box.off", format_mesh(solids::box(0, 0, 0, 1, 2, 3), MeshFormat::off));
    work.write("cube.obj", format_mesh(solids::tessellated_cube(2, 3, solids::kDemoSnap), MeshFormat::obj));
  }
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
  for (const Case& c : {Case{0x1p-24, 24, 26},
                        {0x1p-26, 26, 26},
                        {0x1p-27, 27, 61},
                        {1 + 0x1p-52, 53, 61},
                        {0x1p-61, 61, 61},
                        {0x1p-62, 62, 72},
                        {0x1p-73, 73, 124},
                        {1e-30, 147, 250},
                        {0x1p-250, 250, 250},
                        {0x1p-251, 251, 0},
                        {2, 1, 26}}) {
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
  const Outcome chain = work.run(
      "dymsum convert cube.obj a.off && dymsum convert a.off b.ply && "
      "dymsum convert b.ply c.stl && dymsum convert c.stl d.obj && dymsum convert d.obj e.glb");
  ASSERT_EQ(chain.code, 0) << chain.err;
  const auto mesh = [&](const std::string& file, MeshFormat format) {
    return *Mesh::create(*parse_mesh(work.read(file), format, file));
  };
  EXPECT_EQ(mesh("b.ply", MeshFormat::ply).data(), solids::tessellated_cube(2, 3, solids::kDemoSnap).data());
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
  const Outcome repaired = work.run("dymsum convert turned.off right.off --repair");
  EXPECT_EQ(repaired.code, 0);
  EXPECT_EQ(repaired.err,
            "turned.off: repaired: 1 face turned over\nturned.off: repaired: reversed-faces at (1, 0, 0)\n");
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
  EXPECT_EQ(work.run("dymsum convert box.off x.wkt").code, 1);
  EXPECT_EQ(work.run("dymsum convert box.off -").out, work.read("box.off")) << "off if --to is not given";
  EXPECT_EQ(work.run("dymsum convert box.off - --to wkt").code, 1) << "no format of solids";
  EXPECT_EQ(work.run("dymsum info box.off -o box.svg").code, 1);
  EXPECT_EQ(work.run("dymsum info box.glb").code, 2);
}

TEST_F(SolidCli, SolidsComeFromStandardInput) {
  for (const char* format : {"off", "obj", "ply", "stl"}) {
    const std::string out = std::string("dymsum convert box.off - --to ") + format;
    EXPECT_EQ(work.run(out + " | dymsum info - --from " + format + " --json").code, 0) << format;
    EXPECT_EQ(work.run(out + " | dymsum sum - box.off --from " + format).code, 0) << format;
    EXPECT_EQ(work.run(out + " | dymsum convert - back.off --from " + format + " && dymsum info back.off").code, 0)
        << format;
    if (std::string(format) == "stl") continue;  // binary: nothing to tell it by
    EXPECT_EQ(work.run(out + " | dymsum sum box.off -").code, 0) << format;
    EXPECT_EQ(work.run(out + " | dymsum info -").out, work.run("dymsum info box.off").out) << format;
  }
  work.write("cut.off", "OFF\n8 6 12\n0 0 0\n");
  EXPECT_NE(work.run("dymsum info - < cut.off").err.find("standard input:3: "), std::string::npos);
  EXPECT_EQ(work.run("dymsum sum - - < box.off").code, 1);
  EXPECT_EQ(work.run("echo 'POINT (0 0)' | dymsum sum - box.off").code, 1) << "one planar, one solid";
  EXPECT_EQ(work.run("dymsum info - --from wkt < box.off").code, 2);
  EXPECT_EQ(work.run("dymsum info box.off --from off").code, 1);
}

constexpr const char* kOctahedron =
    "OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n"
    "3 1 2 5\n3 3 1 5\n3 0 3 5\n";

TEST_F(SolidCli, HullTakesWhatIsConvexButForRounding) {
  // A cube whose top has a middle that lies 2^-52 below it.
  work.write("dent.off",
             "OFF\n9 9 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n0.5 0.5 0.99999999999999978\n4 0 2 3 "
             "1\n3 4 5 8\n3 5 7 8\n"
             "3 7 6 8\n3 6 4 8\n4 0 1 5 4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n");
  EXPECT_EQ(work.run("dymsum depth dent.off box.off --axis 0,0,1 --degrees 9").code, 2);
  EXPECT_EQ(json("dymsum sum dent.off box.off --json")["faces"], 6)
      << "the dent is summed exactly, and the box fills it";
  const Outcome sum = work.run("dymsum sum dent.off box.off --hull --json");
  ASSERT_EQ(sum.code, 0) << sum.err;
  EXPECT_NE(sum.err.find("dent.off: convex hull: 1 of 9 vertices inside it, largest deviation 2.22e-16"),
            std::string::npos)
      << sum.err;
  const Json report = Json::parse(sum.out);
  EXPECT_EQ(report["inputs"][0]["hull"], (Json{{"given", 9}, {"inside", 1}, {"deviation", 0x1p-52}}));
  EXPECT_EQ(report["inputs"][0]["vertices"], 8) << "of the hull, which is summed";
  EXPECT_EQ(report["volume"], 24.0);
  const Json hull = json("dymsum hull dent.off cube.off --json");
  EXPECT_EQ(hull["verb"], "hull");
  EXPECT_EQ(hull["faces"], 6);
  EXPECT_EQ(hull["inputs"][0]["hull"]["deviation"], 0x1p-52);
  EXPECT_EQ(work.run("dymsum hull dent.off - | dymsum info -").out.find("not convex"), std::string::npos);
  for (const char* verb : {"nfp", "depth"})
    EXPECT_EQ(work.run(std::string("dymsum ") + verb + " dent.off box.off --hull").code, 0) << verb;
  EXPECT_EQ(work.run("dymsum rotate dent.off box.off --steps 3 --hull").code, 0);
  EXPECT_EQ(work.run("dymsum scale dent.off box.off --at 1,2 --hull").code, 0);
  // Points without faces, and a flat set of them.
  EXPECT_EQ(
      work.run("printf 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nv 0 0 1\\n' | dymsum hull - points.off && dymsum info points.off")
          .code,
      0);
  EXPECT_EQ(work.run("printf 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\n' | dymsum hull - flat.off").code, 2);
  work.write("square.wkt", kSquare);
  EXPECT_EQ(work.run("dymsum sum square.wkt square.wkt --hull").code, 1);
  EXPECT_EQ(work.run("dymsum info dent.off --hull --repair").code, 1);
}

TEST_F(SolidCli, SumsChainAndAreReadBack) {
  work.write("octahedron.off", kOctahedron);
  work.write(
      "third.off",
      "OFF\n4 4 0\n0.1 0.2 0.3\n1.1 0.1 0.30000001\n0.2 1.3 0.1\n0.3 0.4 1.7\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Json at_once = json(
      "dymsum sum box.off octahedron.off third.off box.off --json -o all.off -o all.ply -o all.obj -o all.stl -o "
      "all.glb");
  EXPECT_EQ(at_once["inputs"].size(), 4u);
  for (const char* file : {"all.off", "all.ply", "all.obj"}) {
    const Json back = json(std::string("dymsum info ") + file + " --json");
    EXPECT_EQ(back["convex"], true) << file << ": facets of rounded sums are plane";
    EXPECT_NEAR(back["volume"].get<double>(), at_once["volume"].get<double>(), 1e-9);
  }
  EXPECT_EQ(json("dymsum info all.stl --json")["convex"], true) << "in single precision, too";
  // The same sum through files and pipes, and in another order: rounded once each, so equal where all sums are doubles.
  work.run("dymsum sum box.off octahedron.off -o - --to ply | dymsum sum - box.off -o two.off");
  work.run("dymsum sum box.off box.off octahedron.off -o three.off");
  EXPECT_EQ(work.read("two.off").substr(0, 40), work.read("three.off").substr(0, 40));
  EXPECT_EQ(json("dymsum sum two.off third.off --json")["volume_exact"], at_once["volume_exact"]);
  work.write("square.wkt", kSquare);
  EXPECT_EQ(work.run("dymsum sum square.wkt square.wkt square.wkt").code, 0) << "in the plane, too";
  EXPECT_EQ(work.run("dymsum nfp box.off box.off box.off").code, 1);
}

TEST_F(SolidCli, SumsThatRoundingCollapsesAreTheHullOfWhatIsLeft) {
  work.write("far.off",
             "OFF\n8 6 0\n1125899906842624 1125899906842624 1125899906842624\n1125899906842625 1125899906842624 "
             "1125899906842624\n"
             "1125899906842625 1125899906842625 1125899906842624\n1125899906842624 1125899906842625 1125899906842624\n"
             "1125899906842624 1125899906842624 1125899906842625\n1125899906842625 1125899906842624 1125899906842625\n"
             "1125899906842625 1125899906842625 1125899906842625\n1125899906842624 1125899906842625 1125899906842625\n"
             "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  work.write("tiny.off", "OFF\n4 4 0\n0 0 0\n1e-9 0 0\n0 1e-9 0\n0 0 1e-9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const std::string file : {"s.off", "s.obj", "s.ply"}) {
    const Outcome written = work.run("dymsum sum far.off tiny.off -o " + file);
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_NE(written.err.find(file + ": round"), std::string::npos) << written.err;
    EXPECT_EQ(json("dymsum info " + file + " --json")["volume"], 1.0);
  }
  for (const std::string file : {"s.stl", "s.glb"}) {  // in single precision nothing is left
    const Outcome refused = work.run("dymsum sum far.off tiny.off -o " + file);
    EXPECT_EQ(refused.code, 2) << file;
    EXPECT_NE(refused.err.find(file), std::string::npos) << refused.err;
    EXPECT_FALSE(work.exists(file));
  }
  EXPECT_EQ(work.run("dymsum sum far.off tiny.off -o s.json").code, 0) << "exact";
  const Outcome hull = work.run("dymsum sum far.off tiny.off --hull -o s.off");
  EXPECT_EQ(hull.code, 0);
  EXPECT_NE(hull.err.find("s.off: rounded, "), std::string::npos) << hull.err;
  EXPECT_EQ(json("dymsum info s.off --json")["volume"], 1.0);
  work.write(
      "near.off",
      "OFF\n4 4 0\n1 1 1\n1.000000001 1 1\n1 1.000000001 1\n1 1 1.000000001\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const char* file : {"n.stl", "n.glb", "- --to stl", "- --to glb"})
    EXPECT_EQ(work.run(std::string("dymsum convert near.off ") + file).code, 2) << file;
  EXPECT_EQ(work.run("dymsum info near.off -o n.glb").code, 2);
  EXPECT_EQ(work.run("dymsum convert near.off n.ply").code, 0);
}

TEST_F(SolidCli, PlanarPicturesAreReadBackAlsoWhereRoundingBendsEdges) {
  work.write("far.wkt",
             "POLYGON ((1125899906842624 1125899906842624, 1125899906842625 1125899906842624, 1125899906842625 "
             "1125899906842625, 1125899906842624 1125899906842625, 1125899906842624 1125899906842624))");
  work.write("tiny.wkt", "POLYGON ((0 0, 1e-9 0, 0 1e-9, 0 0))");
  const Outcome snapped = work.run("dymsum sum far.wkt tiny.wkt -o s.wkt");
  EXPECT_EQ(snapped.code, 0);
  EXPECT_NE(snapped.err.find("rounding: 1 vertex merged"), std::string::npos) << snapped.err;
  EXPECT_EQ(work.run("dymsum info s.wkt").code, 0);
  const Outcome picture = work.run("dymsum sum far.wkt tiny.wkt -o s.svg");
  EXPECT_EQ(picture.code, 0);
  EXPECT_EQ(picture.err, snapped.err);
  EXPECT_EQ(work.run("dymsum convert s.svg back.wkt").code, 0);
  EXPECT_EQ(work.read("back.wkt"), work.read("s.wkt"));
  EXPECT_EQ(work.run("dymsum sum tiny.wkt tiny.wkt -o s.svg").err, "");
}

TEST_F(SolidCli, PlanarPicturesAreTitledByWhatTheyShow) {
  work.write("square.wkt", kSquare);
  const auto title = [&](const std::string& verb, const std::string& is) {
    ASSERT_EQ(work.run("dymsum " + verb + " -o titled.svg").code, 0) << verb;
    EXPECT_NE(work.read("titled.svg").find(">" + is + "<"), std::string::npos) << verb;
  };
  title("sum square.wkt square.wkt", "P ⊕ Q");
  title("nfp square.wkt square.wkt", "A ⊕ −B");
  title("erode square.wkt square.wkt", "P ⊖ Q");
  title("slice square.wkt square.wkt --tan-half 0", "O ⊕ −R(θ)");
}

TEST_F(SolidCli, TrianglesForProgramsThatTakeNoOtherFaces) {
  EXPECT_EQ(json("dymsum convert box.off t.off --triangulate --json")["faces"], 12);
  EXPECT_EQ(json("dymsum info t.off --json")["volume"], 6.0);
  EXPECT_EQ(work.run("dymsum sum box.off box.off -o t.ply --triangulate").code, 0);
  EXPECT_EQ(json("dymsum info t.ply --json")["faces"], 12);
  EXPECT_EQ(work.run("dymsum hull box.off t.obj --triangulate").code, 0);
  work.write("square.wkt", kSquare);
  EXPECT_EQ(work.run("dymsum convert square.wkt s.poly --triangulate").code, 1);
  EXPECT_EQ(work.run("dymsum sum square.wkt square.wkt --triangulate").code, 1);
}

// A cube of side 2^k has volume 2^3k and surface 6 2^2k.
TEST_F(SolidCli, VolumesAndSurfacesOutsideTheRangeOfDoublesAreText) {
  const auto cube = [](double s) {
    return format_mesh(scaled(solids::box(0, 0, 0, 1, 1, 1), s, s, s).value(), MeshFormat::off);
  };
  work.write("huge.off", cube(0x1p400));
  work.write("tiny.off", cube(0x1p-400));
  work.write("flea.off", cube(0x1p-532));
  EXPECT_EQ(json("dymsum info huge.off --json")["volume"], "1.7218479456385751e+361");
  EXPECT_EQ(json("dymsum info tiny.off --json")["volume"], "5.8077137562175032e-362");
  EXPECT_EQ(json("dymsum info tiny.off --json")["area"], 6 * 0x1p-800);
  EXPECT_TRUE(json("dymsum info flea.off --json")["area"].is_string()) << "6 2^-1064 is no normal double";
  const Json sum = json("dymsum sum tiny.off tiny.off --json");
  EXPECT_EQ(sum["volume"], "4.6461710049740025e-361");
  EXPECT_EQ(json("dymsum sum huge.off huge.off --json")["area"], 24 * 0x1p800);
  EXPECT_NE(work.run("dymsum sum huge.off huge.off").out.find("volume 1.3774783565108600e+362"), std::string::npos);
  EXPECT_NE(work.run("dymsum info huge.off").out.find("volume 1.7218479456385751e+361"), std::string::npos);
}

}  // namespace
}  // namespace dymsum::cli_test
