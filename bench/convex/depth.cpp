#include "convex/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh_io.h"
#include "python.h"
#include "versus/rival.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

struct Query {
  Rotation turn;
  double matrix[9];
  Point3 at;
};

std::vector<Query> make_queries(double size, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  Rotation turn;
  const Rotation step = *Rotation::about({1, 2, 3}, 0.0126);
  std::vector<Query> queries;
  for (int k = 0; k < count; ++k) {
    Query query{turn = step * turn, {}, {size * offset(random), size * offset(random), size * offset(random)}};
    for (int i = 0; i < 9; ++i)
      query.matrix[i] = static_cast<double>(turn.matrix()[i]) / static_cast<double>(turn.norm());
    queries.push_back(query);
  }
  return queries;
}

/// The rows of one pair: ours first, its answers the truth.
class Depths {
 public:
  Depths(const solids::NamedMesh& p, const solids::NamedMesh& q, int queries)
      : p_(p), q_(q), size_(bounds(p.mesh)[3] - bounds(p.mesh)[0]), queries_(make_queries(size_, queries)) {}

  void query_ours() {
    ConvexSum difference = *ConvexSum::create(p_.mesh, negated(q_.mesh));
    const double start = cpu_ms();
    for (const Query& query : queries_) {
      difference.set(query.turn);
      truth_.push_back(difference.depth(query.at).depth);
    }
    add("dymsum, moving", 1e3 * (cpu_ms() - start), truth_);
  }

  void ask(const DepthPair& pair, DepthRival rival) {
    std::vector<double> depths;
    const double start = cpu_ms();
    for (const Query& query : queries_) depths.push_back(pair.depth(rival, query.matrix, query.at));
    add(name(rival), 1e3 * (cpu_ms() - start), depths);
  }

  /// By its own clock inside of its calls; 0: its own tolerances.
  void query_coal(double tolerance) {
    std::ostringstream queries;
    queries << std::setprecision(17);
    for (const Query& query : queries_) {
      for (const double v : query.matrix) queries << v << " ";
      queries << query.at.x << " " << query.at.y << " " << query.at.z << "\n";
    }
    std::ostringstream set;
    set << tolerance;
    std::istringstream answer(query_python("coal_depth.py",
                                           {{"p.off", format_mesh(p_.mesh, MeshFormat::off)},
                                            {"q.off", format_mesh(q_.mesh, MeshFormat::off)},
                                            {"queries.txt", queries.str()}},
                                           set.str(), 120));
    std::string version;
    double us = 0;
    answer >> version >> us;
    std::vector<double> depths;
    for (double depth; answer >> depth;) depths.push_back(depth);
    const std::string settings = tolerance > 0 ? ", tolerances " + set.str() : ", its own tolerances";
    if (depths.size() == queries_.size()) add("Coal " + version + settings, us, depths);
    else rows_.push_back({std::string(p_.name), std::string(q_.name), "Coal" + settings, 0, 0, 0, 0});
  }

  const std::vector<DepthRow>& rows() const { return rows_; }

 private:
  void add(const std::string& system, double us, const std::vector<double>& depths) {
    DepthRow row{std::string(p_.name),
                 std::string(q_.name),
                 system,
                 us / static_cast<double>(queries_.size()),
                 queries_.size(),
                 0,
                 0};
    for (std::size_t k = 0; k < depths.size(); ++k) {
      const double error = std::abs(depths[k] - truth_[k]) / size_;
      row.wrong += error > 1e-6;
      row.worst = std::max(row.worst, error);
    }
    rows_.push_back(row);
  }

  const solids::NamedMesh &p_, &q_;
  double size_;
  std::vector<Query> queries_;
  std::vector<double> truth_;
  std::vector<DepthRow> rows_;
};

}  // namespace

std::vector<DepthRow> measure_depth(const solids::NamedMesh& p, const solids::NamedMesh& q, int queries) {
  Depths depths(p, q, queries);
  depths.query_ours();
  const DepthPair pair(p.mesh, q.mesh);
  for (const DepthRival rival : {DepthRival::fcl, DepthRival::fcl_tight, DepthRival::ccd_gjk_epa, DepthRival::ccd_mpr})
    depths.ask(pair, rival);
  if (has_python())
    for (const double tolerance : {0.0, 1e-12}) depths.query_coal(tolerance);
  return depths.rows();
}

}  // namespace dymsum::bench
