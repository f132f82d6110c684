// The folder of `swirl crossing --out DIR`. It is that of a sweep (sweep.hpp) of which only some
// points are run, so `swirl collect` makes a table of the runs. Its axes are the parameters and the
// numbers of discs of the range; search_seed() gives the seeds of the replicas.
//
// The search chooses the length of a run from the results before it. The plan has only the length
// of the first runs; each result names its own. A call that repeats the search makes the same
// choices and finds their results. A result of another length, left by a search with another
// --rate, is replaced.
#pragma once

#include <filesystem>

#include "swirl/study/crossing.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// The plan of searches in a range of numbers of discs; parameters may be lists. Throws UsageError.
SweepPlan search_plan(ParameterTexts given, std::int64_t from, std::int64_t to);

/// The runs of one search in the folder: that with these parameters, which are values of the plan.
class SearchFolder : public StoredRuns {
  public:
    SearchFolder(std::filesystem::path folder, SweepPlan plan, ParameterTexts parameters)
        : folder_(std::move(folder)), plan_(std::move(plan)), parameters_(std::move(parameters)) {}

    std::optional<SearchRun> find(std::int64_t discs, std::int64_t replica,
                                  const std::vector<std::string>& config_texts) override;
    void store(std::int64_t discs, std::int64_t replica, const RunResult& result) override;

  private:
    std::size_t point_of(std::int64_t discs, std::int64_t replica) const;

    const std::filesystem::path folder_;
    const SweepPlan plan_;
    const ParameterTexts parameters_;
};

}  // namespace swirl
