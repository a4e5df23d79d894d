#include "outputs.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "dymsum/mesh_io.h"
#include "exit_code.h"
#include "progress_bar.h"

namespace dymsum::cli {
const Region& RoundedSum::region() {
  if (!region_) region_ = with_repair_ ? repaired() : snapped();
  return *region_;
}

Region RoundedSum::snapped() {
  SnapRounded made = require(snap_rounded(sum_));
  if (!made.rounding.nearest) {
    rounding_ = made.rounding;
    std::cerr << "rounding: " << rounding_->to_string() << "\n";
  }
  return std::move(made.region);
}

Region RoundedSum::repaired() {
  Result<Repaired> repaired = sum_.rounded_with_repair();
  if (!repaired) return snapped();
  if (repaired->report.changed()) std::cerr << "rounding: " << repaired->report.to_string() << "\n";
  return std::move(repaired->region);
}

bool is_stage_picture(const std::string& file) { return file.ends_with("stages.svg"); }

bool writes_to_stdout(const std::vector<std::string>& files) {
  return std::find(files.begin(), files.end(), "-") != files.end();
}

std::ostream& report_stream(const std::vector<std::string>& files, bool json) {
  if (!writes_to_stdout(files)) return std::cout;
  if (json) throw Stop(kUsage, "--json and the output - both want standard output");
  return std::cerr;
}

std::string format_name(const std::string& file, const std::string& to) {
  if (file == "-") return "." + to;
  return file.ends_with(".gz") ? file.substr(0, file.size() - 3) : file;
}

RegionFormat output_format(const std::string& file, const OutputOptions& options) {
  const std::string name = format_name(file, options.to);
  if (!mesh_format(name)) return require_format(region_format(name));
  throw Stop(kUsage,
             (file == "-" ? "--to " + options.to : file) +
                 " is a format of solids; planar regions are written as .poly .wkt .geojson .dxf .gpkg .svg or .json");
}

void check_outputs(const OutputOptions& options) {
  for (const std::string& file : options.files) output_format(file, options);
}

bool writes_rounded(const OutputOptions& options) {
  return std::any_of(options.files.begin(), options.files.end(), [&](const std::string& file) {
    const RegionFormat format = output_format(file, options);
    return format != RegionFormat::json && format != RegionFormat::svg;
  });
}

void write_text(const std::string& file, const std::string& text) {
  const WriteGuard guard;
  require(write_file(file, text));
}

std::optional<Rounding> write_sum(const Region& p, const Region& q, const PlanarSum& sum, const SumNames& names,
                                  const OutputOptions& options) {
  RoundedSum rounded(sum, options.round_repair);
  std::vector<std::string> texts;
  for (const std::string& file : options.files) {
    const RegionFormat format = output_format(file, options);
    if (is_stage_picture(file)) {
      texts.push_back(draw_trace(p, q, sum));
    } else if (format == RegionFormat::svg) {
      texts.push_back(draw_sum(p, q, sum, rounded.region(), names));
    } else if (format == RegionFormat::json) {
      texts.push_back(sum_to_json(sum));
    } else {
      texts.push_back(format_sum(sum, rounded.region(), format));
    }
  }
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(options.files[i], texts[i]);
  return rounded.rounding();
}

}  // namespace dymsum::cli
