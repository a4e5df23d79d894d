// contains with solid operands; what a sum is expected to take, and the limit of what it may.
#include "cli_fixture.h"
#include "dymsum/mesh_io.h"
#include "dymsum/solids.h"

namespace dymsum::cli_test {
namespace {

class SolidContains : public CliTest {
 protected:
  SolidContains() {
    work.write("cube.off", kCube);
    // two cubes of side 2, side by side with a gap of 2: where a cube just fits in between
    work.write("two.off",
               "OFF\n16 12 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n3 -1 -1\n5 -1 -1\n"
               "5 1 -1\n3 1 -1\n3 -1 1\n5 -1 1\n5 1 1\n3 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n"
               "4 3 0 4 7\n4 8 11 10 9\n4 12 13 14 15\n4 8 9 13 12\n4 9 10 14 13\n4 10 11 15 14\n4 11 8 12 15\n");
    work.write("wire.off", "OFF\n2 1 0\n0 0 0\n3 0 0\n2 0 1\n");
  }
  int code(const std::string& arguments) { return work.run("dymsum contains " + arguments).code; }
};

TEST_F(SolidContains, OneQuestionIsAnsweredByTheExitCode) {
  // closed: [-2, 6] x [-2, 2]^2; open: without its boundary and the rectangle at x = 2
  for (const char* in : {"0,0,0", "-2,0,0", "6,2,2", "2,0,0", "2,1/3,-2"})
    EXPECT_EQ(code(std::string("two.off cube.off --at ") + in), 0) << in;
  for (const char* out : {"-2.0000000000000004,0,0", "0,0,9", "6,2,6000000000000001/3000000000000000"})
    EXPECT_EQ(code(std::string("two.off cube.off --at ") + out), 4) << out;
  for (const char* out : {"2,0,0", "-2,0,0", "6,2,2", "2,1/3,-1/7"})
    EXPECT_EQ(code(std::string("two.off cube.off --semantics open --at ") + out), 4) << out;
  for (const char* in : {"2.0000000000000004,0,0", "1/3,5/3,-1e-9", "6000000000000001/3000000000000000,0,0"})
    EXPECT_EQ(code(std::string("two.off cube.off --semantics open --at ") + in), 0) << in;
}

TEST_F(SolidContains, ManyQuestionsAreReadFromAFile) {
  work.write("places.txt", "# along x\n0 0 0\n1/3, 0, 0\n\n2,0,0 # tight\n0x\n");
  const Outcome bad = work.run("dymsum contains two.off cube.off --at-file places.txt");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("places.txt:6:"), std::string::npos) << bad.err;
  work.write("places.txt", "# along x\n0 0 0\n1/3, 0, 0\n\n2,0,0 # tight\n1/7 5 0\n1e-30 0 0\n1e-3,1/3,0\n");
  const Json report = json("dymsum contains two.off cube.off --at-file places.txt --at 9,9,9 --semantics open --json");
  std::string inside;
  for (const Json& answer : report["answers"]) inside += answer["inside"].get<bool>() ? "1" : "0";
  EXPECT_EQ(inside, "0110011") << "--at comes first";
  EXPECT_EQ(report["semantics"], "open");
  EXPECT_EQ(report["answers"][2]["exact"], (Json{"1/3", "0/1", "0/1"}));
  const Outcome text = work.run("dymsum contains two.off cube.off --at 1/3,0.1,0 --at 9,0,0");
  EXPECT_EQ(text.out, "(1/3, 0.10000000000000001, 0): inside\n(9, 0, 0): outside\n");
  EXPECT_EQ(text.code, 0);
}

TEST_F(SolidContains, PartsWithoutVolumeAndWrongUsage) {
  EXPECT_EQ(code("two.off wire.off --thin --semantics open --at 2,0,0"), 0);
  EXPECT_EQ(code("two.off wire.off --thin --semantics open --at 1,1,0"), 4) << "along a face";
  EXPECT_EQ(code("two.off wire.off --thin --at 1,1,0"), 0);
  refused("dymsum contains two.off cube.off", "--at");
  refused("dymsum contains two.off cube.off --at 1,2", "--at");
  refused("dymsum contains two.off cube.off --at 1,2,1/0", "--at");
  refused("dymsum contains two.off cube.off --at 1,2,90deg", "--at");
  EXPECT_EQ(code("two.off cube.off --semantics open --at 6,0,1e-200"), 4) << "of any size";
  EXPECT_EQ(code("two.off cube.off --semantics open --at 5.5,1.9999999999999998,1e-200"), 0);
  EXPECT_EQ(code("wire.off wire.off --thin --at 6,0,0"), 0);
  EXPECT_EQ(code("wire.off wire.off --thin --at 6,1e-200,0"), 4);
  work.write("plate.off", "OFF\n4 1 0\n0 0 0\n0 2 0\n0 2 2\n0 0 2\n4 0 1 2 3\n");
  EXPECT_EQ(json("dymsum contains wire.off plate.off --thin --semantics open --at 1,1,1 --json", 2)["error"]["code"],
            "unsupported_operand");
}

/// Leaning prisms in a row.
std::string combs(int n) {
  std::string vertices, faces;
  int count = 0, squares = 0;
  for (int k = 0; k < n; ++k) {
    const int first = count;
    for (const int z : {0, 1})
      for (const auto& [x, y] : {std::pair{0, 0}, {3, 0}, {3 + k % 3, 3 + k % 7}, {k % 2, 2}})
        vertices += std::to_string(16 * k + x + z * (k % 4)) + " " + std::to_string(y + z * (k % 3)) + " " +
                    std::to_string(2 * z) + "\n",
            ++count;
    for (const auto& face : {std::array{3, 2, 1}, {3, 1, 0}, {4, 5, 7}, {5, 6, 7}}) {
      faces += "3";
      for (const int v : face) faces += " " + std::to_string(first + v);
      faces += "\n", ++squares;
    }
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      faces += "4 " + std::to_string(first + i) + " " + std::to_string(first + j) + " " +
               std::to_string(first + 4 + j) + " " + std::to_string(first + 4 + i) + "\n";
      ++squares;
    }
  }
  return "OFF\n" + std::to_string(count) + " " + std::to_string(squares) + " 0\n" + vertices + faces;
}

TEST_F(SolidContains, WhatALongSumWillTakeIsToldBeforeAndHasALimit) {
  work.write("many.off", combs(200));
  work.write("few.off", combs(12));
  const Outcome refused = work.run("dymsum sum many.off many.off --memory 20");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.err.starts_with("expected: about ")) << refused.err;
  EXPECT_NE(refused.err.find(" face + vertex and "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find(" edge + edge facets, "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("the sum is predicted to take "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("the limit is 20 MB"), std::string::npos) << refused.err;
  EXPECT_EQ(refused.out, "");
  const std::string reported = refused.err.substr(refused.err.find("facets, ") + 8);
  EXPECT_GT(std::stod(reported), 20) << "the same memory that the error names";
  const Outcome small = work.run("dymsum sum few.off few.off --memory 1000 -o few.json");
  EXPECT_EQ(small.code, 0) << small.err;
  EXPECT_EQ(small.err, "") << "a short sum";
  EXPECT_EQ(json("dymsum sum few.off few.off --memory 1 --json", 2)["error"]["code"], "out_of_memory");
  EXPECT_EQ(work.run("dymsum sum few.off few.off --memory 1 -o none.off").code, 2);
  EXPECT_NE(work.run("ls none.off").code, 0) << "nothing is written";
  work.run("dymsum sum few.off few.off -o free.json");
  EXPECT_EQ(work.read("free.json"), work.read("few.json")) << "a limit changes nothing";
  CliTest::refused("dymsum sum few.off few.off --memory 0", "--memory");
}

TEST_F(SolidContains, TheLimitIsForConvexSolidsAndStagesToo) {
  work.write("ball.off", format_mesh(solids::geodesic_sphere(20, 1, solids::kDemoSnap).data(), MeshFormat::off));
  work.write("few.off", combs(12));
  const std::string convex = "the sum of convex solids takes at least ", any = "the sum is predicted to take ";
  for (const auto& [sum, says] : {std::pair{"sum ball.off ball.off", convex},
                                  {"sum ball.off ball.off ball.off", convex},
                                  {"nfp ball.off ball.off", convex},
                                  {"sum ball.off ball.off --engine brute", any}}) {
    const Outcome refused = work.run(std::string("dymsum ") + sum + " --memory 1 -o none.off");
    EXPECT_EQ(refused.code, 2) << sum;
    EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("the limit is 1 MB"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(work.run("dymsum sum ball.off ball.off --memory 100").code, 0);
  // Enough for the sum, not for a picture of all its pieces.
  EXPECT_EQ(work.run("dymsum sum few.off few.off --memory 30").code, 0);
  const Outcome stages = work.run("dymsum sum few.off few.off --memory 30 -o stages.glb");
  EXPECT_EQ(stages.code, 2);
  EXPECT_NE(stages.err.find("drawing the stages takes about "), std::string::npos) << stages.err;
  EXPECT_FALSE(work.exists("stages.glb"));
}

TEST_F(SolidContains, MassesOfParallelFacesAreAnnounced) {
  std::string planks, faces;  // in a row, apart
  for (int k = 0; k < 25; ++k) {
    for (const int z : {0, 1})
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 99}, {0, 99}})
        planks += std::to_string(2 * k + x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    for (const auto& f :
         {std::array{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
      faces += "4";
      for (const int v : f) faces += " " + std::to_string(8 * k + v);
      faces += "\n";
    }
  }
  work.write("planks.off", "OFF\n200 150 0\n" + planks + faces);
  const Outcome refused = work.run("dymsum sum planks.off planks.off --memory 1");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.err.starts_with("expected: about ")) << refused.err;
  EXPECT_NE(refused.err.find(" MB of memory\n"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace dymsum::cli_test
