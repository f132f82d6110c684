// An error about a file. The message names the file and the problem, with a hint if one helps. The
// program prints it after "error: " and exits with code 1.
#pragma once

#include <stdexcept>

namespace swirl {

struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace swirl
