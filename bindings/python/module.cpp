// The module swirl._engine: access to the layers below the command line. The Python package around
// it (swirl/) provides the public names and their documentation.
#include <pybind11/pybind11.h>

#include "calls.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"

namespace swirl::python {
namespace {

void translate(std::exception_ptr thrown, PyObject* failure, PyObject* file_error) {
    const auto set = [](PyObject* kind, const std::exception& error) {
        PyErr_SetString(kind, python_message(error.what()).c_str());
    };
    try {
        std::rethrow_exception(thrown);
    } catch (const UsageError& error) {
        set(PyExc_ValueError, error);
    } catch (const Failure& error) {
        set(failure, error);
    } catch (const FileError& error) {
        set(file_error, error);
    } catch (const Interrupted& error) {
        set(PyExc_KeyboardInterrupt, error);
    }
}

PyObject *failure_type = nullptr, *file_error_type = nullptr;

}  // namespace
}  // namespace swirl::python

PYBIND11_MODULE(_engine, module) {
    namespace python = swirl::python;
    using python::failure_type, python::file_error_type;
    // The first lines of a docstring are the signature, of which tests/python/stubs_test.py makes
    // the stub file.
    pybind11::options options;
    options.disable_function_signatures();
    failure_type = PyErr_NewExceptionWithDoc(
        "swirl.Failure", "The call was valid, but the run failed.", PyExc_RuntimeError, nullptr);
    file_error_type = PyErr_NewExceptionWithDoc("swirl.FileError",
                                                "A file is missing, damaged or of another kind.",
                                                PyExc_OSError, nullptr);
    module.add_object("Failure", failure_type);
    module.add_object("FileError", file_error_type);
    pybind11::register_exception_translator([](std::exception_ptr thrown) {
        if (thrown) python::translate(thrown, failure_type, file_error_type);
    });
    module.def(
        "write_file",
        [](const std::string& path, const pybind11::bytes& content) {
            swirl::write_file_atomically(path, std::string_view(content));
        },
        "write_file(path: str, content: bytes) -> None");
    python::bind_snapshots(module);
    python::bind_simulation(module);
    python::bind_runs(module);
    python::bind_statistics(module);
    python::bind_studies(module);
    python::bind_recordings(module);
}
