#include "snapped_operand.h"

#include <iostream>
#include <utility>

namespace dymsum::cli {
namespace {

template <class Data>
void report_noise(const Data& data, const std::string& file, const InputOptions& options, ReadingNotes& notes) {
  const std::optional<CoordinateNoise> noise = coordinate_noise(data);
  if (!noise) return;
  notes["noise"] = {{"grid", noise->grid.to_string()}, {"noisy", noise->noisy}, {"coordinates", noise->coordinates}};
  if (!options.quiet && options.offers_repair)
    std::cerr << shown_file(file) << ": " << noise->to_string() << " (--snap " << noise->grid.to_string()
              << " rounds them)\n";
}

}  // namespace

template <class Data>
std::optional<Error> snap_operand(Data& data, const std::string& file, const InputOptions& options,
                                  ReadingNotes& notes) {
  if (options.snap.empty()) {
    report_noise(data, file, options, notes);
    return std::nullopt;
  }
  const CoordinateGrid grid = require_option(coordinate_grid(options.snap), "--snap");
  Result<Snapped<Data>> made = snapped(std::move(data), grid);
  if (!made) return made.error();
  const SnapReport& report = made->report;
  if (report.moved > 0)
    notes["snap"] = {{"grid", grid.to_string()},
                     {"coordinates", report.coordinates},
                     {"moved", report.moved},
                     {"largest_move", report.largest_move}};
  if (!options.quiet && report.moved > 0)
    std::cerr << shown_file(file) << ": snapped to " << grid.to_string() << ": " << report.to_string() << "\n";
  data = std::move(made).value().data;
  return std::nullopt;
}

template std::optional<Error> snap_operand(RegionData& data, const std::string& file, const InputOptions& options,
                                           ReadingNotes& notes);
template std::optional<Error> snap_operand(MeshData& data, const std::string& file, const InputOptions& options,
                                           ReadingNotes& notes);

}  // namespace dymsum::cli
