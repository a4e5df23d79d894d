// Long work: the progress bar, and Ctrl-C.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "dymsum/dymsum.h"
#include "process.h"

namespace dymsum::cli_test {
namespace {

/// A sum repeated for about ever.
constexpr const char* kLong = "dymsum sum a.wkt a.wkt --repeat 1000000 -o sum.wkt -o sum.svg";

// timeout --foreground signals once; without it the signal goes to the whole group as well, and a second Ctrl-C kills.
class LongWork : public testing::Test {
 protected:
  LongWork() { work.write("a.wkt", format_region(shapes::noisy_star(300, 0.6, 11), RegionFormat::wkt)); }
  Workplace work;
};

TEST_F(LongWork, CtrlCEndsWith130AndLeavesNoFile) {
  work.write("sum.wkt", "older\n");
  const Outcome outcome = work.run(std::string("timeout --foreground --preserve-status -s INT 0.5 ") + kLong);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "dymsum: interrupted\n");
  EXPECT_EQ(work.read("sum.wkt"), "older\n");
  EXPECT_EQ(work.file_count(), 2U) << "no sum.svg and no temporary file";
}

TEST_F(LongWork, OneSlowComputationIsInterruptedInside) {
  work.write("b.wkt", format_region(shapes::noisy_star(1500, 0.9, 5), RegionFormat::wkt));
  const Outcome outcome = work.run(
      "timeout --foreground --preserve-status -s INT -k 60 0.5 dymsum sum b.wkt b.wkt --engine brute -o sum.wkt");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_FALSE(work.exists("sum.wkt"));
}

TEST_F(LongWork, LargeSumsAreInterruptedInEveryStage) {
  work.write("b.wkt", format_region(shapes::noisy_star(4000, 0.9, 5), RegionFormat::wkt));
  for (const char* const after : {"0.3", "0.6", "1.2"}) {
    const Outcome outcome = work.run(std::string("timeout --foreground --preserve-status -s INT -k 5 ") + after +
                                     " dymsum sum b.wkt b.wkt --repeat 1000 -o sum.wkt");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_FALSE(work.exists("sum.wkt"));
  }
}

// `timeout` in front of a shell would say 130 for a process that the signal killed, too: only one that ends by itself
// says that it was interrupted.
TEST_F(LongWork, ScaleRangesEndWithTheirOwnExitCode) {
  work.write("big.wkt", format_region(shapes::noisy_star(2000, 0.9, 5), RegionFormat::wkt));
  work.write("ball.off", format_mesh(solids::geodesic_sphere(6, 1).data(), MeshFormat::off));
  for (const char* const question : {"big.wkt big.wkt --path '-9,0 9,0'", "ball.off ball.off --path '-9,0,0 9,0,0'"}) {
    const Outcome outcome =
        work.run(std::string("timeout --foreground --preserve-status -s INT -k 9 0.4 dymsum scale-range ") + question +
                 " --repeat 100000");
    EXPECT_EQ(outcome.code, 130) << question;
    EXPECT_EQ(outcome.err, "dymsum: interrupted\n") << question;
  }
}

// These write no file: the signal ends them wherever they are.
TEST_F(LongWork, QuestionsAndScaleRangesEndAtOnce) {
  work.write("big.wkt", format_region(shapes::noisy_star(2000, 0.9, 5), RegionFormat::wkt));
  work.write("room.wkt", "POLYGON((-9 -9,9 -9,9 9,-9 9,-9 -9))");
  std::string positions, poses;
  for (int k = 0; k < 255; ++k) {
    positions += std::to_string(0.001 * k) + ",0.5\n";
    poses += std::to_string(0.001 * k) + ",0.5,0.25\n";
  }
  work.write("places.txt", positions);
  work.write("poses.txt", poses);
  for (const char* const question :
       {"contains big.wkt big.wkt --at-file places.txt --repeat 100000",
        "contains big.wkt big.wkt --at-file poses.txt --repeat 100000",
        "contains big.wkt big.wkt --at 0.1,0.5,0.25 --repeat 100000", "family big.wkt big.wkt --scale 1/10:10",
        "scale-range big.wkt big.wkt --path '-9,0 9,0' --repeat 100000",
        "scale-range big.wkt room.wkt --inside --repeat 100000"}) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        work.run(std::string("timeout --foreground --preserve-status -s INT -k 9 0.4 dymsum ") + question);
    EXPECT_EQ(outcome.code, 130) << question << ": " << outcome.err;
    EXPECT_EQ(outcome.out, "") << question;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(1400)) << question;
  }
}

// Stages that never query whether to go on, of a solid with thousands of faces.
TEST_F(LongWork, LargeConvexSolidsEndAtOnce) {
  work.write("ball.off", format_mesh(solids::geodesic_sphere(40, 1, solids::kDemoSnap).data(), MeshFormat::off));
  for (const char* const run :
       {"1 dymsum sum ball.off ball.off -o sum.off", "2.5 dymsum sum ball.off ball.off -o sum.off",
        "1 dymsum rotate ball.off ball.off --steps 9 -o turn.off"}) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        work.run(std::string("timeout --foreground --preserve-status -s INT -k 9 ") + run + " --repeat 1000");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(outcome.code, 130) << run << ": " << outcome.err;
    EXPECT_LT(took.count(), std::stod(run) + 1) << run;
  }
  EXPECT_FALSE(work.exists("sum.off"));
  EXPECT_FALSE(work.exists("turn.off"));
}

TEST_F(LongWork, ManyQuestionsEndWithOneErrorObject) {
  work.write("ball.off", format_mesh(solids::geodesic_sphere(3, 1, solids::kDemoSnap).data(), MeshFormat::off));
  std::string positions;
  for (int k = 0; k < 20000; ++k) positions += std::to_string(0.0001 * k) + ",0.5,0.25\n";
  work.write("places.txt", positions);
  for (const char* const question : {"contains ball.off ball.off --at-file places.txt --json --repeat 1000",
                                     "depth ball.off ball.off --at-file places.txt --json --repeat 1000",
                                     "depth a.wkt a.wkt --move 0.1,0 --json --repeat 100000",
                                     "contains a.wkt a.wkt --at-file places.txt --json --repeat 100000"}) {
    const Outcome outcome =
        work.run(std::string("timeout --foreground --preserve-status -s INT -k 9 0.5 dymsum ") + question);
    EXPECT_EQ(outcome.code, 130) << question << ": " << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << question << ": " << outcome.out;
    EXPECT_EQ(json["error"]["code"], "cancelled") << question;
  }
}

TEST_F(LongWork, AnInterruptedReportIsOneObject) {
  const Outcome outcome =
      work.run("timeout --foreground --preserve-status -s INT 0.5 dymsum sum a.wkt a.wkt --repeat 1000000 --json");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["error"]["code"], "cancelled");
  EXPECT_EQ(json["error"]["exit"], 130);
}

TEST_F(LongWork, OutOfMemoryIsAnErrorWithSizes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
#endif
  const Outcome outcome = work.run("sh -c 'ulimit -v 200000; exec dymsum sum a.wkt a.wkt --engine brute -o sum.wkt'");
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("the sum of 300 and 300 vertices is too large: out of memory in the stage"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(" segments"), std::string::npos) << outcome.err;
  EXPECT_FALSE(work.exists("sum.wkt"));
}

TEST_F(LongWork, AFileThatMayNotGrowIsAnErrorAndLeavesTheOldOne) {
  work.write("sum.wkt", "old");
  const Outcome outcome = work.run("sh -c 'ulimit -f 1; exec dymsum sum a.wkt a.wkt -o sum.wkt'");
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("sum.wkt: writing failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(work.read("sum.wkt"), "old");
}

TEST_F(LongWork, TheBarIsOnlyForTerminalsAndElsewhereALineTells) {
  work.write("b.wkt", format_region(shapes::noisy_star(1500, 0.9, 5), RegionFormat::wkt));
  const std::string command = "dymsum sum b.wkt b.wkt --engine brute --repeat 1000";
  const Outcome piped = work.run("timeout 60 sh -c '" + command +
                                 " 2> told & until grep -qs work told; do sleep 0.1; done; kill -INT $!; wait $!'");
  EXPECT_EQ(piped.code, 130) << piped.err;
  const std::string told = work.read("told");
  EXPECT_TRUE(told.starts_with("dymsum: at work for ")) << told;
  EXPECT_NE(told.find("% "), std::string::npos) << told;
  EXPECT_TRUE(told.ends_with("\ndymsum: interrupted\n")) << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 2) << told;
  work.write("wait.sh", command + " & until grep -qs left seen; do sleep 0.1; done; kill -INT $!; wait $!");
  const Outcome terminal = work.run("timeout 60 script -qefc 'sh wait.sh' seen");
  EXPECT_EQ(terminal.code, 130) << terminal.out;
  EXPECT_NE(terminal.out.find("% "), std::string::npos) << terminal.out;
  EXPECT_NE(terminal.out.find("["), std::string::npos);
  EXPECT_NE(terminal.out.find(" left"), std::string::npos) << terminal.out;
}

}  // namespace
}  // namespace dymsum::cli_test
