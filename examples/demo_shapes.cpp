// Writes generated shapes as WKT files into a folder: operands for the command line. Usage: demo_shapes FOLDER
#include <dymsum/dymsum.h>

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
  using namespace dymsum;
  if (argc != 2) {
    std::cerr << "usage: demo_shapes FOLDER\n";
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::vector<shapes::Named> all = {
      {"gear", shapes::gear(12, 8, 10)},
      {"star", shapes::star(5, 1, 3)},
      {"disc", shapes::disc(16, 1)},
      {"disc32", shapes::disc(32, 1)},
      {"grate", shapes::grate(5, 4, 1, 12)},
      {"spiral", shapes::spiral(3, 24, 4, 1)},
      {"random", shapes::random_polygon(80, 3, 7)},
      {"slot", shapes::letter_u(4, 4, 1)},
      {"peg", shapes::rectangle(0, 0, 2, 1)},
      {"cavity", shapes::rectangle(0, 0, 4, 3)},
  };
  for (const shapes::Named& shape : all) {
    const std::string file = (folder / shape.name).string() + ".wkt";
    const Result<bool> written = write_file(file, format_region(shape.region, RegionFormat::wkt));
    if (!written) {
      std::cerr << written.error().to_string() << "\n";
      return 2;
    }
  }
}
