// The thesis's figures 3.5, 3.6 and 3.7 from our measurements, and the files of docs/results.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "planar/plot.h"
#include "planar/report.h"

namespace dymsum::bench {
namespace {

std::vector<const Row*> rows_of_thesis_set(const std::vector<Row>& rows, bool large_only) {
  std::vector<const Row*> chosen;
  for (const Row& row : rows) {
    if (row.group == Group::thesis && (row.large || !large_only)) chosen.push_back(&row);
  }
  return chosen;
}

std::vector<std::string> names(const std::vector<const Row*>& rows) {
  std::vector<std::string> result;
  for (const Row* row : rows) result.push_back(row->name);
  return result;
}

/// Figure 3.5: a dot per pair of the thesis-like set, in the order of the sizes of the reduced convolution.
std::string speed_up(const std::vector<Row>& rows) {
  std::vector<const Row*> chosen = rows_of_thesis_set(rows, false);
  std::stable_sort(chosen.begin(), chosen.end(), [](const Row* a, const Row* b) {
    return a->ours.convolution.reduced < b->ours.convolution.reduced;
  });
  Series series{"time of CGAL's reduced convolution / ours", colour(0), {}};
  for (const Row* row : chosen) series.values.push_back(row->reduced.finished ? row->ratio() : 0);
  const PlotText text{"Speed-up over CGAL's reduced convolution (thesis, figure 3.5)",
                      "pairs of the thesis-like set, by size of the reduced convolution", "CGAL's time / ours",
                      names(chosen), "a dot per pair; above 1 we are faster"};
  return draw_dots(text, {series}, {{1, "as fast as CGAL"}, {100, "100 times"}});
}

/// Figure 3.6: the fraction of each stage in our time, for pairs of the larger models.
std::string stage_fractions(const std::vector<Row>& rows) {
  const std::vector<const Row*> chosen = rows_of_thesis_set(rows, true);
  std::vector<Series> series;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (const SumStats::Stage& stage : chosen[i]->ours.stats.stages) {
      auto found = std::find_if(series.begin(), series.end(), [&](const Series& s) { return s.name == stage.name; });
      if (found == series.end()) {
        series.push_back({std::string(stage.name), colour(series.size()), std::vector<double>(chosen.size(), 0)});
        found = series.end() - 1;
      }
      found->values[i] += stage.ms;
    }
  }
  return draw_fractions({"Share of each stage in our time (thesis, figure 3.6)", "pairs of the larger models",
                         "share of the time", names(chosen), "medians over all repetitions; each pair's total is 1"},
                        series);
}

/// Figure 3.7: reduced, kinetic and full convolution of pairs of the larger models, in the order of the full ones.
std::string convolution_plot(const std::vector<Row>& rows) {
  std::vector<const Row*> chosen = rows_of_thesis_set(rows, true);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Row* a, const Row* b) { return a->ours.convolution.full < b->ours.convolution.full; });
  std::vector<Series> series{{"full", colour(1), {}}, {"kinetic", colour(7), {}}, {"reduced", colour(0), {}}};
  for (const Row* row : chosen) {
    series[0].values.push_back(static_cast<double>(row->ours.convolution.full));
    series[1].values.push_back(static_cast<double>(row->ours.convolution.kinetic));
    series[2].values.push_back(static_cast<double>(row->ours.convolution.reduced));
  }
  return draw_dots(
      {"Segments of the three convolutions (thesis, figure 3.7)", "pairs of the larger models", "segments",
       names(chosen), "full: the thesis's and CGAL's; kinetic: signed short turns; reduced: ours and the thesis's"},
      series);
}

bool write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  return static_cast<bool>(file.flush());
}

}  // namespace

bool write_results(const std::string& folder, const std::vector<Row>& rows) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  return write(folder + "/planar.csv", to_csv(rows)) && write(folder + "/planar.md", to_markdown(rows)) &&
         write(folder + "/figure-3.5.svg", speed_up(rows)) &&
         write(folder + "/figure-3.6.svg", stage_fractions(rows)) &&
         write(folder + "/figure-3.7.svg", convolution_plot(rows));
}

}  // namespace dymsum::bench
