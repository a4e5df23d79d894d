#include "planar/pairs.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "planar/crossing_grates.h"
#include "thesis/thesis_shapes.h"

namespace dymsum::bench {
namespace {

/// Shapes that are valid, or can be repaired; a note for those that cannot, and one for all that were repaired alike.
class Mender {
 public:
  Mender(std::string label, Pairs& pairs) : label_(std::move(label)), pairs_(pairs) {}
  ~Mender() {
    for (const auto& [what, count] : repaired_) {
      pairs_.notes.push_back(label_ + ": repaired in " + std::to_string(count) + " shapes: " + what);
    }
  }

  std::optional<Region> operator()(const NamedShape& shape) {
    Result<Region> region = Region::create(shape.data);
    if (region.ok()) return std::move(region).value();
    Result<Repaired> repaired = repair(shape.data);
    if (!repaired.ok()) {
      pairs_.notes.push_back(label_ + " " + shape.name + ": left out: " + repaired.error().to_string());
      return std::nullopt;
    }
    ++repaired_[repaired.value().report.to_string()];
    return std::move(repaired).value().region;
  }

 private:
  std::string label_;
  Pairs& pairs_;
  std::map<std::string, int> repaired_;
};

std::vector<Region> read_all(const std::string& path, const std::string& label, Pairs& pairs) {
  std::vector<Region> regions;
  Result<std::vector<NamedShape>> shapes = read_shapes(path);
  if (!shapes.ok()) {
    pairs.notes.push_back(label + ": left out: " + shapes.error().to_string());
    return regions;
  }
  Mender repaired(label, pairs);
  for (const NamedShape& shape : shapes.value()) {
    std::optional<Region> region = repaired(shape);
    if (region) regions.push_back(std::move(*region));
  }
  return regions;
}

std::optional<Region> real_shape(const std::string& data, const std::string& name, Pairs& pairs) {
  std::vector<Region> regions = read_all(data + "/planar/" + name + ".poly", name, pairs);
  if (regions.size() != 1) return std::nullopt;
  return std::move(regions[0]);
}

/// The same region rotated by a quarter: (x, y) -> (-y, x). Exact.
Region turned(const Region& region) {
  RegionData data = region.data();
  const auto turn = [](Ring& ring) {
    for (Point& p : ring) p = {0.0 - p.y, p.x};
  };
  for (Part& part : data.parts) {
    turn(part.outer);
    for (Ring& hole : part.holes) turn(hole);
  }
  return Region::create(std::move(data)).value();
}

/// The larger models, of which the thesis draws figures 3.6 and 3.7.
bool is_large(std::string_view name) {
  static const std::set<std::string_view> large{"airplane", "bird", "dog",   "G1",    "G2",
                                                "G3",       "G4",   "hand1", "hand2", "star"};
  return large.count(name) > 0;
}

void add_thesis_pairs(Pairs& pairs) {
  const std::vector<shapes::Named> set = shapes::thesis_like_set();
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t j = i; j < set.size(); ++j) {
      pairs.list.push_back({std::string(set[i].name) + " + " + std::string(set[j].name), Group::thesis, set[i].region,
                            set[j].region, false, is_large(set[i].name) && is_large(set[j].name)});
    }
  }
}

void add_star(Pairs& pairs, int n, double noise, const char* noise_text) {
  pairs.list.push_back({"star " + std::to_string(n) + " + star " + std::to_string(n) + ", noise " + noise_text,
                        Group::stars, shapes::noisy_star(n, noise, 1), shapes::noisy_star(n, noise, 2)});
}

void add_grates_and_pockets(Pairs& pairs) {
  const Region grate = shapes::grate(20, 1, 0.25, 20);
  pairs.list.push_back({"grate 20 + grate 20", Group::holes, grate, grate});
  pairs.list.push_back({"grate 20 + grate 20 turned", Group::holes, grate, turned(grate)});
  auto [p, q] = crossing_grates(5);
  pairs.list.push_back({"crossing grates 5 + 5", Group::holes, std::move(p), std::move(q)});
  const Region pockets = shapes::pockets(20, 10, shapes::demo_snap(10));
  pairs.list.push_back({"pockets 20 + square", Group::holes, pockets, shapes::rectangle(0, 0, 0.625, 0.625)});
  pairs.list.push_back(
      {"pockets 20 + disc 16", Group::holes, pockets, shapes::disc(16, 0.25, shapes::demo_snap(0.25))});
}

void add_real(Pairs& pairs, const std::string& data) {
  if (data.empty()) {
    pairs.notes.push_back("no data folder (DYMSUM_DATA): the real polygons and nesting tables are skipped");
    return;
  }
  const auto neuron = real_shape(data, "neuron", pairs), monkey = real_shape(data, "monkey", pairs);
  const auto bird = real_shape(data, "bird", pairs), dog = real_shape(data, "dog", pairs);
  const auto star = real_shape(data, "star", pairs);
  const auto add = [&](const char* label, const std::optional<Region>& p, const std::optional<Region>& q) {
    if (p && q) pairs.list.push_back({label, Group::real, *p, *q});
  };
  add("neuron + disc 32", neuron, shapes::disc(32, 1, shapes::demo_snap(1)));
  add("neuron + small disc 32", neuron,
      shapes::disc(32, 1.0 / 64, shapes::demo_snap(1.0 / 64)));  // no hole of the neuron is filled
  add("monkey + bird", monkey, bird);
  add("bird + bird (real)", bird, bird);
  add("dog + bird (real)", dog, bird);
  add("star + star (real)", star, star);
}

void add_table(Pairs& pairs, const std::string& data, Group group) {
  if (data.empty()) return;
  const std::string label = name(group);
  const std::vector<Region> items = read_all(data + "/nesting/" + label + ".json", label, pairs);
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (std::size_t j = 0; j < items.size(); ++j) {
      pairs.list.push_back(
          {label + " nfp " + std::to_string(i) + ", " + std::to_string(j), group, items[i], items[j], true});
    }
  }
}

}  // namespace

const char* name(Group group) {
  switch (group) {
    case Group::thesis:
      return "thesis-like set";
    case Group::stars:
      return "stars";
    case Group::holes:
      return "grates and pockets";
    case Group::real:
      return "real polygons";
    case Group::swim:
      return "swim";
    case Group::shirts:
      return "shirts";
  }
  return "";
}

Pairs all_pairs(const std::string& data) {
  Pairs pairs;
  add_real(pairs, data);
  add_star(pairs, 50, 0.9, "0.9");
  add_star(pairs, 100, 0.9, "0.9");
  add_star(pairs, 200, 0.5, "0.5");
  add_star(pairs, 200, 0.9, "0.9");
  add_star(pairs, 500, 0.1, "0.1");
  add_grates_and_pockets(pairs);
  add_table(pairs, data, Group::swim);
  add_table(pairs, data, Group::shirts);
  add_thesis_pairs(pairs);
  return pairs;
}

Pairs demo_pairs(const std::string& data) {
  Pairs all;
  add_real(all, data);
  add_star(all, 100, 0.9, "0.9");
  add_grates_and_pockets(all);
  add_thesis_pairs(all);
  std::set<std::string> shown{
      "neuron + disc 32",      "monkey + bird",        "bird + bird (real)",  "star 100 + star 100, noise 0.9",
      "crossing grates 5 + 5", "pockets 20 + disc 16", "airplane + insignia", "G1 + hand1",
      "pentagon + U"};
  if (data.empty()) shown.insert({"bird + bird", "bird + dog"});
  Pairs pairs;
  pairs.notes = std::move(all.notes);
  for (Pair& pair : all.list) {
    if (shown.count(pair.name) > 0) pairs.list.push_back(std::move(pair));
  }
  return pairs;
}

void set_coordinates(Pairs& pairs, Kind kind) {
  if (!kind) return;
  std::vector<Pair> rounded;
  for (Pair& pair : pairs.list) {
    Result<Region> p = with_coordinates(pair.p, kind), q = with_coordinates(pair.q, kind);
    if (p && q) {
      rounded.push_back(std::move(pair));
      rounded.back().p = *std::move(p), rounded.back().q = *std::move(q);
    } else {
      pairs.notes.push_back(pair.name + ": left out: " + name(*kind) + ": " + (p ? q : p).error().to_string());
    }
  }
  pairs.list = std::move(rounded);
}

std::string data_folder() {
  if (const char* named = std::getenv("DYMSUM_DATA")) return std::filesystem::is_directory(named) ? named : "";
  const std::string beside = std::string(DYMSUM_SOURCE_DIR) + "/../shared/data";
  return std::filesystem::is_directory(beside) ? beside : "";
}

}  // namespace dymsum::bench
