// Errors of a command. The message says what is wrong and quotes the value; a hint may follow on a
// second line. The program prints it after "error: " and exits with the code of the class.
#pragma once

#include <stdexcept>
#include <string>

#include "swirl/io/short_values.hpp"
#include "swirl/run/message.hpp"

namespace swirl {

/// The call is not valid: exit code 2.
class UsageError : public std::runtime_error {
  public:
    explicit UsageError(const std::string& message)
        : std::runtime_error(with_short_values(message)) {}
};

/// The call is valid, but it failed: exit code 1.
class Failure : public std::runtime_error {
  public:
    explicit Failure(const std::string& message) : std::runtime_error(with_short_values(message)) {}
};

/// A signal stopped the work before its end: exit code 130.
class Interrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Code that is also compiled for the browser, where there are no exceptions, throws by these
// functions. There they pass the message to the page instead (bindings/wasm).
[[noreturn]] void throw_usage_error(const Message& message);
[[noreturn]] void throw_interrupted(const std::string& sentence);

// For code that is not part of the page. The page has no such functions, so a sentence without a
// code cannot get into it.
[[noreturn]] void throw_usage_error(const std::string& sentence);
Message without_code(const std::string& sentence);

}  // namespace swirl
