#include "page.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>

namespace dymsum::bench {

std::string fixed(double v, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << v;
  return text.str();
}

std::string ratio(double a, double b, int digits) {
  return a > 0 && b > 0 ? fixed(a / b, a / b < 10 ? digits : 0) : "-";
}

void Report::line(const std::string& text) {
  std::cout << text << std::endl;
  markdown << text << "\n";
}
void Report::row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  line(text);
}
void Report::heading(const std::vector<std::string>& cells) {
  row(cells);
  row(std::vector<std::string>(cells.size(), "---"));
}
void Report::promise(const std::string& text, const std::string& measured, bool met) {
  line("- " + text + ": " + measured + (met ? " (met)" : " (**NOT met**)"));
}

void write_result(const std::string& folder, const std::string& name, const std::string& text) {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  std::ofstream file(folder + "/" + name, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + folder + "/" + name);
}

int guarded(int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::cerr << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 3;
  }
}

}  // namespace dymsum::bench
