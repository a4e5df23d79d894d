// Tight features in every file and picture, and areas of every size in reports.
#include <gtest/gtest.h>

#include <string>

#include "cli_fixture.h"
#include "dymsum/dymsum.h"
#include "oracles/snapped_shapes.h"

namespace dymsum::cli_test {
namespace {

class TightOutput : public CliTest {
 protected:
  TightOutput() {
    work.write("peg.wkt", "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))\n");
    work.write("slot.wkt", "POLYGON ((-1 -1, 3 -1, 3 4, 2 4, 2 0, 0 0, 0 4, -1 4, -1 -1))\n");
    // A cavity of the peg's size: one free position.
    work.write("box.wkt", "POLYGON ((-1 -1, 3 -1, 3 3, -1 3, -1 -1), (0 0, 0 2, 2 2, 2 0, 0 0))\n");
  }
  std::string run(const std::string& command, int code = 0) {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return outcome.out;
  }
  Json json(const std::string& command) { return Json::parse(run(command)); }
};

TEST_F(TightOutput, GeoJsonKeepsTightFeaturesAsAFeatureOfTheirOwn) {
  const Json slot = Json::parse(run("dymsum nfp slot.wkt peg.wkt -o - --to geojson"));
  ASSERT_EQ(slot["type"], "FeatureCollection");
  ASSERT_EQ(slot["features"].size(), 2u);
  EXPECT_EQ(slot["features"][0]["properties"]["tight"], false);
  EXPECT_EQ(slot["features"][0]["geometry"]["type"], "Polygon");
  EXPECT_EQ(slot["features"][1]["properties"]["tight"], true);
  EXPECT_EQ(slot["features"][1]["geometry"], Json::parse(R"({"type":"LineString","coordinates":[[0,0],[0,4]]})"));
  const Json box = Json::parse(run("dymsum nfp box.wkt peg.wkt -o - --to geojson"));
  EXPECT_EQ(box["features"][1]["geometry"], Json::parse(R"({"type":"MultiPoint","coordinates":[[0,0]]})"));
  // Both features are shapes that can be named; without tight features nothing changes.
  run("dymsum nfp slot.wkt peg.wkt -o slot.geojson");
  EXPECT_EQ(json("dymsum sum 'slot.geojson#sum' peg.wkt --json")["inputs"][0]["vertices"], 4);
  EXPECT_EQ(Json::parse(run("dymsum sum peg.wkt peg.wkt -o - --to geojson"))["type"], "Polygon");
  EXPECT_EQ(Json::parse(run("dymsum nfp slot.wkt peg.wkt --semantics regular -o - --to geojson"))["type"], "Polygon");
}

TEST_F(TightOutput, WktPolyAndNestingKeepTightFeaturesAsFurtherPieces) {
  const std::string wkt = run("dymsum nfp slot.wkt peg.wkt -o - --to wkt");
  EXPECT_TRUE(wkt.starts_with("GEOMETRYCOLLECTION (POLYGON")) << wkt;
  EXPECT_NE(wkt.find("LINESTRING (0 0,0 4)"), std::string::npos) << wkt;
  const std::string poly = run("dymsum nfp slot.wkt peg.wkt -o - --to poly");
  EXPECT_TRUE(poly.starts_with("# tight features: the last 1 polylines and 0 points\n")) << poly;
  EXPECT_NE(poly.find("2 open\n0 0\n0 4\n"), std::string::npos) << poly;
  // Read back it is the same closed set: the same sum with a square.
  run("dymsum nfp slot.wkt peg.wkt -o slot.nfp.wkt -o slot.nfp.poly");
  run("dymsum nfp slot.wkt peg.wkt --semantics regular -o regular.wkt");
  const Json expected = json("dymsum sum regular.wkt peg.wkt --json")["area_exact"];
  for (const char* file : {"slot.nfp.wkt", "slot.nfp.poly"})
    EXPECT_EQ(json(std::string("dymsum sum ") + file + " peg.wkt --json")["area_exact"], expected) << file;
  // An exact fit of erode is in the set and tight: written once.
  const std::string fit = run("dymsum erode box.wkt box.wkt -o - --to wkt");
  EXPECT_EQ(fit, "MULTIPOINT (0 0)\n");
}

TEST_F(TightOutput, PicturesDrawThemInOneColour) {
  run("dymsum nfp slot.wkt peg.wkt -o sum.svg");
  work.write("turned.wkt", "POLYGON ((0 0, -2 0, -2 -2, 0 -2, 0 0))\n");  // the peg by half a turn
  run("dymsum rotate slot.wkt turned.wkt --steps 4 -o strip.svg -o turn.anim.svg");
  run("dymsum scale slot.wkt peg.wkt --robot --sweep 1:2:1/2 -o scale.svg");
  run("dymsum cspace peg.wkt slot.wkt --slices 4 -o slices.svg");
  for (const char* file : {"sum.svg", "strip.svg", "turn.anim.svg", "scale.svg", "slices.svg"}) {
    const std::string text = work.read(file);
    EXPECT_NE(text.find("#d81e3a"), std::string::npos) << file;
    EXPECT_EQ(text.find("#d7301f"), std::string::npos) << file;
  }
  EXPECT_NE(work.read("slices.svg").find("<path class=\"tight\" d=\"M0 0L0 -4\""), std::string::npos);
}

// Seven digits of coordinates near 1e9 are steps of 100: drawings of small scenes there have an origin of their own.
TEST_F(TightOutput, PicturesFarFromTheOriginAreDrawnAsNearIt) {
  work.write("here.wkt", "POLYGON ((0 0, 0.75 0, 0.75 0.5, 0 0.5, 0 0))\n");
  work.write("there.wkt",
             "POLYGON ((1000000000 1000000000, 1000000000.75 1000000000, 1000000000.75 1000000000.5, "
             "1000000000 1000000000.5, 1000000000 1000000000))\n");
  work.write("bit.wkt", "POLYGON ((0 0, 0.125 0, 0 0.125, 0 0))\n");
  const auto drawn = [&](const std::string& region, const std::string& verb, const std::string& file) {
    run("dymsum " + verb + " -o " + file);
    const std::string text = work.read(file);
    EXPECT_EQ(text.find("1000000000"), std::string::npos) << file;
    EXPECT_EQ(text.find("1e+09"), std::string::npos) << file << " of " << region;
    return text;
  };
  const auto frame = [](const std::string& text) {
    const std::size_t at = text.find("d=\"M");
    return text.substr(at, text.find('"', at + 3) - at);
  };
  const std::string strip = drawn("there", "scale there.wkt bit.wkt --scaled q --at 1,2", "there.svg");
  EXPECT_EQ(frame(strip), "d=\"M0 0.75L0.875 0.75L0.875 0.25L0.75 0.125L0 0.125Z") << strip;
  drawn("there", "scale there.wkt bit.wkt --scaled q --at 1,2", "there.anim.svg");
  work.write("copies.txt", "1 1e9 1e9\n");
  drawn("here", "scale here.wkt bit.wkt --copies copies.txt", "copies.svg");
  drawn("there", "path bit.wkt there.wkt --from 999999999,999999999,0 --to 1000000002,1000000000,0", "path.svg");
}

TEST_F(TightOutput, AreasOutsideTheRangeOfDoublesAreText) {
  work.write("huge.wkt", "POLYGON ((0 0, 1e200 0, 1e200 1e200, 0 1e200, 0 0))\n");
  work.write("minute.wkt", "POLYGON ((0 0, 1e-200 0, 1e-200 1e-200, 0 1e-200, 0 0))\n");
  const Json huge = json("dymsum sum huge.wkt huge.wkt --json"),
             minute = json("dymsum sum minute.wkt minute.wkt --json");
  EXPECT_EQ(huge["area"], "3.9999999999999998e+400");
  EXPECT_EQ(minute["area"], "3.9999999999999999e-400");
  EXPECT_NE(run("dymsum sum huge.wkt huge.wkt").find("area 3.9999999999999998e+400\n"), std::string::npos);
  EXPECT_EQ(json("dymsum info huge.wkt --json")["shapes"][0]["area"], "9.9999999999999994e+399");
  EXPECT_NE(run("dymsum info huge.wkt").find("area 9.9999999999999994e+399\n"), std::string::npos);
}

TEST_F(TightOutput, LongFractionsOfAreasAreGivenWhenAskedFor) {
  const auto save = [&](const char* file, const Region& region) {
    work.write(file, format_region(region, RegionFormat::wkt));
  };
  save("star.wkt", shapes::noisy_star(3000, 0.5, 1));
  save("small.wkt", snapped_shapes::disc(7, 0.0004));
  const Json plain = json("dymsum sum star.wkt small.wkt --json"),
             exact = json("dymsum sum star.wkt small.wkt --json --exact");
  ASSERT_GT(plain["crossings"], 50);
  EXPECT_TRUE(plain["area_exact"].is_null());
  EXPECT_GT(exact["area_exact"].get<std::string>().size(), 4000u);
  EXPECT_EQ(plain["area"], exact["area"]);
  EXPECT_TRUE(json("dymsum scale star.wkt small.wkt --at 1 --json")["frames"][0]["area_exact"].is_null());
  EXPECT_EQ(json("dymsum scale star.wkt small.wkt --at 1 --json --exact")["frames"][0]["area_exact"],
            exact["area_exact"]);
  EXPECT_EQ(json("dymsum rotate peg.wkt slot.wkt --steps 4 --json")["frames"][0]["area_exact"],
            json("dymsum sum peg.wkt slot.wkt --json")["area_exact"]);
}

}  // namespace
}  // namespace dymsum::cli_test
