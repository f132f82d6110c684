// C++ columns as numpy arrays. A view reads a column in place, keeps its owner alive and cannot be
// written to. An owned array takes the column over.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace swirl::python {

namespace py = pybind11;

/// Arguments that numpy converts and copies if necessary.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using WholeNumbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

inline py::ssize_t signed_size(std::size_t n) { return static_cast<py::ssize_t>(n); }

/// The product of `shape` must be the length of the column.
template <class T>
py::array view_of(const std::vector<T>& column, std::vector<py::ssize_t> shape,
                  const py::object& owner) {
    // numpy would allocate memory for a null pointer.
    static const T placeholder{};
    py::array_t<T> view(std::move(shape), column.empty() ? &placeholder : column.data(), owner);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

template <class T>
py::array owned_array(std::vector<T> column, std::vector<py::ssize_t> shape) {
    auto stored = std::make_unique<std::vector<T>>(std::move(column));
    const py::capsule owner(stored.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    const std::vector<T>& values = *stored.release();
    return view_of(values, std::move(shape), owner);
}

}  // namespace swirl::python
