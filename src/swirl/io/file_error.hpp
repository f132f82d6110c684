// What goes wrong with files, as one sentence for the person at the keyboard: which file, what was
// wrong with it, what would be right. The front door prints it and leaves with exit code 1.
#pragma once

#include <stdexcept>

namespace swirl {

struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace swirl
