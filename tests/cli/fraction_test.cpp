// Every option that takes a place takes fractions, exactly: the answer is that of shapes three times as large at three
// times the position, which doubles hold.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

/// What a part of an answer does where everything is three times as large.
enum class Grows { not_at_all, once, squared };

struct Compared {
  std::string pointer;
  Grows grows = Grows::not_at_all;
};

struct Question {
  std::string command;             ///< with P and Q for the operands and a position between bars: 1/3|1
  std::vector<Compared> compared;  ///< pointers into the answer
  int exit = 0;
};

std::string named(const std::string& command, const std::string& p, const std::string& q, bool larger) {
  std::string made;
  for (std::size_t k = 0; k < command.size(); ++k) {
    if (command[k] == 'P') made += p;
    else if (command[k] == 'Q') made += q;
    else if (command[k] == '<') {
      const std::size_t bar = command.find('|', k), end = command.find('>', k);
      made += larger ? command.substr(bar + 1, end - bar - 1) : command.substr(k + 1, bar - k - 1);
      k = end;
    } else made += command[k];
  }
  return made;
}

class FractionCli : public CliTest {
 protected:
  FractionCli() {
    work.write("peg.wkt", kPeg), work.write("slot.wkt", kSlot);
    work.write("peg3.wkt", "POLYGON ((0 0, 6 0, 6 3, 0 3, 0 0))\n");
    work.write("slot3.wkt", "POLYGON ((0 0, 12 0, 12 12, 9 12, 9 3, 3 3, 3 12, 0 12, 0 0))\n");
    work.write("cube.off", kCube);
    work.write("cube3.off",
               "OFF\n8 6 0\n-3 -3 -3\n3 -3 -3\n3 3 -3\n-3 3 -3\n-3 -3 3\n3 -3 3\n3 3 3\n-3 3 3\n"
               "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
    work.write("wedge.off", kTetrahedron);
    work.write("wedge3.off", "OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    work.run("dymsum cspace peg.wkt slot.wkt -o slot.obstacle && dymsum cspace peg3.wkt slot3.wkt -o slot3.obstacle");
  }

  static double number(const Json& value) {
    if (value.is_number()) return value;
    const std::string text = value;
    const std::size_t slash = text.find('/');
    return std::stod(text) / (slash == std::string::npos ? 1 : std::stod(text.substr(slash + 1)));
  }

  void compare(const Question& question, const std::string& p, const std::string& q, const std::string& end) const {
    const std::string small = named(question.command, p + end, q + end, false),
                      large = named(question.command, p + "3" + end, q + "3" + end, true);
    const Json given = json("dymsum " + small + " --json", question.exit),
               other = json("dymsum " + large + " --json", question.exit);
    for (const auto& [pointer, grows] : question.compared) {
      const Json &a = given.at(Json::json_pointer(pointer)), &b = other.at(Json::json_pointer(pointer));
      if (grows == Grows::not_at_all) {
        EXPECT_EQ(a, b) << small << " " << pointer;
      } else {
        const double factor = grows == Grows::once ? 3 : 9;
        EXPECT_NEAR(factor * number(a), number(b), 1e-15 * std::abs(number(b))) << small << " " << pointer;
      }
    }
  }
};

TEST_F(FractionCli, PlacesInThePlaneMayBeFractions) {
  work.write("places.txt", "1/3 5\n1,6\n"), work.write("places3.txt", "1 15\n3,18\n");
  work.write("poses.txt", "1/3 5 0.5\n"), work.write("poses3.txt", "1 15 0.5\n");
  const std::vector<Compared> depth{{"/meeting"},
                                    {"/distance", Grows::once},
                                    {"/distance_squared_exact", Grows::squared},
                                    {"/ways/0/move_exact/0", Grows::once},
                                    {"/ways/0/contacts/0/at_exact/1", Grows::once},
                                    {"/ways/0/direction"},
                                    {"/ways/0/contacts/0/p"}};
  const std::vector<Compared> angles{{"/answers/0/free_angles"}};
  const std::vector<Compared> clearance{{"/answers/0/free"},
                                        {"/answers/0/distance", Grows::once},
                                        {"/answers/0/nearest/0", Grows::once},
                                        {"/answers/0/nearest/2"},
                                        {"/answers/0/translation/distance", Grows::once},
                                        {"/answers/0/free_angles"},
                                        {"/answers/0/contact"},
                                        {"/weight", Grows::once}};
  const std::vector<Compared> ranges{{"/free/0/high"}, {"/free/0/at_high/0/at/0", Grows::once}};
  for (const Question& question : std::vector<Question>{
           {"depth Q P --move <1/3,5/3|1,5>", depth},
           {"depth Q P --move <1/3,17/3|1,17>", depth, 4},
           {"contains P Q --at <7/3,1/3|7,1>", {{"/answers/0/inside"}}},
           {"contains P Q --at <7/3,1/3|7,1>,0.5", {{"/answers/0/inside"}}},
           {"angles P Q --at <1/3,5|1,15>", angles},
           {"angles P Q --at-file <places.txt|places3.txt>", angles},
           {"angles --obstacle <slot|slot3>.obstacle --at <1/3,5|1,15>", angles},
           {"clearance P Q --at <1/3,5|1,15>,0.5", clearance},
           {"clearance P Q --at-file <poses.txt|poses3.txt>", clearance},
           {"clearance P Q --at <7/3,1/3|7,1>,0.5 --weight <2|6>", clearance},
           {"clearance --obstacle <slot|slot3>.obstacle --at <1/3,5|1,15>,0.5", clearance},
           {"scale-range P Q --path '<-7/3,1/3 -1/3,1/3|-7,1 -1,1>'", ranges},
           {"scale-range P Q --inside --place <1/3,4/3|1,4>", ranges},
       })
    compare(question, "peg", "slot", ".wkt");
}

TEST_F(FractionCli, PlacesInSpaceMayBeFractions) {
  work.write("moves.txt", "1/3 1/3 1/7\n0,0,2\n"), work.write("moves3.txt", "1 1 3/7\n0,0,6\n");
  const auto depth = [](const std::string& at) {
    return std::vector<Compared>{{at + "/meeting"},
                                 {at + "/distance", Grows::once},
                                 {at + "/distance_squared_exact", Grows::squared},
                                 {at + "/ways/0/move_exact/0", Grows::once},
                                 {at + "/ways/0/contacts/0/at_exact/1", Grows::once},
                                 {at + "/ways/0/direction"},
                                 {at + "/ways/0/contacts/0/p"}};
  };
  const std::vector<Compared> ranges{{"/free/0/high"}, {"/free/0/at_high/0/at/0", Grows::once}};
  for (const Question& question : std::vector<Question>{
           {"depth P Q --move <1/3,1/3,1/3|1,1,1>", depth("")},
           {"depth P Q --move <1/3,1/3,10/3|1,1,10>", depth(""), 4},
           {"depth P Q --move <1/3,1/3,1/3|1,1,1> --along <1/3,0,0|1,0,0>", {{"/along_exact"}}},
           {"depth P Q --at-file <moves.txt|moves3.txt>", depth("/rows/0")},
           {"contains P Q --at <1/3,1/3,1/7|1,1,3/7>", {{"/answers/0/inside"}}},
           {"scale-range Q P --path '<-7/3,0,0 -4/3,0,0|-7,0,0 -4,0,0>'", ranges},
           {"scale-range Q P --inside --place <1/3,0,0|1,0,0>", ranges},
       })
    compare(question, "cube", "wedge", ".off");
}

TEST_F(FractionCli, APositionIsNotRounded) {
  // On the long edge, and on the large face; the nearest doubles are inside.
  work.write("triangle.wkt", "POLYGON ((0 0, 3 0, 0 1, 0 0))\n"), work.write("point.wkt", "POINT (0 0)\n");
  EXPECT_EQ(json("dymsum depth triangle.wkt point.wkt --move 1,2/3 --json", 4)["meeting"], "touching");
  EXPECT_EQ(json("dymsum depth triangle.wkt point.wkt --move 1,0.66666666666666663 --json")["meeting"], "overlapping");
  work.write("point.off", "OFF\n1 1 0\n0 0 0\n1 0\n");
  EXPECT_EQ(json("dymsum depth wedge.off point.off --thin --move 1/3,1/3,1/3 --json", 4)["meeting"], "touching");
  EXPECT_EQ(json("dymsum depth wedge.off point.off --thin --move 0.333333333333333314,1/3,1/3 --json")["meeting"],
            "overlapping");
  EXPECT_EQ(json("dymsum depth wedge.off cube.off --move 1/3,0,0 --axis 0,0,1 --degrees 5", 1), Json());
  EXPECT_EQ(json("dymsum angles peg.wkt slot.wkt --at 1/3,0.1", 2), Json()) << "three times 0.1 is no double";
}

}  // namespace
}  // namespace dymsum::cli_test
