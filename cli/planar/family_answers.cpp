#include "planar/family_answers.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "dymsum/names.h"
#include "motion_report.h"
#include "record_json.h"
#include "report.h"

namespace dymsum::cli {
namespace {

/// Outside of the family's interval is wrong usage of the option.
FamilySum timed_sum(std::vector<Scale> scales, const std::string& option, const auto& compute) {
  const auto computed = [&] {
    Result<PlanarSum> sum = compute();
    return !sum && sum.error().code == ErrorCode::bad_scale ? require_option(std::move(sum), option)
                                                            : require(std::move(sum));
  };
  auto [sum, timing] = timed(1, computed);
  return {std::move(scales), std::move(sum), timing.median_ms};
}

std::string interval_text(const std::vector<Scale>& ends) {
  return "[" + shown(ends[0].exact()) + ", " + shown(ends[1].exact()) + "]";
}

/// Of a cell or a lifetime.
Json interval_json(const Rational& low, const Rational& high) { return {low.to_string(), high.to_string()}; }

Json set_json(const std::optional<FamilySum>& set, bool exact) {
  if (!set) return nullptr;
  Json json = {{"interval", interval_json(set->scales[0].exact(), set->scales[1].exact())}};
  json.update(size_json(set->sum, exact));
  json["ms"] = set->ms;
  return json;
}

/// Only what the feature has: two contacts or a sum of two vertices, one contact, an identity.
Json lifetime_json(const ScalingFamily& family, const Lifetime& life) {
  Json json = {{"feature", name(life.feature)},
               {"scales", interval_json(begin_of_cell(family, life.first_cell), end_of_cell(family, life.last_cell))},
               {"cells", {life.first_cell, life.last_cell}}};
  if (life.feature == FamilyFeature::hole) json["hole"] = life.hole;
  if (life.feature == FamilyFeature::edge) json["contact"] = json_of(life.in);
  if (life.feature != FamilyFeature::vertex) return json;
  json["in"] = json_of(life.in);
  json["out"] = json_of(life.out);
  if (life.corner_p != SumVertex::kNone) json["corner"] = {life.corner_p, life.corner_q};
  return json;
}

Json sums_json(const std::vector<FamilySum>& sums, bool exact) {
  Json list = Json::array();
  for (const FamilySum& sum : sums)
    list.push_back(frame_json(frame_name(sum.scales), size_json(sum.sum, exact), sum.ms));
  return list;
}

Json events_list(const std::vector<ScaleEvent>& events) {
  Json list = Json::array();
  for (const ScaleEvent& e : events) list.push_back(event_json(e));
  return list;
}

std::string contact_words(const Contact& c) {
  const std::string p = std::to_string(c.p), q = std::to_string(c.q);
  return c.kind == Contact::Kind::edge_of_p ? "edge " + p + " of P + vertex " + q + " of Q"
                                            : "vertex " + p + " of P + edge " + q + " of Q";
}

std::string feature_words(const Lifetime& life) {
  if (life.feature == FamilyFeature::hole) return std::to_string(life.hole);
  if (life.feature == FamilyFeature::edge) return contact_words(life.in);
  if (life.corner_p != SumVertex::kNone)
    return "vertex " + std::to_string(life.corner_p) + " of P + vertex " + std::to_string(life.corner_q) + " of Q";
  return contact_words(life.in) + ", " + contact_words(life.out);
}

std::string sum_words(const PlanarSum& sum) {
  std::string text = counted(sum.parts.size(), "part") + ", " + counted(sum.hole_count(), "hole") + ", " +
                     counted(sum.vertex_count(), "vertex", "vertices") + ", area " + shown_area(sum);
  if (!sum.tight_points.empty()) text += ", " + counted(sum.tight_points.size(), "tight point");
  if (!sum.tight_segments.empty()) text += ", " + counted(sum.tight_segments.size(), "tight segment");
  return text;
}

void print_lifetimes(std::ostream& out, const ScalingFamily& family, const std::vector<Lifetime>& lifetimes) {
  out << "  lifetimes: feature, scales, which\n";
  for (const Lifetime& life : lifetimes)
    out << "  " << name(life.feature) << "  " << shown(begin_of_cell(family, life.first_cell)) << " to "
        << shown(end_of_cell(family, life.last_cell)) << "  " << feature_words(life) << "\n";
}

int tier_of_family(const ScalingFamily& family) { return require(family.at(family.low())).stats.tier_bits; }

}  // namespace

std::vector<const FamilySum*> FamilyAnswers::sums() const {
  std::vector<const FamilySum*> all;
  for (const FamilySum& sum : at) all.push_back(&sum);
  if (outer) all.push_back(&*outer);
  if (inner) all.push_back(&*inner);
  return all;
}

Rational begin_of_cell(const ScalingFamily& family, std::uint32_t cell) {
  return cell == 0 ? family.low().exact() : family.events()[cell - 1].parameter;
}
Rational end_of_cell(const ScalingFamily& family, std::uint32_t cell) {
  return cell >= family.events().size() ? family.high().exact() : family.events()[cell].parameter;
}

FamilyAnswers answers_of(const ScalingFamily& family, const FamilyQuestions& questions) {
  FamilyAnswers answers;
  for (const Scale& s : questions.at) answers.at.push_back(timed_sum({s}, "--at", [&] { return family.at(s); }));
  if (questions.changes) answers.changes = family.changes(family.low(), family.high(), *questions.changes);
  if (questions.lifetimes) answers.lifetimes = require(family.lifetimes());
  if (questions.outer) {
    const auto& [a, b] = *questions.outer;
    answers.outer = timed_sum({a, b}, "--outer", [&, &a = a, &b = b] { return family.outer(a, b); });
  }
  if (questions.inner) {
    const auto& [a, b] = *questions.inner;
    answers.inner = timed_sum({a, b}, "--inner", [&, &a = a, &b = b] { return family.inner(a, b); });
  }
  return answers;
}

std::string caption_of(const FamilyAnswers& answers, const FamilySum& sum) {
  if (sum.scales.size() == 1) return frame_name(sum.scales).pose;
  return (answers.outer && &sum == &*answers.outer ? "some s in " : "all s in ") + interval_text(sum.scales);
}

Json family_json(const FamilySource& source, const FamilyAnswers& answers, bool exact) {
  const ScalingFamily& family = source.family;
  const FamilyOptions& options = family.options();
  Json json = report_head("family", inputs_json(source.inputs), tier_of_family(family), source.timing);
  json.update({{"motion", "scaling"},
               {"scaled", name(options.moving)},
               {"robot", options.reflect_q},
               {"semantics", name(options.semantics)},
               {"interval", interval_json(family.low().exact(), family.high().exact())},
               {"ratio", family.ratio().exact().to_string()},
               {"cells", family.work().cells},
               {"events", events_list(family.events())},
               {"sums", sums_json(answers.at, exact)},
               {"changes", answers.changes ? events_list(*answers.changes) : Json(nullptr)},
               {"lifetimes", nullptr},
               {"outer", set_json(answers.outer, exact)},
               {"inner", set_json(answers.inner, exact)},
               {"work", json_without(family.work(), {"cells", "ms"})}});
  if (!answers.lifetimes) return json;
  json["lifetimes"] = Json::array();
  for (const Lifetime& life : *answers.lifetimes) json["lifetimes"].push_back(lifetime_json(family, life));
  return json;
}

void print_family(std::ostream& out, const FamilySource& source, const FamilyAnswers& answers) {
  const ScalingFamily& family = source.family;
  const FamilyWork& work = family.work();
  const auto& events = family.events();
  const auto topology = std::count_if(events.begin(), events.end(), [](const ScaleEvent& e) { return e.topology; });
  out << "family of " << source.inputs[0].file << " and " << source.inputs[1].file << ", s from "
      << shown(family.low().exact()) << " to " << shown(family.high().exact()) << "\n  "
      << counted(work.events, "event") << ", " << work.visible << " visible, the topology changes at " << topology
      << "; " << counted(work.cells, "cell") << "\n  " << counted(work.names, "different vertex", "different vertices")
      << ", structures in " << counted(work.bytes, "byte") << ", " << shown(source.timing) << "\n";
  for (const FamilySum* sum : answers.sums())
    out << "  " << caption_of(answers, *sum) << ": " << sum_words(sum->sum) << "\n";
  if (answers.changes)
    for (const ScaleEvent& e : *answers.changes) out << "  " << event_line(e) << "\n";
  if (answers.lifetimes) print_lifetimes(out, family, *answers.lifetimes);
}

}  // namespace dymsum::cli
