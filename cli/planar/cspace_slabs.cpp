#include "planar/cspace_slabs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>

#include "dymsum/planar_operand.h"
#include "dymsum/region_io.h"
#include "dymsum/rotation_family.h"
#include "dymsum/shapes.h"
#include "dymsum/snap_rounding.h"
#include "dymsum/sum_locator.h"
#include "outputs.h"

namespace dymsum::cli {
namespace {

constexpr double kCellsAlong = 256;
constexpr std::size_t kMostCells = std::size_t{1} << 26;

/// The shortest digits that are read as this double.
std::string digits_of(double v) { return Json(v).dump(); }

std::string slab_name(std::size_t k, const char* extension) {
  const std::string digits = std::to_string(k);
  return "slab_" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits + extension;
}

/// The radius about the origin that the robot stays in, rounded up.
double reach_of(const Region& robot) {
  const auto [x0, y0, x1, y1] = bounds(robot);
  return std::hypot(std::max(std::abs(x0), std::abs(x1)), std::max(std::abs(y0), std::abs(y1))) * (1 + 0x1p-40);
}

/// The grid of all maps: a rim of one cell around whatever the robot can hit.
void lay_grid(const std::vector<Input>& inputs, const SlabOptions& options, SlabMaps& maps) {
  const auto [x0, y0, x1, y1] = bounds(inputs[1].region);
  const double reach = reach_of(inputs[0].region), side = std::max(x1 - x0, y1 - y0) + 2 * reach;
  maps.tolerance = options.tolerance * side;
  maps.cell = options.resolution > 0 ? options.resolution : side / kCellsAlong;
  const double rim = reach + 2 * maps.tolerance + maps.cell;
  maps.x = x0 - rim;
  maps.y = y0 - rim;
  const double across = std::ceil((x1 + rim - maps.x) / maps.cell), up = std::ceil((y1 + rim - maps.y) / maps.cell);
  if (!(across * up <= static_cast<double>(kMostCells)))
    throw Stop(kUsage, "--resolution: " + digits_of(maps.cell) + " makes maps of more than " +
                           std::to_string(kMostCells) + " cells");
  maps.width = static_cast<std::size_t>(across);
  maps.height = static_cast<std::size_t>(up);
}

/// A cell meets the set where its centre lies in the set and a cell about the origin together.
std::vector<std::uint8_t> blocked_cells(const SlabMaps& maps, const PlanarSum& set) {
  const double half = maps.cell / 2 * (1 + 0x1p-40);
  const SumLocator grown(require(minkowski_sum(set, shapes::rectangle(-half, -half, half, half))));
  std::vector<Point> centres;
  for (std::size_t row = 0; row < maps.height; ++row)
    for (std::size_t column = 0; column < maps.width; ++column)
      centres.push_back({maps.x + (static_cast<double>(column) + 0.5) * maps.cell,
                         maps.y + (static_cast<double>(row) + 0.5) * maps.cell});
  return require(grown.contains_each(centres));
}

/// Rows from above, 0 where blocked.
std::string pgm_text(const SlabMaps& maps, const SlabMap& slab) {
  std::string text = "P5\n" + std::to_string(maps.width) + " " + std::to_string(maps.height) + "\n255\n";
  for (std::size_t row = maps.height; row-- > 0;)
    for (std::size_t column = 0; column < maps.width; ++column)
      text.push_back(slab.blocked[row * maps.width + column] != 0 ? '\0' : static_cast<char>(254));
  return text;
}

std::string yaml_text(const SlabMaps& maps, std::size_t k) {
  const SlabMap& slab = maps.slabs[k];
  return "# headings from " + digits_of(slab.from) + " to " + digits_of(slab.to) + "\nimage: " + slab_name(k, ".pgm") +
         "\nresolution: " + digits_of(maps.cell) + "\norigin: [" + digits_of(maps.x) + ", " + digits_of(maps.y) +
         ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

std::size_t blocked_count(const SlabMap& slab) {
  return static_cast<std::size_t>(std::count(slab.blocked.begin(), slab.blocked.end(), std::uint8_t{1}));
}

}  // namespace

SlabMaps slab_maps(const std::vector<Input>& inputs, const SlabOptions& options, const std::string& folder) {
  SlabMaps maps;
  maps.folder = folder;
  lay_grid(inputs, options, maps);
  FamilyOptions family;
  family.moving = MovingOperand::q;
  family.reflect_q = true;
  const double step = 2 * std::numbers::pi / static_cast<double>(options.slabs);
  // Neighbours overlap by more than what angles are rounded by.
  const auto heading = [&](std::size_t k, double off) {
    return require(Orientation::nearest(-std::numbers::pi + step * (static_cast<double>(k) + off)));
  };
  constexpr double kOverlap = 0x1p-12;
  for (std::size_t k = 0; k < options.slabs; ++k) {
    if (options.progress && !options.progress("slabs", static_cast<double>(k) / static_cast<double>(options.slabs)))
      break;
    const Orientation from = heading(k, -kOverlap), to = heading(k + 1, kOverlap);
    SlabMap& slab = maps.slabs.emplace_back();
    slab.from = -std::numbers::pi + step * static_cast<double>(k);
    slab.to = slab.from + step;
    slab.set = require_option(outer_rotated_sum(inputs[1].region, inputs[0].region, from, to, maps.tolerance, family),
                              "--tolerance");
    slab.blocked = blocked_cells(maps, slab.set);
  }
  return maps;
}

void write_slab_maps(const SlabMaps& maps) {
  std::error_code failed;
  std::filesystem::create_directories(maps.folder, failed);
  if (failed) throw Stop(kBadInput, maps.folder + ": cannot be made: " + failed.message());
  for (std::size_t k = 0; k < maps.slabs.size(); ++k) {
    write_text(maps.folder + slab_name(k, ".pgm"), pgm_text(maps, maps.slabs[k]));
    write_text(maps.folder + slab_name(k, ".yaml"), yaml_text(maps, k));
    RoundedSum rounded(maps.slabs[k].set, false);
    write_text(maps.folder + slab_name(k, ".wkt"), format_region(rounded.region(), RegionFormat::wkt));
  }
}

Json slab_json(const SlabMaps& maps, const std::vector<Input>& inputs, const Timing& timing) {
  Json slabs = Json::array();
  for (const SlabMap& slab : maps.slabs)
    slabs.push_back({{"from", slab.from},
                     {"to", slab.to},
                     {"vertices", slab.set.vertex_count()},
                     {"area", slab.set.area()},
                     {"blocked", blocked_count(slab)}});
  Json json = report_head("cspace", inputs_json(inputs), maps.slabs[0].set.stats.tier_bits, timing);
  json.update({{"folder", maps.folder},
               {"cell", maps.cell},
               {"width", maps.width},
               {"height", maps.height},
               {"tolerance", maps.tolerance},
               {"slabs", std::move(slabs)}});
  return json;
}

void print_slabs(std::ostream& out, const SlabMaps& maps) {
  out << counted(maps.slabs.size(), "map") << " of " << maps.width << " x " << maps.height << " cells of "
      << digits_of(maps.cell) << " in " << maps.folder << ", sets within " << digits_of(maps.tolerance) << "\n";
  for (const SlabMap& slab : maps.slabs)
    out << "  headings " << digits_of(slab.from) << " to " << digits_of(slab.to) << ": area "
        << digits_of(slab.set.area()) << ", " << counted(blocked_count(slab), "blocked cell") << "\n";
}

}  // namespace dymsum::cli
