// Options of swirl sweep and swirl map: how the runs are shared between processes and machines.
#pragma once

#include <cstdint>
#include <string>

#include "swirl/cli/options.hpp"
#include "swirl/study/slurm.hpp"
#include "swirl/study/sweep.hpp"

namespace swirl {

struct ShareOptions {
    std::string part, threads, tasks, cores;
    SlurmJob job;
    bool slurm = false, rest = false;

    /// Throws UsageError.
    SweepShare share() const;
    /// The Slurm job with its numbers of tasks and cores. Throws UsageError.
    SlurmJob slurm_job() const;
};

/// --threads
Option threads_option(ShareOptions& options);
/// --part, --slurm and so on. Without `with_rest` the rest always follows.
void add_cluster_options(Subcommand& subcommand, ShareOptions& options, bool with_rest);

}  // namespace swirl
