// The command-line contract: verbs, JSON keys, formats, exit codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli_fixture.h"
#include "dymsum/dymsum.h"

namespace dymsum::cli_test {
namespace {

class Cli : public CliTest {
 protected:
  Cli() {
    work.write("square.wkt", kSquare);
    work.write("frame.wkt", kFrame);
  }
  Json json(const std::string& command, int code = 0) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err, "") << command;
    return Json::parse(outcome.out);
  }
  std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  }
};

TEST_F(Cli, SumPrintsEveryKeyOfTheContract) {
  const Json report = json("dymsum sum frame.wkt square.wkt --json --repeat 3");
  for (const char* key : {"inputs", "tier", "time_ms", "outer", "holes", "vertices", "area", "area_exact", "tight",
                          "convolution", "crossings"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(keys(report["tight"]), (std::vector<std::string>{"points", "segments"}));
  EXPECT_EQ(keys(report["convolution"]), (std::vector<std::string>{"full", "kinetic", "reduced"}));
  EXPECT_EQ(keys(report["time_ms"]), (std::vector<std::string>{"median", "min", "stages"}));
  EXPECT_LE(report["time_ms"]["min"], report["time_ms"]["median"]);
  EXPECT_EQ(report["inputs"][0], (Json{{"file", "frame.wkt"}, {"vertices", 8}, {"holes", 1}, {"parts", 1}}));
  EXPECT_EQ(report["inputs"][1], (Json{{"file", "square.wkt"}, {"vertices", 4}, {"holes", 0}, {"parts", 1}}));
  EXPECT_EQ(report["outer"], 1);
  EXPECT_EQ(report["holes"], 1);
  EXPECT_EQ(report["vertices"], 8);
  EXPECT_EQ(report["area"], 32.0);
  EXPECT_EQ(report["area_exact"], "32/1");
  EXPECT_EQ(report["tier"], 29);
}

TEST_F(Cli, EveryEngineAndSemanticsGivesTheSameArea) {
  for (const char* engine : {"fast", "brute", "winding"}) {
    for (const char* semantics : {"closed", "open", "regular"}) {
      const Json report =
          json(std::string("dymsum sum frame.wkt square.wkt --json --engine ") + engine + " --semantics " + semantics);
      EXPECT_EQ(report["area_exact"], "32/1") << engine << " " << semantics;
      EXPECT_EQ(report["engine"], engine);
      EXPECT_EQ(report["semantics"], semantics);
    }
  }
}

TEST_F(Cli, NfpReflectsTheSecondOperand) {
  work.write("corner.wkt", "POLYGON ((0 0, 2 0, 0 2, 0 0))");
  const Json report = json("dymsum nfp corner.wkt corner.wkt --json -o nfp.wkt");
  EXPECT_EQ(report["area_exact"], "12/1");
  EXPECT_EQ(report["vertices"], 6);
  EXPECT_EQ(work.read("nfp.wkt").rfind("POLYGON", 0), 0U);
  const Json sum = json("dymsum sum corner.wkt corner.wkt --json");
  EXPECT_EQ(sum["area_exact"], "8/1");
}

TEST_F(Cli, ErodeEndsWithFourWhereNothingFits) {
  work.write("large.wkt", "POLYGON ((0 0, 9 0, 9 1, 0 1, 0 0))");
  work.write("box.wkt", "POLYGON ((0 0, 5 0, 5 5, 0 5, 0 0))");
  work.write("exact.wkt", "POLYGON ((0 0, 5 0, 5 1, 0 1, 0 0))");
  const Json fits = json("dymsum erode box.wkt square.wkt --json");
  EXPECT_EQ(fits["area_exact"], "16/1");
  const Json exactly = json("dymsum erode box.wkt exact.wkt --json");
  EXPECT_EQ(exactly["outer"], 0);
  EXPECT_EQ(exactly["segments"], 1);
  EXPECT_EQ(exactly["tight"]["segments"], 1);
  const Json not_at_all = json("dymsum erode box.wkt large.wkt --json", 4);
  EXPECT_EQ(not_at_all["outer"], 0);
  EXPECT_EQ(not_at_all["area_exact"], "0/1");
  const Outcome human = work.run("dymsum erode box.wkt large.wkt");
  EXPECT_EQ(human.code, 4);
  EXPECT_NE(human.out.find("0 parts"), std::string::npos) << human.out;
}

TEST_F(Cli, OutputsFollowTheExtension) {
  const Outcome outcome = work.run(
      "dymsum sum frame.wkt square.wkt -o a.poly -o a.wkt -o a.geojson -o a.json -o a.svg -o stages.svg "
      "-o x.stages.svg");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Result<RegionData> wkt = read_region_data((work.folder() / "work/a.wkt").string());
  ASSERT_TRUE(wkt.ok());
  for (const char* file : {"a.poly", "a.geojson"}) {
    const Result<RegionData> same = read_region_data((work.folder() / "work" / file).string());
    ASSERT_TRUE(same.ok()) << file;
    EXPECT_EQ(*Region::create(*same), *Region::create(*wkt)) << file;
  }
  EXPECT_TRUE(Json::parse(work.read("a.json")).is_object());
  EXPECT_NE(work.read("a.svg").find("<svg"), std::string::npos);
  EXPECT_NE(work.read("stages.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(work.read("stages.svg"), work.read("x.stages.svg"));
  EXPECT_NE(work.read("stages.svg"), work.read("a.svg"));
  EXPECT_EQ(work.file_count(), 9U);
}

TEST_F(Cli, StandardInputAndOutput) {
  const Outcome outcome = work.run("dymsum convert frame.wkt - --to geojson | dymsum sum - square.wkt -o -");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("POLYGON", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.err.find("area 32"), std::string::npos) << outcome.err;
  for (const char* format : {"poly", "wkt", "geojson", "svg"}) {
    const std::string command = std::string("dymsum convert frame.wkt - --to ") + format;
    const Outcome told = work.run(command + " | dymsum info - --json");
    EXPECT_EQ(told.code, 0) << format << ": " << told.err;
    const Outcome named = work.run(command + " | dymsum info - --json --from " + format);
    ASSERT_EQ(named.code, 0) << format << ": " << named.err;
    EXPECT_EQ(Json::parse(named.out)["shapes"][0]["area"], 16.0) << format;
  }
}

TEST_F(Cli, ConvertKeepsEveryDigit) {
  work.write("odd.wkt", "POLYGON ((0.1 -2.5e-300, 3 0.30000000000000004, 1e22 7.25, 0.1 -2.5e-300))");
  ASSERT_EQ(work.run("dymsum convert odd.wkt odd.poly && dymsum convert odd.poly odd.geojson && "
                     "dymsum convert odd.geojson odd.svg && dymsum convert odd.svg back.wkt")
                .code,
            0);
  const std::string folder = (work.folder() / "work/").string();
  EXPECT_EQ(*Region::create(*read_region_data(folder + "odd.wkt")),
            *Region::create(*read_region_data(folder + "back.wkt")));
}

TEST_F(Cli, InfoDescribesAFile) {
  const Json report = json("dymsum info frame.wkt --json");
  EXPECT_EQ(report["inputs"][0], (Json{{"file", "frame.wkt"}, {"vertices", 8}, {"holes", 1}, {"parts", 1}}));
  EXPECT_EQ(report["tier"], 29);
  EXPECT_EQ(report["shapes"][0]["bounds"], (Json{0.0, 0.0, 5.0, 5.0}));
  EXPECT_EQ(report["shapes"][0]["valid"], true);
  work.write("fine.wkt", "POLYGON ((0 0, 1 1e-9, 0 1, 0 0))");
  EXPECT_GT(json("dymsum info fine.wkt --json")["tier"], 29);
  work.write("huge.wkt", "POLYGON ((0 0, 1e300 1e-300, 0 1, 0 0))");
  EXPECT_EQ(json("dymsum info huge.wkt --json")["tier"], 0);
  const Outcome human = work.run("dymsum info frame.wkt -o frame.svg");
  EXPECT_EQ(human.code, 0);
  EXPECT_NE(human.out.find("1 hole"), std::string::npos) << human.out;
  EXPECT_NE(work.read("frame.svg").find("<svg"), std::string::npos);
}

TEST_F(Cli, WrongUsageEndsWithOne) {
  for (const char* arguments :
       {"", "glue a b", "sum square.wkt", "sum square.wkt square.wkt --engine slow",
        "sum square.wkt square.wkt --repeat 0", "sum square.wkt square.wkt --json -o -", "sum - - ",
        "sum square.wkt square.wkt --semantics ajar", "convert square.wkt", "convert square.wkt - --json",
        "info square.wkt -o square.poly", "sum square.wkt square.wkt --nothing"}) {
    const Outcome outcome = work.run(std::string("dymsum ") + arguments + " </dev/null");
    EXPECT_EQ(outcome.code, 1) << arguments << "\n" << outcome.err;
    const bool json = std::string(arguments).find("--json") != std::string::npos;
    EXPECT_EQ(outcome.out.empty(), !json) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST_F(Cli, UnknownVerbsAndOptionsAreNamedWithWhatMayBeMeant) {
  EXPECT_EQ(work.run("dymsum sun square.wkt square.wkt").err.find("dymsum: unknown verb 'sun'; did you mean sum?\n"),
            0U);
  EXPECT_EQ(work.run("dymsum clear a b").err.find("dymsum: unknown verb 'clear'; did you mean clearance?\n"), 0U);
  const std::string far = work.run("dymsum frobnicate a b").err;
  EXPECT_EQ(far.find("dymsum: unknown verb 'frobnicate'\nThe verbs are sum nfp erode"), 0U) << far;
  const std::string option = work.run("dymsum sum square.wkt square.wkt --semantic=open").err;
  EXPECT_EQ(option.find("dymsum: sum has no option --semantic; did you mean --semantics?\nUsage: dymsum sum P Q"), 0U)
      << option;
}

TEST_F(Cli, FailuresAreJsonWhereJsonIsAskedFor) {
  work.write("bow.wkt", kBow);
  const auto failure = [&](const std::string& command, int code) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command;
    EXPECT_NE(outcome.err, "") << command;
    const Json report = Json::parse(outcome.out);
    EXPECT_EQ(report["error"]["exit"], code) << command;
    EXPECT_NE(outcome.err.find(report["error"]["message"].get<std::string>()), std::string::npos) << outcome.err;
    return report;
  };
  const Json crossing = failure("dymsum nfp bow.wkt square.wkt --json", 2);
  EXPECT_EQ(crossing["verb"], "nfp");
  EXPECT_EQ(crossing["error"]["code"], "self_crossing");
  EXPECT_EQ(crossing["error"]["evidence"]["file"], "bow.wkt");
  EXPECT_EQ(crossing["error"]["evidence"]["ring"], 0);
  EXPECT_EQ(failure("dymsum sum square.wkt square.wkt --engine slow --json", 1)["error"]["code"], "usage");
  EXPECT_EQ(failure("dymsum glue --json", 1)["verb"], "glue");
  EXPECT_TRUE(failure("dymsum --json", 1)["verb"].is_null());
  const Outcome info = work.run("dymsum info bow.wkt --json");
  EXPECT_EQ(info.code, 2);
  EXPECT_EQ(Json::parse(info.out)["shapes"][0]["error"]["code"], "self_crossing") << "one object, the report";
}

TEST_F(Cli, BadInputEndsWithTwoAndSaysWhere) {
  work.write("bow.wkt", kBow);
  work.write("cut.poly", "1\n4 out\n0 0\n1 0\n");
  work.write("nan.wkt", "POLYGON ((0 0, nan 2, 2 0, 0 0))");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"sum absent.wkt square.wkt", "absent.wkt"},
      {"sum bow.wkt square.wkt", "bow.wkt"},
      {"sum square.wkt cut.poly", "cut.poly:"},
      {"info nan.wkt", "nan.wkt"},
      {"info bow.wkt", "bow.wkt"},
      {"sum square.wkt square.doc", "square.doc"},
      {"sum square.wkt square.wkt -o absent/sum.wkt", "absent/sum.wkt"}};
  for (const auto& [arguments, position] : cases) {
    const Outcome outcome = work.run("dymsum " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(position), std::string::npos) << arguments << "\n" << outcome.err;
  }
  EXPECT_EQ(work.file_count(), 5U);
}

TEST_F(Cli, RepairIsAskedForAndReported) {
  work.write("twice.wkt", "POLYGON ((0 0, 0 1, 1 1, 1 1, 1 0, 0 0))");
  const Outcome refused = work.run("dymsum sum twice.wkt square.wkt --json");
  EXPECT_EQ(refused.code, 2) << refused.out;
  const Outcome repaired = work.run("dymsum sum twice.wkt square.wkt --json --repair");
  ASSERT_EQ(repaired.code, 0) << repaired.err;
  EXPECT_NE(repaired.err.find("twice.wkt: repaired: "), std::string::npos) << repaired.err;
  EXPECT_EQ(repaired.err.find("square.wkt"), std::string::npos) << repaired.err;
  EXPECT_EQ(Json::parse(repaired.out)["area_exact"], "4/1");
}

TEST_F(Cli, EveryVerbHasHelpWithAnExample) {
  for (const char* verb : {"", "sum", "nfp", "erode", "info", "convert"}) {
    const Outcome outcome = work.run(std::string("dymsum ") + verb + " --help");
    EXPECT_EQ(outcome.code, 0) << verb;
    EXPECT_NE(outcome.out.find("Example: dymsum "), std::string::npos) << verb << outcome.out;
  }
}

}  // namespace
}  // namespace dymsum::cli_test
