// An error about a file. The message names the file and the problem, with a hint if one helps. The
// program prints it after "error: " and exits with code 1.
#pragma once

#include <stdexcept>
#include <string>

#include "swirl/io/short_values.hpp"

namespace swirl {

struct FileError : std::runtime_error {
    explicit FileError(const std::string& message)
        : std::runtime_error(with_short_values(message)) {}
};

/// The content of a file is not what its writer wrote: the file was cut off, or changed since.
struct DamagedFile : FileError {
    using FileError::FileError;
};

/// A file that another process writes has changed while it was read. Opened again, it is readable.
struct FileChanged : FileError {
    using FileError::FileError;
};

}  // namespace swirl
