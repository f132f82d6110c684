// Serialises the state of a computation to bytes and back. A type to be saved lists its members:
//
//     template <class Visitor> void fields(Visitor&& visit) { visit(sum_); visit(weight_); }
//
// The same function serves for writing and for reading. All bits of a number are stored. The bytes
// are those of a little-endian machine: checkpoints are not portable to big-endian ones.
//
// Bytes from a file are not trusted. The reader rejects
//   - an integer that cannot be a count or an index: below 0, or above `largest_count`;
//   - a bool other than 0 and 1;
//   - a column of another length, if fields() visits it as a std::span: the length of such a column
//     is fixed by the object, like the number of cells of a map;
//   - an object with inconsistent members: after reading an object whose type has
//     `bool is_consistent() const`, the reader calls it.
// So visit a nested object by visit(object), never by object.fields(visit), which would skip the
// last check.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "swirl/io/file_error.hpp"

namespace swirl {

template <class T, class Visitor>
concept HasFields = requires(T& value, Visitor& visitor) {
    value.fields(visitor);
};

/// A type with an invariant of its members.
template <class T>
concept HasInvariant = requires(const T& value) {
    { value.is_consistent() } -> std::same_as<bool>;
};

/// Upper limit of integers in a saved state, so that a counter never overflows afterwards.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 62;

/// Numbers and plain structures of numbers. An array of them is stored with one copy, which gives
/// the same bytes as storing them one by one.
template <class T, class Visitor>
concept StoredAsBytes =
    std::is_trivially_copyable_v<T> && !HasFields<T, Visitor> && !std::same_as<T, bool> &&
    (std::is_arithmetic_v<T> ||
     (std::is_aggregate_v<T> && !requires { std::tuple_size<T>::value; }));

/// The position of the numbers of a field: `count` numbers of `width` bytes each.
struct SavedField {
    std::size_t begin, width, count;
};

class StateWriter {
  public:
    /// If `layout` is not null, the position of each written field is appended to it.
    explicit StateWriter(std::vector<SavedField>* layout = nullptr) : layout_(layout) {}

    template <class T>
    void operator()(T& value) {
        using Value = std::remove_const_t<T>;
        auto& changeable = const_cast<Value&>(value);  // fields() serves both directions
        if constexpr (HasFields<Value, StateWriter>) {
            changeable.fields(*this);
        } else {
            static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>,
                          "give this type a fields() member");
            numbers(&value, 1);
        }
    }
    void operator()(const std::string& text) {
        size(text.size());
        bytes_ += text;
    }
    void operator()(std::string& text) { (*this)(std::as_const(text)); }
    template <class T>
    void operator()(std::vector<T>& values) {
        size(values.size());
        if constexpr (StoredAsBytes<T, StateWriter>) {
            numbers(values.data(), values.size());
        } else if constexpr (std::same_as<T, bool>) {
            for (const bool value : values) bytes_ += value ? '\1' : '\0';
        } else {
            for (T& value : values) (*this)(value);
        }
    }
    /// The same bytes as for a vector.
    template <class T>
    requires StoredAsBytes<T, StateWriter>
    void operator()(std::span<T> values) {
        size(values.size());
        numbers(values.data(), values.size());
    }
    template <class T>
    void operator()(std::optional<T>& value) {
        bytes_ += value ? '\1' : '\0';
        if (value) (*this)(*value);
    }
    template <class A, class B>
    void operator()(std::pair<A, B>& value) {
        (*this)(value.first);
        (*this)(value.second);
    }
    template <class K, class V>
    void operator()(std::map<K, V>& values) {
        size(values.size());
        for (auto& [key, value] : values) {
            (*this)(key);
            (*this)(value);
        }
    }
    template <class T, std::size_t n>
    void operator()(std::array<T, n>& values) {
        for (T& value : values) (*this)(value);
    }
    template <class... Parts>
    requires(sizeof...(Parts) > 1) void operator()(Parts&... parts) { ((*this)(parts), ...); }

    /// Calls write(*this) and stores what it writes so that it reads back as one std::string.
    template <class Write>
    void as_text(Write&& write) {
        size(0);
        const std::size_t begin = bytes_.size();
        write(*this);
        const std::uint64_t n = bytes_.size() - begin;
        std::memcpy(bytes_.data() + begin - sizeof n, &n, sizeof n);
    }

    const std::string& bytes() const& { return bytes_; }
    std::string bytes() && { return std::move(bytes_); }

  private:
    /// A plain structure is a sequence of words of eight bytes.
    template <class T>
    void numbers(const T* values, std::size_t count) {
        constexpr std::size_t width = sizeof(T) % 8 == 0 ? 8 : sizeof(T);
        if (layout_) layout_->push_back({bytes_.size(), width, count * (sizeof(T) / width)});
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    void size(std::uint64_t n) { numbers(&n, 1); }
    std::vector<SavedField>* layout_;
    std::string bytes_;
};

/// Throws FileError if the bytes end too soon, and in the cases listed at the top.
class StateReader {
  public:
    explicit StateReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    void operator()(T& value) {
        if constexpr (HasFields<T, StateReader>) {
            value.fields(*this);
            static_assert(
                HasInvariant<T> || !requires { &T::is_consistent; },
                "it must be bool is_consistent() const");
            if constexpr (HasInvariant<T>)
                if (!value.is_consistent()) fail_inconsistent();
        } else if constexpr (std::same_as<T, bool>) {
            value = flag();
        } else {
            static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                          "give this type a fields() member");
            std::memcpy(static_cast<void*>(&value), take(sizeof(T)).data(), sizeof(T));
            // A negative integer is above the limit, too, once it is converted to unsigned.
            if constexpr (std::integral<T>)
                if (static_cast<std::make_unsigned_t<T>>(value) > largest_count)
                    fail_inconsistent();
        }
    }
    void operator()(std::string& text) { text = take(size()); }
    template <class T>
    void operator()(std::vector<T>& values) {
        const std::uint64_t n = size();
        if constexpr (StoredAsBytes<T, StateReader>) {
            if (n > rest_.size() / sizeof(T)) fail_too_short();
            values.resize(n);
            const std::string_view bytes = take(n * sizeof(T));
            if (n > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
        } else if constexpr (std::same_as<T, bool>) {
            if (n > rest_.size()) fail_too_short();
            values.resize(n);
            for (std::uint64_t k = 0; k < n; ++k) values[k] = flag();
        } else {
            if (n > rest_.size()) fail_too_short();  // each element takes at least one byte
            values.clear();
            values.resize(n);
            for (T& value : values) (*this)(value);
        }
    }
    template <class T>
    requires StoredAsBytes<T, StateReader>
    void operator()(std::span<T> values) {
        if (size() != values.size()) fail_inconsistent();
        const std::string_view bytes = take(values.size_bytes());
        if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    }
    template <class T>
    void operator()(std::optional<T>& value) {
        value.reset();
        if (flag()) (*this)(value.emplace());
    }
    template <class A, class B>
    void operator()(std::pair<A, B>& value) {
        (*this)(value.first);
        (*this)(value.second);
    }
    template <class K, class V>
    void operator()(std::map<K, V>& values) {
        values.clear();
        for (std::uint64_t n = size(); n > 0; --n) {
            K key{};
            (*this)(key);
            (*this)(values[key]);
        }
    }
    template <class T, std::size_t n>
    void operator()(std::array<T, n>& values) {
        for (T& value : values) (*this)(value);
    }
    template <class... Parts>
    requires(sizeof...(Parts) > 1) void operator()(Parts&... parts) { ((*this)(parts), ...); }

    /// Throws FileError if bytes are left.
    void expect_end() const {
        if (!rest_.empty()) throw FileError("the saved state is longer than that of this run.");
    }

  private:
    [[noreturn]] static void fail_too_short() {
        throw FileError("the saved state ends too soon; it belongs to another kind of run.");
    }
    [[noreturn]] static void fail_inconsistent() {
        throw FileError(
            "the saved state is inconsistent; it was changed, or written by another version of the "
            "program.");
    }
    bool flag() {
        const char byte = take(1)[0];
        if (byte != '\0' && byte != '\1') fail_inconsistent();
        return byte == '\1';
    }
    std::string_view take(std::uint64_t n) {
        if (n > rest_.size()) fail_too_short();
        const std::string_view taken = rest_.substr(0, n);
        rest_.remove_prefix(n);
        return taken;
    }
    std::uint64_t size() {
        std::uint64_t n;
        std::memcpy(&n, take(sizeof n).data(), sizeof n);
        return n;
    }
    std::string_view rest_;
};

}  // namespace swirl
