// The command line. Reads the arguments, calls the subcommand, and turns what went wrong into one
// sentence and an exit code: 0 done, 1 could not be done, 2 wrong call, 130 stopped by a signal.
#include <CLI/CLI.hpp>

#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "swirl/app/command_line.hpp"
#include "swirl/app/commands.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/version.hpp"

namespace {

int complain(const char* sentence, int code) {
    std::fprintf(stderr, "swirl: %s\n", sentence);
    return code;
}

/// The subcommand that the arguments name, or the program itself.
const CLI::App& deepest(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? app : deepest(*named.front());
}

std::string did_you_mean(const CLI::App& app, const std::string& wrong) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const auto meant = swirl::nearest_name(wrong.substr(0, wrong.find('=')), names);
    return meant ? "; did you mean " + *meant + "?" : ".";
}

/// What the parser has to say, as a sentence that names the value and what would be right.
std::string in_words(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& place = deepest(app);
    const std::string name = &place == &app ? "swirl" : "swirl " + place.get_name();
    const std::string help = " Try `" + name + " --help`.";
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        // The parser keeps them back to front; an unknown option comes before its value.
        const auto extras = app.remaining(true);
        for (const std::string& extra : extras)
            if (extra.starts_with('-'))
                return "There is no option " + extra + did_you_mean(place, extra) + help;
        const std::string extra = extras.empty() ? "" : extras.front();
        const std::string what = &place == &app ? "There is no command '" : "There is no use for '";
        return what + extra + "'" + did_you_mean(place, extra) + help;
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
        const std::string what = error.what();
        const std::string option = what.substr(0, what.find(':'));
        if (what.find("At Most 1") != what.npos)
            return option + " is given more than once, but it must be given once." + help;
        return option + " needs a value after it." + help;
    }
    if (dynamic_cast<const CLI::ConversionError*>(&error)) {
        // "Could not convert: --fps = 59.94"
        const std::string what = error.what();
        const std::size_t colon = what.find(": "), equals = what.find(" = ");
        if (colon < equals && equals != what.npos) {
            const std::string value = what.substr(equals + 3);
            return what.substr(colon + 2, equals - colon - 2) + " is '" + value +
                   "', but it must be a " +
                   (swirl::read_number(value) ? "whole number." : "number.") + help;
        }
    }
    return std::string(error.what()) + "." + help;
}

int main_or_throw(int argc, char** argv) {
    CLI::App app(
        "A laboratory for swirled granular matter: exact event-driven simulation of discs\n"
        "in a swirled dish, after Lee et al., Phys. Rev. E 100, 012903 (2019).",
        "swirl");
    app.set_version_flag("--version", swirl::version());
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(34);
    for (const swirl::Command* command : swirl::Command::all()) command->add_to(app);
    swirl::set_examples(
        app, {"swirl run --discs 48", "swirl paper --figure 5b --quick", "swirl run --help"});
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return complain(in_words(app, error).c_str(), 2);
    }
    if (app.get_subcommands().empty()) {
        std::fputs(app.help().c_str(), stderr);
        return 2;
    }
    return 0;
}

/// A program may be called with its standard input, output or errors closed. The next file it
/// opened would get that number, and be written into by whoever complains.
void open_closed_standard_files() {
    for (int number = 0; number <= 2; ++number)
        if (fcntl(number, F_GETFD) < 0) (void)open("/dev/null", O_RDWR);
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
