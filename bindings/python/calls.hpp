// What every function of the module needs: parameters out of keyword arguments, the command line's
// sentences without its hyphens, and work during which Python goes on and Ctrl-C is heard.
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

/// Keyword arguments as the table of parameters reads them (run/parameters.hpp); None is what was
/// not given. Throws TypeError for what is neither a number nor a text, and for a name that no
/// parameter has.
ParameterTexts texts_of(const py::dict& given);
/// The same, where a list stands for several values.
ParameterTexts lists_of(const py::dict& given);

/// "mu_disc is -1, …" for "--mu-disc is -1, …".
std::string plain_sentence(std::string_view sentence);

/// The interpreter is somebody else's as long as this lives.
class WithoutInterpreter {
  public:
    WithoutInterpreter() : state_(PyEval_SaveThread()) {}
    ~WithoutInterpreter();
    WithoutInterpreter(const WithoutInterpreter&) = delete;
    WithoutInterpreter& operator=(const WithoutInterpreter&) = delete;

  private:
    PyThreadState* state_;
};

/// What Python raised while we were away from it; raised again once we are back.
class Raised {
  public:
    explicit operator bool() const { return error_ != nullptr; }
    /// Asks for Ctrl-C, and calls `more` if nothing has been raised yet. From a thread without the
    /// interpreter.
    void listen(const std::function<void()>& more = {});
    /// With the interpreter.
    void raise_again() const {
        if (error_) std::rethrow_exception(error_);
    }
    /// The exception as an object, or None.
    py::object object() const;

  private:
    std::exception_ptr error_;
};

/// Whether Python would tell this thread of signals. With the interpreter.
bool is_main_thread();

/// work() in a thread of its own, while this one listens for Ctrl-C every twentieth of a second and
/// calls `more`. Whatever is raised sets `stop`; when the work has ended it is raised here.
template <class Work>
auto listening(std::atomic<bool>& stop, Work&& work, const std::function<void()>& more = {}) {
    Raised raised;
    std::future<decltype(work())> done;
    {
        const WithoutInterpreter without;
        done = std::async(std::launch::async, work);
        while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            raised.listen(more);
            if (raised) stop = true;
        }
    }
    raised.raise_again();
    return done.get();
}

void bind_runs(py::module_& module);
void bind_simulations(py::module_& module);
void bind_studies(py::module_& module);
void bind_recordings(py::module_& module);

}  // namespace swirl::python
