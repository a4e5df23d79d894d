// Maps of grid cells: sets of cells against the union of their squares, the rules for grey values, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "dymsum/planar_sum.h"
#include "dymsum/region_io.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

class ReadMap : public testing::Test {
 protected:
  ReadMap() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("dymsum_read_map_") + test->name());
    fs::create_directories(folder_);
  }
  ~ReadMap() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  static Region region(const std::string& path) {
    Result<RegionData> data = read_region_data(path);
    EXPECT_TRUE(data.ok()) << path << ": " << (data.ok() ? "" : data.error().to_string());
    return Region::create(std::move(data).value()).value();
  }
  static Error refused(const std::string& path) {
    const Result<RegionData> data = read_region_data(path);
    EXPECT_FALSE(data.ok());
    return data.ok() ? Error{} : data.error();
  }
  // Cells by column and row from below, as squares.
  static Region squares(const std::vector<Point>& cells, double x = 0, double y = 0, double side = 1) {
    std::vector<Region> all;
    for (const Point& c : cells) {
      const double l = std::fma(c.x, side, x), r = std::fma(c.x + 1, side, x);
      const double b = std::fma(c.y, side, y), t = std::fma(c.y + 1, side, y);
      all.push_back(Region::create({{{{{l, b}, {r, b}, {r, t}, {l, t}}, {}}}, {}, {}}).value());
    }
    return union_of(all)->rounded().value();
  }
  static std::string pgm(int width, int height, const std::vector<int>& rows) {
    std::string text = "P2\n# by hand\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    for (const int v : rows) text += std::to_string(v) + " ";
    return text;
  }

  fs::path folder_;
};

TEST_F(ReadMap, a_movingai_map_with_its_border) {
  const std::string file = write("small.map", "type octile\nheight 3\nwidth 4\nmap\n.GS.\n.@T.\nW..O\n");
  EXPECT_EQ(region(file + "#occupied"), squares({{1, 1}, {2, 1}, {0, 0}, {3, 0}}));
  EXPECT_EQ(region(file + "#free"), squares({{0, 2}, {1, 2}, {2, 2}, {3, 2}, {0, 1}, {3, 1}, {1, 0}, {2, 0}}));
  std::vector<Point> blocked{{1, 1}, {2, 1}, {0, 0}, {3, 0}};
  for (double k = -1; k <= 4; ++k) blocked.insert(blocked.end(), {{k, -1}, {k, 3}});
  for (double k = 0; k <= 2; ++k) blocked.insert(blocked.end(), {{-1, k}, {4, k}});
  EXPECT_EQ(region(file), squares(blocked));
  EXPECT_EQ(region(file + "#blocked"), squares(blocked));
  EXPECT_TRUE(read_region_data(file + "#unknown")->parts.empty());
  EXPECT_EQ(refused(file + "#walls").code, ErrorCode::malformed);
}

// Cells that touch in corners alone, holes that touch, islands in holes.
TEST_F(ReadMap, random_sets_of_cells_are_the_unions_of_their_squares) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    const int w = 1 + static_cast<int>(random() % 9), h = 1 + static_cast<int>(random() % 9);
    std::vector<Point> cells;
    std::string rows;
    for (int row = 0; row < h; ++row) {
      for (int i = 0; i < w; ++i) {
        const bool solid = round == 0 ? (row + i) % 2 == 0 : random() % 100 < 30 + static_cast<unsigned>(round);
        if (solid) cells.push_back({static_cast<double>(i), static_cast<double>(h - 1 - row)});
        rows += solid ? '@' : '.';
      }
      rows += '\n';
    }
    if (cells.empty()) continue;
    const std::string file = write(
        "random.map", "type octile\nheight " + std::to_string(h) + "\nwidth " + std::to_string(w) + "\nmap\n" + rows);
    EXPECT_EQ(region(file + "#occupied"), squares(cells)) << rows;
  }
}

TEST_F(ReadMap, a_ros_map_with_every_kind_of_cell) {
  // Occupied, unknown and free in trinary mode; 204 is 51 / 255 = 0.2 exactly.
  write("room.pgm", pgm(4, 2, {0, 205, 254, 255, 89, 90, 204, 100}));
  const std::string keys = "image: room.pgm\nresolution: 0.05\norigin: [-1.5, 2.25, 0.0]  # lower left\n";
  const std::string file = write("room.yaml", keys + "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n");
  const auto set = [&](const std::vector<Point>& cells) { return squares(cells, -1.5, 2.25, 0.05); };
  // 255 - 89 = 166 is more than 0.65 * 255 = 165.75, 165 is less.
  EXPECT_EQ(region(file + "#occupied"), set({{0, 1}, {0, 0}}));
  EXPECT_EQ(region(file + "#unknown"), set({{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(region(file + "#free"), set({{1, 1}, {2, 1}, {3, 1}}));
  const std::string negated =
      write("negated.yaml", keys + "negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.2\nmode: scale\n");
  EXPECT_EQ(region(negated + "#free"), set({{0, 1}}));
  EXPECT_EQ(region(negated + "#occupied"), set({{1, 1}, {2, 1}, {3, 1}, {2, 0}}));
  const std::string raw = write("raw.yml", keys + "occupied_thresh: 0.65\nfree_thresh: 0.25\nmode: raw\nnegate: 0\n");
  EXPECT_EQ(region(raw + "#free"), set({{0, 1}}));
  EXPECT_EQ(region(raw + "#occupied"), set({{0, 0}, {1, 0}, {3, 0}}));
  EXPECT_EQ(region(raw + "#unknown"), set({{1, 1}, {2, 1}, {3, 1}, {2, 0}}));
}

TEST_F(ReadMap, bytes_wide_values_lists_and_quotes) {
  write("bytes.pgm", std::string("P5 2 1 255\n") + '\0' + '\xff');
  write("wide.pgm", std::string("P5\n2 1\n65535\n") + std::string("\0\1\xff\xfe", 4));
  const auto yaml = [&](const std::string& image) {
    return write("list.yaml", "---\nimage: '" + image +
                                  "'\nresolution: 2\norigin:\n  - 1\n- 0.0\n- \"0\"\nunused: x\n"
                                  "negate: 0\noccupied_thresh: 0.5\nfree_thresh: 0.5\n");
  };
  for (const char* image : {"bytes.pgm", "wide.pgm"})
    EXPECT_EQ(region(yaml(image) + "#occupied"), squares({{0, 0}}, 1, 0, 2)) << image;
}

TEST_F(ReadMap, the_yaw_turns_the_map_about_its_origin) {
  write("two.pgm", pgm(3, 2, {0, 255, 255, 0, 0, 255}));
  const auto file = [&](const std::string& yaw) {
    return write("turned.yaml", "image: two.pgm\nresolution: 1\norigin: [10, 20, " + yaw +
                                    "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n");
  };
  const Region straight = region(file("0") + "#occupied"), turned = region(file("0.5") + "#occupied");
  ASSERT_EQ(straight.parts().size(), 1u);
  ASSERT_EQ(turned.parts().size(), 1u);
  // The same corners, turned; vertices are listed from the smallest one.
  for (const Point& p : straight.parts()[0].outer) {
    const double u = p.x - 10, v = p.y - 20;
    double least = INFINITY;
    for (const Point& q : turned.parts()[0].outer)
      least = std::min(least, std::hypot(q.x - 10 - std::cos(0.5) * u + std::sin(0.5) * v,
                                         q.y - 20 - std::sin(0.5) * u - std::cos(0.5) * v));
    EXPECT_LT(least, 1e-14);
  }
}

TEST_F(ReadMap, wrong_files_are_refused_with_their_place) {
  const auto map = [&](const std::string& text, ErrorCode code, std::int64_t line) {
    const Error error = refused(write("wrong.map", text));
    EXPECT_EQ(error.code, code) << text;
    EXPECT_EQ(error.evidence.line, line) << text << error.message;
  };
  map("type octile\nheight 1\nwidth 2\nmap\n.\n", ErrorCode::malformed, 5);
  map("type octile\nheight 1\nwidth 2\nmap\n.x\n", ErrorCode::malformed, 5);
  map("type octile\nheight 2\nwidth 2\nmap\n..\n", ErrorCode::truncated, 5);
  map("type octile\nheight 1\nwidth 2\nmap\n..\n..\n", ErrorCode::malformed, 6);
  map("type octile\nheight 0\nwidth 2\nmap\n", ErrorCode::malformed, 2);
  map("type octile\nwidth 2\nheight 2\nmap\n", ErrorCode::malformed, 2);
  map("type octile\nheight 32768\nwidth 32768\n", ErrorCode::truncated, 3);
  write("one.pgm", pgm(1, 1, {0}));
  const std::string rest = "resolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.2\n";
  const auto yaml = [&](const std::string& text, std::int64_t line) {
    const Error error = refused(write("wrong.yaml", text));
    EXPECT_EQ(error.code, ErrorCode::malformed) << text;
    EXPECT_EQ(error.evidence.line, line) << text << error.message;
  };
  yaml("image: one.png\n" + rest, 1);
  yaml(rest, 1);
  yaml("image: one.pgm\nimage: one.pgm\n" + rest, 2);
  yaml("image: one.pgm\nresolution: 0\norigin: [0, 0, 0]\n", 2);
  yaml("image: one.pgm\nresolution: 1\norigin: [0, 0]\n", 3);
  yaml("image: one.pgm\nresolution: 1\norigin: [0, inf, 0]\n", 3);
  yaml("image: one.pgm\nmode: grey\n" + rest, 2);
  yaml("image: one.pgm\n- 3\n" + rest, 2);
  yaml("image: one.pgm\nwords\n" + rest, 2);
  EXPECT_EQ(refused(write("absent.yaml", "image: absent.pgm\n" + rest)).code, ErrorCode::cannot_open);
  const std::string good = write("good.yaml", "image: bad.pgm\n" + rest);
  const auto image = [&](const std::string& text, ErrorCode code) {
    write("bad.pgm", text);
    const Error error = refused(good);
    EXPECT_EQ(error.code, code) << text;
    EXPECT_TRUE(error.evidence.file.ends_with("bad.pgm"));
  };
  image("P6\n1 1\n255\n...", ErrorCode::malformed);
  image("P5\n2 2\n255\nabc", ErrorCode::truncated);
  image("P2\n2 1\n255\n1", ErrorCode::truncated);
  image("P2\n1 1\n255\n256", ErrorCode::malformed);
  image("P2\n0 1\n255\n", ErrorCode::malformed);
  image("P2\n1 1\n70000\n", ErrorCode::malformed);
  image("P5\n1000000000 1000000000\n255\n", ErrorCode::malformed);
  image("P5\n30000 30000\n255\nxyz", ErrorCode::truncated);
}

}  // namespace
}  // namespace dymsum::io_test
