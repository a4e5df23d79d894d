#include "solid/depth_track.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "dymsum/continuous_depth.h"
#include "exact_number.h"
#include "line_file.h"
#include "numbers.h"
#include "outputs.h"
#include "pictures/depth_trace.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

struct TrackPose {
  Point3 at;
  Rotation turned;
};

TrackPose pose_in(const std::string& text, const std::string& file, std::int64_t line) {
  std::vector<double> v;
  const std::vector<std::string> words = words_of(text);
  for (const std::string& word : words)
    if (const std::optional<double> number = double_number(word)) v.push_back(*number);
  if (v.size() != words.size() || (v.size() != 3 && v.size() != 7))
    refuse_line({ErrorCode::malformed, "a pose is x,y,z, or x,y,z and a quaternion w,x,y,z" + no_double_in(text), {}},
                file, line);
  TrackPose pose{{v[0], v[1], v[2]}, {}};
  if (v.size() == 3) return pose;
  const Result<Rotation> turned = Rotation::nearest(v[3], v[4], v[5], v[6]);
  if (!turned) refuse_line(turned.error(), file, line);
  pose.turned = *turned;
  return pose;
}

std::vector<TrackPose> read_motion(const std::string& file) {
  std::vector<TrackPose> poses;
  const bool any = for_each_line(
      file_text(file), [&](const std::string& text, std::int64_t line) { poses.push_back(pose_in(text, file, line)); });
  if (!any) refuse_line({ErrorCode::malformed, "the file holds no poses", {}}, file, std::nullopt);
  return poses;
}

double radius_of(const Mesh& mesh) {
  double most = 0;
  for (const Point3& v : mesh.vertices()) most = std::max(most, length_of(v.x, v.y, v.z));
  return most;
}

/// The end of the shortest way out moves by no more than the sum's boundary and Q do, off jumps; where it is nearer
/// than that its direction tells.
bool exact_jumps(const DepthRow& last, const DepthRow& row, double radius) {
  if (last.contact.meeting != Meeting::overlapping || row.contact.meeting != Meeting::overlapping) return false;
  const auto end = [](const DepthRow& r) {
    const Point3& n = r.contact.euclidean_normal;
    const double d = r.contact.euclidean_depth;
    return Point3{r.at.x + d * n.x, r.at.y + d * n.y, r.at.z + d * n.z};
  };
  const auto gap = [](const Point3& a, const Point3& b) { return length_of(a.x - b.x, a.y - b.y, a.z - b.z); };
  const double turned = (row.turned * last.turned.inverse()).angle();
  if (gap(last.contact.euclidean_normal, row.contact.euclidean_normal) > 0.25 &&
      row.contact.euclidean_depth < gap(last.at, row.at))
    return true;
  return gap(end(last), end(row)) > (gap(last.at, row.at) + 2 * turned * radius) * (1 + 1e-6) + 4 * row.contact.error;
}

std::vector<DepthRow> track_rows(const std::vector<SolidInput>& inputs, const std::vector<TrackPose>& poses,
                                 const TrackOptions& track, double& smoothing) {
  ContinuousDepthOptions options;
  options.smoothing_length = track.smoothing, options.inflation = track.inflation, options.threads = 0;
  std::size_t done = 0;
  ProgressBar bar;
  const Progress reported = bar.callback();
  options.progress = [&](std::string_view, double) {
    return reported("depth", static_cast<double>(done) / static_cast<double>(poses.size()));
  };
  Result<ContinuousDepth> made = ContinuousDepth::create(inputs[0].mesh, inputs[1].mesh, options);
  if (!made) stop_with(in_solid_operand(made.error(), inputs));
  ContinuousDepth pair = *std::move(made);
  smoothing = pair.smoothing_length();
  const double radius = radius_of(inputs[1].mesh);
  std::vector<DepthRow> rows;
  for (const TrackPose& pose : poses) {
    DepthRow row{pose.at, pose.turned, require(pair.query(pose.at, pose.turned)), {}};
    row.squared = pair.euclidean_squared();
    if (!rows.empty()) row.exact_jumps = exact_jumps(rows.back(), row, radius);
    rows.push_back(std::move(row));
    ++done;
    options.progress({}, 0);
    throw_if_interrupted();
  }
  return rows;
}

Json json_xyz(const Point3& v) { return {v.x, v.y, v.z}; }

Json row_json(const DepthRow& row) {
  const ContinuousContact& c = row.contact;
  Json json = {{"at", json_xyz(row.at)},
               {"quaternion", row.turned.quaternion()},
               {"meeting", name(c.meeting)},
               {"exact_depth", c.euclidean_depth},
               {"depth_squared_exact", row.squared.to_string()},
               {"depth", c.depth}};
  if (c.meeting != Meeting::overlapping) return json;
  json.update({{"exact_direction", json_xyz(c.euclidean_normal)},
               {"normal", json_xyz(c.normal)},
               {"witness_p", json_xyz(c.witness_p)},
               {"witness_q", json_xyz(c.witness_q)},
               {"gradient", json_xyz(c.gradient)},
               {"torque", json_xyz(c.torque)},
               {"branch", c.branch},
               {"discontinuity", name(c.discontinuity)},
               {"exact_jumps", row.exact_jumps},
               {"smoothed", c.smoothed}});
  return json;
}

std::string track_output(const std::string& file, const std::vector<DepthRow>& rows, const Json& json,
                         const std::string& title) {
  const std::string name = format_name(file, "csv");
  if (name.ends_with(".svg")) return depth_svg(rows, title);
  return name.ends_with(".json") ? json.dump(1) + "\n" : depth_csv(rows);
}

std::string summary_text(const std::vector<DepthRow>& rows) {
  std::size_t overlapping = 0, jumped = 0, exact = 0;
  double most = 0, ratio = 1;
  for (const DepthRow& row : rows) {
    if (row.contact.meeting != Meeting::overlapping) continue;
    ++overlapping, jumped += jumps(row), exact += row.exact_jumps;
    most = std::max(most, row.contact.euclidean_depth);
    ratio = std::max(ratio, row.contact.depth / row.contact.euclidean_depth);
  }
  std::ostringstream out;
  out << "  they overlap in " << overlapping << " of " << counted(rows.size(), "row") << ", by at most " << most
      << "\n  the continuous depth is at most " << ratio << " times the exact one, and jumps " << jumped
      << " times; the exact direction jumps " << exact << " times\n";
  return out.str();
}

}  // namespace

ExitCode run_track(const std::vector<std::string>& operands, const TrackOptions& track, const ReportOptions& report,
                   const InputOptions& input) {
  for (const std::string& file : track.files) {
    const std::string name = format_name(file, "csv");
    if (!name.ends_with(".csv") && !name.ends_with(".svg") && !name.ends_with(".json"))
      throw Stop(kUsage, "-o writes depth along a motion as .csv, .svg or .json: " + file);
  }
  std::ostream& out = report_stream(track.files, report.json);
  const std::vector<SolidInput> inputs = read_solids(operands, input);
  const std::vector<TrackPose> poses = read_motion(track.motion);
  const InterruptGuard guard;
  double smoothing = 0;
  const auto [rows, timing] = timed(report.repeat, [&] { return track_rows(inputs, poses, track, smoothing); });
  Json found = {{"smoothing_length", smoothing}, {"inflation", track.inflation}, {"rows", Json::array()}};
  for (const DepthRow& row : rows) found["rows"].push_back(row_json(row));
  const std::string title = "Depth of " + inputs[1].file + " in " + inputs[0].file + " along " + track.motion;
  std::vector<std::string> texts;
  for (const std::string& file : track.files) texts.push_back(track_output(file, rows, found, title));
  for (std::size_t k = 0; k < texts.size(); ++k) write_text(track.files[k], texts[k]);
  if (report.json) {
    Json json = report_head("depth", solid_inputs_json(inputs), tier_of(inputs[0].mesh, inputs[1].mesh), timing);
    json.update(found);
    print_report(json);
  } else {
    out << title << ", smoothing length " << smoothing << "\n" << summary_text(rows);
    print_times(out, timing);
  }
  return kDone;
}

}  // namespace dymsum::cli
