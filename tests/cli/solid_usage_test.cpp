// What verbs of solids say of files that they cannot use, of results that no file holds, and of their own options.
#include <array>
#include <regex>
#include <string>
#include <vector>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

constexpr const char* kEll =
    "OFF\n12 8 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n0 2 1\n6 5 4 3 2 1 0\n"
    "6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n";

class SolidUsage : public CliTest {
 protected:
  SolidUsage() {
    work.write("cube.off", kCube);
    work.write("ell.off", kEll);
    work.write("wedge.off", kTetrahedron);
    work.write("square.wkt", kSquare);
  }
  /// The command ends with this code, and says so on standard error.
  void says(const std::string& command, int code, const std::string& text) const {
    const Outcome outcome = work.run("dymsum " + command + " </dev/null");
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << command << "\n" << outcome.err;
  }
};

TEST_F(SolidUsage, NumbersOfOptionsAreNumbersWithinTheirRange) {
  for (const char* verb :
       {"sum ell.off cube.off", "nfp ell.off cube.off", "erode cube.off wedge.off", "opening cube.off wedge.off",
        "closing cube.off wedge.off", "offset cube.off --by 1", "slice cube.off wedge.off --z 0"})
    for (const char* megabytes : {"nan", "inf", "-inf", "0", "-1", "1e400", "0x10", "' 5'", "many"})
      refused(std::string("dymsum ") + verb + " --memory=" + megabytes,
              "--memory wants a number from 1 to 1e+09, not '");
  refused("dymsum offset cube.off --by 0x1p0", "--by wants a number");
}

TEST_F(SolidUsage, AMemoryLimitIsOfEveryVerbThatComputesASum) {
  std::string vertices, faces;  // many wedges in a row
  for (int k = 0; k < 60; ++k) {
    const std::string x = std::to_string(8 * k);
    vertices += x + " 0 0\n" + std::to_string(8 * k + 3 + k % 4) + " " + std::to_string(k % 3) + " 0\n" + x + " 4 " +
                std::to_string(k % 5) + "\n" + std::to_string(8 * k + k % 3) + " 1 5\n";
    for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
      faces += "3 " + std::to_string(4 * k + f[0]) + " " + std::to_string(4 * k + f[1]) + " " +
               std::to_string(4 * k + f[2]) + "\n";
  }
  work.write("many.off", "OFF\n240 240 0\n" + vertices + faces);
  for (const char* verb : {"sum many.off many.off", "erode many.off many.off", "opening many.off many.off",
                           "closing many.off many.off", "offset many.off --by 0.5", "slice many.off many.off --z 2"}) {
    const Json failure = json(std::string("dymsum ") + verb + " --memory 1 --json", 2)["error"];
    EXPECT_EQ(failure["code"], "out_of_memory") << verb;
    EXPECT_NE(failure["message"].get<std::string>().find("memory"), std::string::npos) << verb;
    const std::string name = std::string(verb).substr(0, std::string(verb).find(' '));
    const std::string begin = name == "sum" ? "the sum " : name == "slice" ? "the slice " : "in this " + name + ", ";
    EXPECT_EQ(failure["message"].get<std::string>().find(begin), 0u) << failure["message"];
  }
}

TEST_F(SolidUsage, ExtensionsThatNothingReadsAreBadInputThatNamesTheFile) {
  for (const char* command : {"sum cube.off part.step", "sum part.step cube.off", "sum part.step part.step",
                              "sum cube.off cube.off part.step", "nfp part.step square.wkt", "erode part.step cube.off",
                              "opening cube.off part.step", "closing part.step cube.off", "offset part.step --by 1",
                              "slice part.step part.step --z 0", "slice cube.off part.step --z 0",
                              "depth part.step cube.off", "contains cube.off part.step --at 0,0,0",
                              "rotate part.step cube.off --steps 2", "scale part.step part.step --at 1",
                              "info part.step", "convert part.step out.off", "convert part.step out.doc"}) {
    says(command, 2, "part.step: the extension is none of .poly, .wkt");
    says(command, 2, ".off, .obj, .stl, .ply, .glb, .3mf");
  }
  says("hull part.step out.off", 2, "part.step: the extension is none of .off, .obj, .stl, .ply, .glb, .3mf");
  work.run("mkdir folder");
  says("sum cube.off folder", 2, "folder: this is a directory");
}

TEST_F(SolidUsage, OperandsOfTheWrongKindAreNamed) {
  says("sum cube.off square.wkt", 1, "cube.off is a solid and square.wkt is not");
  says("sum cube.off cube.off square.wkt", 1, "square.wkt is not");
  says("offset square.wkt --by 1", 1,
       "is for solids: .off .obj .stl .ply .glb .3mf, or an exact result of them, .json, not square.wkt");
  says("opening square.wkt square.wkt --round-between", 1, "--round-between is for solids");
  says("depth ell.off cube.off --axis 0,0,1 --degrees 9", 2,
       "only convex solids are taken; --hull takes the convex hull");
}

TEST_F(SolidUsage, FilesWithVerticesAloneSaySo) {
  work.write("cloud.off", "OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  work.write("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  work.write(
      "cloud.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  for (const std::string file : {"cloud.off", "cloud.obj", "cloud.ply"}) {
    for (const std::string& verb :
         {"info " + file, "convert " + file + " out.off", "sum " + file + " cube.off", "erode cube.off " + file,
          "opening " + file + " cube.off", "offset " + file + " --by 1", "slice " + file + " cube.off --z 0",
          "depth " + file + " cube.off", "contains cube.off " + file + " --at 0,0,0"}) {
      says(verb, 2, file + ": vertex 0: the file holds vertices and no faces (--hull takes the convex hull of points)");
      if (verb.find("slice") != 0 && verb.find("sum") != 0) continue;
      says(verb + " --repair", 0,
           file +
               ": repaired: 4 unused vertices dropped; it holds no face with an area, and is taken as the empty solid");
    }
    EXPECT_EQ(json("dymsum hull " + file + " hull.off --json")["faces"], 4) << file;
  }
  work.write("none.stl", "solid x\nendsolid x\n");
  says("info none.stl --repair", 0, "none.stl: nothing to repair; it holds no face with an area");
  says("info none.stl --hull", 2, "none.stl: there are no points to take the hull of");
  for (const char* verb : {"erode cube.off none.stl", "opening cube.off none.stl", "closing ell.off none.stl"})
    says(verb, 2, "none.stl: every position holds the empty solid");
  work.write("spare.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n7 7 7\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  says(
      "info spare.off", 2,
      "vertex 4: no face uses this vertex (--repair=unused-vertices repairs it: 1 unused vertex dropped) at (7, 7, 7)");
  EXPECT_EQ(work.run("dymsum info cube.off --repair").err, "");
}

TEST_F(SolidUsage, WhatCrossesOnceRoundedIsMergedAndReported) {
  work.write("speck.off", "OFF\n4 4 0\n0 0 0\n1e-18 0 0\n0 1e-18 0\n0 0 1e-18\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const char* verb : {"sum ell.off speck.off", "erode ell.off speck.off", "offset ell.off --by 1e-17"}) {
    for (const std::string file : {"r.off", "r.obj", "r.ply", "r.stl"})
      says(std::string(verb) + " -o " + file, 0, file + ": rounding: ");
    EXPECT_EQ(
        work.run("dymsum info r.off && dymsum convert r.off s.off && dymsum convert s.off t.off && cmp s.off t.off")
            .code,
        0)
        << verb;
    EXPECT_GT(json(std::string("dymsum ") + verb + " -o r.off --json")["rounding"]["distance"], 0) << verb;
    EXPECT_EQ(work.run(std::string("dymsum ") + verb + " -o r.glb -o r.json").code, 0) << verb;
    EXPECT_EQ(work.read("r.glb").substr(0, 4), "glTF");
  }
  work.write(
      "near.off",
      "OFF\n4 4 0\n1 1 1\n1.000000001 1 1\n1 1.000000001 1\n1 1 1.000000001\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const char* command : {"convert near.off n.stl", "convert near.off n.glb", "info near.off -o n.glb"})
    says(command, 2, "(.off, .obj, .ply and .3mf hold it)");
}

TEST_F(SolidUsage, DanglingLinksAreOutputs) {
  EXPECT_EQ(work.run("ln -s there.off link.off && dymsum sum cube.off wedge.off -o link.off && test -L link.off && "
                     "dymsum info there.off && ln -s missing/x.off lost.off && ln -s b.off a.off && ln -s a.off b.off")
                .code,
            0);
  work.run("rm there.off");
  refused("dymsum sum cube.off wedge.off -o link.off -o there.off", "-o there.off is given twice");
  says("convert cube.off lost.off", 2, "lost.off: no file can be made at missing/x.off, where it leads");
  says("convert cube.off a.off", 2, "a.off: symbolic links lead from it round in a circle");
  EXPECT_EQ(work.run("test -L lost.off && test -L a.off && test -L b.off").code, 0);
}

TEST_F(SolidUsage, StandardInputIsToldFromItsFirstWord) {
  const std::string mark = "\xEF\xBB\xBF",
                    obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string off = kTetrahedron, after = off.substr(3);
  std::string returns = "# a comment\n" + off;
  for (char& c : returns) c = c == '\n' ? '\r' : c;
  for (const std::string& text :
       {mark + off, "\n \n# one\n# two\n\n" + off, "off" + after, "Off" + after, mark + "\r\n" + off, returns,
        "# one\n\nmtllib x.mtl\no part\n" + obj, "g part\n" + obj, "usemtl grey\n" + obj, mark + obj}) {
    work.write("text", text);
    const Outcome outcome = work.run("dymsum info - < text");
    EXPECT_EQ(outcome.code, 0) << text << outcome.err;
    EXPECT_NE(outcome.out.find("4 vertices"), std::string::npos) << text << outcome.out;
  }
  EXPECT_EQ(work.run("dymsum convert cube.off - --to ply | sed '1s/ply/PLY/' | dymsum info -").code, 0);
  EXPECT_EQ(work.run("printf 'SOLID a\\nENDSOLID a\\n' | dymsum info -").code, 0);
  work.write("places", "# where\r1,1,1\r9,9,9\r");
  EXPECT_EQ(json("dymsum contains cube.off cube.off --at-file places --json")["answers"].size(), 2u);
}

TEST_F(SolidUsage, HelpSaysWhatIsForWhichOperands) {
  const auto help = [&](const std::string& verb) { return work.run("dymsum " + verb + " --help").out; };
  const std::string offset = help("offset");
  for (const char* planar : {"FILE#NAME", "wkt", "area_exact", "collinear", "Solids:"})
    EXPECT_EQ(offset.find(planar), std::string::npos) << "offset has no " << planar << "\n" << offset;
  const std::string erode = help("erode"), slice = help("slice"), sum = help("sum");
  for (const char* option : {"--thin", "--triangulate"}) {
    EXPECT_EQ(erode.find(option), std::string::npos) << erode;
    EXPECT_EQ(slice.find(option), std::string::npos) << slice;
    EXPECT_NE(sum.find(option), std::string::npos) << sum;
  }
  EXPECT_EQ(slice.find(".ply (rounded)"), std::string::npos) << slice;
  EXPECT_NE(sum.find("of solids .off .obj .stl .ply .3mf (rounded)"), std::string::npos) << sum;
  EXPECT_TRUE(std::regex_search(slice, std::regex("--semantics[^\\n]*\\n *Planar operands: closed"))) << slice;
}

TEST_F(SolidUsage, ErodedSolidsHaveSemantics) {
  EXPECT_EQ(json("dymsum erode cube.off cube.off --json")["tight"]["points"], 1);
  EXPECT_EQ(json("dymsum erode cube.off cube.off --semantics open --json")["tight"]["points"], 1);
  EXPECT_EQ(json("dymsum erode cube.off cube.off --semantics regular --json", 4)["tight"]["points"], 0);
}

}  // namespace
}  // namespace dymsum::cli_test
