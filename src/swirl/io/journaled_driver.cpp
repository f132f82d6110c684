#include "swirl/io/journaled_driver.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace swirl {
namespace {

struct JournaledDriver {
    H5FD_t common;  // first member: the library handles pointers to it
    JournaledFile* file;
    haddr_t end_of_allocation;
    std::string* failure;  // message of the first error
};

JournaledDriver& driver_of(H5FD_t* file) { return *reinterpret_cast<JournaledDriver*>(file); }
const JournaledDriver& driver_of(const H5FD_t* file) {
    return *reinterpret_cast<const JournaledDriver*>(file);
}

/// Exceptions must not pass through C code, so they become an error code.
herr_t guarded(JournaledDriver& driver, auto&& action) {
    try {
        action();
        return 0;
    } catch (const std::exception& error) {
        if (driver.failure->empty()) *driver.failure = error.what();
        return -1;
    }
}

/// The file that the driver opens next; see OpenedByDriver.
JournaledFile* file_to_open = nullptr;
std::string* failure_of_file = nullptr;

const H5FD_class_t& driver_class() {
    static const H5FD_class_t driver = [] {
        H5FD_class_t c;
        std::memset(&c, 0, sizeof c);
#ifdef H5FD_CLASS_VERSION
        // HDF5 1.14 registers a driver only with the right version. Values up to 255 belong to the
        // library's own drivers.
        c.version = H5FD_CLASS_VERSION;
        c.value = H5FD_class_value_t(511);
#endif
        // There are no functions `lock` and `unlock`, so the library takes no lock of its own,
        // whatever HDF5_USE_FILE_LOCKING says: JournaledFile holds the lock on the file.
        c.name = "swirl_journaled";
        c.maxaddr = haddr_t(1) << 62;
        c.fc_degree = H5F_CLOSE_STRONG;
        c.open = [](const char*, unsigned, hid_t, haddr_t) -> H5FD_t* {
            if (file_to_open == nullptr) return nullptr;
            auto* d = static_cast<JournaledDriver*>(std::calloc(1, sizeof(JournaledDriver)));
            if (d == nullptr) return nullptr;
            d->file = file_to_open;
            d->failure = failure_of_file;
            return &d->common;
        };
        c.close = [](H5FD_t* file) -> herr_t {
            std::free(&driver_of(file));
            return 0;
        };
        c.cmp = [](const H5FD_t* a, const H5FD_t* b) {
            const auto *x = driver_of(a).file, *y = driver_of(b).file;
            return x < y ? -1 : x > y ? 1 : 0;
        };
        c.query = [](const H5FD_t*, unsigned long* flags) -> herr_t {
            *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA |
                     H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
            return 0;
        };
        c.get_eoa = [](const H5FD_t* file, H5FD_mem_t) {
            return driver_of(file).end_of_allocation;
        };
        c.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t end) -> herr_t {
            driver_of(file).end_of_allocation = end;
            return 0;
        };
        c.get_eof = [](const H5FD_t* file, H5FD_mem_t) -> haddr_t {
            return driver_of(file).file->size();
        };
        c.read = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* to) -> herr_t {
            return guarded(driver_of(file), [&] { driver_of(file).file->read(at, to, size); });
        };
        c.write = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size,
                     const void* from) -> herr_t {
            return guarded(driver_of(file), [&] { driver_of(file).file->write(at, from, size); });
        };
        c.truncate = [](H5FD_t* file, hid_t, hbool_t) -> herr_t {
            driver_of(file).file->resize(driver_of(file).end_of_allocation);
            return 0;
        };
        const H5FD_mem_t map[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
        std::copy(std::begin(map), std::end(map), std::begin(c.fl_map));
        return c;
    }();
    return driver;
}

}  // namespace

hid_t journaled_driver() {
    static const hid_t id = H5FDregister(&driver_class());
    return id;
}

OpenedByDriver::OpenedByDriver(JournaledFile& file, std::string& failure) {
    file_to_open = &file;
    failure_of_file = &failure;
}
OpenedByDriver::~OpenedByDriver() {
    file_to_open = nullptr;
    failure_of_file = nullptr;
}

}  // namespace swirl
