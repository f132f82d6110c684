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
    std::string file, format, out, scale;
    bool quiet = false;
};

const char* ending(ExportFormat format) {
    switch (format) {
        case ExportFormat::lammps:
            return ".dump";
        case ExportFormat::xyz:
            return ".xyz";
        case ExportFormat::vtp:
            return ".pvd";
        case ExportFormat::csv:
            return ".csv";
        default:
            return ".gsd";
    }
}

void export_file(const ExportCall& call) {
    const auto format = export_format(call.format);
    if (!format)
        throw WrongCall(
            fmt::format("--to is '{}', but it must be lammps, xyz, vtp, csv or gsd.", call.format));
    ExportOptions options;
    if (!call.scale.empty()) {
        const auto scale = read_number(call.scale);
        if (!scale || !(*scale > 0.0))
            throw WrongCall(
                fmt::format("--scale is '{}', but it must be a number above 0.", call.scale));
        options.pixels_per_radius = *scale;
    }
    const auto reader = std::make_shared<TrajectoryReader>(call.file);
    const std::filesystem::path out =
        call.out.empty() ? std::filesystem::path(call.file).replace_extension(ending(*format))
                         : std::filesystem::path(call.out);
    if (out == call.file)
        throw WrongCall(
            fmt::format("'{}' would be written over itself; name another --out.", call.file));
    refuse_unwritable(out);
    const SnapshotSeries series = series_of(reader);
    ProgressLine line(fmt::format("{} frames", series.frames), call.quiet);
    options.done = [&](std::uint64_t k) {
        if (stop_signal().load()) throw Interrupted("Stopped; nothing was written.");
        line.show(double(k + 1) / double(series.frames), fmt::format("frame {}", k + 1));
    };
    export_series(series, *format, out, options);
    line.clear();
    if (call.quiet) return;
    std::string text =
        fmt::format("{} frames of {} discs in {}", series.frames, reader->discs(), out.string());
    if (*format == ExportFormat::csv)
        text += fmt::format("; {} pixels per unit of length, the swirl centre at pixel {}, {}",
                            options.pixels_per_radius, series.reach * options.pixels_per_radius,
                            series.reach * options.pixels_per_radius);
    if (!reader->complete()) text += "\nThe trajectory is not complete; this is what there is.";
    print_all(text + "\n");
}

void add_export_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ExportCall>();
    subcommand.add_option("file", call->file, "a trajectory")->type_name("FILE.h5")->required();
    subcommand
        .add_option(
            "--to", call->format,
            "lammps (text dump), xyz (extended), vtp (ParaView), csv (trackpy), gsd (HOOMD)")
        ->type_name("FORMAT")
        ->required();
    subcommand.add_option("--out", call->out, "where to [FILE with the format's ending]")
        ->type_name("FILE");
    subcommand.add_option("--scale", call->scale, "csv: pixels per unit of length [20]")
        ->type_name("NUMBER");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report");
    subcommand.set_examples({"swirl export frames.h5 --to vtp",
                             "swirl export frames.h5 --to csv --scale 25 --out tracks.csv"});
    subcommand.callback([call] { export_file(*call); });
}

const Command export_command(40, "export",
                             "A trajectory for OVITO, ParaView, MDAnalysis, trackpy, HOOMD.",
                             add_export_command);

}  // namespace
}  // namespace swirl
