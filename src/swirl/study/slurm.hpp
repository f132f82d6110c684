// The same sweep on a cluster that runs Slurm: a job array whose tasks share the folder. Each task
// does its part of the points, then whatever nobody works on; so a task that dies, or runs twice,
// does no harm, and what a dead node leaves behind is done by the others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace swirl {

struct SlurmJob {
    int nodes = 1;                // tasks of the array: one node each
    int cpus = 0;                 // per task; 0: the whole node
    std::string time, partition;  // as sbatch takes them; empty: the cluster's default
};

/// The script that sbatch gets. Throws WrongCall if a text of the job, or the folder's name, cannot
/// stand in a line of it.
std::string slurm_script(const SlurmJob& job, const std::filesystem::path& folder);

/// Writes the script to DIR/job.sh and submits it; the number of the job, also kept in
/// DIR/slurm_job. Throws Failure if Slurm refuses, or is not there.
std::string submit(const std::string& script, const std::filesystem::path& folder);

/// "3 running, 1 pending" of the job of this folder, from squeue; nothing if none was submitted.
std::optional<std::string> slurm_status(const std::filesystem::path& folder);

}  // namespace swirl
