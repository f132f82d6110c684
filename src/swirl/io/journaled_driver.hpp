// An HDF5 virtual file driver on top of JournaledFile.
#pragma once

#include <hdf5.h>

#include <string>

#include "swirl/io/journaled_file.hpp"

namespace swirl {

/// Driver id for H5Pset_driver().
hid_t journaled_driver();

/// While this object lives, under the lock of the library, the driver opens this file and no other.
/// So an external link or a virtual dataset in the file cannot open a second file. `failure`
/// receives the message of the first error.
class OpenedByDriver {
  public:
    OpenedByDriver(JournaledFile& file, std::string& failure);
    ~OpenedByDriver();
    OpenedByDriver(const OpenedByDriver&) = delete;
    OpenedByDriver& operator=(const OpenedByDriver&) = delete;
};

}  // namespace swirl
