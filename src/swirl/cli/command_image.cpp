// swirl image: the container at one instant.
#include <fmt/format.h>

#include "swirl/cli/appearance_options.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/source_options.hpp"
#include "swirl/render/still.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

struct ImageCall {
    std::shared_ptr<SourceTexts> source;
    std::shared_ptr<AppearanceTexts> appearance;
    std::optional<double> start;
    int flashes = 1;
    double every = 1.0;
    std::string out;
    bool quiet = false;
};

void draw_and_report(const ImageCall& call) {
    StillConfig config;
    if (call.out.empty()) throw UsageError("missing required option --out FILE.");
    config.out = call.out;
    reject_output_onto_source(*call.source, {call.out});
    config.appearance = appearance(*call.appearance, Size{1920, 1080});
    config.sources = frame_sources(*call.source);
    const std::optional<double> last = config.sources.front().to;
    config.flashes = call.flashes;
    config.every = call.every;
    const double duration = (call.flashes - 1) * call.every;
    const double start = call.start.value_or(last                ? *last - duration
                                             : call.source->slip ? 0.0
                                                                 : double(default_warmup));
    config.at = start + duration;
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    const double counted = make_still(config);
    print_source_warnings(config.sources, config.appearance);
    if (!call.quiet)
        print_all(fmt::format(
            "{}: period {:g}, {}x{} pixels{}.\n", call.out, start, config.appearance.size.width,
            config.appearance.size.height,
            config.appearance.turned ? fmt::format(", turns since period {:g}", counted) : ""));
}

void add_image_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ImageCall>();
    subcommand.in("Image").add({
        {"--out", &call->out, "Image file: .png, .svg or .pdf", "FILE"},
        {"--start", &call->start, "Period of the image [20; of FILE: the last]", "PERIODS"},
        {"--strobe", &call->flashes, "Number of superimposed instants, from --start on [1]",
         "COUNT"},
        {"--every", &call->every, "Periods between superimposed instants [1]", "PERIODS"},
        {"--quiet", &call->quiet, "Suppress the report"},
    });
    call->appearance = add_appearance_options(subcommand);
    call->source = add_source_options(subcommand);
    subcommand.explain(source_explanation);
    subcommand.set_main_options({"--out", "--start", "--view", "--color", "--trails", "--size",
                                 "--discs", "--mu", "--compare", "--over"});
    subcommand.set_examples(
        {"swirl image --discs 48 --view m --color pinned --out 48.pdf",
         "swirl image --discs 28 --strobe 6 --every 0.05 --view m --out strobe.png",
         "swirl image run.h5 --start 12.5 --trails --out instant.svg"});
    subcommand.callback([call, &subcommand] {
        take_video_config(subcommand, *call->source, "image");
        draw_and_report(*call);
    });
}

const Command image_command("image", add_image_command);

}  // namespace
}  // namespace swirl
