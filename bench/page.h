// The page that a benchmark prints and writes, and the end of its program; shared by the suites.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace dymsum::bench {

/// A number with so many digits after the point.
std::string fixed(double v, int digits);
/// a / b with so many digits below 10 and none above; "-" where one of them is missing (0).
std::string ratio(double a, double b, int digits);

/// Lines on the screen and in the page, and the table for programs.
class Report {
 public:
  void line(const std::string& text);
  void row(const std::vector<std::string>& cells);
  void heading(const std::vector<std::string>& cells);
  /// "- promise: measured (met)".
  void promise(const std::string& text, const std::string& measured, bool met);

  std::ostringstream markdown, csv;
};

/// Writes a file of results; the folder is made where it is missing, and nothing is written for "".
void write_result(const std::string& folder, const std::string& name, const std::string& text);

/// The exit code of run(argc, argv): its own; 1 with a message for std::invalid_argument (usage), 3 for other
/// exceptions.
int guarded(int (*run)(int, char**), int argc, char** argv);

}  // namespace dymsum::bench
