// Everything that a computation has gathered, as bytes, and back. A type that is to be kept says
// what it consists of:
//
//     template <class Visitor> void fields(Visitor&& visit) { visit(sum_); visit(weight_); }
//
// and the same line serves for writing and for reading. Numbers keep every bit. The bytes are those
// of a little-endian machine; a checkpoint is not meant to travel further.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "swirl/files/file_error.hpp"

namespace swirl {

template <class T, class Visitor>
concept HasFields = requires(T& value, Visitor& visitor) {
    value.fields(visitor);
};

/// Many of them are kept as they lie in memory, which is what they are one by one: numbers, and
/// plain structures of them.
template <class T, class Visitor>
concept KeptAsBytes =
    std::is_trivially_copyable_v<T> && !HasFields<T, Visitor> && !std::same_as<T, bool> &&
    (std::is_arithmetic_v<T> ||
     (std::is_aggregate_v<T> && !requires { std::tuple_size<T>::value; }));

class StateWriter {
  public:
    template <class T>
    void operator()(T& value) {
        using Value = std::remove_const_t<T>;
        auto& changeable = const_cast<Value&>(value);  // fields() serves both directions
        if constexpr (HasFields<Value, StateWriter>) {
            changeable.fields(*this);
        } else {
            static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>,
                          "give this type a fields() member");
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof(Value));
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
        if constexpr (KeptAsBytes<T, StateWriter>) {
            bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        } else if constexpr (std::same_as<T, bool>) {
            for (const bool value : values) bytes_ += value ? '\1' : '\0';
        } else {
            for (T& value : values) (*this)(value);
        }
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

    /// What `write` adds, readable as one std::string.
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
    void size(std::uint64_t n) { bytes_.append(reinterpret_cast<const char*>(&n), sizeof n); }
    std::string bytes_;
};

/// Throws FileError when the bytes end too soon: they were written by something else.
class StateReader {
  public:
    explicit StateReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    void operator()(T& value) {
        if constexpr (HasFields<T, StateReader>) {
            value.fields(*this);
        } else {
            static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                          "give this type a fields() member");
            std::memcpy(static_cast<void*>(&value), take(sizeof(T)).data(), sizeof(T));
        }
    }
    void operator()(std::string& text) { text = take(size()); }
    template <class T>
    void operator()(std::vector<T>& values) {
        const std::uint64_t n = size();
        if constexpr (KeptAsBytes<T, StateReader>) {
            if (n > rest_.size() / sizeof(T)) too_short();
            values.resize(n);
            const std::string_view bytes = take(n * sizeof(T));
            if (n > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
        } else if constexpr (std::same_as<T, bool>) {
            const std::string_view bytes = take(n);
            values.assign(bytes.begin(), bytes.end());
        } else {
            if (n > rest_.size()) too_short();  // every element takes a byte at least
            values.clear();
            values.resize(n);
            for (T& value : values) (*this)(value);
        }
    }
    template <class T>
    void operator()(std::optional<T>& value) {
        value.reset();
        if (take(1)[0] != '\0') (*this)(value.emplace());
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

    /// Everything has been read.
    void expect_end() const {
        if (!rest_.empty()) throw FileError("The saved state holds more than this run keeps.");
    }

  private:
    [[noreturn]] static void too_short() {
        throw FileError("The saved state ends too soon: it is that of another kind of run.");
    }
    std::string_view take(std::uint64_t n) {
        if (n > rest_.size()) too_short();
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
