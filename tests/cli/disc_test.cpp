// dymsum disc: polygons, and radii that are none.
#include <gtest/gtest.h>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class DiscCli : public CliTest {};

TEST_F(DiscCli, PolygonsNearestToASetAreThereWhereItFallsApart) {
  // The erosion at its neck: two arcs that touch in a cusp.
  work.write("neck.wkt", "POLYGON ((0 0,3 2,6 0,6 6,3 4,0 6,0 0))");
  const std::string disc = "dymsum disc neck.wkt --set erosion --semantics regular --radius 1 -o -";
  const auto inside = work.run(disc + " --to wkt --bound inside"),
             outside = work.run(disc + " --to wkt --bound outside");
  EXPECT_EQ(inside.code, 0) << inside.err;
  EXPECT_NE(inside.err.find(" may be left out"), std::string::npos) << inside.err;
  EXPECT_EQ(inside.out.rfind("MULTIPOLYGON", 0), 0u) << inside.out;
  EXPECT_EQ(outside.code, 0) << outside.err;
  const auto nearest = work.run(disc + " --to wkt --bound nearest");
  EXPECT_EQ(nearest.code, 0);
  EXPECT_EQ(nearest.out.rfind("MULTIPOLYGON", 0), 0u);
  EXPECT_NE(work.run(disc + " --to wkt --bound middle").code, 0);
  // Where no bound is requested those are made, and said.
  const auto any = work.run(disc + " --to wkt");
  EXPECT_EQ(any.code, 0) << any.err;
  EXPECT_EQ(any.out, nearest.out);
  EXPECT_NE(any.err.find("polygons: nearest, within 0.001; those inside"), std::string::npos) << any.err;
  const auto told = work.run("dymsum disc neck.wkt --set erosion --semantics regular --radius 1 -o neck2.wkt --json");
  EXPECT_NE(told.out.find("\"bound\": \"nearest\""), std::string::npos) << told.out;
}

TEST_F(DiscCli, PolygonsOnEitherSideOfASetThatVanishes) {
  work.write("house.wkt", "POLYGON ((0 0,0.3 0,0.3 0.1,0.1 0.3,0 0.1,0 0))");
  const Json events = json("dymsum disc house.wkt --set erosion --radius 0.01 --events --json")["events"];
  const std::string last = "event:" + std::to_string(events.size() - 1);
  for (const std::string& radius : {last, std::string("0.08")})
    for (const char* bound : {"inside", "outside", "nearest"}) {
      const auto made =
          work.run("dymsum disc house.wkt --set erosion --radius " + radius + " -o vanishing.wkt --bound " + bound);
      EXPECT_EQ(made.code, 0) << radius << " " << bound << ": " << made.err;
      EXPECT_EQ(work.run("dymsum info vanishing.wkt").code, 0) << radius << " " << bound;
    }
}

TEST_F(DiscCli, PolygonsOfAVertexAtAThirdOfAnEdge) {
  work.write("third.wkt", "POLYGON((0 0,0.3333333333333333 0.1,1 0.3,0 1,0 0))");
  for (const char* set : {"sum", "erosion", "opening", "closing"}) {
    const auto made =
        work.run(std::string("dymsum disc third.wkt --radius 0.1 -o third2.wkt --bound inside --set ") + set);
    EXPECT_EQ(made.code, 0) << set << made.err;
  }
}

TEST_F(DiscCli, ErrorsOfPolygonsAreNoFinerThanDoubles) {
  work.write("far.wkt", "POLYGON((1e9 0,1000000001 0,1e9 1,1e9 0))");
  const auto made = work.run("dymsum disc far.wkt --radius 0.01 -o far2.wkt");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("polygons: inside, within 0.00363"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find(" within "), std::string::npos) << "the area has its error: " << made.out;
}

TEST_F(DiscCli, AreasAreShownWithErrorsThatAreNotNegligible) {
  work.write("square.wkt", "POLYGON((0 0,2 0,2 2,0 2,0 0))");
  EXPECT_EQ(work.run("dymsum disc square.wkt --radius 1").out.find(" within "), std::string::npos);
  const auto thin = work.run("dymsum disc square.wkt --radius 0.99999999999 --set erosion");
  EXPECT_NE(thin.out.find(" within "), std::string::npos) << thin.out;
}

TEST_F(DiscCli, RadiiThatAreNoRadiiAreUsageAndThoseOutOfRangeAreData) {
  work.write("u.wkt", "POLYGON((0 0,4 0,4 4,2 1,0 4,0 0))");
  const auto code = [&](const char* radius) {
    return work.run(std::string("dymsum disc u.wkt --radius=") + radius).code;
  };
  EXPECT_EQ(code("-1"), 1);
  EXPECT_EQ(code("event:99"), 1);
  EXPECT_EQ(code("1e200"), 2);
  EXPECT_EQ(code("1e-200"), 2);
  EXPECT_EQ(code("event:0"), 0);
}

}  // namespace
}  // namespace dymsum::cli_test
