// Protection against damaged or malicious recordings. Such a file can crash the HDF5 library, which
// was not written for them. So every command that takes a recording first reads all of it in a
// child process, and reports an error if that process crashes.
#pragma once

#include <string>

namespace swirl {

/// Throws Failure if reading the HDF5 file crashes the child process, and Interrupted at a signal.
/// Other errors of the file are left to the caller's own reading. Does nothing if the file is not
/// an HDF5 file. Call it before any thread is started.
void try_reading(const std::string& file);

}  // namespace swirl
