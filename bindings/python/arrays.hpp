// Columns of ours as arrays of numpy. A view reads the column where it is, keeps its owner alive
// and cannot be written to; an owned array has taken the column over.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace swirl::python {

namespace py = pybind11;

/// `shape` times the product of itself must be the length of the column.
template <class T>
py::array view_of(const std::vector<T>& column, std::vector<py::ssize_t> shape,
                  const py::object& owner) {
    // Of nothing there is no address, and what has none numpy would fill itself.
    static const T nothing{};
    py::array_t<T> view(std::move(shape), column.empty() ? &nothing : column.data(), owner);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

template <class T>
py::array owned_array(std::vector<T> column, std::vector<py::ssize_t> shape) {
    auto kept = std::make_unique<std::vector<T>>(std::move(column));
    const py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    const std::vector<T>& values = *kept.release();
    return view_of(values, std::move(shape), owner);
}

}  // namespace swirl::python
