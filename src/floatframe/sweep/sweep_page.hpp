#pragma once
// The page of a study for the viewer (viewer/README.md): every figure of every run, the curves of
// runs whose results are kept, and the pages of the best and the worst run.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/sweep/sweep.hpp"
#include "floatframe/sweep/sweep_row.hpp"

namespace floatframe {

/// Limit of the runs of a study with a page, and of those whose curves it shows.
inline constexpr std::size_t most_runs_of_page = 20'000;
inline constexpr std::size_t most_runs_with_curves = 60;

/// Numbers from 0 of the completed runs with the best and the worst figure.
struct RankedRuns {
  std::size_t best = 0, worst = 0;
};
/// Empty without a ranking, or if no completed run has the figure.
std::optional<RankedRuns> ranked_runs(const std::optional<SweepRanking>& ranking,
                                      const std::vector<SweepRow>& rows);

/// `count` runs or fewer, both ends of the list among them.
std::vector<std::size_t> evenly_chosen(const std::vector<std::size_t>& runs, std::size_t count);

/// Makes the pages of the best and the worst run if the study has a ranking, and writes the page of
/// the study, with a link to each. One row per run. Throws OutputError, RunCancelled if `stop` is
/// set meanwhile.
void write_sweep_page(const SweepOptions& options, const std::vector<SweepRow>& rows,
                      const std::atomic<bool>& stop, const SweepReport& report);

}  // namespace floatframe
