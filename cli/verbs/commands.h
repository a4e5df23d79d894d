// The verbs. Each function adds one to the application; when the command line chooses it, it sets `action`.
#pragma once

#include "exit_code.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

void add_sum(CLI::App& app, Action& action);
void add_nfp(CLI::App& app, Action& action);
void add_erode(CLI::App& app, Action& action);
void add_edit(CLI::App& app, Action& action);
void add_union(CLI::App& app, Action& action);
void add_intersect(CLI::App& app, Action& action);
void add_subtract(CLI::App& app, Action& action);
void add_nfp_table(CLI::App& app, Action& action);
void add_disc(CLI::App& app, Action& action);
void add_opening(CLI::App& app, Action& action);
void add_closing(CLI::App& app, Action& action);
void add_offset(CLI::App& app, Action& action);
void add_scale(CLI::App& app, Action& action);
void add_family(CLI::App& app, Action& action);
void add_scale_range(CLI::App& app, Action& action);
void add_rotate(CLI::App& app, Action& action);
void add_slice(CLI::App& app, Action& action);
void add_cspace(CLI::App& app, Action& action);
void add_clearance(CLI::App& app, Action& action);
void add_angles(CLI::App& app, Action& action);
void add_path(CLI::App& app, Action& action);
void add_depth(CLI::App& app, Action& action);
void add_robustness(CLI::App& app, Action& action);
void add_stack(CLI::App& app, Action& action);
void add_local_sum(CLI::App& app, Action& action);
void add_contains(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_check_sum(CLI::App& app, Action& action);
void add_check_nfp(CLI::App& app, Action& action);
void add_check_fit(CLI::App& app, Action& action);
void add_check_offset(CLI::App& app, Action& action);
void add_check_mesh(CLI::App& app, Action& action);
void add_features(CLI::App& app, Action& action);
void add_decompose(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_hull(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);

}  // namespace dymsum::cli
