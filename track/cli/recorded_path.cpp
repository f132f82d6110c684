#include "track/cli/recorded_path.hpp"

#include <fmt/format.h>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "track/cli/tracked_video.hpp"
#include "track/video/tracking.hpp"

namespace swirl {
namespace {

using namespace tracking;

/// A polyline through 120 points of a circle is inside it by at most 0.04 % of the radius.
constexpr int path_points = 120;

std::string harmonics_text(const RecordedMotion& motion) {
    return counted(static_cast<std::int64_t>(motion.cosine.size()), "harmonic");
}

/// "1.892 ± 0.002 disc radii", without the error of the disc radius.
std::string in_radii(double pixels, double error, const TrackedVideo& video) {
    return with_error(pixels / video.radius, error / video.radius) + " disc radii";
}

/// The relative error of the disc radius, in which lengths are given. The edge of a disc or of the
/// rim is found to about a third of a pixel. If the ratio of their diameters is given, the radius
/// follows from the rim, which is larger.
double scale_error(const TrackedVideo& video, const VideoSource& source) {
    constexpr double edge_error = 0.3;  // pixels
    const bool is_ratio_given = source.disc_diameter && source.container_diameter;
    return edge_error / (is_ratio_given ? video.rim_radius : video.radius);
}

/// The wall is where discs are stopped. Without tracks only the visible rim is known, which may be
/// the wall's outer edge.
std::string wall_text(const TrackedVideo& video) {
    return fmt::format(
        "{} radius {:.3f} disc radii",
        video.number > 0 ? "container" : "visible rim:", video.container_radius / video.radius);
}

std::string period_text(const TrackedVideo& video, const RecordedMotion& motion) {
    return with_error(motion.period(), motion.period_error()) +
           (video.fps > 0.0 ? " s" : " frames");
}

}  // namespace

void write_motion(const TrackedVideo& video, const RecordedMotion& motion,
                  const VideoSource& source, const std::filesystem::path& file) {
    std::string text = fmt::format(
        "# motion of the container in {}: mean of {:.2f} periods, {}\n# disc radius {:.3f} pixels, "
        "scale error {:.1f} %; {}\n# amplitude {}; standard error of a coordinate {:.2g} disc "
        "radii\n# period {}, here {} in the unit of time of swirl run\nt,x,y\n",
        stored_path(source.video), motion.periods, harmonics_text(motion), video.radius,
        100.0 * scale_error(video, source), wall_text(video),
        in_radii(motion.amplitude(), motion.point_error, video), motion.point_error / video.radius,
        period_text(video, motion), paper_period);
    for (int k = 0; k <= path_points; ++k) {
        const Vec2 c = motion.offset(double(k % path_points) / path_points);
        text += fmt::format("{},{:.6f},{:.6f}\n", paper_period * k / path_points,
                            c.x / video.radius, -c.y / video.radius);
    }
    write_output(file, text);
}

std::string motion_text(const TrackedVideo& video, const RecordedMotion& motion,
                        const VideoSource& source, const std::string& file) {
    return fmt::format(
        "{}: motion of the container, mean of {:.2f} periods, {}\n  amplitude   {}, {} pixels; a "
        "coordinate varies by {:.3f} pixels between periods\n  period      {}\n  scale       disc "
        "radius {} pixels; {}\n  next        swirl run --motion {} --container-radius {}\n",
        file, motion.periods, harmonics_text(motion),
        in_radii(motion.amplitude(), motion.point_error, video),
        with_error(motion.amplitude(), motion.point_error), motion.scatter,
        period_text(video, motion),
        with_error(video.radius, video.radius * scale_error(video, source)), wall_text(video),
        shell_word(file),
        video.number > 0 ? fmt::format("{:.3f}", video.container_radius / video.radius)
                         : "R (inner radius in disc radii; --out finds it)");
}

std::vector<std::string> motion_warnings(const RecordedMotion& motion) {
    constexpr double max_scatter = 0.05;  // share of the amplitude
    constexpr double min_used = 0.9;      // share of the frames
    std::vector<std::string> warnings;
    if (motion.scatter > max_scatter * motion.amplitude())
        warnings.push_back(fmt::format(
            "the periods of the container's motion differ by {:.0f} % of its amplitude; the path "
            "is their mean, and smoother than each of them",
            100.0 * motion.scatter / motion.amplitude()));
    if (motion.used < min_used)
        warnings.push_back(
            fmt::format("{:.0f} % of the frames disagree with the mean motion of the container and "
                        "are not used",
                        100.0 * (1.0 - motion.used)));
    return warnings;
}

}  // namespace swirl
