#include <stdexcept>

#include "dymsum/names.h"
#include "dymsum/solid_edit_script.h"
#include "io/edit/recorded_steps.h"
#include "io/read_file.h"

namespace dymsum {
namespace {

using SolidRecordingJson = nlohmann::json;

constexpr io::CheckedFormat kSolidRecordingFormat{"dymsum solid edits", 1, "a recording of edits of solids"};

SolidRecordingJson mesh_json(const Mesh& mesh) {
  SolidRecordingJson vertices = SolidRecordingJson::array();
  for (const Point3& v : mesh.vertices())
    for (const double c : {v.x, v.y, v.z}) vertices.push_back(c);
  return {{"vertices", std::move(vertices)}, {"faces", mesh.faces()}};
}

Result<Mesh> mesh_of(const SolidRecordingJson& j) {
  MeshData data;
  const SolidRecordingJson& flat = io::list(j.at("vertices"));
  io::demand(flat.size() % 3 == 0, "vertices are a list of coordinates");
  for (std::size_t k = 0; k < flat.size(); k += 3)
    data.vertices.push_back({io::number(flat[k]), io::number(flat[k + 1]), io::number(flat[k + 2])});
  for (const SolidRecordingJson& face : io::list(j.at("faces"))) {
    Face& made = data.faces.emplace_back();
    for (const SolidRecordingJson& v : io::list(face)) made.push_back(io::index(v, data.vertices.size()));
  }
  return data.faces.empty() && data.vertices.empty() ? Mesh() : Mesh::create(std::move(data));
}

Result<SolidEditRecording> solid_recording_of(const SolidRecordingJson& content) {
  SolidEditRecording recording;
  Result<Mesh> p = mesh_of(content.at("p")), q = mesh_of(content.at("q"));
  if (!p) return p.error();
  if (!q) return q.error();
  recording.p = *std::move(p), recording.q = *std::move(q);
  const SolidRecordingJson& options = content.at("options");
  recording.semantics = io::enumerator_in<Semantics>(options.at("semantics"));
  recording.reflect_q = io::flag(options.at("reflect_q"));
  recording.tight = io::flag(options.at("tight"));
  recording.undo_steps = io::count_in(options.at("undo_steps"));
  io::read_steps(content, recording, [](std::string_view text) { return parse_solid_script(text); });
  return recording;
}

}  // namespace

SolidEditRecording begin_recording(const EditableSolidSum& sum, const SolidEditOptions& options) {
  if (sum.undo_count() + sum.redo_count() > 0)
    throw std::invalid_argument("begin_recording: the sum has steps that are not recorded");
  return {sum.p(), sum.q(), options.semantics, options.reflect_q, options.tight, options.undo_steps, {}, {sum.hash()}};
}

void record_step(SolidEditRecording& recording, const SolidScriptStep& step, const EditableSolidSum& sum) {
  recording.steps.push_back(step);
  recording.steps.back().line = 0;
  recording.hashes.push_back(sum.hash());
}

std::string format_recording(const SolidEditRecording& recording) {
  SolidRecordingJson content =
      io::steps_json(recording, [](std::span<const SolidScriptStep> step) { return format_solid_script(step); });
  content.update({{"p", mesh_json(recording.p)},
                  {"q", mesh_json(recording.q)},
                  {"options",
                   {{"semantics", name(recording.semantics)},
                    {"reflect_q", recording.reflect_q ? 1 : 0},
                    {"tight", recording.tight ? 1 : 0},
                    {"undo_steps", recording.undo_steps}}}});
  return io::format_checked(kSolidRecordingFormat, content);
}

Result<SolidEditRecording> parse_solid_recording(std::string_view text, std::string_view name_for_errors) {
  return io::checked_recording<SolidEditRecording>(kSolidRecordingFormat, text, name_for_errors, solid_recording_of);
}

Result<SolidEditRecording> read_solid_recording(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_solid_recording(*text, path == "-" ? "standard input" : path);
}

Result<EditReplay> replay(const SolidEditRecording& recording, const Progress& progress) {
  SolidEditOptions options;
  options.semantics = recording.semantics, options.reflect_q = recording.reflect_q, options.tight = recording.tight;
  options.undo_steps = recording.undo_steps, options.progress = progress;
  return io::replayed(recording, EditableSolidSum::create(recording.p, recording.q, options), progress);
}

}  // namespace dymsum
