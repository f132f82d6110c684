// `swirl track --live`: options, the status line and the images in the browser.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "swirl/cli/options.hpp"

namespace swirl {

struct LiveResult;
struct TrackingSettings;

/// Options as given.
struct LiveOptions {
    std::string source;  // empty: not live
    std::optional<std::int64_t> survey_frames;
    std::optional<double> timeout;  // seconds
    std::optional<std::int64_t> port;
};

void add_live_options(Subcommand& subcommand, LiveOptions& options);
/// Throws UsageError for a value out of range, and for options of a video that is not live.
void check_live_options(const LiveOptions& options);

/// Tracks the live source until it ends or Ctrl-C. `settings.max_frames` limits the frames. Throws
/// Interrupted if it was stopped too early.
LiveResult track_live_source(const LiveOptions& options, TrackingSettings settings, bool quiet);

}  // namespace swirl
