// main() of every command: parses the arguments, does the work, and turns exceptions into an error
// message and an exit code: 0 success, 1 failure, 2 usage error, 130 stopped by a signal.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/parser.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/simd.hpp"

namespace {

int report_error(const char* text, int exit_code) {
    swirl::print_error(text);
    return exit_code;
}

constexpr const char* not_enough_memory = "not enough memory.\nhint: use fewer discs.";

/// Handler for std::terminate(). The libraries for JSON and the command line allocate memory in
/// functions that must not throw, such as destructors, so a bad_alloc there cannot be caught. g++
/// does not always provide the current exception here. Recordings can be resumed, as after a kill.
[[noreturn]] void on_terminate() {
    bool out_of_memory = std::uncaught_exceptions() > 0;
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        out_of_memory = true;
    } catch (...) {
        out_of_memory = false;
    }
    if (out_of_memory) std::_Exit(report_error(not_enough_memory, 1));
    std::abort();
}

int main_or_throw(const swirl::Command& command, int argc, char** argv) {
    swirl::reject_invalid_utf8(argc, argv);
    const swirl::Call call = swirl::parse(command, argc, argv);
    if (!call.text.empty()) {
        swirl::print_all(call.text);
        return 0;
    }
    call.check();
    // ./swirl checks a call in this way before it installs packages for it.
    if (std::getenv("SWIRL_PARSE_ONLY")) return 0;
    (void)swirl::selected_width();  // rejects an invalid SWIRL_SIMD before any work
    call.act();
    return 0;
}

/// If stdin, stdout or stderr is closed, the next opened file would get its number, and messages
/// would be written into it. The replacement is read-only, so output to it fails with an error.
void reserve_standard_descriptors() {
    for (int number = 0; number <= 2; ++number)
        if (fcntl(number, F_GETFD) < 0) (void)open("/dev/null", O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(on_terminate);
    reserve_standard_descriptors();
    // Exceeding the file size limit becomes an error of write(), like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    const swirl::Command* const command = swirl::Command::of_program(argv[0]);
    if (command == nullptr)
        return report_error("this program is called by `swirl`.\nhint: see `swirl --help`.", 2);
    swirl::remember_command_line(command->name(), argc, argv);
    try {
        return main_or_throw(*command, argc, argv);
    } catch (const swirl::UsageError& error) {
        return report_error(error.what(), 2);
    } catch (const swirl::Interrupted& interrupted) {
        return report_error(interrupted.what(), 130);
    } catch (const swirl::Failure& failure) {
        return report_error(failure.what(), 1);
    } catch (const std::bad_alloc&) {
        return report_error(not_enough_memory, 1);
    } catch (const std::exception& unexpected) {
        return report_error(unexpected.what(), 1);
    }
}
