// The command line. Reads the arguments, calls the subcommand, and turns what went wrong into one
// sentence and an exit code: 0 done, 1 could not be done, 2 wrong call, 130 stopped by a signal.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "swirl/cli/command_line.hpp"
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

/// The libraries that hold JSON and read the command line ask for memory where nothing may be
/// thrown, in destructors and the like; nobody can catch that, and g++ does not always tell here
/// what was thrown. What was recorded can be resumed, as after a kill.
[[noreturn]] void end_where_nothing_may_be_thrown() {
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

int main_or_throw(int argc, char** argv) {
    swirl::reject_what_is_no_text(argc, argv);
    const swirl::Call call = swirl::parse(argc, argv);
    if (!call.text.empty()) {
        swirl::print_all(call.text);
        return 0;
    }
    if (!call.act) {
        std::fputs(call.usage.c_str(), stderr);
        return 2;
    }
    (void)swirl::asked_width();  // A wrong SWIRL_SIMD ends every command before it begins.
    call.act();
    return 0;
}

/// A program may be called with its standard input, output or errors closed. The next file it
/// opened would get that number, and be written into by whoever complains. What stands in for it
/// cannot be written to: a result that was to go there is not lost without a word.
void open_closed_standard_files() {
    for (int number = 0; number <= 2; ++number)
        if (fcntl(number, F_GETFD) < 0) (void)open("/dev/null", O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(end_where_nothing_may_be_thrown);
    open_closed_standard_files();
    // A file that grows beyond what is allowed is an error of write(), like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    swirl::remember_command_line(argc, argv);
    try {
        return main_or_throw(argc, argv);
    } catch (const swirl::UsageError& wrong) {
        return report_error(wrong.what(), 2);
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
