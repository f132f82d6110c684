#include "swirl/study/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <map>
#include <sstream>
#include <system_error>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/child_process.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/programs.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// Replaces control characters, which a terminal could interpret.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return text;
}

/// Without the line break at the end of its text.
ProgramOutput run_command(const std::vector<std::string>& words) {
    ProgramOutput output = run_program(words);
    if (output.error != 0) output.text = std::generic_category().message(output.error);
    while (!output.text.empty() && std::isspace(static_cast<unsigned char>(output.text.back())))
        output.text.pop_back();
    return output;
}

/// A line break in an option would end its line of the job script, and the rest would be a command.
void validate_characters(const char* option, const std::string& text, const char* allowed,
                         const char* description) {
    const auto is_allowed = [allowed](unsigned char c) {
        return std::isalnum(c) || std::strchr(allowed, c) != nullptr;
    };
    if (std::all_of(text.begin(), text.end(), is_allowed)) return;
    throw UsageError(
        fmt::format("{} is '{}', but it must be {}.", option, printable(text), description));
}

/// A path in a line #SBATCH, in quotation marks. Each % is doubled because a single one starts a
/// filename pattern of Slurm.
std::string sbatch_path(const fs::path& path) {
    const std::string text = path.string();
    for (const unsigned char c : text)
        if (c < 0x20 || c == 0x7f || c == '"' || c == '\\')
            throw UsageError(
                fmt::format("--out is '{}', but for Slurm it must not contain quotation marks, "
                            "backslashes or line breaks.",
                            printable(text)));
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '%' ? std::string("%%") : std::string(1, c);
    return quoted;  // the caller adds the rest of the path and the closing mark
}

/// A line of the script for an option of sbatch, with or without its dashes.
std::string sbatch_line(const std::string& option) {
    validate_characters("--sbatch", option, "-_.,:=+/@%[]*",
                        "an option of sbatch, such as account=physics");
    const bool is_name =
        !option.empty() && std::isalpha(static_cast<unsigned char>(option.front()));
    if (!is_name && !option.starts_with("-"))
        throw UsageError(fmt::format(
            "--sbatch is '{}', but it must begin with the name of an option of sbatch.", option));
    return fmt::format("#SBATCH {}{}\n", is_name ? "--" : "", option);
}

/// The tasks may start in another directory.
fs::path absolute_folder(const fs::path& folder) { return fs::absolute(folder).lexically_normal(); }

}  // namespace

std::string slurm_script(const SlurmJob& job, const fs::path& folder, const char* command) {
    const fs::path sweep = absolute_folder(folder);
    const fs::path program = main_program();
    validate_characters("--time", job.time, ":-", "a time for sbatch, for example 2:00:00 or 1-12");
    validate_characters("--partition", job.partition, "_-.,", "the name of a partition");
    std::string text = "#!/bin/bash\n#SBATCH --job-name=swirl\n";
    text += fmt::format("#SBATCH --array=1-{}\n#SBATCH --nodes=1\n#SBATCH --ntasks=1\n", job.tasks);
    if (job.cores > 0) text += fmt::format("#SBATCH --cpus-per-task={}\n", job.cores);
    if (!job.time.empty()) text += fmt::format("#SBATCH --time={}\n", job.time);
    if (!job.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", job.partition);
    for (const std::string& option : job.sbatch) text += sbatch_line(option);
    // A minute before its time limit, or when it is preempted, a task saves the state of its runs
    // and ends. Slurm restarts a task whose node fails.
    text += "#SBATCH --requeue\n#SBATCH --signal=TERM@60\n";
    text += fmt::format("#SBATCH --output={}/%A_%a.log\"\n#SBATCH --open-mode=append\n",
                        sbatch_path(sweep / "log"));
    text +=
        fmt::format("exec {} {} --out {} --part \"$SLURM_ARRAY_TASK_ID/{}\" --threads ",
                    shell_word(program.string()), command, shell_word(sweep.string()), job.tasks);
    return text + "\"$SLURM_CPUS_ON_NODE\"\n";
}

std::string submit(const std::string& script, const fs::path& folder) {
    const fs::path sweep = absolute_folder(folder);
    std::error_code ignored;
    fs::create_directories(sweep / "log", ignored);
    write_file_atomically(sweep / "job.sh", script);
    const ProgramOutput output = run_command({"sbatch", "--parsable", (sweep / "job.sh").string()});
    if (output.error == ENOENT)
        throw Failure(
            fmt::format("Slurm is not installed here: there is no sbatch.\nhint: submit '{}' on "
                        "the cluster, or use --part with another scheduler.",
                        (sweep / "job.sh").string()));
    if (output.exit_code != 0)
        throw Failure(fmt::format("sbatch rejected '{}': {}.", (sweep / "job.sh").string(),
                                  printable(output.text)));
    const std::string number = output.text.substr(0, output.text.find(';'));
    write_file_atomically(sweep / "slurm_job", number + "\n");
    return number;
}

std::optional<std::string> slurm_status(const fs::path& folder) {
    const std::optional<std::string> job = read_optional_file(folder / "slurm_job");
    if (!job) return {};
    std::string number = *job;
    number.erase(std::remove_if(number.begin(), number.end(),
                                [](unsigned char c) { return !std::isdigit(c) && c != '_'; }),
                 number.end());
    const ProgramOutput output =
        run_command({"squeue", "--noheader", "--array", "--format=%T", "--jobs=" + number});
    if (output.exit_code != 0) {
        if (output.text.find("Invalid job id") != std::string::npos)
            return fmt::format("job {}: no longer in the queue", number);
        return fmt::format("job {}: squeue failed ({})", number, output.text);
    }
    std::map<std::string, int> states;
    std::istringstream lines(output.text);
    for (std::string state; lines >> state;) {
        std::transform(state.begin(), state.end(), state.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        ++states[state];
    }
    if (states.empty()) return fmt::format("job {}: no longer in the queue", number);
    std::string text = fmt::format("job {}: ", number);
    for (const auto& [state, count] : states)
        text += fmt::format("{}{} {}", text.back() == ' ' ? "" : ", ", count, state);
    return text;
}

}  // namespace swirl
