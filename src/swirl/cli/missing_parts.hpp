// Errors of the subcommands that belong to a part of the program that this build does not contain.
// ./swirl builds each part when it is first called (CONTRIBUTING.md, Build time).
#pragma once

#include "swirl/run/failure.hpp"

namespace swirl {

[[noreturn]] inline void throw_missing(const std::string& subcommand, const std::string& option) {
    throw Failure("this build has no `swirl " + subcommand + "` (" + option +
                  " is OFF).\nhint: ./swirl " + subcommand +
                  " builds what is missing; so does cmake with -D" + option + "=ON.");
}

[[noreturn]] inline void throw_no_camera_support() {
    throw Failure(
        "this build has no camera support (OpenCV was not found, or SWIRL_CAMERA is OFF).\n"
        "hint: install libopencv-core-dev and libopencv-imgproc-dev and rebuild; ./swirl track "
        "does both.");
}

[[noreturn]] inline void throw_no_drawing_support() {
    throw Failure(
        "this build cannot draw (cairo was not found, or SWIRL_DRAWING is OFF).\n"
        "hint: install libcairo2-dev and rebuild; ./swirl does both.");
}

}  // namespace swirl
