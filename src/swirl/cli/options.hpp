// A subcommand as data: its options, its help and its action. Only parser.cpp depends on the
// library that parses arguments.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace swirl {

/// The variable that receives the value of an option. A bool is a flag without value.
using OptionTarget =
    std::variant<bool*, std::string*, std::int64_t*, int*, double*, std::optional<int>*,
                 std::optional<std::int64_t>*, std::optional<double>*, std::vector<std::string>*,
                 std::function<void(const std::string&)>>;

struct Option {
    std::string name;  // "--json"; without hyphens: a positional argument
    OptionTarget target;
    std::string description;
    std::string value_form = {};  // the value in the help: "FILE"
    bool is_required = false;
    /// Not 0: the option may be repeated, and its values are joined by this character.
    char joined_by = '\0';
    /// Values that completions offer, if the form does not list them ("disc|sphere").
    std::vector<std::string> values = {};
    std::string help_group = {};  // set by Group::add()
    bool is_of_run = false;  // a parameter as `swirl run` has it: `swirl help run` describes it
    bool is_given = false;   // set by parse()
};
inline constexpr bool required = true;

/// The form of an option with these values: "light|dark".
std::string one_of(const std::vector<std::string>& values);
/// The words that are values of the option: those in lower case of "NUMBER|paper|ring", or its
/// `values`.
std::vector<std::string> values_of(const Option& option);

class Subcommand {
  public:
    /// subcommand.in("Output").add({{"--json", &json, "File for all results", "FILE"}}): options in
    /// a group of the help. With a vector as target, an option may be repeated.
    struct Group {
        std::deque<Option>& all;
        std::string name;
        void add(std::vector<Option> options) {
            for (Option& option : options) add_one(std::move(option));
        }
        void add_one(Option option) {
            option.help_group = name;
            all.push_back(std::move(option));
        }
    };
    Group in(std::string group) { return {options_, std::move(group)}; }
    void add(std::vector<Option> options) { in("").add(std::move(options)); }

    /// -h and --help list the main options and the groups of all, each a page of its own:
    /// `swirl help NAME GROUP`.
    void divide_help() { is_divided_ = true; }
    bool has_divided_help() const { return is_divided_; }
    /// --help refers to `swirl help run` for options that are `is_of_run`. Parameters in `missing`
    /// are no options of this command.
    void refer_to_run(std::vector<std::string> missing) { missing_of_run_ = std::move(missing); }
    const std::vector<std::string>& missing_of_run() const { return missing_of_run_; }

    /// The options in the short help (-h), by name: about ten. Without a call, all are.
    void set_main_options(std::vector<std::string> names) { main_options_ = std::move(names); }
    bool is_main(const Option& option) const;
    /// Complete commands, shown at the end of the help.
    void set_examples(const std::vector<std::string>& examples);
    /// A text in the help before the examples; a function makes it when it is shown.
    void explain(std::string text) {
        explanation_ = [text = std::move(text)] { return text; };
    }
    void explain(std::function<std::string()> text) {
        explanation_ = std::move(text);
        explanation_is_made_ = true;
    }
    /// Throws UsageError for a wrong call that the parser cannot recognise. ./swirl calls it before
    /// it installs packages for the action.
    void check(std::function<void()> test) { check_ = std::move(test); }
    /// The action, called after all options are set. It reports errors by exceptions
    /// (run/failure.hpp).
    void callback(std::function<void()> action) { action_ = std::move(action); }

    const std::deque<Option>& options() const { return options_; }
    std::deque<Option>& options() { return options_; }
    /// A text with a line break at its end, or nothing.
    std::string explanation() const { return explanation_ ? explanation_() + "\n" : ""; }
    /// Whether the explanation is made when it is shown, so that it belongs to the installation.
    bool explanation_is_made() const { return explanation_is_made_; }
    const std::string& examples() const { return examples_; }
    void check() const {
        if (check_) check_();
    }
    void act() const { action_(); }

  private:
    std::deque<Option> options_;
    std::vector<std::string> main_options_, missing_of_run_;
    bool is_divided_ = false;
    std::function<std::string()> explanation_;
    bool explanation_is_made_ = false;
    std::string examples_;
    std::function<void()> check_, action_;
};

/// The value of an option, from `minimum` to `maximum`, or the default. Throws UsageError.
std::int64_t whole_number(const char* name, const std::string& text, std::int64_t default_value,
                          std::int64_t maximum, std::int64_t minimum = 1);

}  // namespace swirl
