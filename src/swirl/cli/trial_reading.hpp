// Recordings of people you do not trust. The HDF5 library is not built for hostile files: a damaged
// one can crash it. So every command that works on a recording first lets a child process read all
// of it, and if that crashes, ends with a sentence.
#pragma once

#include <string>

namespace swirl {

/// Throws Failure if reading the HDF5 file crashes a process, and Interrupted at a signal. Whatever
/// else is wrong with the file is said by whoever reads it next. Does nothing for a file that is no
/// HDF5 file. To be called before there are threads.
void try_reading(const std::string& file);

}  // namespace swirl
