// swirl picture: the dish at one instant.
#include <fmt/format.h>

#include "swirl/cli/appearance_options.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/source_options.hpp"
#include "swirl/render/picture.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

struct PictureCall {
    std::shared_ptr<SourceTexts> source;
    std::shared_ptr<AppearanceTexts> appearance;
    std::optional<double> at;
    int flashes = 1;
    double every = 1.0;
    std::string out;
    bool quiet = false;
};

void draw_and_report(const PictureCall& call) {
    PictureConfig config;
    if (call.out.empty())
        throw UsageError("There is nowhere for the picture to go: give --out FILE.");
    config.out = call.out;
    reject_to_draw_onto_source(*call.source, {call.out});
    config.appearance = appearance(*call.appearance, Size{1920, 1080});
    config.sources = frame_sources(*call.source);
    const std::optional<double> last = config.sources.front().to;
    config.at = call.at.value_or(last.value_or(call.source->slip ? 0.0 : double(default_warmup)));
    config.flashes = call.flashes;
    config.every = call.every;
    if (const auto wrong = problem(config)) throw UsageError(*wrong);
    make_picture(config);
    if (!call.quiet)
        print_all(fmt::format("{}: swirl {:g}, {}x{} pixels.\n", call.out, config.at,
                              config.appearance.size.width, config.appearance.size.height) +
                  remark_on(config.sources, config.appearance));
}

void add_picture_command(Subcommand& subcommand) {
    const auto call = std::make_shared<PictureCall>();
    const auto group = "Picture";
    subcommand
        .add_option("--out", call->out, "the picture; its ending decides: .png, .svg or .pdf")
        ->type_name("FILE")
        ->group(group);
    subcommand
        .add_option("--at", call->at,
                    "the instant, in swirls from the start [20; the last of FILE]")
        ->type_name("SWIRLS")
        ->group(group);
    subcommand
        .add_option("--strobe", call->flashes,
                    "lay this many instants over each other, the last one at --at [1]")
        ->type_name("COUNT")
        ->group(group);
    subcommand.add_option("--every", call->every, "swirls between two of them [1]")
        ->type_name("SWIRLS")
        ->group(group);
    subcommand.add_flag("--quiet", call->quiet, "no report")->group(group);
    call->appearance = add_appearance_options(subcommand);
    call->source = add_source_options(subcommand);
    subcommand.set_examples(
        {"swirl picture --discs 48 --frame m --color pinned --theme light --out 48.pdf",
         "swirl picture --discs 28 --strobe 6 --every 0.05 --frame m --out strobe.png",
         "swirl picture run.h5 --at 12.5 --trails --out instant.svg"});
    subcommand.callback([call, &subcommand] {
        take_video_config(subcommand, *call->source, "picture");
        draw_and_report(*call);
    });
}

const Command picture_command(61, "picture", "A picture of the dish at one instant.",
                              add_picture_command);

}  // namespace
}  // namespace swirl
