// Verbs whose result is a solid: sum, nfp, erode, opening, closing and offset.
#pragma once

#include <functional>

#include "options.h"
#include "solid/solid_outputs.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {

/// What such a verb is requested.
struct SolidRun {
  std::string verb, engine = "fast";
  std::vector<SolidInput> inputs;
  ReportOptions report;
  std::vector<std::string> files;
  SolidOutput how;
  bool empty_is_no = false;  ///< an empty result ends with kNo
  std::string semantics = "closed";
  double memory_mb = 0;  ///< 0: no limit
  ResultPages pages = {};
  /// Of Boolean operations of open sets what is tight is no part.
  bool of_open_sets = false;
};

/// What it computes: the solid, and what the verb reports besides.
struct SolidOutcome {
  SpatialSum solid;
  Json more = Json::object();
  std::string text;  ///< for a person: a line, or nothing
};

/// Computes, writes the outputs and reports.
ExitCode run_solid(const SolidRun& run, const std::function<Result<SolidOutcome>(const SpatialOptions&)>& compute);

}  // namespace dymsum::cli
