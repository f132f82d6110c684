// A sweep on a cluster with Slurm: a job array whose tasks share the folder. Each task runs its
// part of the points, then all points that no other task has locked. A task that dies or runs twice
// therefore does no harm, and other tasks run the points of a failed node.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swirl {

struct SlurmJob {
    int tasks = 1;                         // number in the array
    int cores = 0;                         // number per task; 0: the cluster's default
    std::string time, partition;           // options of sbatch; empty: the cluster's default
    std::vector<std::string> sbatch = {};  // further options: "--account=physics"
};

/// The job script. `command` is the subcommand that each task calls with its part. Throws
/// UsageError if an option, or the name of the folder, contains characters that would break a line
/// of the script.
std::string slurm_script(const SlurmJob& job, const std::filesystem::path& folder,
                         const char* command = "sweep --finish-others");

/// Writes the script to DIR/job.sh and submits it. Returns the job ID, which is also saved in
/// DIR/slurm_job. Throws Failure if Slurm rejects the job or is not installed.
std::string submit(const std::string& script, const std::filesystem::path& folder);

/// The states of this folder's job from squeue ("3 running, 1 pending"); nothing if none was
/// submitted.
std::optional<std::string> slurm_status(const std::filesystem::path& folder);

}  // namespace swirl
