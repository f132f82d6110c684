// A struct that can only be filled by names.
#pragma once

namespace swirl {

/// As the first member of a struct, it makes a list of values without names a compile error:
///
///     struct Point {
///         [[no_unique_address]] ByName by_name{};
///         double x = 0.0, y = 0.0;
///     };
///     Point a{.x = 1.0};  // compiles
///     Point b{1.0};       // does not: 1.0 is no ByName
///
/// So a new member can stand anywhere in the struct, and no value moves to another member.
struct ByName {
    explicit ByName() = default;
};

}  // namespace swirl
