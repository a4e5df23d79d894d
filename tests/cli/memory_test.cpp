// --memory: what a command has in memory at its peak, as the system measures it, and what it says where that is not
// enough.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli_fixture.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/sanitized.h"

namespace dymsum::cli_test {
namespace {

struct Measured {
  int code = -1;
  double megabytes = 0;  ///< resident at the peak
  std::string err;
};

class MemoryCli : public CliTest {
 protected:
  void SetUp() override {
    if (oracles::kSanitized) GTEST_SKIP() << "a sanitizer has memory of its own";
    write("comb", shapes::comb(40, 2, 1, 40));
    write("lying", turned(shapes::comb(40, 2, 1, 40), std::numbers::pi / 2));
    write("mirrored", turned(shapes::comb(40, 2, 1, 40), -std::numbers::pi / 2));
    write("bars", shapes::comb(60, 3, 0.5, 60));
    write("tilted", turned(shapes::comb(50, 3, 0.5, 60), 0.3));
    write("star", shapes::star(100, 3, 5));
    write("other", turned(shapes::star(90, 3, 5), 0.01));
    write("wheel", shapes::star(20000, 4.999, 5));
    write("spikes", shapes::star(40, 3, 5));
    write("thorns", turned(shapes::star(36, 3, 5), 0.013));
    work.write("bar.wkt", "POLYGON ((-1.5 -0.25, 1.5 -0.25, 1.5 0.25, -1.5 0.25, -1.5 -0.25))\n");
    std::string posts;
    for (int x = 0; x < 30; x += 3)
      for (int y = 0; y < 30; y += 3) {
        const double left = x + 0.1 * (y % 5);
        const std::string l = std::to_string(left), r = std::to_string(left + 1), b = std::to_string(y),
                          t = std::to_string(y + 1);
        posts += (posts.empty() ? "" : ", ") +
                 ("((" + l + " " + b + ", " + r + " " + b + ", " + r + " " + t + ", " + l) + " " + t + ", " + l + " " +
                 b + "))";
      }
    work.write("posts.wkt", "MULTIPOLYGON (" + posts + ")\n");
  }

  static Region turned(const Region& region, double angle) {
    const double c = std::round(std::cos(angle) * 0x1p53) * 0x1p-53, s = std::sin(angle);
    const bool quarter = std::abs(c) < 1e-9;
    RegionData data = region.data();
    for (Part& part : data.parts)
      for (Point& p : part.outer) p = quarter ? Point{-s * p.y, s * p.x} : Point{c * p.x - s * p.y, s * p.x + c * p.y};
    return Region::create(data).value();
  }
  void write(const std::string& name, const Region& region) const {
    work.write(name + ".wkt", format_region(region, RegionFormat::wkt));
  }

  /// `dymsum` with these words.
  Measured run(const std::string& words) const {
    const std::string folder = (work.folder() / "work").string(), line = "exec '" DYMSUM_CLI "' " + words;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      const bool there = chdir(folder.c_str()) == 0;
      dup2(open("measured.out", O_CREAT | O_TRUNC | O_WRONLY, 0600), 1);
      dup2(open("measured.err", O_CREAT | O_TRUNC | O_WRONLY, 0600), 2);
      if (there) execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    rusage used{};
    if (wait4(child, &status, 0, &used) != child) throw std::runtime_error("no outcome");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            static_cast<double>(used.ru_maxrss) / 1000, work.read("measured.err")};
  }
};

struct LimitedCommand {
  std::string words;
  int limit;           ///< in megabytes, far less than the command takes
  bool does_without;   ///< it may end well: windows that do not fit are not made
  std::string output;  ///< what it writes
};

TEST_F(MemoryCli, NoCommandHoldsMoreThanItsLimitAndOneThatSufficesChangesNothing) {
  const double nothing = run("--version").megabytes;
  // Blocks of threads, stacks and pages of the program that are touched later.
  constexpr double kBeside = 14;
  for (const LimitedCommand& c : std::vector<LimitedCommand>{
           {"sum comb.wkt lying.wkt -o out.json", 20, false, "out.json"},
           {"nfp comb.wkt mirrored.wkt -o out.json", 20, false, "out.json"},
           {"scale bars.wkt tilted.wkt --at 1.001,1.002 -o out.svg", 20, true, "out.svg"},
           {"scale star.wkt other.wkt --range 1:1.001 -o out.svg", 8, false, "out.svg"},
           {"local-sum bars.wkt tilted.wkt --box=-60,-60,100,100 -o out.json", 20, false, "out.json"},
           {"cspace spikes.wkt thorns.wkt -o out.json", 20, false, "out.json"},
           {"cspace bar.wkt posts.wkt -o out.json", 20, false, "out.json"},
           {"disc wheel.wkt --radius 0.01 -o out.json", 20, false, "out.json"}}) {
    SCOPED_TRACE(c.words);
    const Measured free = run(c.words);
    ASSERT_EQ(free.code, 0) << free.err;
    const std::string wanted = work.read(c.output);
    std::printf("%s: %.0f MB, without work %.0f\n", c.words.c_str(), free.megabytes, nothing);
    EXPECT_GT(free.megabytes, nothing + c.limit + kBeside) << "a limit that is none";
    const Measured limited = run(c.words + " --memory " + std::to_string(c.limit));
    EXPECT_LT(limited.megabytes, nothing + c.limit + kBeside);
    if (!c.does_without || limited.code != 0) {
      EXPECT_EQ(limited.code, 2) << limited.err;
      EXPECT_NE(limited.err.find("memory"), std::string::npos) << limited.err;
      EXPECT_NE(limited.err.find(std::to_string(c.limit) + " MB"), std::string::npos) << limited.err;
    }
    const Measured enough = run(c.words + " --memory 2000");
    EXPECT_EQ(enough.code, 0) << enough.err;
    EXPECT_EQ(work.read(c.output), wanted);
  }
}

TEST_F(MemoryCli, ErrorsNameTheLimitAndWhatWouldBeHeld) {
  const Json error = json("dymsum sum comb.wkt lying.wkt --memory 5 --json", 2)["error"];
  EXPECT_EQ(error["code"], "out_of_memory");
  const auto message = error["message"].get<std::string>();
  EXPECT_NE(message.find("the sum of 160 and 160 vertices"), std::string::npos) << message;
  EXPECT_NE(message.find("in the stage '"), std::string::npos) << message;
  EXPECT_NE(message.find("5 MB"), std::string::npos) << message;
  const Json path = json("dymsum path bar.wkt posts.wkt --from=-3,-3,0 --to=13.4,14.2,1 --memory 1 --json", 2)["error"];
  EXPECT_EQ(path["code"], "out_of_memory");
  EXPECT_EQ(work.run("dymsum path bar.wkt posts.wkt --from=-3,-3,0 --to=35,35,1 --memory 200").code, 0);
  for (const char* verb : {"sum", "nfp", "erode", "scale", "rotate", "cspace", "path", "local-sum", "disc", "slice"})
    EXPECT_NE(work.run(std::string("dymsum ") + verb + " --help").out.find("--memory"), std::string::npos) << verb;
}

}  // namespace
}  // namespace dymsum::cli_test
