// The part of HDF5 that swirl needs: typed columns that grow, attributes, groups and links. This is
// a thin layer over the C library. It closes handles automatically and reports errors as FileError.
//
// Files are written through JournaledFile: flushed data survives a kill and a power cut, and a full
// disk leaves the last flushed state. After any error, also one while a handle was closed, every
// further call throws. Such a file is never published.
//
// The library keeps global state, and some distributions build it without thread support. One lock
// around each call makes it safe to use files on different threads.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/io/journaled_file.hpp"

namespace swirl {

using Dimensions = std::vector<std::uint64_t>;

/// The value types of a column: double, std::int64_t, std::uint32_t, std::uint8_t.
template <class T>
concept ColumnValue = std::same_as<T, double> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint8_t>;

class Hdf5File;

/// A dataset. Its first dimension counts rows; `row_shape` is the shape of one row.
class Column {
  public:
    Column() = default;
    std::uint64_t rows() const { return rows_; }
    const Dimensions& row_shape() const { return row_shape_; }
    /// Shape of a chunk, rows first; empty if the dataset is not chunked.
    const Dimensions& chunk_shape() const { return chunk_shape_; }

    /// Appends `count` rows.
    template <ColumnValue T>
    void append(const T* values, std::uint64_t count);
    /// Overwrites `count` existing rows from row `first` on. With `component`, overwrites only this
    /// entry of the last dimension of each row.
    template <ColumnValue T>
    void write(std::uint64_t first, std::uint64_t count, const T* values,
               std::optional<std::uint64_t> component = {});
    /// Throws FileError, also if the file is too small to hold that many values.
    template <ColumnValue T>
    std::vector<T> read(std::uint64_t first, std::uint64_t count) const;
    template <ColumnValue T>
    std::vector<T> read() const {
        return read<T>(0, rows_);
    }
    /// Drops the rows from `rows` on, or adds rows of zeros.
    void resize(std::uint64_t rows);

  private:
    friend class Hdf5File;
    struct Handle;
    struct Selection;
    Column(std::shared_ptr<Handle> handle, std::string name);
    std::shared_ptr<Handle> handle_;
    std::string name_;
    std::uint64_t rows_ = 0;
    Dimensions row_shape_, chunk_shape_;
};

class Hdf5File {
  public:
    /// Throws FileError, also if the file is not an HDF5 file.
    Hdf5File(const std::filesystem::path& path, JournaledFile::Mode mode);
    /// Closes the file without a flush: unflushed data is lost. See finish().
    ~Hdf5File();
    Hdf5File(Hdf5File&&) noexcept;
    Hdf5File& operator=(Hdf5File&&) noexcept;

    void create_group(const std::string& name);
    bool has(const std::string& name) const;
    std::vector<std::string> names_in(const std::string& group) const;

    /// Creates a column that grows along its first dimension. `chunk_shape` gives the number of
    /// rows of a chunk and then its extent along the dimensions of a row. Chunks have the full
    /// extent along dimensions that it omits. `compression`: 0 for none, 1…9 for a byte shuffle and
    /// deflate of this level.
    template <ColumnValue T>
    Column create_column(const std::string& name, const Dimensions& row_shape,
                         const Dimensions& chunk_shape, int compression);
    /// Writes a dataset of fixed shape.
    template <ColumnValue T>
    void write(const std::string& name, const std::vector<T>& values, const Dimensions& shape);
    void write(const std::string& name, const std::string& text);
    Column column(const std::string& name) const;
    std::string read_text(const std::string& name) const;
    /// Gives an existing object a second name.
    void link(const std::string& existing, const std::string& name);

    void set_attribute(const std::string& object, const std::string& name, const std::string& text);
    void set_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::string>& texts);
    void set_attribute(const std::string& object, const std::string& name, double value);
    void set_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::int64_t>& values);
    bool has_attribute(const std::string& object, const std::string& name) const;
    double number_attribute(const std::string& object, const std::string& name) const;
    std::vector<std::int64_t> integers_attribute(const std::string& object,
                                                 const std::string& name) const;

    /// Makes a dataset a dimension scale (a netCDF coordinate).
    void make_scale(const std::string& dataset, const std::string& name);
    /// Names the dimensions of a dataset, in order, by dimension scales.
    void attach_scales(const std::string& dataset, const std::vector<std::string>& scales);

    /// After this call everything written so far survives a kill and a power cut.
    void flush();
    /// Flushes and closes the file, and publishes it under its final name.
    void finish(const std::filesystem::path& final_name);

  private:
    friend class Column;
    struct State;
    template <class Read>
    void read_attribute(const std::string& object, const std::string& name, const char* expected,
                        Read&& read) const;
    std::shared_ptr<State> state_;
};

}  // namespace swirl
