// Pictures of what is cut.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>
#include <vector>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

class ShapePicture : public CliTest {};

TEST_F(ShapePicture, NeighbouringPiecesAreFilledWithDifferentColours) {
  work.write(
      "comb.wkt",
      "POLYGON ((0 0, 68 0, 68 20, 64 20, 64 5, 60 5, 60 20, 56 20, 56 5, 52 5, 52 20, 48 20, 48 5, 44 5, 44 20, "
      "40 20, 40 5, 36 5, 36 20, 32 20, 32 5, 28 5, 28 20, 24 20, 24 5, 20 5, 20 20, 16 20, 16 5, 12 5, 12 20, "
      "8 20, 8 5, 4 5, 4 20, 0 20, 0 0))\n");
  ASSERT_EQ(work.run("dymsum decompose comb.wkt -o pieces.svg -o pieces.json").code, 0);
  const std::string picture = work.read("pieces.svg");
  const std::regex filled("fill=\"(#[0-9a-f]{6})\" stroke=\"none\"");
  std::vector<std::string> fills;
  for (std::sregex_iterator at(picture.begin(), picture.end(), filled), end; at != end; ++at) fills.push_back((*at)[1]);
  const Json pieces = Json::parse(work.read("pieces.json"))["pieces"];
  ASSERT_EQ(fills.size(), pieces.size());
  std::map<std::pair<Json, Json>, std::size_t> piece_left_of;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Json& ring = pieces[i]["outer"];
    for (std::size_t k = 0; k < ring.size(); ++k) piece_left_of[{ring[k], ring[(k + 1) % ring.size()]}] = i;
  }
  std::size_t sides = 0;
  for (const auto& [edge, piece] : piece_left_of)
    if (const auto other = piece_left_of.find({edge.second, edge.first}); other != piece_left_of.end()) {
      ++sides;
      EXPECT_NE(fills[piece], fills[other->second]) << "pieces " << piece << " and " << other->second;
    }
  EXPECT_GE(sides, 18u);
}

}  // namespace
}  // namespace dymsum::cli_test
