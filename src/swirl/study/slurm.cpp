#include "swirl/study/slurm.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <map>
#include <sstream>

#include "swirl/io/atomic_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// Without what a terminal would take as a command.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return text;
}

struct Answer {
    int code;
    std::string text;
};

Answer ask(const std::string& command) {
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) throw Failure("No further process could be started.");
    std::string text;
    char block[4096];
    for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
        text.append(block, got);
    const int status = ::pclose(pipe);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, text};
}

/// A line of a job script ends where a text has a line end, and what follows would be a command.
void reject_unfit(const char* option, const std::string& text, const char* allowed,
                  const char* right) {
    const auto fits = [allowed](unsigned char c) {
        return std::isalnum(c) || std::strchr(allowed, c) != nullptr;
    };
    if (std::all_of(text.begin(), text.end(), fits)) return;
    throw UsageError(fmt::format("{} is '{}', but it must be {}.", option, printable(text), right));
}

/// A path in a line #SBATCH: in quotation marks, and each % doubled, which alone would begin one of
/// Slurm's own patterns.
std::string sbatch_path(const fs::path& path) {
    const std::string text = path.string();
    for (const unsigned char c : text)
        if (c < 0x20 || c == 0x7f || c == '"' || c == '\\')
            throw UsageError(fmt::format(
                "--out is '{}', but for Slurm it must have no quotation mark, no backslash and no "
                "line end in it.",
                printable(text)));
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '%' ? std::string("%%") : std::string(1, c);
    return quoted;  // what follows closes the quotation
}

/// The tasks run elsewhere.
fs::path home_of(const fs::path& folder) { return fs::absolute(folder).lexically_normal(); }

}  // namespace

std::string slurm_script(const SlurmJob& job, const fs::path& folder) {
    const fs::path home = home_of(folder);
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    reject_unfit("--time", job.time, ":-", "as sbatch takes it, for example 2:00:00 or 1-12");
    reject_unfit("--partition", job.partition, "_-.,", "the name of a partition");
    std::string text = "#!/bin/bash\n#SBATCH --job-name=swirl\n";
    text += fmt::format("#SBATCH --array=1-{}\n#SBATCH --nodes=1\n#SBATCH --ntasks=1\n", job.nodes);
    text += job.cpus > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", job.cpus)
                         : std::string("#SBATCH --exclusive\n");
    if (!job.time.empty()) text += fmt::format("#SBATCH --time={}\n", job.time);
    if (!job.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", job.partition);
    // A minute before its time is over a task keeps the state of its runs and ends; so does one
    // that is preempted. A task whose node dies is started again.
    text += "#SBATCH --requeue\n#SBATCH --signal=TERM@60\n";
    text += fmt::format("#SBATCH --output={}/%A_%a.log\"\n#SBATCH --open-mode=append\n",
                        sbatch_path(home / "log"));
    text += fmt::format("exec {} sweep --out {} --part \"$SLURM_ARRAY_TASK_ID/{}\" --rest",
                        shell_word(program.string()), shell_word(home.string()), job.nodes);
    text += job.cpus > 0 ? fmt::format(" --threads {}\n", job.cpus) : std::string("\n");
    return text;
}

std::string submit(const std::string& script, const fs::path& folder) {
    const fs::path home = home_of(folder);
    std::error_code ignored;
    fs::create_directories(home / "log", ignored);
    write_file_atomically(home / "job.sh", script);
    const Answer answer = ask("sbatch --parsable " + shell_word((home / "job.sh").string()));
    if (answer.code == 127)
        throw Failure(fmt::format(
            "Slurm is not installed here: there is no sbatch. The script is '{}'; submit it on "
            "the cluster, or use --part with another scheduler.",
            (home / "job.sh").string()));
    if (answer.code != 0)
        throw Failure(fmt::format("sbatch refused '{}': {}.", (home / "job.sh").string(),
                                  printable(answer.text)));
    const std::string number = answer.text.substr(0, answer.text.find(';'));
    write_file_atomically(home / "slurm_job", number + "\n");
    return number;
}

std::optional<std::string> slurm_status(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::exists(folder / "slurm_job", ignored)) return {};
    std::string number = read_whole_file(folder / "slurm_job");
    number.erase(std::remove_if(number.begin(), number.end(),
                                [](unsigned char c) { return !std::isdigit(c) && c != '_'; }),
                 number.end());
    const Answer answer = ask("squeue --noheader --array --format=%T --jobs=" + number);
    if (answer.code != 0) {
        if (answer.text.find("Invalid job id") != std::string::npos)
            return fmt::format("job {}: no longer in the queue", number);
        return fmt::format("job {}: squeue does not answer ({})", number, answer.text);
    }
    std::map<std::string, int> states;
    std::istringstream lines(answer.text);
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
