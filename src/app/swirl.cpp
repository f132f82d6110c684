// The command line. Reads the arguments, calls the subcommand, and turns what went wrong into one
// sentence and an exit code: 0 done, 1 could not be done, 2 wrong call, 130 stopped by a signal.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "swirl/app/command_line.hpp"
#include "swirl/app/output.hpp"
#include "swirl/app/parser.hpp"
#include "swirl/run/failure.hpp"

namespace {

int complain(const char* sentence, int code) {
    std::fprintf(stderr, "swirl: %s\n", sentence);
    return code;
}

int main_or_throw(int argc, char** argv) {
    const swirl::Call call = swirl::parse(argc, argv);
    if (!call.text.empty()) {
        swirl::print_all(call.text);
        return 0;
    }
    if (!call.act) {
        std::fputs(call.usage.c_str(), stderr);
        return 2;
    }
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
    open_closed_standard_files();
    // A file that grows beyond what is allowed is an error of write(), like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    swirl::remember_command_line(argc, argv);
    try {
        return main_or_throw(argc, argv);
    } catch (const swirl::WrongCall& wrong) {
        return complain(wrong.what(), 2);
    } catch (const swirl::Interrupted& interrupted) {
        return complain(interrupted.what(), 130);
    } catch (const swirl::Failure& failure) {
        return complain(failure.what(), 1);
    } catch (const std::bad_alloc&) {
        return complain("There is not enough memory for this; fewer discs need less.", 1);
    } catch (const std::exception& unexpected) {
        return complain(unexpected.what(), 1);
    }
}
