#include "swirl/io/hdf5.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <utility>

#include "swirl/io/file_error.hpp"
#include "swirl/io/journaled_driver.hpp"
#include "swirl/math/real.hpp"

namespace swirl {
namespace {

std::recursive_mutex& library_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}
/// Exclusive use of the library. Each thread also has to switch off the library's own printing of
/// errors, since they are reported as FileError.
class Locked {
  public:
    Locked() : guard_(library_mutex()) {
        thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        (void)silenced;
    }

  private:
    const std::lock_guard<std::recursive_mutex> guard_;
};

// Every file is closed where it is used. If a full disk prevents that, the library must not try
// again at exit: it can crash on the state that the failed attempt left.
[[maybe_unused]] const herr_t no_second_try_at_exit = H5dont_atexit();

// --- handles -------------------------------------------------------------------------------------

class Handle {
  public:
    Handle(hid_t id, herr_t (*close_function)(hid_t)) : id_(id), close_(close_function) {}
    ~Handle() { close(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    operator hid_t() const { return id_; }
    herr_t close() { return id_ >= 0 ? close_(std::exchange(id_, -1)) : 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// The innermost description on the library's error stack.
std::string library_reason() {
    std::string reason;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
            if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
            return 0;
        },
        &reason);
    return reason.empty() ? "the HDF5 library gave no reason" : reason;
}

template <class T>
hid_t memory_type() {
    if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
    if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
    if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
    return H5T_NATIVE_UINT8;
}
/// Little-endian on every machine.
template <class T>
hid_t disk_type() {
    if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
    if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
    if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_STD_U32LE;
    return H5T_STD_U8LE;
}

Handle text_type(std::size_t length) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(length, 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}
/// A fixed-length text cannot be empty: it is stored as one zero byte.
std::string padded(const std::string& text) { return text.empty() ? std::string(1, '\0') : text; }

bool is_fixed_text(hid_t type) {
    return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
}

/// Creation properties of a dataset. Without time stamps, two runs with the same data write the
/// same bytes.
Handle dataset_properties() {
    Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    return properties;
}

Handle simple_space(const Dimensions& shape) {
    const std::vector<hsize_t> size(shape.begin(), shape.end());
    return {H5Screate_simple(int(size.size()), size.data(), nullptr), H5Sclose};
}

Dimensions with_rows(std::uint64_t rows, const Dimensions& row_shape) {
    Dimensions shape{rows};
    shape.insert(shape.end(), row_shape.begin(), row_shape.end());
    return shape;
}

std::uint64_t product(const Dimensions& shape) {
    std::uint64_t n = 1;
    for (const std::uint64_t d : shape) n *= d;
    return n;
}

}  // namespace

struct Hdf5File::State {
    std::string path;
    JournaledFile journaled;
    std::string failure;  // the first error
    hid_t id = -1;

    const bool is_new;  // created by this object: its content is trusted

    State(const std::filesystem::path& p, JournaledFile::Mode mode)
        : path(p.string()), journaled(p, mode), is_new(mode == JournaledFile::Mode::create) {}

    static void leak(const std::shared_ptr<State>& state) { new std::shared_ptr<State>(state); }
    std::string sentence(std::string_view action) const {
        return fmt::format("'{}': {} failed ({}).", path, action, library_reason());
    }
    [[noreturn]] void fail(std::string_view action) {
        reject_overtaken();
        if (failure.empty()) failure = sentence(action);
        journaled.abandon();
        throw FileError(failure);
    }
    /// The library caches where objects were when the file was opened, so a file that has grown
    /// since cannot be read on.
    void reject_overtaken() const {
        if (journaled.is_overtaken())
            throw FileChanged(
                fmt::format("'{}' is still being recorded and has changed while it was read.\n"
                            "hint: read it when that run has ended or has been interrupted.",
                            path));
    }
    /// Throws if `result` reports an error, or if an earlier error was recorded that the library
    /// did not pass on.
    hid_t check(hid_t result, std::string_view action) {
        if (result < 0 || !failure.empty()) fail(action);
        return result;
    }
    /// For destructors, which cannot throw: the next check() does.
    void note(herr_t result, std::string_view action) {
        if (result < 0 && failure.empty()) failure = sentence(action);
    }
    /// Rejects a declared size that the file cannot hold, before memory is allocated for it.
    /// Deflate compresses by at most a factor of about 1000, so `max_ratio` is 2048; it is 1 for
    /// uncompressed data.
    void require_plausible_size(const std::string& name, double bytes,
                                double max_ratio = 2048.0) const {
        if (bytes > max_ratio * double(journaled.size()))
            throw FileError(fmt::format(
                "'{}' is damaged: {} declares more data than the file can hold.", path, name));
    }
    /// Rejects a dataset whose storage contradicts its shape. For contiguous and compact storage
    /// the library copies as many bytes as the shape says, without a bounds check. For chunked
    /// storage, whose chunks may be missing, it allocates a whole chunk first.
    void require_consistent_storage(hid_t set, const std::string& name) const {
        if (is_new) return;
        const Handle properties(H5Dget_create_plist(set), H5Pclose);
        const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
        const auto value_size = double(H5Tget_size(type));
        const H5D_layout_t layout = H5Pget_layout(properties);
        if (layout == H5D_CHUNKED) {
            hsize_t chunk[H5S_MAX_RANK];
            const int rank = H5Pget_chunk(properties, H5S_MAX_RANK, chunk);
            double chunk_size = rank == H5Sget_simple_extent_ndims(space) ? value_size : never;
            for (int d = 0; d < rank; ++d) chunk_size *= double(chunk[d]);
            return require_plausible_size(name, chunk_size);
        }
        const double bytes = value_size * double(H5Sget_simple_extent_npoints(space));
        const haddr_t begin = layout == H5D_CONTIGUOUS ? H5Dget_offset(set) : 0;
        const bool is_in_file = layout == H5D_COMPACT || bytes == 0.0 ||
                                (layout == H5D_CONTIGUOUS && begin != HADDR_UNDEF &&
                                 double(begin) + bytes <= double(journaled.size()));
        if (!is_in_file || double(H5Dget_storage_size(set)) != bytes)
            throw FileError(fmt::format(
                "'{}' is damaged: the storage of {} does not match its shape.", path, name));
    }
    void commit() {
        try {
            journaled.commit();
        } catch (const FileError& error) {
            if (failure.empty()) failure = error.what();
            fail("writing");
        }
    }
    Handle object(const std::string& name) {
        return {check(H5Oopen(id, name.c_str(), H5P_DEFAULT), "opening " + name), H5Oclose};
    }
    hid_t create_dataset(const std::string& name, hid_t type, hid_t space, hid_t properties) {
        return check(
            H5Dcreate2(id, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
            "creating " + name);
    }
    void write_dataset(const std::string& name, hid_t type_on_disk, hid_t type_in_memory,
                       hid_t space, const void* values) {
        Handle set(create_dataset(name, type_on_disk, space, dataset_properties()), H5Dclose);
        check(H5Dwrite(set, type_in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
              "writing " + name);
        check(set.close(), "closing " + name);
    }
    void write_attribute(const std::string& owner, const std::string& name, hid_t type, hid_t space,
                         const void* value) {
        const Handle target = object(owner);
        if (check(H5Aexists(target, name.c_str()), "finding attribute " + name) > 0)
            check(H5Adelete(target, name.c_str()), "replacing attribute " + name);
        Handle attribute(H5Acreate2(target, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
        check(attribute, "creating attribute " + name);
        check(H5Awrite(attribute, type, value), "writing attribute " + name);
        check(attribute.close(), "closing attribute " + name);
    }
};

struct Column::Handle {
    std::shared_ptr<Hdf5File::State> file;
    hid_t id;
    Handle(std::shared_ptr<Hdf5File::State> f, hid_t i) : file(std::move(f)), id(i) {}
    ~Handle() {
        const Locked lock;
        // Closing the file has closed its datasets; the library may have given their id to another
        // object since.
        if (file->id >= 0) file->note(H5Dclose(id), "closing a column");
    }
};

Column::Column(std::shared_ptr<Handle> handle, std::string name)
    : handle_(std::move(handle)), name_(std::move(name)) {
    const ::swirl::Handle space(H5Dget_space(handle_->id), H5Sclose);
    std::vector<hsize_t> extent(
        static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    if (extent.empty()) return;
    rows_ = extent.front();
    row_shape_.assign(extent.begin() + 1, extent.end());
    const ::swirl::Handle properties(H5Dget_create_plist(handle_->id), H5Pclose);
    if (H5Pget_layout(properties) != H5D_CHUNKED) return;
    H5Pget_chunk(properties, int(extent.size()), extent.data());
    chunk_shape_.assign(extent.begin(), extent.end());
    handle_->file->check(0, "opening " + name_);
}

/// Some rows of a column, or one entry of the last dimension of each row: the selection in the
/// file, and the shape of the values in memory.
struct Column::Selection {
    ::swirl::Handle in_file, in_memory;

    Selection(const Column& column, std::uint64_t first, std::uint64_t count,
              std::optional<std::uint64_t> component)
        : in_file(H5Dget_space(column.handle_->id), H5Sclose), in_memory(-1, H5Sclose) {
        Dimensions shape = with_rows(count, column.row_shape_);
        std::vector<hsize_t> begin(shape.size(), 0);
        begin.front() = first;
        if (component) {
            begin.back() = *component;
            shape.back() = 1;
        }
        const std::vector<hsize_t> size(shape.begin(), shape.end());
        H5Sselect_hyperslab(in_file, H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr);
        in_memory = simple_space(shape);
    }
};

void Column::resize(std::uint64_t rows) {
    const Locked lock;
    const Dimensions shape = with_rows(rows, row_shape_);
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    handle_->file->check(H5Dset_extent(handle_->id, extent.data()), "resizing " + name_);
    rows_ = rows;
}

template <ColumnValue T>
void Column::append(const T* values, std::uint64_t count) {
    if (count == 0) return;
    const std::uint64_t first = rows_;
    resize(first + count);
    write(first, count, values);
}

template <ColumnValue T>
void Column::write(std::uint64_t first, std::uint64_t count, const T* values,
                   std::optional<std::uint64_t> component) {
    const Locked lock;
    const Selection rows(*this, first, count, component);
    handle_->file->check(
        H5Dwrite(handle_->id, memory_type<T>(), rows.in_memory, rows.in_file, H5P_DEFAULT, values),
        "writing " + name_);
}

template <ColumnValue T>
std::vector<T> Column::read(std::uint64_t first, std::uint64_t count) const {
    const Locked lock;
    if (first > rows_ || count > rows_ - first)
        throw FileError(fmt::format("'{}' has {} entries in {}, but entries {} to {} were needed.",
                                    handle_->file->path, rows_, name_, first, first + count));
    double bytes = double(count) * sizeof(T);
    for (const std::uint64_t d : row_shape_) bytes *= double(d);
    handle_->file->require_plausible_size(name_, bytes);
    std::vector<T> values(count * product(row_shape_));
    if (values.empty()) return values;
    const Selection rows(*this, first, count, {});
    handle_->file->check(H5Dread(handle_->id, memory_type<T>(), rows.in_memory, rows.in_file,
                                 H5P_DEFAULT, values.data()),
                         "reading " + name_);
    handle_->file->reject_overtaken();
    return values;
}

Hdf5File::Hdf5File(const std::filesystem::path& path, JournaledFile::Mode mode) {
    const Locked lock;
    const hid_t driver = journaled_driver();
    state_ = std::make_shared<State>(path, mode);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // With the library's default driver instead, a file would have no journal.
    if (driver < 0 || H5Pset_driver(access, driver, nullptr) < 0)
        throw FileError(
            fmt::format("'{}' could not be opened: this HDF5 library ({}) has no place "
                        "for another file driver.",
                        path.string(), library_reason()));
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    const OpenedByDriver opened(state_->journaled, state_->failure);
    if (mode == JournaledFile::Mode::create) {
        state_->id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
        state_->check(state_->id, "creating the file");
        return;
    }
    const unsigned flags = mode == JournaledFile::Mode::change ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
    state_->id = H5Fopen(path.c_str(), flags, access);
    if (state_->id >= 0) return;
    state_->reject_overtaken();
    if (!state_->failure.empty()) throw FileError(state_->failure);
    throw DamagedFile(fmt::format("'{}' is not an HDF5 file, or is damaged ({}).", path.string(),
                                  library_reason()));
}

Hdf5File::~Hdf5File() {
    if (state_ == nullptr || state_->id < 0) return;
    const Locked lock;
    state_->journaled.abandon();
    // If the library fails to close the file, it still refers to the state: keep that alive.
    if (H5Fclose(std::exchange(state_->id, -1)) < 0) state_->leak(state_);
}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}

void Hdf5File::flush() {
    const Locked lock;
    state_->check(H5Fflush(state_->id, H5F_SCOPE_GLOBAL), "writing");
    state_->commit();
}

void Hdf5File::finish(const std::filesystem::path& final_name) {
    const Locked lock;
    // Flush first: the library reports errors of a flush, but not all errors of a close.
    flush();
    const herr_t closed = H5Fclose(std::exchange(state_->id, -1));
    if (closed < 0) state_->leak(state_);  // see the destructor
    state_->check(closed, "closing");
    // Closing may have truncated the file.
    state_->commit();
    state_->journaled.publish(final_name);
}

void Hdf5File::create_group(const std::string& name) {
    const Locked lock;
    const Handle group(H5Gcreate2(state_->id, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    state_->check(group, "creating group " + name);
}

bool Hdf5File::has(const std::string& name) const {
    const Locked lock;
    // H5Lexists() fails if a parent is missing, so each part of the path is tested.
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
        const std::string part = name.substr(0, end);
        if (state_->check(H5Lexists(state_->id, part.c_str(), H5P_DEFAULT), "finding " + part) == 0)
            return false;
        if (end == std::string::npos) return true;
    }
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
    const Locked lock;
    const Handle target = state_->object(group);
    std::vector<std::string> names;
    const herr_t listed = H5Literate(
        target, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
            static_cast<std::vector<std::string>*>(out)->emplace_back(name);
            return 0;
        },
        &names);
    state_->check(listed, "listing " + group);
    return names;
}

template <ColumnValue T>
Column Hdf5File::create_column(const std::string& name, const Dimensions& row_shape,
                               const Dimensions& chunk_shape, int compression) {
    const Locked lock;
    const Dimensions shape = with_rows(0, row_shape);
    const std::vector<hsize_t> size(shape.begin(), shape.end());
    std::vector<hsize_t> limit = size, chunk = size;
    limit.front() = H5S_UNLIMITED;
    std::copy(chunk_shape.begin(), chunk_shape.end(), chunk.begin());
    const Handle space(H5Screate_simple(int(size.size()), size.data(), limit.data()), H5Sclose);
    const Handle properties = dataset_properties();
    H5Pset_chunk(properties, int(chunk.size()), chunk.data());
    if (compression > 0) {
        H5Pset_shuffle(properties);
        H5Pset_deflate(properties, unsigned(compression));
    }
    const hid_t id = state_->create_dataset(name, disk_type<T>(), space, properties);
    return {std::make_shared<Column::Handle>(state_, id), name};
}

template <ColumnValue T>
void Hdf5File::write(const std::string& name, const std::vector<T>& values,
                     const Dimensions& shape) {
    const Locked lock;
    state_->write_dataset(name, disk_type<T>(), memory_type<T>(), simple_space(shape),
                          values.data());
}

void Hdf5File::write(const std::string& name, const std::string& text) {
    const Locked lock;
    const Handle type = text_type(text.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
    state_->write_dataset(name, type, type, space, padded(text).data());
}

Column Hdf5File::column(const std::string& name) const {
    const Locked lock;
    if (!has(name)) throw FileError(fmt::format("'{}' has no {}.", state_->path, name));
    const hid_t id = H5Dopen2(state_->id, name.c_str(), H5P_DEFAULT);
    if (id < 0)
        throw FileError(fmt::format("'{}': {} cannot be read as a dataset.", state_->path, name));
    const auto handle = std::make_shared<Column::Handle>(state_, id);
    state_->require_consistent_storage(id, name);
    return {handle, name};
}

std::string Hdf5File::read_text(const std::string& name) const {
    const Locked lock;
    if (!has(name)) throw FileError(fmt::format("'{}' has no {}.", state_->path, name));
    const Handle set(H5Dopen2(state_->id, name.c_str(), H5P_DEFAULT), H5Dclose);
    state_->check(set, "opening " + name);
    const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    if (!is_fixed_text(type) || H5Sget_simple_extent_npoints(space) != 1)
        throw FileError(
            fmt::format("'{}': {} is not a single text of fixed length.", state_->path, name));
    state_->require_consistent_storage(set, name);
    std::string text(H5Tget_size(type), '\0');
    state_->check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
                  "reading " + name);
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

void Hdf5File::link(const std::string& existing, const std::string& name) {
    const Locked lock;
    state_->check(H5Lcreate_hard(state_->id, existing.c_str(), state_->id, name.c_str(),
                                 H5P_DEFAULT, H5P_DEFAULT),
                  "linking " + name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& text) {
    const Locked lock;
    const Handle type = text_type(text.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
    state_->write_attribute(object, name, type, space, padded(text).data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::string>& texts) {
    const Locked lock;
    std::size_t width = 1;
    for (const std::string& text : texts) width = std::max(width, text.size());
    std::string bytes;
    for (const std::string& text : texts) bytes += text + std::string(width - text.size(), '\0');
    state_->write_attribute(object, name, text_type(width), simple_space({texts.size()}),
                            bytes.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
    const Locked lock;
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    state_->write_attribute(object, name, H5T_NATIVE_DOUBLE, space, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::int64_t>& values) {
    const Locked lock;
    const Handle space = values.size() == 1 ? Handle(H5Screate(H5S_SCALAR), H5Sclose)
                                            : simple_space({values.size()});
    state_->write_attribute(object, name, H5T_NATIVE_INT64, space, values.data());
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
    const Locked lock;
    return has(object) &&
           state_->check(H5Aexists_by_name(state_->id, object.c_str(), name.c_str(), H5P_DEFAULT),
                         "finding attribute " + name) > 0;
}

/// Opens an attribute and calls `read(id, count)`. `read` returns false if the attribute is not
/// what `expected` describes.
template <class Read>
void Hdf5File::read_attribute(const std::string& object, const std::string& name,
                              const char* expected, Read&& read) const {
    const Locked lock;
    if (!has_attribute(object, name))
        throw FileError(fmt::format("'{}' has no attribute {} at {}.", state_->path, name, object));
    const Handle id(
        H5Aopen_by_name(state_->id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    const Handle type(H5Aget_type(id), H5Tclose), space(H5Aget_space(id), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    state_->require_plausible_size("attribute " + name, double(count) * double(H5Tget_size(type)),
                                   1.0);
    if (!read(id, count))
        throw FileError(fmt::format("'{}': attribute {} at {} is not {}.", state_->path, name,
                                    object, expected));
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
    double value = 0.0;
    read_attribute(object, name, "a number", [&](hid_t id, hssize_t count) {
        return count == 1 && H5Aread(id, H5T_NATIVE_DOUBLE, &value) >= 0;
    });
    return value;
}

std::vector<std::int64_t> Hdf5File::integers_attribute(const std::string& object,
                                                       const std::string& name) const {
    std::vector<std::int64_t> values;
    read_attribute(object, name, "a list of integers", [&](hid_t id, hssize_t count) {
        values.assign(count > 0 ? std::size_t(count) : 0, 0);
        return !values.empty() && H5Aread(id, H5T_NATIVE_INT64, values.data()) >= 0;
    });
    return values;
}

void Hdf5File::make_scale(const std::string& dataset, const std::string& name) {
    const Locked lock;
    const Handle set = state_->object(dataset);
    state_->check(H5DSset_scale(set, name.c_str()), "naming the dimension " + name);
}

void Hdf5File::attach_scales(const std::string& dataset, const std::vector<std::string>& scales) {
    const Locked lock;
    const Handle set = state_->object(dataset);
    for (unsigned k = 0; k < scales.size(); ++k) {
        const Handle scale = state_->object(scales[k]);
        state_->check(H5DSattach_scale(set, scale, k), "attaching the dimension " + scales[k]);
    }
}

#define SWIRL_INSTANTIATE_FOR(T)                                                      \
    template void Column::append<T>(const T*, std::uint64_t);                         \
    template void Column::write<T>(std::uint64_t, std::uint64_t, const T*,            \
                                   std::optional<std::uint64_t>);                     \
    template std::vector<T> Column::read<T>(std::uint64_t, std::uint64_t) const;      \
    template Column Hdf5File::create_column<T>(const std::string&, const Dimensions&, \
                                               const Dimensions&, int);               \
    template void Hdf5File::write<T>(const std::string&, const std::vector<T>&, const Dimensions&)

SWIRL_INSTANTIATE_FOR(double);
SWIRL_INSTANTIATE_FOR(std::int64_t);
SWIRL_INSTANTIATE_FOR(std::uint32_t);
SWIRL_INSTANTIATE_FOR(std::uint8_t);

}  // namespace swirl
