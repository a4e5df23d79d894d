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
  EXPECT_EQ(work.run(disc + " --to wkt").code, 2);
  const auto nearest = work.run(disc + " --to wkt --bound nearest");
  EXPECT_EQ(nearest.code, 0);
  EXPECT_EQ(nearest.out.rfind("MULTIPOLYGON", 0), 0u);
  EXPECT_NE(work.run(disc + " --to wkt --bound middle").code, 0);
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
