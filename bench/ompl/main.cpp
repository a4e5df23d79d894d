// dymsum_bench_ompl: paths of OMPL's planners round a thin wall, with OMPL's motion validator, which looks at samples,
// and with the certified one; and the exact planner. Every path is looked at again at 20,000 points, by doubles of
// another program.
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cstring>
#include <stdexcept>

#include "adapters/walls.h"
#include "page.h"
#include "spread.h"

namespace dymsum::bench {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;
using sampling::Validator;

constexpr const char* kUsage =
    "dymsum_bench_ompl [--runs N] [--results DIR]\n"
    "  --runs N       of each planner at each wall; 40\n"
    "  --results DIR  also write ompl.md and ompl.csv into DIR\n";

struct Row {
  std::string planner, validator;
  int solved = 0, colliding = 0, simplified_colliding = 0, runs = 0;
  std::vector<double> ms;
};

struct Contestant {
  std::string name;
  Validator validator;
  double fraction = 0.01;  // OMPL's longestValidSegmentFraction, its default
  double seconds = 20;
  int one_in = 1;  // of the runs, one in so many
  std::function<ob::PlannerPtr(const og::SimpleSetup&, const std::shared_ptr<const for_ompl::Scene>&)> make;
};

ob::PlannerPtr rrt_connect(const og::SimpleSetup& setup, const std::shared_ptr<const for_ompl::Scene>&) {
  return std::make_shared<og::RRTConnect>(setup.getSpaceInformation());
}
ob::PlannerPtr bit_star(const og::SimpleSetup& setup, const std::shared_ptr<const for_ompl::Scene>&) {
  return std::make_shared<og::BITstar>(setup.getSpaceInformation());
}
ob::PlannerPtr exact(const og::SimpleSetup& setup, const std::shared_ptr<const for_ompl::Scene>& scene) {
  return std::make_shared<for_ompl::ExactPlanner>(setup.getSpaceInformation(), scene);
}

std::vector<Contestant> contestants() {
  return {{"RRTConnect", Validator::of_samples, 0.01, 20, 1, rrt_connect},
          {"RRTConnect", Validator::of_samples, 0.001, 20, 1, rrt_connect},
          {"RRTConnect", Validator::certified, 0.01, 20, 1, rrt_connect},
          {"BIT*, 0.5 s", Validator::of_samples, 0.01, 0.5, 4, bit_star},
          {"BIT*, 0.5 s", Validator::certified, 0.01, 0.5, 4, bit_star},
          {"dymsum", Validator::certified, 0.01, 20, 1, exact}};
}

std::string name_of(const Contestant& c) {
  return c.validator == Validator::certified ? "certified" : "samples, segment fraction " + fixed(c.fraction, 3);
}

Row measure(const Contestant& contestant, const std::shared_ptr<const for_ompl::Scene>& scene, int runs) {
  const sampling::PlainCollision plain(scene->robot(), scene->obstacle());
  Row row{contestant.name, name_of(contestant), 0, 0, 0, std::max(1, runs / contestant.one_in), {}};
  for (int k = 0; k < row.runs; ++k) {
    og::SimpleSetup setup = sampling::wall_problem(scene, contestant.validator);
    setup.getSpaceInformation()->setStateValidityCheckingResolution(contestant.fraction);
    setup.setPlanner(contestant.make(setup, scene));
    const auto start = std::chrono::steady_clock::now();
    const ob::PlannerStatus status = setup.solve(contestant.seconds);
    row.ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    if (status != ob::PlannerStatus::EXACT_SOLUTION) continue;
    ++row.solved;
    row.colliding += sampling::collides(setup.getSolutionPath(), plain);
    setup.simplifySolution();
    row.simplified_colliding += sampling::collides(setup.getSolutionPath(), plain);
  }
  return row;
}

int run(int argc, char** argv) {
  int runs = 40;
  std::string results;
  for (int k = 1; k < argc; k += 2) {
    if (k + 1 >= argc) throw std::invalid_argument(kUsage);
    if (std::strcmp(argv[k], "--runs") == 0) runs = std::stoi(argv[k + 1]);
    else if (std::strcmp(argv[k], "--results") == 0) results = argv[k + 1];
    else throw std::invalid_argument(kUsage);
  }
  ::ompl::msg::setLogLevel(::ompl::msg::LOG_NONE);
  ::ompl::RNG::setSeed(1);
  Report report;
  report.line("# Paths round a thin wall\n\nWritten by `./run bench ompl --results docs/results`.\n");
  report.line(
      "A robot of 2 by 0.8 in a room of 100 by 100 goes from one side of a wall to the other, round its end. "
      "*Colliding*: paths "
      "that a planner called solutions and that overlap the wall at one of 20,000 points; *simplified*: after OMPL's "
      "simplifySolution, which most programs call. States are checked exactly in "
      "every row: what differs is how motions between them are. The time of the obstacle for all angles, which the "
      "exact "
      "states and the exact planner use, is in the last column, once a wall.\n");
  report.heading({"half thickness", "planner", "motions by", "solved", "colliding", "simplified", "ms mean", "ms worst",
                  "obstacle ms"});
  int certified_paths = 0, certified_colliding = 0, sampled_colliding = 0;
  for (const double half : {0.5, 0.1, 0.02}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto scene = sampling::scene_with_wall(half);
    const double made = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    for (const Contestant& contestant : contestants()) {
      const Row row = measure(contestant, scene, runs);
      const Spread ms = spread(row.ms);
      report.row({fixed(half, 2), row.planner, row.validator,
                  std::to_string(row.solved) + "/" + std::to_string(row.runs), std::to_string(row.colliding),
                  std::to_string(row.simplified_colliding), fixed(ms.mean, 1), fixed(ms.worst, 1), fixed(made, 1)});
      const bool certified = contestant.validator == Validator::certified;
      (certified ? certified_colliding : sampled_colliding) += row.colliding + row.simplified_colliding;
      certified_paths += certified ? 2 * row.solved : 0;
    }
  }
  report.line("");
  report.promise("no path of certified motions collides",
                 std::to_string(certified_colliding) + " of " + std::to_string(certified_paths) + "; of sampled ones " +
                     std::to_string(sampled_colliding),
                 certified_colliding == 0 && certified_paths > 0);
  write_result(results, "ompl.md", report.markdown.str());
  write_result(results, "ompl.csv", report.csv.str());
  return certified_colliding == 0 ? 0 : 1;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
