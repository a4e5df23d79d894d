// What a family of sums is queried about on the command line, and the answers as JSON and for a person.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/event.h"
#include "json_report.h"
#include "planar/family_source.h"

namespace dymsum::cli {

struct FamilyQuestions {
  std::vector<Scale> at;
  std::optional<EventChange> changes;
  bool lifetimes = false;
  std::optional<std::array<Scale, 2>> outer, inner;
};

struct FamilySum {
  std::vector<Scale> scales;  ///< one, or the ends of an interval
  PlanarSum sum;
  double ms = 0;
};

struct FamilyAnswers {
  std::vector<FamilySum> at;
  std::optional<std::vector<ScaleEvent>> changes;
  std::optional<std::vector<Lifetime>> lifetimes;
  std::optional<FamilySum> outer, inner;

  /// All sums: of scales, then outer, then inner.
  std::vector<const FamilySum*> sums() const;
};

/// The scale at which a cell begins or ends: an event, or an end of the interval.
Rational begin_of_cell(const ScalingFamily& family, std::uint32_t cell);
Rational end_of_cell(const ScalingFamily& family, std::uint32_t cell);

/// The answers; a Stop with wrong usage for scales outside of the family.
FamilyAnswers answers_of(const ScalingFamily& family, const FamilyQuestions& questions);
/// "s = 3/2", or "some s in [1, 3/2]".
std::string caption_of(const FamilyAnswers& answers, const FamilySum& sum);

Json family_json(const FamilySource& source, const FamilyAnswers& answers, bool exact);
void print_family(std::ostream& out, const FamilySource& source, const FamilyAnswers& answers);

}  // namespace dymsum::cli
