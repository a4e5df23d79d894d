#include "nesting/table_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/double_text.h"
#include "base/doubles.h"
#include "base/poll.h"
#include "exact/big.h"
#include "io/region/write_wkb.h"
#include "io/source.h"
#include "nesting/angle_differences.h"
#include "nesting/planning_poll.h"
#include "nesting/quarter_turn.h"
#include "planar/shapes/disc_polygon.h"

namespace dymsum {
namespace nesting {
namespace {

/// How many quarter turns an angle in [0, 360) is.
std::optional<int> quarters_of(const Rational& degrees) {
  for (int count = 0; count < 4; ++count)
    if (degrees == Rational(90 * count)) return count;
  return std::nullopt;
}

Result<Orientation> orientation_of(const Rational& degrees, std::optional<int> quarters, double error) {
  if (quarters == 2) return Orientation::half_turn();
  if (quarters) return Orientation::of(*quarters == 3 ? -1 : *quarters, 1);
  // The double of the angle is within 2^-52 of it.
  return Orientation::nearest(reduced_degrees(degrees), error - 0x1p-51);
}

/// Plans rows, angles, keys and tasks, in this order.
class Planner {
 public:
  Planner(NfpTable::State& state, const Progress& progress) : state_(state), poll_(progress) {}

  Result<void> run() {
    if (const Result<void> kept = take_distances(); !kept) return kept;
    digest();
    list_orientations();
    if (!list_rows()) return Error{ErrorCode::out_of_range, "the table has more than 2^32 - 2 rows", {}};
    turn_by_quarters();
    list_answers();
    mark_rows();
    return {};
  }

 private:
  static constexpr std::size_t kMostRows = 0xfffffffe;

  Result<void> take_distances() {
    Result<std::optional<Region>> spacing = planar::polygon_of_distance(state_.input.spacing, "spacing"),
                                  margin = planar::polygon_of_distance(state_.input.margin, "margin");
    if (!spacing) return spacing.error();
    if (!margin) return margin.error();
    state_.spacing = *std::move(spacing), state_.margin = *std::move(margin);
    const std::size_t items = state_.spacing ? state_.input.items.size() : 0;
    for (std::size_t i = 0; i < items; ++i) {
      poll_.at("spacing", i, items);
      state_.grown.push_back(minkowski_sum(state_.input.items[i].shape, *state_.spacing));
    }
    return {};
  }

  void digest() {
    for (const TableItem& item : state_.input.items) state_.item_digests.push_back(digest_of(item.shape));
    for (const TableBin& bin : state_.input.bins) state_.bin_digests.push_back(digest_of(bin.shape));
  }

  /// The index of an angle, which is made when it is first requested.
  std::uint32_t angle(const Rational& degrees) {
    const auto [at, fresh] = angle_of_.emplace(degrees, static_cast<std::uint32_t>(state_.angles.size()));
    if (!fresh) return at->second;
    const std::optional<int> quarters = quarters_of(degrees);
    const double error = state_.input.angle_error;
    state_.angles.push_back({degrees, orientation_of(degrees, quarters, error).value(), quarters ? 0 : error});
    state_.quarters.push_back(quarters);
    return at->second;
  }

  std::vector<std::uint32_t> angles(const std::set<Rational>& degrees) {
    std::vector<std::uint32_t> all;
    for (const Rational& d : degrees) {
      all.push_back(angle(d));
      poll_.at("orientations", all.size(), degrees.size());
    }
    return all;
  }

  /// Items that may take the same orientations are many.
  void list_orientations() {
    std::map<std::set<Rational>, std::size_t> known;
    for (const TableItem& item : state_.input.items) {
      std::set<Rational> own;
      for (const Rational& d : item.degrees) own.insert(reduced_angle(d));
      const auto [at, fresh] = known.emplace(own, sets_.size());
      if (fresh) sets_.push_back(std::move(own));
      set_of_.push_back(at->second);
    }
    for (const std::set<Rational>& own : sets_) own_.push_back(angles(own));
  }

  /// The angles of pairs of items whose orientations are these sets.
  const std::vector<std::uint32_t>& differences(std::size_t from, std::size_t to) {
    const auto [at, fresh] = differences_.try_emplace({from, to});
    if (!fresh) return at->second;
    return at->second = angles(angle_differences(sets_[from], sets_[to], poll_));
  }

  bool add_rows(TableRow row, const std::vector<std::uint32_t>& angles) {
    if (state_.rows.size() + angles.size() > kMostRows) return false;
    for (const std::uint32_t a : angles) {
      row.angle = a;
      state_.rows.push_back(row);
    }
    return true;
  }

  /// Whether there is room for them.
  bool list_rows() {
    const auto items = static_cast<std::uint32_t>(state_.input.items.size());
    const auto bins = static_cast<std::uint32_t>(state_.input.bins.size());
    using Kind = TableRow::Kind;
    for (std::uint32_t a = 0; a < items; ++a)
      for (std::uint32_t b = 0; b < items; ++b)
        if (!add_rows({Kind::nfp, a, b, 0, 0}, differences(set_of_[a], set_of_[b]))) return false;
    for (std::uint32_t c = 0; c < bins; ++c)
      for (std::uint32_t b = 0; b < items; ++b)
        if (!add_rows({Kind::bin_fit, c, b, 0, 0}, own_[set_of_[b]])) return false;
    for (std::uint32_t b = 0; state_.input.strip_height && b < items; ++b)
      if (!add_rows({Kind::strip_fit, TableRow::kNone, b, 0, 0}, own_[set_of_[b]])) return false;
    return true;
  }

  void turn_by_quarters() {
    state_.turned.resize(state_.input.items.size());
    for (const TableRow& row : state_.rows) {
      const std::optional<int> quarters = state_.quarters[row.angle];
      if (!quarters || row.kind == TableRow::Kind::strip_fit) continue;
      std::optional<Region>& slot = state_.turned[row.moving][static_cast<std::size_t>(*quarters)];
      if (slot) continue;
      const Region& shape = state_.input.items[row.moving].shape;
      slot = *quarters == 0 ? shape : Region::create(turned(shape.data(), *quarters)).value();
    }
  }

  Key key(TableRow::Kind kind, const base::Digest& fixed, const base::Digest& moving, const Orientation& o) const {
    const bool nfp = kind == TableRow::Kind::nfp;
    std::string text = nfp ? "no-fit polygon 1\n" : "inner fit 1\n";
    if (const double distance = nfp ? state_.input.spacing : state_.input.margin; distance != 0)
      io::append_number(text += "at distance ", distance);
    text.append(fixed.begin(), fixed.end());
    text.append(moving.begin(), moving.end());
    text += o.is_half_turn() ? "inf" : o.tan_half().to_string();
    return base::sha256(text);
  }

  void list_answers() {
    struct Known {
      std::uint32_t answer, task;
    };
    std::map<Key, Known> known;
    const auto listed = [&](const Key& k, std::size_t task) {
      const auto [at, fresh] =
          known.emplace(k, Known{static_cast<std::uint32_t>(state_.keys.size()), static_cast<std::uint32_t>(task)});
      if (fresh) state_.keys.push_back(k);
      return std::pair{at->second, fresh};
    };
    std::vector<bool> has_row;  // by answer: a mirror has none until its own row comes
    for (std::uint32_t r = 0; r < state_.rows.size(); ++r) {
      poll_.at("keys", r, state_.rows.size());
      TableRow& row = state_.rows[r];
      if (row.kind == TableRow::Kind::strip_fit) continue;
      const bool nfp = row.kind == TableRow::Kind::nfp;
      const base::Digest &fixed = (nfp ? state_.item_digests : state_.bin_digests)[row.fixed],
                         &moving = state_.item_digests[row.moving];
      const Orientation& o = state_.angles[row.angle].orientation;
      const auto [one, fresh] = listed(key(row.kind, fixed, moving, o), state_.tasks.size());
      row.answer = one.answer;
      if (fresh) {
        state_.tasks.push_back({r, Task::kNone});
        if (nfp && state_.quarters[row.angle]) listed(key(row.kind, moving, fixed, o.inverse()), one.task);
      }
      has_row.resize(state_.keys.size(), false);
      if (!fresh && !has_row[one.answer]) state_.tasks[one.task].mirror = r;
      has_row[one.answer] = true;
    }
    state_.answers = state_.keys.size();
    for (TableRow& row : state_.rows)
      if (row.kind == TableRow::Kind::strip_fit) row.answer = static_cast<std::uint32_t>(state_.answers++);
  }

  void mark(std::uint64_t value) {  // splitmix64's steps
    std::uint64_t z = state_.mark ^ (value + 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    state_.mark = z ^ (z >> 31);
  }
  void mark(const base::Digest& digest) {
    for (std::size_t k = 0; k < digest.size(); k += 8) {
      std::uint64_t word = 0;
      for (std::size_t b = 0; b < 8; ++b) word = word << 8 | digest[k + b];
      mark(word);
    }
  }

  /// Rows by their kinds and answers, answers by their keys; strips by the items that lie in them and how.
  void mark_rows() {
    for (const base::Digest& digest : state_.keys) mark(digest);
    for (const base::Digest& digest : state_.item_digests) mark(digest);
    mark(base::bit_cast<std::uint64_t>(state_.input.strip_height.value_or(0)));
    mark(base::bit_cast<std::uint64_t>(state_.input.margin));
    for (const TableAngle& angle : state_.angles)
      mark(base::sha256(angle.orientation.is_half_turn() ? "inf" : angle.orientation.tan_half().to_string()));
    for (const TableRow& row : state_.rows) {
      mark(static_cast<std::uint64_t>(row.kind) << 32 | row.answer);
      mark(std::uint64_t{row.moving} << 32 | row.angle);
    }
  }

  NfpTable::State& state_;
  PlanningPoll poll_;
  std::map<Rational, std::uint32_t> angle_of_;
  std::vector<std::set<Rational>> sets_;         ///< of orientations, each once
  std::vector<std::size_t> set_of_;              ///< by item
  std::vector<std::vector<std::uint32_t>> own_;  ///< angles, by set
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>> differences_;  ///< by sets (from, to)
};

/// Relative angles are as many as their square, if they are not equally spaced.
constexpr std::size_t kMostOrientations = 3600;

std::optional<Error> wrong(const TableInput& input) {
  const auto about = [](const std::string& what, const std::string& name, const std::string& why) {
    return Error{ErrorCode::unsupported_operand, what + " '" + name + "' " + why, {}};
  };
  for (const TableItem& item : input.items) {
    if (item.shape.empty()) return about("item", item.name, "is empty");
    if (item.degrees.empty()) return about("item", item.name, "may take no orientation");
    if (item.degrees.size() > kMostOrientations)
      return about("item", item.name, "may take more than 3600 orientations");
  }
  for (const TableBin& bin : input.bins) {
    if (bin.shape.parts().empty()) return about("bin", bin.name, "is empty");
    if (!bin.shape.polylines().empty() || !bin.shape.points().empty())
      return about("bin", bin.name, "has polylines or points, in which nothing fits");
  }
  if (!(input.angle_error >= 2 * Orientation::kAngularError))
    return Error{ErrorCode::out_of_range, "angles are met within 2^-49 radians: their error cannot be less", {}};
  if (input.strip_height && !(*input.strip_height > 0 && std::isfinite(*input.strip_height)))
    return Error{
        ErrorCode::out_of_range,
        "the height of the strip must be positive and finite, not " + base::general_text(*input.strip_height, 6),
        {}};
  return std::nullopt;
}

}  // namespace

base::Digest digest_of(const Region& shape) {
  std::string bytes;
  io::append_wkb(bytes, shape.data());
  return base::sha256(bytes);
}

}  // namespace nesting

Result<NfpTable> NfpTable::create(TableInput input, const Progress& progress) try {
  if (std::optional<Error> error = nesting::wrong(input)) return *std::move(error);
  auto state = std::make_shared<State>();
  state->input = std::move(input);
  if (const Result<void> done = nesting::Planner(*state, progress).run(); !done) return done.error();
  NfpTable table;
  table.state_ = std::move(state);
  return table;
} catch (const Cancelled&) {
  return cancelled();
}

const TableInput& NfpTable::input() const { return state_->input; }
const std::vector<TableAngle>& NfpTable::angles() const { return state_->angles; }
const std::vector<TableRow>& NfpTable::rows() const { return state_->rows; }
std::size_t NfpTable::answer_count() const { return state_->answers; }
std::size_t NfpTable::task_count() const { return state_->tasks.size(); }

}  // namespace dymsum
