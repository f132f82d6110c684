#include "swirl/cli/called_command.hpp"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/child_process.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/programs.hpp"

namespace swirl {

std::string output_of_command(std::vector<std::string> words, const std::string& stopped,
                              const std::string& before_error) {
    const std::string command = words.front();
    words.insert(words.begin(), main_program());
    const ProgramOutput done = run_program(words, &stop_signal());
    if (stop_signal().load()) throw Interrupted(stopped);
    if (done.error != 0)
        throw Failure(fmt::format("'{}' cannot be started: {}.", words.front(),
                                  std::generic_category().message(done.error)));
    if (done.exit_code == 0) return done.text;
    // Warnings may precede the error.
    constexpr std::string_view mark = "error: ";
    const std::size_t at = done.text.find(mark);
    std::string reason = at == done.text.npos
                             ? fmt::format("`swirl {}` ended without a message.", command)
                             : done.text.substr(at + mark.size());
    while (reason.ends_with('\n')) reason.pop_back();
    throw Failure(before_error + reason);
}

}  // namespace swirl
