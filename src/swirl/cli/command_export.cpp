// swirl export: converts a trajectory for other programs.
#include <fmt/format.h>

#include <algorithm>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/trial_reading.hpp"
#include "swirl/io/export.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/pinned_series.hpp"

namespace swirl {
namespace {

struct ExportCall {
    std::string file, format, out, scale, range, stride;
    bool container = false, quiet = false;
};

std::vector<std::string> format_names() {
    std::vector<std::string> names;
    for (const ExportFormat& format : export_formats()) names.emplace_back(format.name);
    return names;
}

/// "lammps (text dump, …), xyz (…)", from the list of formats.
std::string formats_text() {
    std::string text;
    for (const ExportFormat& format : export_formats())
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", format.name, format.description);
    return text;
}

void choose_frames(const ExportCall& call, ExportOptions& options) {
    if (!call.stride.empty()) {
        const auto stride = read_whole_number(call.stride);
        if (!stride || *stride < 1)
            throw UsageError(fmt::format(
                "--stride is '{}', but it must be a whole number of at least 1.", call.stride));
        options.stride = static_cast<std::uint64_t>(*stride);
    }
    if (call.range.empty()) return;
    const std::size_t colon = call.range.find(':');
    const auto parse = [&](const std::string& text, std::uint64_t& frame) {
        if (text.empty()) return;
        const auto number = read_whole_number(text);
        if (colon == std::string::npos || !number || *number < 0)
            throw UsageError(fmt::format(
                "--range is '{}', but it must be FIRST:LAST, for example 100:199, or 100: for all "
                "frames from 100 on (the first frame is 0).",
                call.range));
        frame = static_cast<std::uint64_t>(*number);
    };
    parse(call.range.substr(0, colon), options.first);
    if (colon != std::string::npos) parse(call.range.substr(colon + 1), options.last);
    if (options.last < options.first)
        throw UsageError(
            fmt::format("--range is '{}', but the last frame is before the first.", call.range));
}

ExportOptions options_of(const ExportCall& call) {
    ExportOptions options;
    if (!call.scale.empty()) {
        const auto scale = read_number(call.scale);
        if (!scale || !(*scale > 0.0))
            throw UsageError(
                fmt::format("--scale is '{}', but it must be a number above 0.", call.scale));
        options.pixels_per_radius = *scale;
    }
    choose_frames(call, options);
    options.container = call.container;
    if (call.container && call.format != "lammps" && call.format != "xyz")
        throw UsageError(fmt::format(
            "--container adds a particle to lammps and xyz, but --format is '{}'.\nhint: omit it.",
            call.format));
    return options;
}

std::string report(const TrajectoryReader& reader, const ExportFormat& format,
                   const ExportOptions& options, const std::filesystem::path& out) {
    std::string text =
        fmt::format("{} of {} in {}\n",
                    counted(std::int64_t(exported_frames(reader.frames(), options)), "frame"),
                    counted(std::int64_t(reader.discs()), "disc"), out.string());
    if (&format == export_format("csv")) {
        const double centre = reader.reach() * options.pixels_per_radius;
        text += fmt::format("{} pixels per unit of length, origin at pixel {:.12g}, {:.12g}\n",
                            options.pixels_per_radius, centre, centre);
    }
    return text;
}

void export_file(const ExportCall& call) {
    const ExportFormat* const format = export_format(call.format);
    if (!format) {
        throw UsageError(fmt::format("--format is '{}', but it must be one of {}.{}", call.format,
                                     formats_text(),
                                     nearest_value_hint(call.format, format_names())));
    }
    ExportOptions options = options_of(call);
    try_reading(call.file);
    const auto reader = std::make_shared<TrajectoryReader>(call.file);
    const std::filesystem::path out =
        call.out.empty() ? std::filesystem::path(call.file).replace_extension(format->ending)
                         : std::filesystem::path(call.out);
    reject_same_files({call.file, out});
    reject_unwritable(out);
    if (reader->frames() == 0) throw Failure(fmt::format("'{}' has no frames.", call.file));
    const bool is_last_given = options.last != ExportOptions{}.last;
    if (std::max(options.first, is_last_given ? options.last : 0) >= reader->frames())
        throw UsageError(fmt::format("--range is '{}', but the last frame of '{}' is {}.",
                                     call.range, call.file, reader->frames() - 1));
    const std::uint64_t frames = exported_frames(reader->frames(), options);
    ProgressLine line(fmt::format("{} frames", frames), call.quiet);
    const std::atomic<bool>& stop = stop_signal();
    options.check_stop = [&stop] {
        if (stop.load()) throw Interrupted("stopped; nothing was written.");
    };
    options.on_frame = [&](std::uint64_t done) {
        options.check_stop();
        line.show(double(done) / double(frames), fmt::format("frame {}", done));
    };
    export_series(with_pinned_discs(series_of_run(reader)), *format, out, options);
    line.clear();
    if (!reader->complete())
        print_warning(
            fmt::format("'{}' is not complete; the existing frames were used.", call.file));
    if (!call.quiet) print_all(report(*reader, *format, options, out));
}

void add_export_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ExportCall>();
    subcommand.add({
        {"file", &call->file, "Trajectory to convert", "FILE.h5", required},
        {"--format", &call->format, "Output format, see below", one_of(format_names()), required},
        {"--out", &call->out, "Output file [FILE with the ending of the format]", "FILE"},
        {"--scale", &call->scale, "Pixels per unit of length in csv [20]", "NUMBER"},
        {"--range", &call->range, "Range of frames, counted from 0, both ends included [all]",
         "FIRST:LAST"},
        {"--stride", &call->stride, "Distance between exported frames [1]", "N"},
        {"--container", &call->container, "Add the container as a particle, lammps and xyz"},
        {"--quiet", &call->quiet, "Print neither progress nor report"},
    });
    subcommand.set_examples(
        {"swirl export frames.h5 --format vtp",
         "swirl export frames.h5 --format csv --scale 25 --out tracks.csv",
         "swirl export frames.h5 --format table --range 1000:1999 --stride 10"});
    std::string formats = "Formats:\n";
    for (const ExportFormat& format : export_formats())
        formats += fmt::format("  {:<7} {}\n", format.name, format.description);
    subcommand.explain(formats);
    subcommand.callback([call] { export_file(*call); });
}

const Command export_command("export", add_export_command);

}  // namespace
}  // namespace swirl
