// Positions that are requested as fractions: taken exactly, or refused with the fraction that no double is.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class FractionPositions : public CliTest {
 protected:
  void SetUp() override {
    work.write("bar.wkt", "POLYGON ((-1 -0.25, 1 -0.25, 1 0.25, -1 0.25, -1 -0.25))\n");
    work.write("block.wkt", "POLYGON ((3 -3, 4 -3, 4 3, 3 3, 3 -3))\n");
    work.write("cube.off", kCube);
    work.write("tetrahedron.off", kTetrahedron);
  }
  /// Wrong usage or bad input that ends with the fraction.
  void refused_for(const std::string& command, const std::string& fraction, int code) const {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << outcome.err;
    EXPECT_NE(outcome.err.find("; " + fraction + " is no double"), std::string::npos) << command << outcome.err;
  }
};

TEST_F(FractionPositions, PathsBeginAndEndExactlyThere) {
  const Json path = json("dymsum path bar.wkt block.wkt --from=-1/3,1/7,0 --to=1/3,2/7,90deg --json");
  EXPECT_EQ(path["waypoints"].front()["exact"], (Json{"-1/3", "1/7"}));
  EXPECT_EQ(path["waypoints"].back()["exact"], (Json{"1/3", "2/7"}));
  // It touches the block at 2 exactly, and overlaps it at any fraction beyond.
  EXPECT_EQ(work.run("dymsum path bar.wkt block.wkt --from=-1/3,0,0 --to=2,0,0").code, 0);
  EXPECT_EQ(work.run("dymsum path bar.wkt block.wkt --from=-1/3,0,0 --to=18014398509481985/9007199254740992,0,0").code,
            4);
  const Json two = json("dymsum path bar.wkt block.wkt --from=0,0,0 --to=1/3,0,0 --to=1/4,0,0 --json");
  EXPECT_EQ(two["paths"][0]["to_exact"], (Json{"1/3", "0/1"}));
  EXPECT_FALSE(two["paths"][1].contains("to_exact"));
  refused("dymsum path bar.wkt block.wkt --from=1/0,0,0 --to=0,0,0", "--from wants x,y,theta");
}

TEST_F(FractionPositions, PathsThatAreGivenAreCheckedExactly) {
  const auto checked = [&](const std::string& poses, int code) {
    work.write("poses.txt", poses);
    return json("dymsum path bar.wkt block.wkt --check-path poses.txt --json", code)["checked"]["outcome"];
  };
  EXPECT_EQ(checked("1/3,0,0\n2,0,0\n2,1/3,0\n", 0), "free");
  EXPECT_EQ(checked("1/3,0,0\n18014398509481985/9007199254740992,0,0\n", 4), "blocked");
  EXPECT_EQ(checked("1/3,0,0\n1/3,0,90deg\n5/3,0,90deg\n", 0), "free");
  EXPECT_EQ(checked("1/4,0,0\n3/4,1/2,90deg\n", 0), "free") << "fractions that doubles are";
  EXPECT_EQ(checked("[[\"1/3\", 0, 0], [\"2/1\", \"1/3\", 0]]", 0), "free");
  work.write("poses.txt", "1/3,0,0\n1/2,0,90deg\n");
  const Outcome both = work.run("dymsum path bar.wkt block.wkt --check-path poses.txt");
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("pose 1 of the path is reached by moving and turning at once"), std::string::npos)
      << both.err;
}

TEST_F(FractionPositions, OthersTakeFractionsThatDoublesAreAndNameThoseThatNoneIs) {
  refused_for("dymsum local-sum bar.wkt block.wkt --box=1/3,0,5,5", "1/3", 1);
  refused_for("dymsum local-sum bar.wkt block.wkt --disc=0,0,2/3", "2/3", 1);
  refused_for("dymsum local-sum cube.off cube.off --ball=0,0,1/7,1", "1/7", 1);
  refused_for("dymsum local-sum cube.off cube.off --box=0,0,0,1,1,1/3", "1/3", 1);
  refused_for("dymsum depth cube.off cube.off --move=1/3,0,0 --axis 0,0,1 --degrees 30", "1/3", 1);
  refused_for("dymsum rotate cube.off cube.off --steps 4 --axis 1/3,0,1", "1/3", 1);
  work.write("motion.csv", "0,0,0\n1/3,0,0\n");
  refused_for("dymsum depth cube.off cube.off --track motion.csv", "1/3", 2);
  work.write("copies.txt", "1/3 0 0\n1/3 1/3 0\n");
  refused_for("dymsum scale bar.wkt block.wkt --copies copies.txt", "1/3", 2);
  EXPECT_EQ(json("dymsum local-sum bar.wkt block.wkt --box=5/2,0,9/2,5 --json")["box"], (Json{2.5, 0, 4.5, 5}));
  work.write("motion.csv", "0,0,0\n1/4,0,0\n");
  EXPECT_EQ(json("dymsum depth cube.off cube.off --track motion.csv --json")["rows"][1]["at"], (Json{0.25, 0, 0}));
  work.write("copies.txt", "1/3 1/2 0\n");
  EXPECT_EQ(json("dymsum scale bar.wkt block.wkt --copies copies.txt --json")["copies"][0]["at"], (Json{0.5, 0}));
}

}  // namespace
}  // namespace dymsum::cli_test
