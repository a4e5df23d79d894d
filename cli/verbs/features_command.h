// What dymsum features and dymsum decompose have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "dymsum/rational.h"
#include "dymsum/shape_features.h"
#include "options.h"
#include "outputs.h"
#include "report.h"

namespace dymsum::cli {

struct FeaturesCommand {
  std::string operand, alpha, tau = "0", from = "0", to, concavity = "straight";
  std::optional<double> hybrid_tolerance;
  bool exact = false;
  const CLI::App* parser = nullptr;
  OutputOptions output;
  ReportOptions report;
  InputOptions input;
};

/// A diameter or a span of diameters. A Stop where it is no number of at least 0.
Rational read_number(const std::string& text, const std::string& option);

struct Selection {
  Rational life, from;
  std::optional<Rational> to;
};

Selection selection_of(const FeaturesCommand& command);

FeatureOptions options_of(const FeaturesCommand& command);

/// `least` tells what --tau is.
void add_shared_options(CLI::App& verb, FeaturesCommand& command, const std::string& least);

}  // namespace dymsum::cli
