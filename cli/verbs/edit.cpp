// dymsum edit P Q SCRIPT, dymsum edit --replay FILE
#include <CLI/CLI.hpp>
#include <memory>

#include "line_file.h"
#include "memory_limit.h"
#include "planar/planar_edit.h"
#include "solid/solid_edit.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct EditCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::string p, q, replay, semantics = "closed", mode = "automatic";
  double memory_mb = 0;  ///< 0: no limit
  PlanarEdit planar;
};

ExitCode run_solids(const EditCommand& command) {
  refuse_options(*command.parser, {"--film", "--mode"}, "is for planar operands");
  const PlanarEdit& given = command.planar;
  SolidEditing edit;
  edit.operands = given.operands, edit.script = given.script, edit.files = given.output.files;
  if (command.parser->count("--to") > 0) edit.to = given.output.to;
  edit.options.semantics = named<Semantics>(command.semantics);
  edit.options.reflect_q = given.options.reflect_q;
  edit.record = given.record, edit.keep_going = given.keep_going;
  edit.report = given.report, edit.input = given.input;
  return run_solid_edit(edit);
}

ExitCode run(EditCommand command) {
  limit_memory(command.memory_mb);
  PlanarEdit& edit = command.planar;
  if (!command.replay.empty()) {
    if (!command.p.empty()) throw Stop(kUsage, "--replay takes operands and script from its file, and no others");
    refuse_options(*command.parser, {"-o",          "--to",     "--film",    "--record",      "--keep-going",
                                     "--semantics", "--mode",   "--reflect", "--exact",       "--repair",
                                     "--fill",      "--snap",   "--nested",  "--curve-error", "--curve-bound",
                                     "--join",      "--drop-z", "--hull",    "--planes",      "--from"},
                   "does not go with --replay");
    const std::string text = file_text(command.replay);
    return records_solids(text) ? run_solid_replay(command.replay, text, edit.report)
                                : run_replay(command.replay, text, edit.report);
  }
  if (edit.script.empty()) throw Stop(kUsage, "edit wants P, Q and SCRIPT, or --replay FILE");
  edit.operands = {command.p, command.q};
  if (edit.script == "-" && (command.p == "-" || command.q == "-"))
    throw Stop(kUsage, "standard input cannot be read twice");
  if (!writes_to_stdout(edit.output.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  if (are_solid(edit.operands, edit.input)) return run_solids(command);
  edit.options.semantics = named<Semantics>(command.semantics);
  edit.options.mode = named<FrameMode>(command.mode);
  return run_planar_edit(edit);
}

void add_options(CLI::App& verb, EditCommand& command) {
  PlanarEdit& edit = command.planar;
  verb.add_option("P", command.p, "The region or solid to which Q is added")->type_name("");
  verb.add_option("Q", command.q, "The other one")->type_name("");
  verb.add_option("SCRIPT", edit.script, "A file with an edit a line, or - for standard input")->type_name("");
  verb.add_option("-o", edit.output.files,
                  "Write the sum after the last step; repeatable; by extension .poly .wkt .geojson .dxf .gpkg "
                  "(rounded), .json (exact, with provenance), .svg (picture), of solids .off .obj .stl .ply .3mf "
                  "(rounded), .json, .glb; - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  one_of(verb.add_option("--to", edit.output.to, "Format of -o -; of solids off if not given"),
         file_formats(OperandKind::either))
      ->capture_default_str();
  verb.add_option("--film", edit.film,
                  "Planar: write the sum after every step: .svg (a film strip) or anim.svg (an animation)")
      ->type_name("FILE");
  verb.add_option("--record", edit.record,
                  "Write all that it takes to make the session again: operands, options, steps, and a hash of the sum "
                  "after each")
      ->type_name("FILE");
  verb.add_option("--replay", command.replay,
                  "Make the session of such a file again, instead of P Q SCRIPT; exit code 4 where a sum has another "
                  "hash, with the first such step")
      ->type_name("FILE");
  verb.add_flag("--keep-going", edit.keep_going,
                "Pass over steps that are refused, with exit code 4; else the first one ends the command, and nothing "
                "is written");
  verb.add_flag("--reflect", edit.options.reflect_q, "P (+) -Q: Q is a robot and P an obstacle");
  one_of<Semantics>(verb.add_option("--semantics", command.semantics, "closed, open or regular"))
      ->capture_default_str();
  one_of<FrameMode>(
      verb.add_option("--mode", command.mode,
                      "Planar: how steps are made: window updates wherever there can be an update; all give the "
                      "same sums"))
      ->capture_default_str();
  add_memory_limit(verb, command.memory_mb);
  add_report_options(verb, edit.report, "Make all steps N times and report the median and minimum step");
  add_exact_option(verb, edit.report, OperandKind::either);
  add_solid_input_options(verb, edit.input);
}

}  // namespace

void add_edit(CLI::App& app, Action& action) {
  auto command = std::make_shared<EditCommand>();
  CLI::App& verb = *app.add_subcommand("edit", "P (+) Q follows edits of P and Q step by step, exact after every one");
  command->parser = &verb;
  add_options(verb, *command);
  verb.footer(
      "Edits, a line each, # begins a comment; indices count from 0, after the edits before:\n"
      "  p move V X Y               q insert V X Y (after V)    p remove V\n"
      "  p extrude V W DX DY        p invert V                  q add-hole PART X Y X Y X Y ...\n"
      "  p remove-hole PART HOLE    p add-part X Y ... hole X Y ...   p remove-part PART\n"
      "Of solids, W the other end of an edge:\n"
      "  p move V X Y Z             p extrude F F ... by DX DY DZ   q invert V W\n"
      "  p insert-in-face F X Y Z   p insert-in-edge V W X Y Z      p remove V\n"
      "  q add-shell X Y Z X Y Z ... face 0 1 2 face ...            p remove-shell F\n"
      "  { and } on lines of their own make one step of the edits between them; undo; redo\n"
      "Examples: dymsum edit plate.wkt star.wkt moves.txt -o sum.wkt --film moves.svg --record session.json\n"
      "          echo 'p move 3 1/2 2' | dymsum edit plate.wkt star.wkt - --json\n"
      "          dymsum edit --replay session.json");
  verb.callback([command, &action] {
    action = [command] {
      const InterruptGuard guard;
      return run(*command);
    };
  });
}

}  // namespace dymsum::cli
