#include "python.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace dymsum::bench {
namespace {

std::string interpreter() {
  const char* value = std::getenv("DYMSUM_PYTHON");
  return value != nullptr ? value : "";
}

}  // namespace

bool has_python() { return !interpreter().empty(); }

std::string query_python(const std::string& script, const std::vector<std::pair<std::string, std::string>>& files,
                         const std::string& more, double limit_s) {
  const auto folder = std::filesystem::temp_directory_path() / ("dymsum_bench_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ostringstream command;
  command << "timeout " << limit_s << " '" << interpreter() << "' '" << DYMSUM_SOURCE_DIR << "/bench/versus/" << script
          << "'";
  for (const auto& [name, text] : files) {
    std::ofstream(folder / name) << text;
    command << " '" << (folder / name).string() << "'";
  }
  command << " " << more << " 2>/dev/null";
  std::string answer;
  if (FILE* pipe = popen(command.str().c_str(), "r"); pipe != nullptr) {
    char buffer[256];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) answer += buffer;
    pclose(pipe);
  }
  std::filesystem::remove_all(folder);
  return answer;
}

}  // namespace dymsum::bench
