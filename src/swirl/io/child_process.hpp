// Programs that run as child processes. Each has its own process group: Ctrl-C reaches only this
// program, which then ends the child.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace swirl {

/// The files of a child, as descriptors; −1 is /dev/null. A file `third` becomes its descriptor 3.
struct ChildFiles {
    int input = -1, output = -1, errors = -1;
    std::string third = {};
};

/// Starts a program with its arguments. PATH is searched if its name has no slash. Signals have
/// their default handling, and none is blocked. Returns 0, or the error as in errno.
int start_child(std::vector<std::string> words, const ChildFiles& files, int& process);
/// Waits for the end of a child and returns its status as waitpid() does.
int wait_for_child(int process);

/// `text` is from the standard output and the standard error. If the program was not started,
/// `error` gives the reason, as errno does. `exit_code` stays −1 also if a signal ended the
/// program.
struct ProgramOutput {
    int error = 0, exit_code = -1;
    std::string text = {};
};
/// Runs a program to its end. If `stop` is set, the program is interrupted, and killed after half a
/// second.
ProgramOutput run_program(const std::vector<std::string>& words,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace swirl
