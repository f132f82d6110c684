// The command line. Reads the arguments, calls the subcommand, and turns what went wrong into one
// sentence and an exit code: 0 done, 1 could not be done, 2 wrong call, 130 stopped by a signal.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <new>

#include "app/commands.hpp"
#include "lab/failure.hpp"
#include "lab/version.hpp"

namespace {

int complain(const char* sentence, int code) {
    std::fprintf(stderr, "swirl: %s\n", sentence);
    return code;
}

int main_or_throw(int argc, char** argv) {
    CLI::App app("A laboratory for swirled granular matter: exact event-driven simulation of discs\n"
                 "in a swirled dish, after Lee et al., Phys. Rev. E 100, 012903 (2019).",
                 "swirl");
    app.set_version_flag("--version", swirl::version());
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    for (const swirl::Command* command : swirl::Command::all()) command->add_to(app);
    swirl::set_examples(app, {"swirl run --discs 48", "swirl paper --figure 5b --quick",
                              "swirl run --help"});
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "swirl: %s\nTry `swirl --help`.\n", error.what());
        return 2;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
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
