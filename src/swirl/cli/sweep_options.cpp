#include "swirl/cli/sweep_options.hpp"

#include <fmt/format.h>

#include <optional>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

constexpr std::int64_t max_parts = 1'000'000, max_tasks = 100'000, max_cores = 4096;

}  // namespace

SweepShare ShareOptions::share() const {
    SweepShare result;
    result.rest = rest;
    result.threads = static_cast<unsigned>(whole_number("threads", threads, 0, max_cores));
    if (part.empty()) return result;
    const std::size_t slash = part.find('/');
    const auto number = read_whole_number(std::string_view(part).substr(0, slash));
    const auto parts = slash == std::string::npos
                           ? std::nullopt
                           : read_whole_number(std::string_view(part).substr(slash + 1));
    if (!number || !parts || *number < 1 || *parts < *number || *parts > max_parts)
        throw UsageError(
            fmt::format("--part is '{}', but it must be PART/PARTS, for example 2/10.", part));
    result.part = static_cast<std::size_t>(*number);
    result.parts = static_cast<std::size_t>(*parts);
    return result;
}

SlurmJob ShareOptions::slurm_job() const {
    SlurmJob result = job;
    result.tasks = static_cast<int>(whole_number("tasks", tasks, 1, max_tasks));
    result.cores = static_cast<int>(whole_number("cores", cores, 0, max_cores));
    return result;
}

Option threads_option(ShareOptions& options) {
    return {"--threads", &options.threads, "Number of simultaneous runs [one per core]", "N"};
}

void add_cluster_options(Subcommand& subcommand, ShareOptions& options, bool with_rest) {
    const char* const cluster = "Cluster";
    subcommand.in(cluster).add(
        {{"--part", &options.part, "Part of the points to run, such as 2/10", "PART/PARTS"}});
    if (with_rest)
        subcommand.in(cluster).add({{"--finish-others", &options.rest,
                                     "After the part, run points that no process works on"}});
    subcommand.in(cluster).add({
        {"--slurm", &options.slurm, "Submit a Slurm job array instead of running here"},
        {"--tasks", &options.tasks, "Number of tasks of the array [1]", "N"},
        {"--cores", &options.cores, "Cores per task [the default of the cluster]", "N"},
        {"--time", &options.job.time, "Time limit of a task, in the format of sbatch", "TIME"},
        {"--partition", &options.job.partition, "Slurm partition", "NAME"},
        {"--sbatch", &options.job.sbatch, "Further option of sbatch, such as mem=4G; repeatable",
         "ARG"},
    });
}

}  // namespace swirl
