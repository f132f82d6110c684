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

std::recursive_mutex& library_lock() {
    static std::recursive_mutex lock;
    return lock;
}
/// The library to oneself. It tells failures to whoever asks, and each thread has to ask it not to
/// print them: they are ours to tell.
class Locked {
  public:
    explicit Locked(std::recursive_mutex& lock) : guard_(lock) {
        thread_local const herr_t quiet = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        (void)quiet;
    }

  private:
    const std::lock_guard<std::recursive_mutex> guard_;
};

// Every file is closed where it is used. One that a full disk kept from closing must be left alone:
// trying again at exit, the library may crash over the state it was left in.
[[maybe_unused]] const herr_t no_second_try_at_exit = H5dont_atexit();

// --- handles -------------------------------------------------------------------------------------

class Handle {
  public:
    Handle(hid_t id, herr_t (*how)(hid_t)) : id_(id), close_(how) {}
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

/// The innermost thing the library has to say about its last failure.
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
/// Little-endian on the disk, whatever the machine.
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

std::uint64_t product(const Dimensions& shape) {
    std::uint64_t n = 1;
    for (const std::uint64_t d : shape) n *= d;
    return n;
}

}  // namespace

struct Hdf5File::State {
    std::string path;
    JournaledFile journaled;
    std::string failure;
    hid_t id = -1;

    const bool is_ours;  // nobody else has written into it

    State(const std::filesystem::path& p, JournaledFile::Mode mode)
        : path(p.string()), journaled(p, mode), is_ours(mode == JournaledFile::Mode::create) {}

    static void leak(const std::shared_ptr<State>& state) { new std::shared_ptr<State>(state); }
    std::string sentence(std::string_view what) const {
        return fmt::format("'{}': {} failed ({}).", path, what, library_reason());
    }
    [[noreturn]] void fail(std::string_view what) {
        reject_overtaken();
        if (failure.empty()) failure = sentence(what);
        journaled.abandon();
        throw FileError(failure);
    }
    /// The library knows what was where when the file was opened.
    void reject_overtaken() const {
        if (journaled.is_overtaken())
            throw FileError(
                fmt::format("'{}' is being recorded by a run, which has added to it while it was "
                            "read; it can be read when that run has ended or was interrupted.",
                            path));
    }
    /// A failure that the library did not pass on counts too.
    hid_t check(hid_t result, std::string_view what) {
        if (result < 0 || !failure.empty()) fail(what);
        return result;
    }
    /// For destructors, which cannot throw: the next check() does.
    void note(herr_t result, std::string_view what) {
        if (result < 0 && failure.empty()) failure = sentence(what);
    }
    /// A file that promises more than it can hold lies, and memory for that must not even be asked
    /// for. Deflate makes at best a byte of a thousand; what is not packed is there as it is.
    void reject_more_than_it_holds(const std::string& name, double bytes,
                                   double max_packed = 2048.0) const {
        if (bytes > max_packed * double(journaled.size()))
            throw FileError(fmt::format(
                "'{}' is damaged: its {} is said to hold more than such a small file can.", path,
                name));
    }
    /// A dataset that lies in one piece lies in the file, and is as large as its shape says: the
    /// library copies as much as the shape says from as much as there is. One in chunks may lack
    /// some, but each is made in memory first.
    void reject_false_storage(hid_t set, const std::string& name) const {
        if (is_ours) return;
        const Handle properties(H5Dget_create_plist(set), H5Pclose);
        const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
        const auto value = double(H5Tget_size(type));
        const double bytes = value * double(H5Sget_simple_extent_npoints(space));
        const H5D_layout_t layout = H5Pget_layout(properties);
        if (layout == H5D_CHUNKED) {
            hsize_t chunk[H5S_MAX_RANK];
            const int rank = H5Pget_chunk(properties, H5S_MAX_RANK, chunk);
            double values = rank == H5Sget_simple_extent_ndims(space) ? value : never;
            for (int d = 0; d < rank; ++d) values *= double(chunk[d]);
            return reject_more_than_it_holds(name, values);
        }
        const haddr_t at = layout == H5D_CONTIGUOUS ? H5Dget_offset(set) : 0;
        const bool is_there = layout == H5D_COMPACT || bytes == 0.0 ||
                              (layout == H5D_CONTIGUOUS && at != HADDR_UNDEF &&
                               double(at) + bytes <= double(journaled.size()));
        if (!is_there || double(H5Dget_storage_size(set)) != bytes)
            throw FileError(fmt::format(
                "'{}' is damaged: its {} does not lie in the file as its shape says.", path, name));
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
    void write_attribute(const std::string& owner, const std::string& name, hid_t type, hid_t space,
                         const void* value) {
        const Handle target = object(owner);
        if (check(H5Aexists(target, name.c_str()), "looking for attribute " + name) > 0)
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
        const Locked lock(library_lock());
        // Closing the file closes its datasets; the number may belong to something else by then.
        if (file->id >= 0) file->note(H5Dclose(id), "closing a column");
    }
};

Column::Column(std::shared_ptr<Handle> handle, std::string name)
    : handle_(std::move(handle)), name_(std::move(name)) {
    const ::swirl::Handle space(H5Dget_space(handle_->id), H5Sclose);
    Dimensions shape(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
    std::vector<hsize_t> extent(shape.size());
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    std::copy(extent.begin(), extent.end(), shape.begin());
    if (shape.empty()) return;
    rows_ = shape.front();
    row_shape_.assign(shape.begin() + 1, shape.end());
    const ::swirl::Handle properties(H5Dget_create_plist(handle_->id), H5Pclose);
    if (H5Pget_layout(properties) != H5D_CHUNKED) return;
    H5Pget_chunk(properties, int(extent.size()), extent.data());
    chunk_shape_.assign(extent.begin(), extent.end());
    const int filters = H5Pget_nfilters(properties);
    packing_ = filters > 1 ? Packing::deflate : filters == 1 ? Packing::stream : Packing::none;
    handle_->file->check(0, "opening " + name_);
}

/// Some rows of a column, or one entry of the last dimension of each: in the file and in memory.
struct Column::Selection {
    ::swirl::Handle there, here;

    Selection(const Column& column, std::uint64_t first, std::uint64_t count,
              std::optional<std::uint64_t> component)
        : there(H5Dget_space(column.handle_->id), H5Sclose), here(-1, H5Sclose) {
        std::vector<hsize_t> from(1 + column.row_shape_.size(), 0), size{count};
        from.front() = first;
        size.insert(size.end(), column.row_shape_.begin(), column.row_shape_.end());
        if (component) {
            from.back() = *component;
            size.back() = 1;
        }
        H5Sselect_hyperslab(there, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr);
        here = {H5Screate_simple(int(size.size()), size.data(), nullptr), H5Sclose};
    }
};

void Column::resize(std::uint64_t rows) {
    const Locked lock(library_lock());
    std::vector<hsize_t> extent{rows};
    extent.insert(extent.end(), row_shape_.begin(), row_shape_.end());
    handle_->file->check(H5Dset_extent(handle_->id, extent.data()), "resizing " + name_);
    rows_ = rows;
}

template <ColumnValue T>
void Column::append(const T* values, std::uint64_t count) {
    if (count == 0) return;
    const std::uint64_t first = rows_;
    resize(first + count);
    change(first, count, values);
}

template <ColumnValue T>
void Column::change(std::uint64_t first, std::uint64_t count, const T* values,
                    std::optional<std::uint64_t> component) {
    const Locked lock(library_lock());
    const Selection rows(*this, first, count, component);
    handle_->file->check(
        H5Dwrite(handle_->id, memory_type<T>(), rows.here, rows.there, H5P_DEFAULT, values),
        "writing " + name_);
}

void Column::put_chunk(std::uint64_t first, const void* bytes, std::size_t size, bool raw,
                       std::optional<std::uint64_t> component) {
    const Locked lock(library_lock());
    std::vector<hsize_t> from(1 + row_shape_.size(), 0);
    from.front() = first;
    if (component) from.back() = *component;
    const std::uint32_t filters_left_out = raw && packing_ != Packing::none ? 1 : 0;
    handle_->file->check(
        H5Dwrite_chunk(handle_->id, H5P_DEFAULT, filters_left_out, from.data(), size, bytes),
        "writing " + name_);
}

template <ColumnValue T>
std::vector<T> Column::read(std::uint64_t first, std::uint64_t count) const {
    const Locked lock(library_lock());
    if (first > rows_ || count > rows_ - first)
        throw FileError(fmt::format("'{}' has {} entries in {}, entries {} to {} were asked for.",
                                    handle_->file->path, rows_, name_, first, first + count));
    double bytes = double(count) * sizeof(T);
    for (const std::uint64_t d : row_shape_) bytes *= double(d);
    handle_->file->reject_more_than_it_holds(name_, bytes);
    std::vector<T> values(count * product(row_shape_));
    if (values.empty()) return values;
    const Selection rows(*this, first, count, {});
    handle_->file->check(
        H5Dread(handle_->id, memory_type<T>(), rows.here, rows.there, H5P_DEFAULT, values.data()),
        "reading " + name_);
    handle_->file->reject_overtaken();
    return values;
}

Hdf5File::Hdf5File(const std::filesystem::path& path, JournaledFile::Mode mode) {
    const Locked lock(library_lock());
    const hid_t driver = journaled_driver();
    state_ = std::make_shared<State>(path, mode);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_driver(access, driver, nullptr);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    const OpensOnly opens_only(state_->journaled, state_->failure);
    if (mode == JournaledFile::Mode::create) {
        // Without access times two runs with the same data write the same bytes.
        state_->id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
        state_->check(state_->id, "creating the file");
        return;
    }
    const unsigned how = mode == JournaledFile::Mode::change ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
    state_->id = H5Fopen(path.c_str(), how, access);
    if (state_->id < 0) state_->reject_overtaken();
    if (state_->id < 0)
        throw FileError(fmt::format("'{}' is not an HDF5 file, or is damaged ({}).", path.string(),
                                    library_reason()));
}

Hdf5File::~Hdf5File() {
    if (state_ == nullptr || state_->id < 0) return;
    const Locked lock(library_lock());
    state_->journaled.abandon();
    // If the library cannot let go of the file it will try again at exit; what it then reaches for
    // must still be there.
    if (H5Fclose(std::exchange(state_->id, -1)) < 0) state_->leak(state_);
}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}

void Hdf5File::flush() {
    const Locked lock(library_lock());
    state_->check(H5Fflush(state_->id, H5F_SCOPE_GLOBAL), "writing");
    state_->commit();
}

void Hdf5File::finish(const std::filesystem::path& final_name) {
    const Locked lock(library_lock());
    // All that can fail comes before the closing, while the library can still say so.
    flush();
    const herr_t closed = H5Fclose(std::exchange(state_->id, -1));
    if (closed < 0) state_->leak(state_);  // see the destructor
    state_->check(closed, "closing");
    // Closing may have trimmed the file.
    state_->commit();
    state_->journaled.rename_to(final_name);
}

void Hdf5File::create_group(const std::string& name) {
    const Locked lock(library_lock());
    const Handle group(H5Gcreate2(state_->id, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    state_->check(group, "creating group " + name);
}

bool Hdf5File::has(const std::string& name) const {
    const Locked lock(library_lock());
    // Each part of the path has to be asked for by itself.
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
        const std::string part = name.substr(0, end);
        if (state_->check(H5Lexists(state_->id, part.c_str(), H5P_DEFAULT),
                          "looking for " + part) == 0)
            return false;
        if (end == std::string::npos) return true;
    }
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
    const Locked lock(library_lock());
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
                               const Dimensions& chunk_shape, Packing packing, int level) {
    const Locked lock(library_lock());
    std::vector<hsize_t> size{0}, limit{H5S_UNLIMITED};
    for (auto* shape : {&size, &limit})
        shape->insert(shape->end(), row_shape.begin(), row_shape.end());
    std::vector<hsize_t> chunk(size);
    std::copy(chunk_shape.begin(), chunk_shape.end(), chunk.begin());
    const Handle space(H5Screate_simple(int(size.size()), size.data(), limit.data()), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(properties, int(chunk.size()), chunk.data());
    H5Pset_obj_track_times(properties, false);  // no clock in the bytes
    if (packing == Packing::deflate) H5Pset_shuffle(properties);
    if (packing != Packing::none) H5Pset_deflate(properties, unsigned(level));
    const hid_t id = H5Dcreate2(state_->id, name.c_str(), disk_type<T>(), space, H5P_DEFAULT,
                                properties, H5P_DEFAULT);
    state_->check(id, "creating " + name);
    return {std::make_shared<Column::Handle>(state_, id), name};
}

template <ColumnValue T>
void Hdf5File::write(const std::string& name, const std::vector<T>& values,
                     const Dimensions& shape) {
    const Locked lock(library_lock());
    const std::vector<hsize_t> size(shape.begin(), shape.end());
    const Handle space(H5Screate_simple(int(size.size()), size.data(), nullptr), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    Handle set(H5Dcreate2(state_->id, name.c_str(), disk_type<T>(), space, H5P_DEFAULT, properties,
                          H5P_DEFAULT),
               H5Dclose);
    state_->check(set, "creating " + name);
    state_->check(H5Dwrite(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                  "writing " + name);
    state_->check(set.close(), "closing " + name);
}

void Hdf5File::write(const std::string& name, const std::string& text) {
    const Locked lock(library_lock());
    const Handle type = text_type(text.size());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    Handle set(
        H5Dcreate2(state_->id, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
        H5Dclose);
    state_->check(set, "creating " + name);
    const std::string padded = text.empty() ? std::string(1, '\0') : text;
    state_->check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()),
                  "writing " + name);
    state_->check(set.close(), "closing " + name);
}

Column Hdf5File::column(const std::string& name) const {
    const Locked lock(library_lock());
    if (!has(name)) throw FileError(fmt::format("'{}' has no {}.", state_->path, name));
    const hid_t id = H5Dopen2(state_->id, name.c_str(), H5P_DEFAULT);
    if (id < 0) throw FileError(fmt::format("{} in '{}' is not a dataset.", name, state_->path));
    const auto handle = std::make_shared<Column::Handle>(state_, id);
    state_->reject_false_storage(id, name);
    return {handle, name};
}

std::string Hdf5File::read_text(const std::string& name) const {
    const Locked lock(library_lock());
    if (!has(name)) throw FileError(fmt::format("'{}' has no {}.", state_->path, name));
    const Handle set(H5Dopen2(state_->id, name.c_str(), H5P_DEFAULT), H5Dclose);
    state_->check(set, "opening " + name);
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_npoints(space) != 1)
        throw FileError(
            fmt::format("{} in '{}' is not one text of fixed length.", name, state_->path));
    state_->reject_false_storage(set, name);
    std::string text(H5Tget_size(type), '\0');
    state_->check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
                  "reading " + name);
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

void Hdf5File::link(const std::string& existing, const std::string& name) {
    const Locked lock(library_lock());
    state_->check(H5Lcreate_hard(state_->id, existing.c_str(), state_->id, name.c_str(),
                                 H5P_DEFAULT, H5P_DEFAULT),
                  "linking " + name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& text) {
    const Locked lock(library_lock());
    const Handle type = text_type(text.size());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const std::string padded = text.empty() ? std::string(1, '\0') : text;
    state_->write_attribute(object, name, type, space, padded.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::string>& texts) {
    const Locked lock(library_lock());
    std::size_t width = 1;
    for (const std::string& text : texts) width = std::max(width, text.size());
    std::string padded;
    for (const std::string& text : texts) padded += text + std::string(width - text.size(), '\0');
    const Handle type = text_type(width);
    const hsize_t size = texts.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    state_->write_attribute(object, name, type, space, padded.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
    const Locked lock(library_lock());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    state_->write_attribute(object, name, H5T_NATIVE_DOUBLE, space, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::int64_t>& values) {
    const Locked lock(library_lock());
    const hsize_t size = values.size();
    const Handle space(size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr),
                       H5Sclose);
    state_->write_attribute(object, name, H5T_NATIVE_INT64, space, values.data());
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
    const Locked lock(library_lock());
    return has(object) &&
           state_->check(H5Aexists_by_name(state_->id, object.c_str(), name.c_str(), H5P_DEFAULT),
                         "looking for attribute " + name) > 0;
}

namespace {

/// An attribute that is there, with its type and its number of values.
struct Attribute {
    Handle id, type, space;
    hssize_t count;

    Attribute(hid_t file, const std::string& object, const std::string& name)
        : id(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
             H5Aclose),
          type(H5Aget_type(id), H5Tclose),
          space(H5Aget_space(id), H5Sclose),
          count(H5Sget_simple_extent_npoints(space)) {}
    bool is_text() const {
        return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    }
};

}  // namespace

/// Reads an attribute with `read`, which says whether it is of the kind that is `wanted`.
template <class Read>
void Hdf5File::read_attribute(const std::string& object, const std::string& name,
                              const char* wanted, Read&& read) const {
    const Locked lock(library_lock());
    if (!has_attribute(object, name))
        throw FileError(fmt::format("'{}' has no attribute {} at {}.", state_->path, name, object));
    const Attribute attribute(state_->id, object, name);
    state_->reject_more_than_it_holds(
        "attribute " + name, double(attribute.count) * double(H5Tget_size(attribute.type)), 1.0);
    if (!read(attribute))
        throw FileError(fmt::format("Attribute {} at {} in '{}' is not {}.", name, object,
                                    state_->path, wanted));
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
    std::string text;
    read_attribute(object, name, "one text of fixed length", [&](const Attribute& a) {
        if (!a.is_text() || a.count != 1) return false;
        text.assign(H5Tget_size(a.type), '\0');
        return H5Aread(a.id, a.type, text.data()) >= 0;
    });
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
    double value = 0.0;
    read_attribute(object, name, "a number", [&](const Attribute& a) {
        return a.count == 1 && H5Aread(a.id, H5T_NATIVE_DOUBLE, &value) >= 0;
    });
    return value;
}

std::vector<std::int64_t> Hdf5File::integers_attribute(const std::string& object,
                                                       const std::string& name) const {
    std::vector<std::int64_t> values;
    read_attribute(object, name, "a list of integers", [&](const Attribute& a) {
        values.assign(a.count > 0 ? std::size_t(a.count) : 0, 0);
        return !values.empty() && H5Aread(a.id, H5T_NATIVE_INT64, values.data()) >= 0;
    });
    return values;
}

void Hdf5File::make_scale(const std::string& dataset, const std::string& name) {
    const Locked lock(library_lock());
    const Handle set = state_->object(dataset);
    state_->check(H5DSset_scale(set, name.c_str()), "naming the dimension " + name);
}

void Hdf5File::attach_scales(const std::string& dataset, const std::vector<std::string>& scales) {
    const Locked lock(library_lock());
    const Handle set = state_->object(dataset);
    for (unsigned k = 0; k < scales.size(); ++k) {
        const Handle scale = state_->object(scales[k]);
        state_->check(H5DSattach_scale(set, scale, k), "attaching the dimension " + scales[k]);
    }
}

#define SWIRL_FOR_COLUMNS_OF(T)                                                       \
    template void Column::append<T>(const T*, std::uint64_t);                         \
    template std::vector<T> Column::read<T>(std::uint64_t, std::uint64_t) const;      \
    template Column Hdf5File::create_column<T>(const std::string&, const Dimensions&, \
                                               const Dimensions&, Packing, int);      \
    template void Column::change<T>(std::uint64_t, std::uint64_t, const T*,           \
                                    std::optional<std::uint64_t>);                    \
    template void Hdf5File::write<T>(const std::string&, const std::vector<T>&, const Dimensions&)

SWIRL_FOR_COLUMNS_OF(double);
SWIRL_FOR_COLUMNS_OF(std::int64_t);
SWIRL_FOR_COLUMNS_OF(std::uint32_t);
SWIRL_FOR_COLUMNS_OF(std::uint8_t);

}  // namespace swirl
