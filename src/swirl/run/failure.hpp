// What went wrong, as one full sentence for the person at the keyboard: what, which value, what
// would be right. The front end prints it and ends the program with the code.
#pragma once

#include <stdexcept>
#include <string>

namespace swirl {

/// The call itself was wrong: exit code 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The call was right, but it could not be done: exit code 1.
class Failure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The work was stopped by a signal before its end: exit code 130.
class Interrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// What reads parameters and places discs throws by these, so that it can be compiled for a page in
// a browser, where there are no exceptions and the sentence goes to the page instead
// (bindings/wasm).
[[noreturn]] void throw_wrong_call(const std::string& sentence);
[[noreturn]] void throw_interrupted(const std::string& sentence);

}  // namespace swirl
