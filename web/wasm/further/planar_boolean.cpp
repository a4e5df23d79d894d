// Boolean operations on regions and planar sums, regions by their lines.
#include "dymsum/planar_boolean.h"

#include <vector>

#include "arrays.h"
#include "dymsum/region_by_lines.h"
#include "plain.h"
#include "planar_operand.h"

namespace dymsum::web {
namespace {

using emscripten::function;

std::shared_ptr<PlanarSum> union_of_sets(const val& sets, const val& options) {
  std::vector<TakenOperand> taken;
  const auto n = sets["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) taken.emplace_back(sets[k]);
  return shared(got(united(std::vector<PlanarOperand>(taken.begin(), taken.end()), sum_options(options))));
}

val lines_data(RegionByLines made) {
  val v = val::object();
  v.set("report", made.to_string());
  v.set("region", shared(std::move(made.region)));
  v.set("axes", plain(made.axes));
  v.set("tolerance", made.tolerance);
  v.set("largestMove", made.largest_move);
  v.set("merged", plain(made.merged));
  v.set("looseEdges", plain(made.loose_edges));
  return v;
}
/// Of one region, or of a list of them, which have axes in common.
val by_its_lines(const val& regions, const val& options) {
  LinesOptions how;
  if (const val tolerance = member(options, "tolerance"); !is_none(tolerance)) how.tolerance = tolerance.as<double>();
  how.sums = sum_options(options);
  const auto data_of = [](const val& region) { return region.as<std::shared_ptr<Region>>()->data(); };
  if (!regions.isArray()) return lines_data(got(by_lines(data_of(regions), how)));
  std::vector<RegionData> all;
  const auto n = regions["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) all.push_back(data_of(regions[k]));
  return list_of(got(by_lines(all, how)), lines_data);
}

EMSCRIPTEN_BINDINGS(planar_boolean) {
  function("byLines", guarded<&by_its_lines>);
  function("united", guarded<&union_of_sets>);
  function("intersection", guarded<&of_sets<&intersection>>);
  function("difference", guarded<&of_sets<&difference>>);
  function("symmetricDifference", guarded<&of_sets<&symmetric_difference>>);
}

}  // namespace
}  // namespace dymsum::web
