#include "swirl/render/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/measure/cluster_rotation.hpp"

namespace swirl {

namespace {

constexpr int plot_samples = 64;  // samples per period

/// The 98th percentile, rounded up to a readable number.
double scale_end(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (values.empty()) return 1.0;
    const auto percentile =
        values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), percentile, values.end());
    if (!(*percentile > 0.0)) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(*percentile)));
    for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (*percentile <= step * power * (1.0 + 1e-9)) return step * power;
    return 10.0 * power;
}

/// The mean over the discs, as every report and the browser page have it, so that curve, turns and
/// ϖ agree. A disc that passes the centre of mass makes a peak, which the range of the plot leaves
/// out. A single disc has its spin, as in the minimal model.
double rotation_of(const Snapshot& s) {
    return s.size() == 1 ? s.spin[0] : cluster_rotation(s).individual;
}

/// Collects in a first pass what scales and plot need.
struct Survey {
    std::vector<double> spins, speeds, slips;
    bool single_disc = true;  // true if every snapshot has one

    Curve scan(const FrameSource& source, Frame frame, double start, double end) {
        const Playback playback = source.open();
        const double omega = (source.clockwise ? -2.0 : 2.0) * pi / source.period;
        Curve curve;
        // One period earlier if the source has it, so that the running mean exists at `start`.
        const double begin = std::max(source.from.value_or(0.0), start - 1.0);
        double sum = 0.0;
        for (int k = 0;; ++k) {
            const double periods = begin + static_cast<double>(k) / plot_samples;
            if (periods > end + 1e-9) break;
            const Snapshot s = playback(std::min(periods, end));
            single_disc = single_disc && s.size() == 1;
            const double rotation = rotation_of(s) / omega;
            curve.time.push_back(periods);
            curve.raw.push_back(rotation);
            sum += rotation;
            const auto size = curve.raw.size();
            if (size > plot_samples) sum -= curve.raw[size - plot_samples - 1];
            curve.smooth.push_back(sum /
                                   static_cast<double>(std::min<std::size_t>(size, plot_samples)));
            constexpr int samples_per_scale_sample = 8;  // enough for a percentile
            if (k % samples_per_scale_sample == 0) add_to_scales(s, frame);
        }
        return curve;
    }

  private:
    void add_to_scales(const Snapshot& s, Frame frame) {
        const FrameTransform transform(s, frame);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 v = transform.velocity(s.position(i), s.velocity(i));
            spins.push_back(std::abs(s.spin[i]));
            speeds.push_back(std::sqrt(dot(v, v)));
            if (!s.are_spheres()) continue;
            const Vec2 c = slip_on_floor(s.disc(i), s.container_velocity);
            slips.push_back(std::sqrt(dot(c, c)));
        }
    }
};

/// The sector of each disc of the source at this time, by its angle about the centre of mass.
std::map<std::int64_t, std::uint8_t> sectors_at(const FrameSource& source, double periods) {
    const Snapshot s = source.open()(periods);
    const std::vector<std::int64_t> ids =
        source.ids ? source.ids(periods) : std::vector<std::int64_t>();
    Vec2 centre{0.0, 0.0};
    for (std::size_t i = 0; i < s.size(); ++i)
        centre = centre + (1.0 / static_cast<double>(s.size())) * s.position(i);
    std::map<std::int64_t, std::uint8_t> sectors;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 p = s.position(i) - centre;
        const double turns = std::atan2(p.y, p.x) / full_turn + 1.0;
        const auto sector = static_cast<std::size_t>(turns * double(sector_colors.size()));
        sectors[ids.size() == s.size() ? ids[i] : std::int64_t(i)] =
            static_cast<std::uint8_t>(sector % sector_colors.size());
    }
    return sectors;
}

/// For each disc of this state. A disc that was not there at the start has the first colour.
std::vector<std::uint8_t> sectors_of(const SourceState& now,
                                     const std::map<std::int64_t, std::uint8_t>& at_start) {
    std::vector<std::uint8_t> sectors;
    for (std::size_t i = 0; i < now.snapshot.size(); ++i) {
        const auto found = at_start.find(now.ids.empty() ? std::int64_t(i) : now.ids[i]);
        sectors.push_back(found == at_start.end() ? std::uint8_t{0} : found->second);
    }
    return sectors;
}

std::vector<Panel> panels_of(const std::vector<FrameSource>& sources,
                             const Appearance& appearance) {
    std::vector<Panel> panels;
    for (const FrameSource& source : sources)
        for (const Frame frame : appearance.frames) {
            const bool in_lab = frame == Frame::lab;
            Panel panel{frame, "", source.container_radius, source.amplitude,
                        appearance.turned && in_lab};
            const std::string name = in_lab ? "lab frame" : "M-frame";
            const bool is_named = appearance.captions_only && appearance.frames.size() == 1;
            const std::string& alone = is_named ? source.caption : name;
            if (appearance.texts)
                panel.caption = sources.size() == 1             ? alone
                                : appearance.frames.size() == 1 ? source.caption
                                                                : source.caption + ", " + name;
            panels.push_back(panel);
        }
    return panels;
}

/// Parameters that all sources share. The others are part of the captions.
std::vector<std::string> shared_parameters(const std::vector<FrameSource>& sources) {
    std::vector<std::string> shared;
    for (const std::string& label : sources[0].parameters)
        if (std::all_of(sources.begin(), sources.end(), [&](const FrameSource& source) {
                return std::find(source.parameters.begin(), source.parameters.end(), label) !=
                       source.parameters.end();
            }))
            shared.push_back(label);
    return shared;
}

SheetSpec spec_of(const std::vector<FrameSource>& sources, const Appearance& appearance,
                  double duration) {
    SheetSpec spec;
    spec.size = appearance.size;
    spec.style = appearance;
    spec.turns_since = appearance.turns_since;
    spec.panels = panels_of(sources, appearance);
    spec.clock = appearance.texts && appearance.clock && !appearance.captions_only;
    if (appearance.captions_only) {
        // What a small image cannot show, and what makes a GIF large.
        spec.style.path = spec.style.orientation = false;
        spec.style.swirl_size = 1.55;
        spec.has_large_captions = true;
        return spec;
    }
    // In slow motion the clock must still change visibly.
    if (duration > 0.0)
        spec.clock_decimals =
            std::clamp(2 + static_cast<int>(std::ceil(-std::log10(duration))), 2, 12);
    if (appearance.texts) {
        spec.title = escaped(appearance.title);
        if (spec.title.empty() && sources.size() == 1) spec.title = sources[0].caption;
        spec.parameters = shared_parameters(sources);
    }
    return spec;
}

}  // namespace

std::optional<std::string> problem(const std::vector<FrameSource>& sources,
                                   const Appearance& appearance) {
    const char* const hint = "\nhint: choose another --color.";
    for (const FrameSource& source : sources) {
        if (appearance.coloring == Coloring::spin && !source.has_spin)
            return fmt::format("{} has no spins, so discs cannot be coloured by spin.{}",
                               source.caption, hint);
        if (appearance.coloring == Coloring::slip && !source.has_slip)
            return fmt::format(
                "{}: there are no spheres on a floor, so discs cannot be coloured by slip.{}",
                source.caption, hint);
        if (appearance.coloring == Coloring::pinned && source.ids)
            return fmt::format(
                "{} does not have the same discs in every frame, so pinned discs cannot be "
                "determined.{}",
                source.caption, hint);
    }
    return std::nullopt;
}

Page::Page(const std::vector<FrameSource>& sources, const Appearance& appearance, double start,
           double end)
    : sources_(sources), appearance_(appearance), start_(start) {
    SheetSpec spec = spec_of(sources, appearance, end - start);
    const bool needs_scale = appearance.coloring == Coloring::spin ||
                             appearance.coloring == Coloring::speed ||
                             appearance.coloring == Coloring::slip;
    if (appearance.coloring == Coloring::sector)
        for (const FrameSource& source : sources) sectors_.push_back(sectors_at(source, start));
    Survey survey;
    if (appearance.plot || appearance.turned || needs_scale) {
        for (std::size_t k = 0; k < sources.size(); ++k) {
            Curve curve = survey.scan(sources[k], appearance.frames.front(), start, end);
            curve.color = k == 0 ? appearance.theme.curve : appearance.theme.accent;
            if (sources.size() > 1) curve.label = sources[k].caption;
            curves_.push_back(std::move(curve));
        }
        spec.style.full_spin = scale_end(std::move(survey.spins));
        const bool slip = appearance.coloring == Coloring::slip;
        spec.style.full_speed = appearance.full_speed.value_or(
            scale_end(std::move(slip ? survey.slips : survey.speeds)));
    }
    if (appearance.plot) {
        PlotStyle plot{.from = start,
                       .to = std::max(end, start + 1e-6),
                       .lowest = 0.0,
                       .highest = 1.0,
                       .em = 10.0};
        fit_range(plot, curves_);
        // A single disc has no rotation except its spin.
        plot.vertical_label = survey.single_disc ? "$ω$/$Ω$" : "$ϖ$/$Ω$";
        spec.plot = plot;
    }
    sheet_.emplace(spec);
}

void Page::draw(const Canvas& canvas, std::span<const Moment> moments, double periods) const {
    /// Pointers into a moment; SceneContent refers to these vectors.
    struct Pointers {
        std::vector<const Snapshot*> past, ghosts;
        std::vector<std::span<const std::int64_t>> past_ids;
        std::vector<std::uint8_t> sectors;
    };
    std::vector<Pointers> pointers(moments.size());
    std::vector<SceneContent> contents;
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const Moment& moment = moments[k];
        for (const auto& state : moment.past) {
            pointers[k].past.push_back(&state->snapshot);
            if (sources_[k].ids) pointers[k].past_ids.push_back(state->ids);
        }
        for (const auto& state : moment.ghosts) pointers[k].ghosts.push_back(&state->snapshot);
        if (!sectors_.empty()) pointers[k].sectors = sectors_of(*moment.now, sectors_[k]);
        SceneContent content{.now = moment.now->snapshot,
                             .path = sources_[k].path,
                             .pinned = moment.pinned,
                             .sectors = pointers[k].sectors,
                             .past = pointers[k].past,
                             .ghosts = pointers[k].ghosts,
                             .backdrop = moment.backdrop ? &*moment.backdrop : nullptr,
                             .ids = moment.now->ids,
                             .past_ids = pointers[k].past_ids};
        if (appearance_.turned)
            content.turns =
                (sources_[k].clockwise ? -1.0 : 1.0) * turns_until(curves_[k], start_, periods);
        content.clockwise = sources_[k].clockwise;
        for (std::size_t f = 0; f < appearance_.frames.size(); ++f) contents.push_back(content);
    }
    sheet_->draw_frame(canvas, contents, curves_, periods);
}

SourcePlayer Page::player(std::size_t source, double start) const {
    return SourcePlayer(sources_[source], appearance_.trails ? appearance_.trail_length : 0.0,
                        appearance_.coloring == Coloring::pinned, start);
}

double turns_until(const Curve& curve, double start, double now) {
    double turns = 0.0, last = start;
    for (std::size_t k = 0; k < curve.time.size() && last < now; ++k) {
        // Each sample stands for the time since the previous one.
        if (curve.time[k] <= start) continue;
        const double next = std::min(curve.time[k], now);
        if (std::isfinite(curve.raw[k])) turns += (next - last) * curve.raw[k];
        last = next;
    }
    return turns;
}

}  // namespace swirl
