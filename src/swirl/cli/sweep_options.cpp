#include "swirl/cli/sweep_options.hpp"

#include <fmt/format.h>

#include <optional>

#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

constexpr std::int64_t max_parts = 1'000'000, max_nodes = 100'000, max_cores = 4096;

}  // namespace

std::int64_t whole_number(const char* name, const std::string& text, std::int64_t default_value,
                          std::int64_t maximum) {
    if (text.empty()) return default_value;
    const auto value = read_whole_number(text);
    if (!value || *value < 1 || *value > maximum)
        throw UsageError(fmt::format("--{} is '{}', but it must be a whole number from 1 to {}.",
                                     name, text, maximum));
    return *value;
}

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
    result.nodes = static_cast<int>(whole_number("nodes", nodes, 1, max_nodes));
    result.cpus = static_cast<int>(whole_number("cpus", cpus, 0, max_cores));
    return result;
}

void add_threads_option(Subcommand& subcommand, ShareOptions& options, const char* group) {
    subcommand.add_option("--threads", options.threads,
                          "Number of simultaneous runs [one per core]", "N", group);
}

void add_cluster_options(Subcommand& subcommand, ShareOptions& options, bool with_rest) {
    const char* const cluster = "Cluster";
    subcommand.add_option("--part", options.part, "Part of the points to run, such as 2/10",
                          "PART/PARTS", cluster);
    if (with_rest)
        subcommand.add_flag("--finish-others", options.rest,
                            "After the part, run points that no process works on", cluster);
    subcommand.add_flag("--slurm", options.slurm,
                        "Submit a Slurm job array instead of running here", cluster);
    subcommand.add_option("--nodes", options.nodes, "Number of tasks of the array [1]", "N",
                          cluster);
    subcommand.add_option("--cpus", options.cpus, "Cores per task [the default of the cluster]",
                          "N", cluster);
    subcommand.add_option("--time", options.job.time,
                          "Time limit of a task, in the format of sbatch", "TIME", cluster);
    subcommand.add_option("--partition", options.job.partition, "Slurm partition", "NAME", cluster);
    subcommand.add_option("--sbatch", options.job.sbatch,
                          "Further option of sbatch, such as mem=4G; repeatable", "ARG", cluster);
}

}  // namespace swirl
