// The verb contains: places of sums and configurations of robots, by hand and against the other verbs.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class ContainsCli : public CliTest {
 protected:
  ContainsCli() {
    work.write("square.wkt", kSquare);
    work.write("frame.wkt", kFrame);
    work.write("slot.wkt", "POLYGON ((-1 -1, 2 -1, 2 2, -1 2, -1 -1), (0 0, 0 1, 1 1, 1 0, 0 0))\n");
  }
  int code(const std::string& arguments) { return work.run("dymsum contains " + arguments).code; }
};

TEST_F(ContainsCli, OneQuestionIsAnsweredByTheExitCode) {
  // The sum of frame and square: [0, 6]^2 without the interior of [2, 4]^2.
  for (const char* in : {"0,0", "1,1", "6,6", "2,3", "2,2", "1.9999999999999998,3"})
    EXPECT_EQ(code(std::string("frame.wkt square.wkt --at ") + in), 0) << in;
  for (const char* out : {"3,3", "2.0000000000000004,3", "6.000000000000001,6", "-1e-300,0"})
    EXPECT_EQ(code(std::string("frame.wkt square.wkt --at ") + out), 4) << out;
  EXPECT_EQ(code("frame.wkt square.wkt --semantics open --at 2,3"), 4) << "touching is outside of an open sum";
  EXPECT_EQ(code("frame.wkt square.wkt --semantics open --at 1.9999999999999998,3"), 0);
}

TEST_F(ContainsCli, AConfigurationIsInsideWhereTheRobotOverlaps) {
  // A square in a hole of its size: jammed, and free as touching is.
  for (const char* free : {"0,0,0", "1,0,90deg", "1,1,180deg", "2,0,0", "9,9,1"})
    EXPECT_EQ(code(std::string("square.wkt slot.wkt --at ") + free), 4) << free;
  for (const char* hit : {"1e-300,0,0", "0,0,1e-9", "1,0,1.57", "1.5,0,0", "0,0,90deg"})
    EXPECT_EQ(code(std::string("square.wkt slot.wkt --at ") + hit), 0) << hit;
  EXPECT_EQ(code("square.wkt slot.wkt --semantics closed --at 0,0,0"), 0);
  EXPECT_EQ(code("square.wkt slot.wkt --semantics closed --at 2,0,0"), 0);
  EXPECT_EQ(code("square.wkt slot.wkt --semantics closed --at 2.0000000000000004,0,0"), 4);
}

TEST_F(ContainsCli, ManyQuestionsAreReadFromAFile) {
  std::ostringstream file;
  std::string few;
  for (int k = 0; k < 300; ++k) {
    const std::string line = std::to_string(k % 7 * 0.5 - 1) + "," + std::to_string(k % 11 * 0.5 - 2) + "," +
                             std::to_string(k % 13 * 45) + "deg";
    file << line << (k % 3 == 0 ? " # a comment\n\n" : "\n");
    if (k < 60) few += " --at=" + line;
  }
  work.write("many.txt", file.str());
  const Outcome many = work.run("dymsum contains square.wkt slot.wkt --json --at-file many.txt");
  const Outcome single = work.run("dymsum contains square.wkt slot.wkt --json" + few);
  ASSERT_EQ(many.code, 0) << many.err;
  ASSERT_EQ(single.code, 0) << single.err;
  const Json a = Json::parse(many.out)["answers"], b = Json::parse(single.out)["answers"];
  ASSERT_EQ(a.size(), 300u);
  std::size_t inside = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    EXPECT_EQ(a[k], b[k]) << "by the obstacle of all angles, and by themselves";
    inside += a[k]["inside"].get<bool>();
  }
  EXPECT_GT(inside, 10u);
  EXPECT_LT(inside, 50u);
}

TEST_F(ContainsCli, PositionsMayBeFractions) {
  // The first is on the boundary of the hole, which is open.
  const Outcome two = work.run("dymsum contains frame.wkt square.wkt --json --at 2,7/3 --at 1/3,0.1 --at 3,3");
  ASSERT_EQ(two.code, 0) << two.err;
  const Json answers = Json::parse(two.out)["answers"];
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0]["exact"], Json({"2/1", "7/3"}));
  EXPECT_EQ(answers[0]["inside"], true);
  EXPECT_EQ(answers[1]["exact"], Json({"1/3", "3602879701896397/36028797018963968"})) << "a decimal is a double";
  EXPECT_FALSE(answers[2].contains("exact"));
  EXPECT_EQ(answers[2]["inside"], false);
  EXPECT_EQ(code("frame.wkt square.wkt --at 2,7/3 --semantics open"), 4);
  const std::string tiny = "1" + std::string(40, '0');
  EXPECT_EQ(code("frame.wkt square.wkt --at 2,7/3"), 0);
  EXPECT_EQ(code("frame.wkt square.wkt --at 2" + std::string(39, '0') + "1/1" + std::string(40, '0') + ",7/3"), 4);
  EXPECT_EQ(work.run("dymsum contains frame.wkt square.wkt --at 2/6,0.5").out.rfind("(1/3, 0.5): inside\n", 0), 0u);
  // A square in a hole of its size.
  EXPECT_EQ(code("square.wkt slot.wkt --at 0/7,0,0"), 4);
  EXPECT_EQ(code("square.wkt slot.wkt --at 1/" + tiny + ",0,0"), 0);
  EXPECT_EQ(code("square.wkt slot.wkt --semantics closed --at 2,1/3,0"), 0);
  EXPECT_EQ(code("square.wkt slot.wkt --semantics closed --at 2,-4/3,90deg"), 0);
  work.write("places.txt", "1/3 1/2\n2,7/3 # on the hole\n");
  const Outcome file = work.run("dymsum contains frame.wkt square.wkt --at-file places.txt");
  EXPECT_EQ(file.out.substr(0, file.out.find("inside\n", 20) + 7), "(1/3, 0.5): inside\n(2, 7/3): inside\n");
  for (const char* wrong : {"1/0,1", "1/,1", "1/3,x", "/3,1", "0.5/2,nan"})
    EXPECT_EQ(code(std::string("frame.wkt square.wkt --at ") + wrong), 1) << wrong;
  EXPECT_EQ(work.run("dymsum angles square.wkt slot.wkt --at 1/3,1").code, 4);
}

TEST_F(ContainsCli, WrongQuestionsAreTold) {
  for (const char* wrong :
       {"", "--at 1", "--at nan,0", "--at 1,2,3,4", "--at 1,2 --at 1,2,3", "--at 1,,2", "--at 1,2 --semantics regular"})
    EXPECT_EQ(code(std::string("square.wkt frame.wkt ") + wrong), 1) << wrong;
  work.write("bad.txt", "1 2\n3 4 5\n");
  const Outcome mixed = work.run("dymsum contains square.wkt frame.wkt --at-file bad.txt");
  EXPECT_EQ(mixed.code, 2);
  EXPECT_EQ(mixed.err, "bad.txt:2: all questions have an angle, or none\n");
  work.write("bad.txt", "1 2\n\n3;4\n");
  EXPECT_EQ(work.run("dymsum contains square.wkt frame.wkt --at-file bad.txt").err,
            "bad.txt:3: a question is x,y or x,y,theta\n");
  work.write("bad.txt", "# none\n");
  EXPECT_EQ(work.run("dymsum contains square.wkt frame.wkt --at-file bad.txt").code, 2);
  EXPECT_EQ(work.run("dymsum contains square.wkt frame.wkt --at-file absent.txt").code, 2);
}

}  // namespace
}  // namespace dymsum::cli_test
