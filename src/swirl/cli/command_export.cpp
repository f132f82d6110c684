// swirl export: a trajectory for other programs.
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
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

struct ExportCall {
    std::string file, format, out, scale, range, stride;
    bool quiet = false;
};

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
    const auto take = [&](const std::string& text, std::uint64_t& frame) {
        if (text.empty()) return;
        const auto number = read_whole_number(text);
        if (colon == std::string::npos || !number || *number < 0)
            throw UsageError(fmt::format(
                "--range is '{}', but it must be FIRST:LAST, for example 100:199, or 100: for all "
                "from frame 100 on; the first frame is 0.",
                call.range));
        frame = static_cast<std::uint64_t>(*number);
    };
    take(call.range.substr(0, colon), options.first);
    if (colon != std::string::npos) take(call.range.substr(colon + 1), options.last);
    if (options.last < options.first)
        throw UsageError(
            fmt::format("--range is '{}', but the last frame is before the first.", call.range));
}

void export_file(const ExportCall& call) {
    const ExportFormat* const format = export_format(call.format);
    if (!format)
        throw UsageError(
            fmt::format("--to is '{}', but it must be one of {}.", call.format, formats_text()));
    ExportOptions options;
    if (!call.scale.empty()) {
        const auto scale = read_number(call.scale);
        if (!scale || !(*scale > 0.0))
            throw UsageError(
                fmt::format("--scale is '{}', but it must be a number above 0.", call.scale));
        options.pixels_per_radius = *scale;
    }
    choose_frames(call, options);
    try_reading(call.file);
    const auto reader = std::make_shared<TrajectoryReader>(call.file);
    const std::filesystem::path out =
        call.out.empty() ? std::filesystem::path(call.file).replace_extension(format->ending)
                         : std::filesystem::path(call.out);
    reject_same_files({call.file, out});
    reject_unwritable(out);
    const SnapshotSeries series = series_of(reader);
    if (series.frames == 0) throw Failure(fmt::format("'{}' holds no frames.", call.file));
    const bool is_last_given = options.last != ExportOptions{}.last;
    if (std::max(options.first, is_last_given ? options.last : 0) >= series.frames)
        throw UsageError(fmt::format("--range is '{}', but the last frame of '{}' is {}.",
                                     call.range, call.file, series.frames - 1));
    const std::uint64_t frames = exported_frames(series, options);
    ProgressLine line(fmt::format("{} frames", frames), call.quiet);
    const std::atomic<bool>& stop = stop_signal();
    options.listen = [&stop] {
        if (stop.load()) throw Interrupted("Stopped; nothing was written.");
    };
    options.done = [&](std::uint64_t done) {
        options.listen();
        line.show(double(done) / double(frames), fmt::format("frame {}", done));
    };
    export_series(series, *format, out, options);
    line.clear();
    if (call.quiet) return;
    std::string text =
        fmt::format("{} frames of {} discs in {}", frames, reader->discs(), out.string());
    if (format == export_format("csv"))
        text += fmt::format("; {} pixels per unit of length, the swirl centre at pixel {}, {}",
                            options.pixels_per_radius, series.reach * options.pixels_per_radius,
                            series.reach * options.pixels_per_radius);
    if (!reader->complete()) text += "\nThe trajectory is not complete; this is what there is.";
    print_all(text + "\n");
}

void add_export_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ExportCall>();
    subcommand.add_option("file", call->file, "a trajectory")->type_name("FILE.h5")->required();
    subcommand.add_option("--to", call->format, formats_text())->type_name("FORMAT")->required();
    subcommand.add_option("--out", call->out, "where to [FILE with the format's ending]")
        ->type_name("FILE");
    subcommand.add_option("--scale", call->scale, "csv: pixels per unit of length [20]")
        ->type_name("NUMBER");
    subcommand
        .add_option("--range", call->range, "frames FIRST to LAST alone, counted from 0 [all]")
        ->type_name("FIRST:LAST");
    subcommand.add_option("--stride", call->stride, "only every N-th of the frames [1]")
        ->type_name("N");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report");
    subcommand.set_examples({"swirl export frames.h5 --to vtp",
                             "swirl export frames.h5 --to csv --scale 25 --out tracks.csv",
                             "swirl export frames.h5 --to table --range 1000:1999 --stride 10"});
    subcommand.callback([call] { export_file(*call); });
}

const Command export_command(
    40, "export", "A trajectory for OVITO, ParaView, MDAnalysis, trackpy, HOOMD, pandas.",
    add_export_command);

}  // namespace
}  // namespace swirl
