// HDF5, as much of it as we need: typed columns that grow, attributes, groups, links. The C library
// with its handles closed by themselves and its failures as FileError. Files are written through
// StagedFile, so what was flushed survives a kill and a power cut, and a full disk leaves the last
// flushed state. After a failure, of the disk or of the library, also one that came while a handle
// was closed, every further call throws: such a file is never completed.
//
// The library keeps global state and is not built for threads in every distribution; one lock
// around each call makes files on different threads safe.
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

/// The types a column may have: double, std::int64_t, std::uint32_t, std::uint8_t.
template <class T>
concept ColumnValue = std::same_as<T, double> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint8_t>;

/// What lies between the values of a column and its bytes in the file.
enum class Packing {
    none,
    stream,   // a zlib stream that somebody else makes (put_chunk)
    deflate,  // a byte shuffle and deflate, by the library
};

class Hdf5File;

/// A dataset. `row` is the shape of one entry along the first dimension.
class Column {
  public:
    Column() = default;
    std::uint64_t rows() const { return rows_; }
    const Dimensions& row_shape() const { return row_shape_; }

    /// Adds rows at the end; `count` values of row_shape each.
    template <ColumnValue T>
    void append(const T* values, std::uint64_t count);
    /// Changes rows that are there; with `component`, only that entry of the last dimension.
    template <ColumnValue T>
    void change(std::uint64_t first, std::uint64_t count, const T* values,
                std::optional<std::uint64_t> component = {});
    /// Puts a whole chunk into its place as it is to lie in the file, past the library's filters:
    /// the one that begins at row `first` (and at `component`). `raw`: not compressed, though the
    /// others may be. Little-endian values, or what the column's deflate filter would make of them.
    void put_chunk(std::uint64_t first, const void* bytes, std::size_t size, bool raw,
                   std::optional<std::uint64_t> component = {});
    /// Of a chunk, rows first.
    const Dimensions& chunk_shape() const { return chunk_shape_; }
    Packing packing() const { return packing_; }
    /// Throws FileError, also when the file is too small to hold that much.
    template <ColumnValue T>
    std::vector<T> read(std::uint64_t first, std::uint64_t count) const;
    template <ColumnValue T>
    std::vector<T> read() const {
        return read<T>(0, rows_);
    }
    /// Cuts off what lies behind.
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
    Packing packing_ = Packing::none;
};

class Hdf5File {
  public:
    /// Throws FileError, also when the file is no HDF5 file.
    Hdf5File(const std::filesystem::path& path, JournaledFile::Mode mode);
    /// Closes. What was not flushed is lost; see close().
    ~Hdf5File();
    Hdf5File(Hdf5File&&) noexcept;
    Hdf5File& operator=(Hdf5File&&) noexcept;

    void create_group(const std::string& name);
    bool has(const std::string& name) const;
    std::vector<std::string> names_in(const std::string& group) const;

    /// A column that grows along its first dimension in chunks of `chunk_shape`: rows, and for the
    /// dimensions of a row that it does not name all there is. `level`: of deflate, 1…9.
    template <ColumnValue T>
    Column create_column(const std::string& name, const Dimensions& row_shape,
                         const Dimensions& chunk_shape, Packing packing, int level = 1);
    /// A dataset that is written once.
    template <ColumnValue T>
    void write(const std::string& name, const std::vector<T>& values, const Dimensions& shape);
    void write(const std::string& name, const std::string& text);
    Column column(const std::string& name) const;
    std::string read_text(const std::string& name) const;
    /// A second name for the same object.
    void link(const std::string& existing, const std::string& name);

    void set_attribute(const std::string& object, const std::string& name, const std::string& text);
    void set_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::string>& texts);
    void set_attribute(const std::string& object, const std::string& name, double value);
    void set_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::int64_t>& values);
    bool has_attribute(const std::string& object, const std::string& name) const;
    std::string text_attribute(const std::string& object, const std::string& name) const;
    double number_attribute(const std::string& object, const std::string& name) const;
    std::vector<std::int64_t> integers_attribute(const std::string& object,
                                                 const std::string& name) const;

    /// Makes a dataset a dimension scale (a netCDF coordinate), and names the dimensions of others.
    void make_scale(const std::string& dataset, const std::string& name);
    void attach_scales(const std::string& dataset, const std::vector<std::string>& scales);

    /// What has been written survives a kill and a power cut.
    void flush();
    /// Flushes, closes, and gives the file its final name.
    void finish(const std::filesystem::path& final_name);

  private:
    friend class Column;
    struct State;
    template <class Read>
    void read_attribute(const std::string& object, const std::string& name, const char* wanted,
                        Read&& read) const;
    std::shared_ptr<State> state_;
};

}  // namespace swirl
