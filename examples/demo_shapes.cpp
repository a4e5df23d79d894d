// Writes shapes as WKT files, operands for the command line, and a picture of a sum of two. Usage: demo_shapes FOLDER
#include <dymsum/dymsum.h>

#include <filesystem>
#include <iostream>

namespace {

using namespace dymsum;

/// A plate with holes like the reflected star: smaller, of exactly its size, and larger. In the sum with the star the
/// first one fills up, the second one leaves a single point, the others leave holes.
Region plate_for(const Region& star) {
  RegionData data = shapes::rectangle(0, 0, 42, 16).data();
  double left = 1;
  for (const double scale : {0.75, 1.0, 1.5, 2.5}) {
    Ring hole(star.parts().front().outer.rbegin(), star.parts().front().outer.rend());
    for (Point& p : hole) p = {left + 3 * scale - p.x * scale, 8 - p.y * scale};
    data.parts.front().holes.push_back(hole);
    left += 6 * scale + 1;
  }
  return Region::create(data).value();
}

void write(const std::filesystem::path& file, const std::string& text) {
  const Result<void> written = write_file(file.string(), text);
  if (!written) std::cerr << written.error().to_string() << "\n", std::exit(2);
}

Region lines(std::vector<Polyline> polylines) { return Region::create({{}, std::move(polylines), {}}).value(); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    const bool asked = argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"));
    (asked ? std::cout : std::cerr) << "usage: demo_shapes FOLDER\n";
    return asked ? 0 : 1;
  }
  const std::filesystem::path folder = argv[1];
  const Region star = shapes::star(5, 1.5, 3, shapes::demo_snap(3)), plate = plate_for(star);
  const std::vector<std::pair<std::string, Region>> all = {
      {"gear", shapes::gear(12, 8, 10, shapes::demo_snap(10))},
      {"star", star},
      {"plate", plate},
      {"disc", shapes::disc(16, 1, shapes::demo_snap(1))},
      {"disc32", shapes::disc(32, 1, shapes::demo_snap(1))},
      {"grate", shapes::grate(5, 4, 1, 12)},
      {"spiral", shapes::spiral(3, 24, 4, 1, shapes::demo_snap(17))},
      {"random", shapes::random_polygon(80, 3, 7)},
      {"slot", shapes::letter_u(4, 4, 1)},
      {"peg", shapes::rectangle(0, 0, 2, 1)},
      {"cavity", shapes::rectangle(0, 0, 4, 3)},
      {"hook", lines({{{0, 0}, {2, 0}, {2, 1}}})},  // a bent wire
      {"rooms", lines({{{0, 0}, {8, 0}, {8, 6}, {0, 6}, {0, 0}}, {{4, 0}, {4, 2}}, {{4, 3.5}, {4, 6}}})},  // walls
  };
  std::filesystem::create_directories(folder);
  for (const auto& [name, region] : all) write(folder / (name + ".wkt"), format_region(region, RegionFormat::wkt));
  write(folder / "plate_and_star.svg", draw_sum(plate, star, minkowski_sum(plate, star).value()));
}
