// HDF5's virtual file driver on top of StagedFile.
#pragma once

#include <hdf5.h>

#include <string>

#include "swirl/io/journaled_file.hpp"

namespace swirl {

/// For H5Pset_driver.
hid_t journaled_driver();

/// What the library opens by this driver while it lives, under the lock: this file and no other, so
/// a link or a virtual dataset that leads to another file leads nowhere. `failure` becomes the
/// sentence of the first failure of the file.
class OpensOnly {
  public:
    OpensOnly(JournaledFile& file, std::string& failure);
    ~OpensOnly();
    OpensOnly(const OpensOnly&) = delete;
    OpensOnly& operator=(const OpensOnly&) = delete;
};

}  // namespace swirl
