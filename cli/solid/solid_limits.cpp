#include "solid/solid_limits.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "dymsum/spatial_sum.h"

namespace dymsum::cli {

namespace {

// So many facets take about half a second on one core, and seconds where each meets many others.
constexpr double kManyFacets = 20000;

}  // namespace

void add_memory_option(CLI::App& verb, double& megabytes, OperandKind kind) {
  const std::string what = "Stop with an error before more than MB megabytes are held" +
                           std::string(kind == OperandKind::solid ? " beside operands and result"
                                                                  : "; of solids beside operands and result");
  within(verb.add_option("--memory", megabytes, what), 1, 1e9)->type_name("MB");
}

void add_round_option(CLI::App& verb, double& tolerance, OperandKind kind) {
  const std::string what =
      std::string(kind == OperandKind::solid ? "Where" : "Solids: where") +
      " surfaces cross once their coordinates are rounded, merge what is nearer than this fraction "
      "of the largest coordinate; 2^-40 if not given, in single precision 2^-20";
  within(verb.add_option("--round", tolerance, what), 0x1p-50, 0x1p-4)->type_name("TOLERANCE");
}

std::uint64_t memory_bytes(double megabytes) { return static_cast<std::uint64_t>(std::llround(megabytes * 1e6)); }

void announce_cost(const Mesh& p, const Mesh& q) {
  // Short operands cannot have many facets; angles are looked at only where they can.
  if (static_cast<double>(p.triangle_count()) * static_cast<double>(q.triangle_count()) < kManyFacets) return;
  const SpatialCost cost = predict_cost(p, q);
  if (cost.face_vertex + cost.edge_edge < kManyFacets) return;
  std::cerr << "expected: about " << std::llround(cost.face_vertex) << " face + vertex and "
            << std::llround(cost.edge_edge) << " edge + edge facets, " << (cost.bytes + 999999) / 1000000
            << " MB of memory\n";
}

}  // namespace dymsum::cli
