// Removes the closed blocks of all averages in an object, so that the averages of the next period
// stand alone. What an observation follows across the end of a period stays: discs in the wall
// layer, the frames before, collisions whose discs are not yet known to be pinned.
#pragma once

#include <type_traits>

namespace swirl {

/// A visitor of fields().
struct ForgetBlocks {
    template <class... Fields>
    void operator()(Fields&&... fields) const {
        (forget(fields), ...);
    }

  private:
    template <class Field>
    void forget(Field& field) const {
        if constexpr (requires { field.forget_blocks(); }) {
            field.forget_blocks();
        } else if constexpr (requires { field.fields(*this); }) {
            field.fields(*this);
        } else if constexpr (requires { field.begin()->fields(*this); }) {
            for (auto& element : field) element.fields(*this);
        } else if constexpr (requires { field.begin()->forget_blocks(); }) {
            for (auto& element : field) element.forget_blocks();
        }
    }
};

}  // namespace swirl
