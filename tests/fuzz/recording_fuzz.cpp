// Trajectories, event logs and tracks with wrong content. Datasets and attributes of good files are
// removed, exchanged, shortened, or given other types, shapes and values through the HDF5 library.
// So the library opens the file, and the fuzzer reaches the readers of this program. (Random bytes
// are mostly rejected by the library: hdf5_fuzz.cpp.)
//
// The first byte of the input selects the file. Then follow the edits: a location, a kind of edit,
// and the numbers that it needs.
#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "fuzzed_file.hpp"
#include "read_recording.hpp"

namespace {

using namespace swirl;

class Input {
  public:
    Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    bool empty() const { return at_ == end_; }
    unsigned byte() { return empty() ? 0u : *at_++; }
    double number() {
        constexpr double special[] = {0.0,   -0.0, 1.0,  -1.0, 0.5,       1e308,
                                      -1e18, 1e18, 2e-9, 3e9,  1e-320,    4294967295.0,
                                      5.0,   2.0,  7.0,  -3e9, 281474e99, -1e-9};
        const unsigned which = byte();
        if (which == 255) return std::numeric_limits<double>::quiet_NaN();
        if (which == 254) return std::numeric_limits<double>::infinity();
        if (which < std::size(special)) return special[which];
        return double(which) + double(byte()) / 256.0;
    }
    /// Mostly small, sometimes huge.
    hsize_t length() {
        const unsigned which = byte();
        return which < 250 ? which % 41 : hsize_t(1) << (which - 250) * 9;
    }

  private:
    const std::uint8_t *at_, *end_;
};

struct Location {
    std::string object, attribute;  // attribute is empty for the object itself
};

/// A good file: its bytes, and the locations that can be edited.
struct Good {
    std::vector<unsigned char> bytes;
    std::vector<Location> locations;
};

void add_attributes(hid_t file, const std::string& object, std::vector<Location>& locations) {
    const auto add = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
        auto& [object_name, list] =
            *static_cast<std::pair<std::string, std::vector<Location>*>*>(to);
        list->push_back({object_name, name});
        return 0;
    };
    std::pair<std::string, std::vector<Location>*> to{object, &locations};
    H5Aiterate_by_name(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &to,
                       H5P_DEFAULT);
}

hid_t open_image(const std::vector<unsigned char>& bytes) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, false);
    H5Pset_file_image(access, const_cast<unsigned char*>(bytes.data()), bytes.size());
    const hid_t file = H5Fopen("fuzzed", H5F_ACC_RDWR, access);
    H5Pclose(access);
    if (file < 0) __builtin_trap();  // it must be readable
    return file;
}

std::vector<unsigned char> image_of(hid_t file) {
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    std::vector<unsigned char> bytes(std::size_t(H5Fget_file_image(file, nullptr, 0)));
    H5Fget_file_image(file, bytes.data(), bytes.size());
    return bytes;
}

Good good_file(std::vector<unsigned char> bytes) {
    Good good{std::move(bytes), {}};
    const hid_t file = open_image(good.bytes);
    std::vector<std::string> names;
    H5Lvisit(
        file, H5_INDEX_NAME, H5_ITER_INC,
        [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
            static_cast<std::vector<std::string>*>(to)->push_back(std::string("/") + name);
            return 0;
        },
        &names);
    for (const std::string& name : names) {
        good.locations.push_back({name, ""});
        add_attributes(file, name, good.locations);
    }
    H5Fclose(file);
    return good;
}

hid_t chosen_type(unsigned which) {
    switch (which % 6) {
        case 0:
            return H5Tcopy(H5T_IEEE_F64LE);
        case 1:
            return H5Tcopy(H5T_STD_I64BE);
        case 2:
            return H5Tcopy(H5T_STD_U8LE);
        case 3:
            return H5Tcopy(H5T_IEEE_F32BE);
        default: {
            const hid_t text = H5Tcopy(H5T_C_S1);
            H5Tset_size(text, which % 6 == 4 ? 1 + which / 6 : H5T_VARIABLE);
            return text;
        }
    }
}

hid_t chosen_space(Input& input, bool& large) {
    std::vector<hsize_t> shape(input.byte() % 5);
    double entries = 1.0;
    for (hsize_t& n : shape) entries *= double(n = input.length());
    large = entries > 1e5;
    return shape.empty() ? H5Screate(input.byte() % 8 == 0 ? H5S_NULL : H5S_SCALAR)
                         : H5Screate_simple(int(shape.size()), shape.data(), nullptr);
}

/// Replaces a dataset or attribute by another one.
void replace(hid_t file, const Location& location, Input& input) {
    bool large = false;
    const hid_t type = chosen_type(input.byte()), space = chosen_space(input, large);
    const bool is_text = H5Tget_class(type) == H5T_STRING;
    std::vector<double> values(large || is_text ? 0
                                                : std::size_t(H5Sget_simple_extent_npoints(space)));
    for (double& value : values) value = input.number();
    if (location.attribute.empty()) {
        H5Ldelete(file, location.object.c_str(), H5P_DEFAULT);
        const hid_t set = H5Dcreate2(file, location.object.c_str(), type, space, H5P_DEFAULT,
                                     H5P_DEFAULT, H5P_DEFAULT);
        if (set >= 0 && !values.empty())
            H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        if (set >= 0) H5Dclose(set);
    } else {
        H5Adelete_by_name(file, location.object.c_str(), location.attribute.c_str(), H5P_DEFAULT);
        const hid_t attribute =
            H5Acreate_by_name(file, location.object.c_str(), location.attribute.c_str(), type,
                              space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        if (attribute >= 0 && !values.empty())
            H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
        if (attribute >= 0) H5Aclose(attribute);
    }
    H5Sclose(space);
    H5Tclose(type);
}

/// Changes numbers in a dataset or an attribute.
void change(hid_t file, const Location& location, Input& input) {
    const bool is_set = location.attribute.empty();
    const hid_t id = is_set ? H5Dopen2(file, location.object.c_str(), H5P_DEFAULT)
                            : H5Aopen_by_name(file, location.object.c_str(),
                                              location.attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    if (id < 0) return;
    const hid_t space = is_set ? H5Dget_space(id) : H5Aget_space(id);
    const hid_t type = is_set ? H5Dget_type(id) : H5Aget_type(id);
    const hssize_t entries = H5Sget_simple_extent_npoints(space);
    if (entries > 0 && entries < 100'000 && H5Tget_class(type) != H5T_STRING) {
        std::vector<double> values(static_cast<std::size_t>(entries), 0.0);
        if (is_set)
            H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        else
            H5Aread(id, H5T_NATIVE_DOUBLE, values.data());
        for (unsigned k = 1 + input.byte() % 8; k > 0; --k)
            values[(256u * input.byte() + input.byte()) % values.size()] = input.number();
        if (is_set)
            H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        else
            H5Awrite(id, H5T_NATIVE_DOUBLE, values.data());
    }
    H5Tclose(type);
    H5Sclose(space);
    is_set ? H5Dclose(id) : H5Aclose(id);
}

/// Removes or adds rows.
void resize(hid_t file, const std::string& name, hsize_t rows) {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    if (set < 0) return;
    const hid_t space = H5Dget_space(set);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank > 0) {
        std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
        H5Sget_simple_extent_dims(space, extent.data(), nullptr);
        extent.front() = rows;
        H5Dset_extent(set, extent.data());
    }
    H5Sclose(space);
    H5Dclose(set);
}

void edit(hid_t file, const std::vector<Location>& locations, Input& input) {
    const auto choose = [&] { return locations[input.byte() % locations.size()]; };
    const Location location = choose();
    const char* const name = location.object.c_str();
    switch (input.byte() % 8) {
        case 0:
            if (location.attribute.empty())
                H5Ldelete(file, name, H5P_DEFAULT);
            else
                H5Adelete_by_name(file, name, location.attribute.c_str(), H5P_DEFAULT);
            return;
        case 1:
            return replace(file, location, input);
        case 2:
            return resize(file, location.object, input.length() % 4096);
        case 3: {
            const std::string other = choose().object;
            if (other == location.object) return;
            H5Ldelete(file, name, H5P_DEFAULT);
            H5Lcreate_hard(file, other.c_str(), file, name, H5P_DEFAULT, H5P_DEFAULT);
            return;
        }
        case 4:  // a soft link, perhaps to itself
            H5Ldelete(file, name, H5P_DEFAULT);
            H5Lcreate_soft(choose().object.c_str(), file, name, H5P_DEFAULT, H5P_DEFAULT);
            return;
        case 5:  // a link into another file of this name
            H5Ldelete(file, name, H5P_DEFAULT);
            H5Lcreate_external("fuzzed", choose().object.c_str(), file, name, H5P_DEFAULT,
                               H5P_DEFAULT);
            return;
        default:
            return change(file, location, input);
    }
}

}  // namespace

extern "C" const char* __asan_default_options() { return SWIRL_CHEAPER_ALLOCATIONS; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<Good> good = [] {
        keep_tables_of_library();
        std::vector<Good> files;
        for (const auto& bytes : good_recordings()) files.push_back(good_file(bytes));
        return files;
    }();
    Input input(data, size);
    const std::size_t which = input.byte() % good.size();
    const Good& chosen = good[which];
    const hid_t opened = open_image(chosen.bytes);
    for (int edits = 0; edits < 8 && !input.empty(); ++edits) edit(opened, chosen.locations, input);
    const std::vector<unsigned char> bytes = image_of(opened);
    H5Fclose(opened);
    const FuzzedFile file(bytes.data(), bytes.size());
    read_recording(file.path(), kinds_of_good_recordings[which]);
    return 0;
}
