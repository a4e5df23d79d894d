// erode, opening, closing, offset and slice of solids.
#include <cstdint>
#include <cstring>

#include "cli_fixture.h"

namespace dymsum::cli_test {
namespace {

/// A block of 8 x 8 x 4 with a square tunnel of width 2 along z.
constexpr const char* kBore =
    "OFF\n16 16 0\n-4 -4 0\n4 -4 0\n4 4 0\n-4 4 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-4 -4 4\n4 -4 4\n4 4 4\n-4 4 4\n-1 "
    "-1 4\n"
    "1 -1 4\n1 1 4\n-1 1 4\n4 8 9 13 12\n4 1 0 4 5\n4 0 1 9 8\n4 5 4 12 13\n4 9 10 14 13\n4 2 1 5 6\n4 1 2 10 9\n4 6 5 "
    "13 14\n"
    "4 10 11 15 14\n4 3 2 6 7\n4 2 3 11 10\n4 7 6 14 15\n4 11 8 12 15\n4 0 3 7 4\n4 3 0 8 11\n4 4 7 15 12\n";

class SolidVerbs : public CliTest {
 protected:
  SolidVerbs() {
    work.write("tunnel.off", kBore);
    work.write("cube.off", kCube);
    work.write("wedge.off", kTetrahedron);
  }
};

TEST_F(SolidVerbs, ErodeKeepsWhatHasRoomAndWhatHasNone) {
  const Json room = json("dymsum erode tunnel.off cube.off -o room.off -o room.json --json");
  EXPECT_EQ(room["volume_exact"], "40/1");
  EXPECT_EQ(json("dymsum info room.off --json")["volume"], 40.0);
  const Json lists = Json::parse(work.read("room.json"));
  EXPECT_EQ(lists["face_list"].size(), 10u);
  EXPECT_EQ(lists["edge_list"].size(), 24u);
  for (const Json& edge : lists["edge_list"]) EXPECT_EQ(edge["faces"].size(), 2u);
  const Json fit = json("dymsum erode cube.off cube.off --json");
  EXPECT_EQ(fit["tight"], (Json{{"points", 1}, {"segments", 0}, {"faces", 0}})) << "an answer of yes";
  EXPECT_EQ(json("dymsum erode cube.off tunnel.off --json", 4)["faces"], 0);
}

TEST_F(SolidVerbs, OpeningAndClosing) {
  EXPECT_EQ(json("dymsum opening tunnel.off cube.off --json")["volume_exact"], "240/1");
  EXPECT_EQ(json("dymsum closing tunnel.off cube.off --json -o full.stl")["volume_exact"], "256/1") << "no tunnel";
  EXPECT_EQ(json("dymsum info full.stl --json")["volume"], 256.0);
  EXPECT_EQ(json("dymsum opening cube.off tunnel.off --json", 4)["moved"], 0.0);
  const Json failure = json("dymsum opening wedge.off cube.off --json", 4);
  EXPECT_EQ(failure["volume"], 0.0);
  EXPECT_EQ(json("dymsum opening cube.off cube.off --json")["volume_exact"], "8/1") << "one position is left";
  EXPECT_EQ(work.run("dymsum closing cube.off cube.off --engine winding").code, 1);
}

TEST_F(SolidVerbs, OffsetTellsItsBounds) {
  const Json grown = json("dymsum offset cube.off --by 0.5 --tolerance 0.05 -o grown.ply -o grown.glb --json");
  EXPECT_LE(grown["high"], 0.5);
  EXPECT_GE(grown["low"], 0.45);
  EXPECT_GT(grown["volume"], 23.2);
  EXPECT_LT(grown["volume"], 8 + 12 + 6 * 3.1416 / 4 + 0.5236);
  const Json shrunk = json("dymsum offset cube.off --by -0.5 --bound outside --json");
  EXPECT_GE(shrunk["low"], -0.5);
  EXPECT_EQ(json("dymsum offset cube.off --by -1.5 --json", 4)["volume"], 0.0);
  const Outcome text = work.run("dymsum offset cube.off --by 0.5");
  EXPECT_NE(text.out.find("contains the offset by "), std::string::npos) << text.out;
  refused("dymsum offset cube.off --by 0", "--by");
  refused("dymsum offset cube.off", "--by");
  refused("dymsum offset cube.off --by 1 --tolerance 1e-9", "--tolerance");
  refused("dymsum offset cube.off --by nan", "--by");
  refused("dymsum offset cube.off --by 1e-300", "--by:");
  refused("dymsum offset cube.off --by 1e-300 --tolerance 1", "--by:");
  refused("dymsum offset cube.off --by -1 --tolerance 1e-300", "--tolerance:");
  EXPECT_EQ(work.run("dymsum offset missing.off --by 1").code, 2);
}

TEST_F(SolidVerbs, SliceIsPlanar) {
  const Json slice = json("dymsum slice tunnel.off cube.off --z 1.5 --json -o s.svg -o s.wkt -o s.json -o s.geojson");
  EXPECT_EQ(slice["area_exact"], "100/1");
  EXPECT_EQ(slice["tight"], (Json{{"points", 1}, {"segments", 0}}));
  EXPECT_EQ(json("dymsum info s.wkt --json")["shapes"][0]["area"], 100.0);
  EXPECT_EQ(json("dymsum info s.svg --json")["shapes"][0]["area"], 100.0) << "the picture reads back";
  const Json exact = Json::parse(work.read("s.json"));
  EXPECT_EQ(exact["tight_points"][0]["exact"], (Json{"0/1", "0/1"}));
  for (const Json& vertex : exact["parts"][0]["outer"])
    EXPECT_LT(vertex["out"].get<std::size_t>(), exact["contacts"].size());
  EXPECT_EQ(json("dymsum slice tunnel.off cube.off --z 5 --json -o top.svg")["touching"], 1) << "the sum's top";
  EXPECT_EQ(count("top.svg", "touching only"), 1u);
  EXPECT_EQ(json("dymsum slice wedge.off wedge.off --z 0.5 --json")["area_exact"], "9/8");
  EXPECT_EQ(json("dymsum slice wedge.off wedge.off --z 0.5 --reflect --json")["area_exact"],
            json("dymsum slice wedge.off wedge.off --z -0.5 --reflect --json")["area_exact"]);
  EXPECT_EQ(json("dymsum slice tunnel.off cube.off --z 1e-80 --json")["area_exact"],
            json("dymsum slice tunnel.off cube.off --z 0.25 --json")["area_exact"])
      << "heights of 270 bits";
  for (const char* z : {"nan", "inf", "-inf", "1e301", "1e999", "1/2", "0x1p-2x", ""})
    refused(std::string("dymsum slice tunnel.off cube.off --z '") + z + "'", "--z");
  refused("dymsum slice tunnel.off cube.off", "--z");
  refused("dymsum slice tunnel.off cube.off --z 1 -o s.off", "s.off");
  refused("dymsum slice tunnel.off cube.off --z 1 -o stages.svg", "stages.svg");
  refused("dymsum slice tunnel.off cube.off --z 1 --degrees 3", "--degrees");
}

TEST_F(SolidVerbs, CoordinatesOfManyBitsAreTaken) {
  work.write("fine.off", "OFF\n4 4 0\n0 0 0\n1 1e-200 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  for (const char* command : {"sum tunnel.off fine.off", "nfp tunnel.off fine.off", "erode tunnel.off fine.off",
                              "slice fine.off tunnel.off --z 0.5"}) {
    const Json report = json(std::string("dymsum ") + command + " --json");
    EXPECT_EQ(report["verb"], std::string(command).substr(0, std::string(command).find(' '))) << "717 bits along y";
  }
}

TEST_F(SolidVerbs, AllSumsHaveTheSameLists) {
  for (const char* operands : {"cube.off wedge.off", "tunnel.off wedge.off"}) {
    const Json report = json(std::string("dymsum sum ") + operands + " -o s.json --json");
    const Json lists = Json::parse(work.read("s.json"));
    EXPECT_EQ(lists["face_list"].size(), report["faces"]) << operands;
    EXPECT_EQ(lists["vertex_list"].size(), report["vertices"]) << operands;
    EXPECT_GT(lists["edge_list"].size(), lists["face_list"].size()) << operands;
    for (const char* key : {"faces", "segments", "points"})
      EXPECT_TRUE(lists["tight_list"][key].is_array()) << operands;
    for (const char* list : {"vertex_list", "edge_list", "face_list"})
      for (const Json& one : lists[list]) EXPECT_TRUE(one.contains("p") && one.contains("q")) << operands << list;
    for (const Json& edge : lists["edge_list"]) EXPECT_EQ(edge["faces"].size(), 2u) << operands;
  }
}

TEST_F(SolidVerbs, StagesAreDrawnBesideTheResult) {
  for (const char* operands : {"cube.off wedge.off", "tunnel.off cube.off"}) {
    EXPECT_EQ(work.run(std::string("dymsum nfp ") + operands + " -o stages.glb -o plain.glb").code, 0) << operands;
    EXPECT_GT(work.read("stages.glb").size(), work.read("plain.glb").size()) << operands;
    EXPECT_EQ(count("stages.glb", "BLEND"), 1u) << operands;
  }
}

TEST_F(SolidVerbs, TightFacesAreFilledInPictures) {
  // a plate as thick as its slot: a rectangle of positions, drawn as two triangles within four bars
  work.write(
      "slot.off",
      "OFF\n16 12 0\n0 0 0\n8 0 0\n8 8 0\n0 8 0\n0 0 1\n8 0 1\n8 8 1\n0 8 1\n0 0 2\n8 0 2\n8 8 2\n0 8 2\n0 0 3\n"
      "8 0 3\n8 8 3\n0 8 3\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 8 11 10 9\n4 12 13 "
      "14 15\n4 8 9 13 12\n4 9 10 14 13\n4 10 11 15 14\n4 11 8 12 15\n");
  work.write("plate.off",
             "OFF\n8 6 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 1\n2 0 1\n2 2 1\n0 2 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
             "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const Json sum = json("dymsum nfp slot.off plate.off -o slot.glb --json");
  EXPECT_EQ(sum["tight"]["faces"], 1);
  const std::string bytes = work.read("slot.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  const Json scene = Json::parse(bytes.substr(20, length));
  const Json& marks = scene["meshes"].back()["primitives"][0];
  EXPECT_EQ(scene["accessors"][marks["indices"].get<std::size_t>()]["count"], 3 * (2 + 4 * 8));
  EXPECT_EQ(scene["materials"].back()["doubleSided"], true);
}

TEST_F(SolidVerbs, HaveHelpWithAnExample) {
  for (const char* verb : {"opening", "closing", "offset", "slice", "erode"}) {
    const Outcome outcome = work.run(std::string("dymsum ") + verb + " --help");
    EXPECT_NE(outcome.out.find("Example: dymsum "), std::string::npos) << verb << outcome.out;
  }
}

}  // namespace
}  // namespace dymsum::cli_test
