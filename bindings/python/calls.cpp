#include "calls.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include "arrays.hpp"
#include "swirl/io/short_values.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_files.hpp"

namespace swirl::python {
namespace {

/// repr(), short and in one line (_arguments.py).
std::string shown(const py::handle& value) {
    return py::cast<std::string>(py::module_::import("swirl._arguments").attr("shown")(value));
}

[[noreturn]] void throw_wrong_type(const std::string& name, const py::handle& value,
                                   const char* expected) {
    throw py::type_error(fmt::format("{} is {}, but it must be {}.", name, shown(value), expected));
}

/// That of NumPy has another name in version 2.
bool is_truth_value(const py::handle& value) {
    const std::string_view type = Py_TYPE(value.ptr())->tp_name;
    return PyBool_Check(value.ptr()) || type == "numpy.bool_" || type == "numpy.bool";
}

/// A text in UTF-8. Python allows halves of surrogate pairs, which UTF-8 does not.
std::string utf8_text(const std::string& name, const py::handle& value) {
    py::ssize_t size = 0;
    const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
    if (text != nullptr) return {text, static_cast<std::size_t>(size)};
    PyErr_Clear();
    throw UsageError(fmt::format(
        "{} is {}, but half of a surrogate pair is not a character.", name,
        shortened(std::string(py::str(py::module_::import("builtins").attr("ascii")(value))))));
}

/// As many digits as are needed to read the same number back.
std::string number_text(const std::string& name, const py::handle& value) {
    constexpr auto expected = "a number or a text";
    if (is_truth_value(value) || py::isinstance<py::bytes>(value) || py::hasattr(value, "__len__"))
        throw_wrong_type(name, value, expected);
    PyObject* number = nullptr;
    if (PyIndex_Check(value.ptr()))
        number = PyNumber_Index(value.ptr());
    else if (py::hasattr(value, "__float__"))
        number = PyNumber_Float(value.ptr());
    else
        throw_wrong_type(name, value, expected);
    if (number == nullptr) throw py::error_already_set();
    return py::repr(py::reinterpret_steal<py::object>(number));
}

bool is_list(const py::handle& value) {
    return !py::isinstance<py::str>(value) && !py::isinstance<py::tuple>(value) &&
           !py::isinstance<py::bytes>(value) && py::hasattr(value, "__iter__");
}

/// A parameter whose value may be an array, as rows of a text: "points T:X:Y T:X:Y …".
struct ArrayParameter {
    const char *name, *word, *expected;
    py::ssize_t min_columns, max_columns;
};
constexpr ArrayParameter array_parameters[] = {
    {"path", "points", "a text or an array of numbers with the columns t, x and y", 3, 3},
    {"sizes", "list", "a text or an array of numbers, a radius or the columns radius and mass", 1,
     2},
    {"initial", "states", "a text or an array of numbers with the columns x, y, vx, vy and spin", 5,
     5}};

const ArrayParameter* array_parameter(const std::string& name) {
    for (const ArrayParameter& p : array_parameters)
        if (plain_name(name) == p.name) return &p;
    return nullptr;
}

std::string array_text(const ArrayParameter& p, const py::handle& value) {
    Numbers array;
    try {
        const py::array given = py::module_::import("numpy").attr("asarray")(value);
        const char kind = given.dtype().kind();
        if (kind == 'i' || kind == 'u' || kind == 'f') array = Numbers::ensure(given);
    } catch (const py::error_already_set&) {
    }
    const py::ssize_t columns = array.ndim() == 2 ? array.shape(1) : 1;
    if (array.size() == 0 || array.ndim() < 1 || array.ndim() > 2 || columns < p.min_columns ||
        columns > p.max_columns)
        throw_wrong_type(user_name(p.name), value, p.expected);
    std::string text = p.word;
    for (py::ssize_t k = 0; k < array.size(); ++k)
        text += fmt::format("{}{}", k % columns == 0 ? ' ' : ':', array.data()[k]);
    return text;
}

/// A tuple is one value with several parts: mixture=(12, 1.3), or several ramps.
std::string value_text(const std::string& name, const py::handle& value) {
    if (py::isinstance<py::str>(value)) return utf8_text(name, value);
    if (const auto* array = array_parameter(name); array && is_list(value))
        return array_text(*array, value);
    if (!py::isinstance<py::tuple>(value)) return number_text(name, value);
    std::string text;
    const char* const separator = name == "ramp" ? ";" : ":";
    for (const py::handle part : value)
        text += (text.empty() ? "" : separator) +
                (py::isinstance<py::str>(part) ? utf8_text(name, part) : number_text(name, part));
    return text;
}

std::string list_text(const std::string& name, const py::handle& values) {
    std::string text;
    for (const py::handle value : values)
        text += (text.empty() ? "" : ",") + value_text(name, value);
    if (text.empty())
        throw UsageError(
            fmt::format("{} is an empty list, but it must have at least one value.", name));
    return text;
}

/// `arguments` are those of the function, in addition to the parameters.
ParameterTexts texts_by(const py::dict& given, const std::vector<std::string>& arguments,
                        auto&& text_of) {
    ParameterTexts texts;
    for (const auto& [key, value] : given) {
        if (value.is_none()) continue;
        const std::string name = utf8_text("the name of a parameter", key);
        const Parameter* const row = find_parameter(name);
        const bool is_name = row && (name == row->name || name == user_name(row->name));
        if (!is_name || !row->is_settable()) {
            std::vector<std::string> names = arguments;
            for (std::string& known : parameter_names()) names.push_back(std::move(known));
            const auto similar = nearest_name(name, names);
            throw py::type_error(fmt::format("there is no parameter '{}'.\nhint: {}",
                                             shortened(name),
                                             similar ? fmt::format("did you mean '{}'?", *similar)
                                                     : "swirl.parameters() lists all parameters."));
        }
        const std::string text = text_of(name, value);
        // An error message that quotes the text would end at the null character.
        if (text.find('\0') != std::string::npos)
            throw UsageError(fmt::format("{} contains a null character.", name));
        if (!texts.emplace(row->name, with_file_contents(name, text)).second)
            throw UsageError(fmt::format("{} is given twice, as {} and as {}.",
                                         user_name(row->name), row->name, user_name(row->name)));
    }
    return texts;
}

}  // namespace

ParameterTexts texts_of(const py::dict& given) {
    return texts_by(
        given, {"frames_per_period"}, [](const std::string& name, const py::handle& value) {
            if (is_list(value) && !array_parameter(name))
                throw_wrong_type(
                    name, value,
                    "one number or text (only swirl.sweep() and swirl.map() take lists)");
            return value_text(name, value);
        });
}

ParameterTexts lists_of(const py::dict& given) {
    return texts_by(
        given, {"replicates", "frames_per_period"},
        [](const std::string& name, const py::handle& value) {
            // One array is one path; a list is an axis with several.
            const bool is_array = array_parameter(name) && py::isinstance<py::array>(value);
            return is_list(value) && !is_array ? list_text(name, value) : value_text(name, value);
        });
}

std::string python_message(std::string_view message) {
    const auto is_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    std::string plain;
    while (!message.empty()) {
        if (message.size() > 2 && message.starts_with("--") && is_word(message[2])) {
            message.remove_prefix(2);
            for (; !message.empty(); message.remove_prefix(1)) {
                const bool joins = message[0] == '-' && message.size() > 1 && is_word(message[1]);
                if (!joins && !is_word(message[0])) break;
                plain += joins ? '_' : message[0];
            }
            continue;
        }
        plain += message[0];
        message.remove_prefix(1);
    }
    return plain;
}

namespace {

bool is_exiting() {
#if PY_VERSION_HEX >= 0x030d0000  // Python 3.13 made the function public and removed the old name.
    return Py_IsFinalizing();
#else
    return _Py_IsFinalizing();
#endif
}

}  // namespace

WithoutInterpreter::~WithoutInterpreter() {
    // While Python exits, it would terminate a daemon thread inside this destructor, and thereby
    // the whole program. The thread waits for the end of the process instead.
    while (is_exiting()) pause();
    PyEval_RestoreThread(state_);
}

void PendingError::check_signals(const std::function<void()>& more) {
    if (error_ || is_exiting()) return;
    const py::gil_scoped_acquire interpreter;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (more) more();
    } catch (...) {
        error_ = std::current_exception();
    }
}

py::object PendingError::object() const {
    if (!error_) return py::none();
    try {
        std::rethrow_exception(error_);
    } catch (py::error_already_set& error) {
        return error.value();
    } catch (const std::exception& error) {
        return py::module_::import("builtins").attr("RuntimeError")(error.what());
    }
}

bool is_main_thread() {
    const py::module_ threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace swirl::python
