#include "viewer/viewer_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "exit_code.h"

namespace dymsum::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "DYMSUM_VIEWER";
constexpr std::string_view kOpening = R"(<script id="dymsum-data" type="application/json">)", kClosing = "</script>";

/// The viewer's file as seen from the folder of the program: installed, and in the build tree.
constexpr const char* kPositions[] = {"../share/dymsum/viewer.html", "../../web/viewer/dist/index.html"};

std::string hole() { return std::string(kOpening) + std::string(kClosing); }

}  // namespace

std::optional<std::string> find_viewer() {
  if (const char* named = std::getenv(kVariable)) return *named == '\0' ? std::nullopt : std::optional(named);
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  if (unknown) return std::nullopt;
  for (const char* position : kPositions) {
    const fs::path file = (program.parent_path() / position).lexically_normal();
    if (fs::is_regular_file(file, unknown)) return file.string();
  }
  return std::nullopt;
}

std::string viewer_text() {
  const std::optional<std::string> file = find_viewer();
  if (!file)
    throw Stop(kBadInput,
               "dymsum: there is no viewer beside this program, in share/dymsum/viewer.html or in "
               "web/viewer/dist/index.html: `./run web` builds it, and the variable DYMSUM_VIEWER may name it");
  std::error_code unknown;
  if (!fs::is_regular_file(*file, unknown)) throw Stop(kBadInput, *file + ": no such file, named as the viewer");
  std::ifstream in(*file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw Stop(kBadInput, *file + ": the viewer cannot be read");
  const std::size_t at = text.find(hole());
  if (at == std::string::npos || text.find(hole(), at + 1) != std::string::npos)
    throw Stop(kBadInput, *file + ": not a viewer of dymsum: it does not have " + hole() + " once");
  return text;
}

std::string viewer_with(const std::string& viewer, const std::string& data) {
  const std::size_t at = viewer.find(hole()) + kOpening.size();
  return viewer.substr(0, at) + data + viewer.substr(at);
}

}  // namespace dymsum::cli
