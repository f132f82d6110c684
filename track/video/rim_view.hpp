// What the rim shows about the view of the camera, and which part of it hinders tracking.
//
// The outline of the rim is the median over the frames of the edge on each ray from its centre, so
// that discs and hands, which move, do not matter. A camera that is inclined by θ sees an ellipse
// whose axes have the ratio cos θ. While the shutter is open, edges across the motion become wider
// than edges along it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "track/video/container_rim.hpp"

namespace swirl::tracking {

struct RimView {
    double axes = 1.0;     // ratio of the axes of the outline
    double outside = 0.0;  // share of the rim outside the frame, mean
    double hidden = 0.0;   // share of the rim in the frame that shows no edge, median
    double smear = 1.0;    // width of edges across the motion, relative to that along it
};

RimView view_of_rim(const std::vector<PreparedFrame>& frames, const ContainerRim& rim);

/// Why discs cannot be followed, with the number that shows it, and what to do.
struct PoorView {
    std::string cause, hint;
};
/// The property that exceeds its limit by the largest factor. None if the view is good enough.
std::optional<PoorView> poor_view(const RimView& view);

/// The message of a failure, after the cause.
std::string with_cause(const std::string& message, const PoorView& poor);

/// Throws the failure that is handled, with the cause in its message if the view is poor.
template <class Kind>
[[noreturn]] void rethrow_with_cause(const Kind& failure, const RimView& view) {
    if (const auto poor = poor_view(view)) throw Kind(with_cause(failure.what(), *poor));
    throw;
}

}  // namespace swirl::tracking
