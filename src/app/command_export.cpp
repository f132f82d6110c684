// swirl export: a trajectory for other programs.
#include <fmt/format.h>

#include "swirl/app/commands.hpp"
#include "swirl/app/output.hpp"
#include "swirl/app/progress_line.hpp"
#include "swirl/app/stop_signal.hpp"
#include "swirl/files/export.hpp"
#include "swirl/files/trajectory.hpp"
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

std::uint64_t frame_number(const std::string& option, const std::string& text, std::int64_t from) {
    const auto value = read_whole_number(text);
    if (!value || *value < from)
        throw WrongCall(fmt::format("--{} has '{}', but it must be a whole number of at least {}.",
                                    option, text, from));
    return static_cast<std::uint64_t>(*value);
}

void choose_frames(const ExportCall& call, ExportOptions& options) {
    if (!call.stride.empty()) options.stride = frame_number("stride", call.stride, 1);
    if (call.range.empty()) return;
    const std::size_t colon = call.range.find(':');
    if (colon == std::string::npos)
        throw WrongCall(fmt::format(
            "--range is '{}', but it must be FIRST:LAST, for example 100:199, or 100: for all "
            "from frame 100 on; the first frame is 0.",
            call.range));
    const std::string first = call.range.substr(0, colon), last = call.range.substr(colon + 1);
    if (!first.empty()) options.first = frame_number("range", first, 0);
    if (!last.empty()) options.last = frame_number("range", last, 0);
    if (options.last < options.first)
        throw WrongCall(
            fmt::format("--range is '{}', but the last frame is before the first.", call.range));
}

void export_file(const ExportCall& call) {
    const ExportFormat* const format = export_format(call.format);
    if (!format)
        throw WrongCall(
            fmt::format("--to is '{}', but it must be one of {}.", call.format, formats_text()));
    ExportOptions options;
    if (!call.scale.empty()) {
        const auto scale = read_number(call.scale);
        if (!scale || !(*scale > 0.0))
            throw WrongCall(
                fmt::format("--scale is '{}', but it must be a number above 0.", call.scale));
        options.pixels_per_radius = *scale;
    }
    choose_frames(call, options);
    const auto reader = std::make_shared<TrajectoryReader>(call.file);
    const std::filesystem::path out =
        call.out.empty() ? std::filesystem::path(call.file).replace_extension(format->ending)
                         : std::filesystem::path(call.out);
    if (out == call.file)
        throw WrongCall(
            fmt::format("'{}' would be written over itself; name another --out.", call.file));
    refuse_unwritable(out);
    const SnapshotSeries series = series_of(reader);
    const std::uint64_t frames = exported_frames(series, options);
    if (frames == 0)
        throw Failure(fmt::format("There is no frame {} in '{}'; it has {}, the first is 0.",
                                  options.first, call.file, series.frames));
    ProgressLine line(fmt::format("{} frames", frames), call.quiet);
    options.done = [&](std::uint64_t done) {
        if (stop_signal().load()) throw Interrupted("Stopped; nothing was written.");
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
