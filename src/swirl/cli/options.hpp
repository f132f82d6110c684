// A subcommand as data: its options, its help and its action. Only parser.cpp depends on the
// library that parses arguments.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
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
    std::string help_group = {};
    bool is_required = false;
    bool is_given = false;  // set by parse()
    /// Not 0: the option may be repeated, and its values are joined by this character.
    char joined_by = '\0';

    Option* type_name(std::string form) {
        value_form = std::move(form);
        return this;
    }
    Option* group(std::string name_of_group) {
        help_group = std::move(name_of_group);
        return this;
    }
    Option* repeatable(char separator) {
        joined_by = separator;
        return this;
    }
    Option* required() {
        is_required = true;
        return this;
    }
};

class Subcommand {
  public:
    /// The returned pointer stays valid. With a vector as target, the option may be repeated.
    template <class Target>
    Option* add_option(std::string name, Target& target, std::string description,
                       std::string form = "", std::string group = "") {
        Option* const option = add(std::move(name), &target, std::move(description));
        return option->type_name(std::move(form))->group(std::move(group));
    }
    Option* add_option_function(std::string name, std::function<void(const std::string&)> take,
                                std::string description) {
        return add(std::move(name), std::move(take), std::move(description));
    }
    Option* add_flag(std::string name, bool& target, std::string description,
                     std::string group = "") {
        return add(std::move(name), &target, std::move(description))->group(std::move(group));
    }

    /// The options in the short help (-h), by name: about ten. Without a call, all are.
    void set_main_options(std::vector<std::string> names) { main_options_ = std::move(names); }
    bool is_main(const Option& option) const;
    /// Complete commands, shown at the end of the help.
    void set_examples(const std::vector<std::string>& examples);
    /// A text in the help before the examples; a function makes it when it is shown.
    void explain(std::string text) {
        explanation_ = [text = std::move(text)] { return text; };
    }
    void explain(std::function<std::string()> text) { explanation_ = std::move(text); }
    /// Throws UsageError for a wrong call that the parser cannot recognise. ./swirl calls it before it
    /// installs packages for the action.
    void check(std::function<void()> test) { check_ = std::move(test); }
    /// The action, called after all options are set. It reports errors by exceptions
    /// (run/failure.hpp).
    void callback(std::function<void()> action) { action_ = std::move(action); }

    const std::deque<Option>& options() const { return options_; }
    std::deque<Option>& options() { return options_; }
    /// The end of the full help.
    std::string footer() const;
    const std::string& examples() const { return examples_; }
    void check() const {
        if (check_) check_();
    }
    void act() const { action_(); }

  private:
    Option* add(std::string name, OptionTarget target, std::string description) {
        options_.push_back({std::move(name), std::move(target), std::move(description)});
        return &options_.back();
    }

    std::deque<Option> options_;
    std::vector<std::string> main_options_;
    std::function<std::string()> explanation_;
    std::string examples_;
    std::function<void()> check_, action_;
};

}  // namespace swirl
