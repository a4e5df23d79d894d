#include "process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dymsum::cli_test {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Workplace::Workplace() {
  std::string name = (fs::temp_directory_path() / "dymsum-cli-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
  folder_ = name;
  fs::create_directories(folder_ / "work");
}

Workplace::~Workplace() { fs::remove_all(folder_); }

Outcome Workplace::run(const std::string& command) const {
  const fs::path bin = fs::path(DYMSUM_CLI).parent_path();
  write("../command.sh", "export DYMSUM_VIEWER= PATH='" + bin.string() + "':\"$PATH\"\ncd '" +
                             (folder_ / "work").string() + "'\n" + command + "\n");
  const std::string base = folder_.string();
  const std::string line = "bash '" + base + "/command.sh' >'" + base + "/out' 2>'" + base + "/err'";
  const int status = std::system(line.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_text(folder_ / "out");
  outcome.err = read_text(folder_ / "err");
  return outcome;
}

void Workplace::write(const std::string& file, const std::string& text) const {
  std::ofstream out(folder_ / "work" / file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

std::string Workplace::read(const std::string& file) const { return read_text(folder_ / "work" / file); }
bool Workplace::exists(const std::string& file) const { return fs::exists(folder_ / "work" / file); }

std::size_t Workplace::file_count() const {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(folder_ / "work")) ++n;
  return n;
}

}  // namespace dymsum::cli_test
