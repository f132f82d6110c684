// Helpers for all functions of the module: parameters from keyword arguments, messages in Python's
// notation, and long calls that other threads and Ctrl-C can interrupt.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <string>
#include <string_view>

#include "swirl/run/parameters.hpp"

namespace swirl::python {

namespace py = pybind11;

/// Converts keyword arguments to texts for run/parameters.hpp. None counts as not given. Throws
/// TypeError for a value that is neither a number nor a text, and for an unknown name.
ParameterTexts texts_of(const py::dict& given);
/// The same for a sweep: a list holds several values.
ParameterTexts lists_of(const py::dict& given);

/// Converts option names to Python names: "--mu-disc is -1, …" becomes "mu_disc is -1, …".
std::string python_message(std::string_view message);

/// Releases the interpreter lock for its lifetime.
class WithoutInterpreter {
  public:
    WithoutInterpreter() : state_(PyEval_SaveThread()) {}
    ~WithoutInterpreter();
    WithoutInterpreter(const WithoutInterpreter&) = delete;
    WithoutInterpreter& operator=(const WithoutInterpreter&) = delete;

  private:
    PyThreadState* state_;
};

/// An exception raised by Python during a call without the interpreter lock, to be rethrown later.
class PendingError {
  public:
    explicit operator bool() const { return error_ != nullptr; }
    /// Checks for Ctrl-C, then calls `more`, unless there is an error already. The caller must not
    /// hold the interpreter lock.
    void check_signals(const std::function<void()>& more = {});
    /// The caller must hold the interpreter lock.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }
    /// The exception as an object, or None.
    py::object object() const;

  private:
    std::exception_ptr error_;
};

/// True if Python delivers signals to this thread. The caller must hold the interpreter lock.
bool is_main_thread();

/// Runs work() in another thread. Meanwhile this thread checks for Ctrl-C 20 times per second and
/// calls `more`. An exception sets `stop`, and is rethrown here when the work has ended.
auto interruptible(std::atomic<bool>& stop, auto&& work, const std::function<void()>& more = {}) {
    PendingError error;
    std::future<decltype(work())> done;
    {
        const WithoutInterpreter without;
        done = std::async(std::launch::async, work);
        while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            error.check_signals(more);
            if (error) stop = true;
        }
    }
    error.rethrow();
    return done.get();
}

/// Makes the constructor of a class raise TypeError: an object without content would be invalid.
void forbid_construction(py::object type);

void bind_runs(py::module_& module);
void bind_snapshots(py::module_& module);
void bind_simulation(py::module_& module);
void bind_statistics(py::module_& module);
void bind_studies(py::module_& module);
void bind_recordings(py::module_& module);

}  // namespace swirl::python
