#include "cspace/turning_pairs.h"

#include <filesystem>
#include <stdexcept>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "planar/crossing_grates.h"
#include "thesis/thesis_shapes.h"

namespace dymsum::bench {
namespace {

struct Shape {
  Region region;
  std::string source;
};

Region generated(std::string_view name) {
  for (shapes::Named& shape : shapes::thesis_like_set())
    if (shape.name == name) return std::move(shape.region);
  throw std::runtime_error("no generated shape of this name: " + std::string(name));
}

Shape stand_in(const std::string& name) { return {generated(name), "stand-in " + name}; }

/// The thesis's polygon, or its stand-in where there is no such file.
Shape real(const std::string& data, const std::string& name) {
  const std::string path = data + "/planar/" + name + ".poly";
  if (data.empty() || !std::filesystem::exists(path)) return stand_in(name);
  Repaired repaired = repair(read_region_data(path).value()).value();
  std::string source = name + ".poly";
  if (repaired.report.changed()) source += " (" + repaired.report.to_string() + ")";
  return {std::move(repaired.region), std::move(source)};
}

TurningPair pair(std::string name, const Shape& robot, const Shape& obstacle, const PrintedObstacle& thesis = {}) {
  const auto corners = [](const Shape& s) { return s.source + ", " + std::to_string(s.region.vertex_count()); };
  return {std::move(name), corners(robot) + "; " + corners(obstacle), robot.region, obstacle.region, thesis};
}

}  // namespace

std::vector<TurningPair> turning_pairs(const std::string& data) {
  const Shape bar = stand_in("bar"), star = real(data, "star"),
              circle{shapes::disc(32, 4, shapes::demo_snap(4)), "regular 32-gon"};
  const auto [upright, lying] = crossing_grates(4);
  std::vector<TurningPair> pairs;
  pairs.push_back(pair("bar/circle", bar, circle, {0.1, 256, 256, 1, 36, 36, 36, 36}));
  pairs.push_back(pair("bar/sewing", bar, stand_in("sewing"), {0.05, 68, 82, 1, 42, 33, 30, 22}));
  pairs.push_back(pair("star/star", star, star, {4.9, 2288, 3499, 1, 1608, 1300, 382, 257}));
  pairs.push_back(pair("star/hand", star, stand_in("hand1"), {6.8, 3286, 3034, 1, 1689, 2758, 281, 297}));
  pairs.push_back(pair("grate1/grate2", stand_in("G1"), stand_in("G2"), {4.9, 1028, 4097, 126, 1394, 5243, 469, 1204}));
  pairs.push_back(pair("bar/grate4", bar, stand_in("G4"), {0.3, 244, 1027, 17, 191, 131, 92, 77}));
  pairs.push_back(pair("grate3/grate4", stand_in("G3"), stand_in("G4"), {21.7, 991, 1947, 39, 1162, 10136, 400, 1544}));
  pairs.push_back(
      pair("dog/bird", real(data, "dog"), real(data, "bird"), {3350.6, 39145, 18500, 1, 38342, 255635, 2921, 3742}));
  pairs.push_back(pair("crossing grates", {upright, "grate of 4 + 4 bars"}, {lying, "grate of 4 + 4 bars"}));
  return pairs;
}

std::vector<TurningPair> symmetric_pairs() {
  std::vector<TurningPair> pairs;
  const auto with_itself = [&](const std::string& name, const Region& region) {
    pairs.push_back(pair(name + " with itself", {region, name}, {region, name}));
  };
  for (const int n : {3, 4, 6, 8, 16, 32})
    with_itself("regular " + std::to_string(n) + "-gon", shapes::disc(n, 1, shapes::demo_snap(1)));
  for (const int n : {4, 8, 22})
    with_itself("star of " + std::to_string(n) + " points", shapes::star(n, 3.2, 6.9, shapes::demo_snap(6.9)));
  with_itself("gear of 8 teeth", shapes::gear(8, 3, 4, shapes::demo_snap(4)));
  with_itself("comb of 5 teeth", shapes::comb(5, 1, 0.25, 3));
  with_itself("grate of 4 holes", shapes::grate(5, 1, 0.25, 4));
  with_itself("G1", generated("G1"));
  const Region square = shapes::rectangle(0, 0, 1, 1);
  pairs.push_back(pair("square in holes of its size", {square, "square"},
                       {shapes::grate(4, 2, 1, 3), "grate with holes 1 wide and 1 high"}));
  return pairs;
}

std::vector<TurningPair> with_coordinates(std::vector<TurningPair> pairs, Kind kind, std::vector<std::string>& notes) {
  if (!kind) return pairs;
  std::erase_if(pairs, [&](TurningPair& pair) {
    Result<Region> robot = with_coordinates(pair.robot, kind), obstacle = with_coordinates(pair.obstacle, kind);
    if (robot && obstacle) {
      pair.robot = *std::move(robot), pair.obstacle = *std::move(obstacle);
      return false;
    }
    notes.push_back(pair.name + ": left out: " + (robot ? obstacle : robot).error().to_string());
    return true;
  });
  return pairs;
}

}  // namespace dymsum::bench
