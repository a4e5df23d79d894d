#include "scaling/pairs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "planar/crossing_grates.h"
#include "thesis/thesis_shapes.h"

namespace dymsum::bench {
namespace {

/// Coordinates on integers of at most 22 bits; repaired where that makes vertices collinear or equal.
Region snapped(const Region& region) {
  const auto box = bounds(region);
  double size = 0;
  for (const double v : box) size = std::max(size, std::abs(v));
  const double f = std::ldexp(1.0, 21 - std::ilogb(size));
  RegionData data = region.data();
  const auto all = [&](Ring& ring) {
    for (Point& p : ring) p = {std::round(p.x * f), std::round(p.y * f)};
  };
  for (Part& part : data.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  Result<Repaired> repaired = repair(std::move(data));
  if (!repaired.ok()) throw std::runtime_error(repaired.error().to_string());
  return std::move(repaired).value().region;
}

/// Both on one grid: the sizes keep their proportion.
std::pair<Region, Region> snapped_pair(const Region& p, const Region& q) {
  const auto size = [](const Region& r) {
    double m = 0;
    for (const double v : bounds(r)) m = std::max(m, std::abs(v));
    return std::ilogb(m);
  };
  const int difference = size(q) - size(p);
  const double f = std::ldexp(1.0, difference);
  Region a = snapped(p), b = snapped(q);
  b = scaled(b, f, f).value();
  return {std::move(a), std::move(b)};
}

Region read(const std::string& data, const std::string& name) {
  return std::move(repair(read_region_data(data + "/planar/" + name + ".poly").value()).value().region);
}

}  // namespace

std::vector<ScalingPair> frame_pairs(const std::string& data) {
  std::vector<ScalingPair> pairs;
  const auto add = [&](const char* name, const Region& p, const Region& q, bool q_scales = false) {
    auto [a, b] = snapped_pair(p, q);
    pairs.push_back({name, std::move(a), std::move(b), q_scales});
  };
  if (!data.empty()) {
    const Region neuron = read(data, "neuron"), monkey = read(data, "monkey"), bird = read(data, "bird"),
                 dog = read(data, "dog");
    add("neuron + disc 32", neuron, shapes::disc(32, 1, shapes::demo_snap(1)), true);
    add("monkey + bird", monkey, bird);
    add("dog + dog", dog, dog);
  }
  add("star 100 + star 100", shapes::noisy_star(100, 0.5, 1), shapes::noisy_star(100, 0.5, 2));
  add("star 200 + star 200", shapes::noisy_star(200, 0.5, 1), shapes::noisy_star(200, 0.5, 2));
  add("star 500 + star 500", shapes::noisy_star(500, 0.1, 1), shapes::noisy_star(500, 0.1, 2));
  const auto [p, q] = crossing_grates(5);
  pairs.push_back({"crossing grates 5 + 5", p, q, false});
  return pairs;
}

std::vector<ScalingPair> table_pairs() {
  std::vector<ScalingPair> pairs;
  const auto set = shapes::thesis_like_set();
  const char* const names[] = {"dog", "G1", "G2", "G3", "G4"};
  const auto find = [&](std::string_view name) -> const Region& {
    for (const shapes::Named& n : set)
      if (n.name == name) return n.region;
    throw std::runtime_error("no such shape");
  };
  for (const char* a : names)
    for (const char* b : names) {
      auto [p, q] = snapped_pair(find(a), find(b));
      pairs.push_back({std::string(a) + " + " + b, std::move(p), std::move(q), false});
    }
  return pairs;
}

std::vector<ScalingPair> sweep_pairs(const std::string& data, Snapping snapping) {
  std::vector<ScalingPair> pairs;
  const auto add = [&](std::string name, Region p, Region q) {
    if (snapping == Snapping::snapped) std::tie(p, q) = snapped_pair(p, q);
    pairs.push_back({std::move(name), std::move(p), std::move(q), false});
  };
  if (!data.empty())
    for (const auto& [p, q] : {std::pair{"dog", "dog"},
                               {"dog", "bird"},
                               {"star", "star"},
                               {"monkey", "bird"},
                               {"neuron", "egg"},
                               {"mammoth", "texas"}})
      add(std::string(p) + " + " + q, read(data, p), read(data, q));
  for (const auto& [n, noise] : {std::pair{100, 0.5}, {500, 0.1}})
    add("star " + std::to_string(n) + " + star " + std::to_string(n), shapes::noisy_star(n, noise, 1),
        shapes::noisy_star(n, noise, 2));
  auto [p, q] = crossing_grates(5);
  add("crossing grates 5 + 5", std::move(p), std::move(q));
  return pairs;
}

std::vector<ScalingPair> with_coordinates(std::vector<ScalingPair> pairs, Kind kind, std::vector<std::string>& notes) {
  if (!kind) return pairs;
  std::erase_if(pairs, [&](ScalingPair& pair) {
    Result<Region> p = with_coordinates(pair.p, kind), q = with_coordinates(pair.q, kind);
    if (p && q) {
      pair.p = *std::move(p), pair.q = *std::move(q);
      return false;
    }
    notes.push_back(pair.name + ": left out: " + (p ? q : p).error().to_string());
    return true;
  });
  return pairs;
}

}  // namespace dymsum::bench
