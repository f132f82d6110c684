// From a video to tracks: what `swirl track` does, without output to the terminal.
//
//   1  survey: the rim, its approximate path, and the sizes and number of discs, from a few frames
//   2  detection of the rim and the discs in every frame, on all cores
//   3  the path of the container, fitted to all frames; correction of the lens
//   4  discs linked to tracks, short gaps filled
//   5  errors, and warnings about what looks wrong
//
// Lengths in pixels, y down. Times in seconds, or in frames if the frame rate is unknown.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "track/video/camera_motion.hpp"
#include "track/video/lens.hpp"
#include "track/video/link.hpp"
#include "track/video/recorded_motion.hpp"
#include "track/video/tilt.hpp"
#include "track/video/tracked_path.hpp"
#include "track/video/video.hpp"

namespace swirl::tracking {

/// Numbers of frames of the video, both included.
struct FrameRange {
    std::int64_t first = 0, last = 0;
};

struct TrackingSettings {
    std::string video;
    std::optional<double> fps;  // replaces the video's own times
    std::optional<std::int64_t> discs;
    std::optional<double> radius_share;  // of a disc, relative to the container
    KnownCamera camera;
    FrameReading reading;  // set by track_video() itself
    std::int64_t first_frame = 0;
    std::int64_t max_frames = 0;                             // 0: all
    std::vector<FrameRange> skip;                            // frames that are not used
    bool accept_duplicates = false, accept_missing = false;  // correct the times instead
    unsigned threads = 0;                                    // 0: one for each core
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& step, double share)> progress;
    bool spins = false;  // measure_spins() follows
    /// Set by track_container() itself: no discs in the frames; the container may move on any path.
    bool motion_only = false;
    /// Set by track_video() itself: the pattern of the floor is removed from all frames.
    bool patterned_floor = false;
    /// Called before the first progress: how many frames there will probably be.
    std::function<void(std::int64_t frames, bool spins)> planned;

    /// Throws Interrupted if `stop` is set.
    void throw_if_stopped() const;
    void report_progress(const std::string& step, double share) const {
        if (progress) progress(step, share);
    }
};

struct TrackedSpecies {
    double radius = 0.0, scatter = 0.0;  // of the radii of single fits, standard deviation
    std::size_t number = 0;
};

/// Centres of the rim in the frames where it was found.
struct RimCentres {
    std::vector<Vec2> centres;
    std::vector<double> times;
    std::vector<std::size_t> frames;
};

/// Positions and radii are those that an ideal camera would see that looks straight down.
struct TrackedVideo {
    int width = 0, height = 0;
    std::int64_t frame_count = 0;
    FrameReading reading;
    double fps = 0.0;           // frames per second; 0: unknown, and times are in frames
    std::vector<double> times;  // ascending

    Lens lens;
    Tilt tilt;
    Vec2 shutter{0.0,
                 0.0};  // delay of a pixel's time against that of the image's centre, per pixel
    double readout = 0.0, readout_error = 0.0;  // from the first to the last row, frame intervals
    TrackedPath path;                           // per second, or per frame
    RimCentres rims;                            // without the camera's motion
    double rim_radius = 0.0;                    // median over the frames
    double reach = 0.0;                         // of the outermost disc, in most frames
    double container_radius = 0.0;              // one of these two
    double container_radius_error = 0.0;
    bool wall_reached = false;  // discs touch it at least three times per period
    std::size_t rims_missed = 0;
    CameraMotion camera;     // removed from all positions
    double wandering = 0.0;  // of the centre of the path, rms of a coordinate; removed
    double shake = 0.0;      // what is left of it, from frame to frame, rms of a coordinate
    std::size_t frames_without_pose = 0;  // not used: the camera's motion is unknown
    Vec2 rim_shift{0.0, 0.0};      // of the path's centre from the rim's to the discs', pixels
    Vec2 shading_shift{0.0, 0.0};  // of discs by light from one side, pixels; removed
    double shading_shift_error = 0.0;
    double contact_at_wall = 0.0;  // contact_ratio that discs at the wall imply; 0: unknown
    double rim_support = 0.0;
    std::vector<double> rim_offsets;  // distance of the rim from the path; −1 if not found

    bool bright = true;    // discs on a darker floor
    bool mixed = false;    // dark and bright discs, in folded frames
    bool opposed = false;  // dark and bright discs: light shifts them in opposite directions
    std::vector<TrackedSpecies> species;
    double radius = 0.0;  // of the most frequent species: the unit of length
    double radius_error = 0.0;

    Tracks tracks;                                // ids from 0; radius for each disc
    std::vector<std::vector<double>> errors;      // of a coordinate, for each disc of each frame
    std::vector<std::vector<std::uint8_t>> seen;  // 0: interpolated
    std::vector<std::vector<Vec2>> rolled;        // ways until the disc's row was read; removed
    std::vector<PossibleSwap> swaps;              // of IDs, the most likely ones first
    std::optional<ExtraDisc> extra;               // the first one beyond the number of discs
    std::size_t number = 0;                       // of discs
    std::optional<std::size_t> number_given;      // by the user
    double spacing = 1.0;  // contact distance / sum of visible radii, if these are parts of discs
    double contact_ratio = 0.0;   // distance of discs in contact / sum of radii
    bool contact_fitted = false;  // from the distribution of all distances
    double contact_error = 0.02;  // of the ratio; an outline that no contact confirms errs by 2 %

    double complete_share = 0.0;               // of the frames: every disc was detected
    double whole = 0.0, complete_whole = 0.0;  // frames with all of the container; and all discs
    double position_error = 0.0;  // rms of `errors`: from the edges, or from overlaps if larger
    double overlap_error = 0.0;   // from distances that hard discs cannot have, or from flights
    double bounce_error = 0.0;    // from bounces off the wall; 0: unknown
    double error_factor = 1.5;    // `position_error` is right within this factor
    std::uint64_t filled = 0;     // interpolated positions
    std::uint64_t rejected = 0, crowded = 0;  // discs beyond the number, and frames with such discs
    bool uneven_times = false;  // `times` have unequal steps: the video's own, or by the phase
    bool by_phase = false;    // the motion is uneven: a time is the phase of the container over Ω
    std::vector<char> rests;  // for each frame: the container rests; empty: it never does
    std::string damage;       // ffmpeg's message about a damaged video
    double jitter = 0.0;      // of the video's times, in steps
    std::vector<std::string> warnings;  // one line each, without "warning: "

    /// Median time between two frames in which the container moves.
    double step() const;
    /// That the frames show.
    double periods() const;
    std::size_t number_seen(std::size_t frame) const {
        return std::size_t(std::count(seen[frame].begin(), seen[frame].end(), 1));
    }
    bool rests_in(std::size_t frame) const { return !rests.empty() && rests[frame]; }
    /// Centre of the container in this frame.
    Vec2 container(std::size_t frame) const { return path.at(times[frame]); }
    /// A position that the lens shows, as recorded.
    Vec2 in_frame(std::size_t frame, const Vec2& at) const {
        return camera.poses.empty() ? at : camera.poses[frame].seen(at);
    }
    /// Position of disc `i` of a frame as the lens and the shutter show it, and as recorded.
    Vec2 seen_by_lens(std::size_t frame, std::size_t i) const {
        return lens.seen(tracks.frames[frame].position[i] + rolled[frame][i]);
    }
    Vec2 in_image(std::size_t frame, std::size_t i) const {
        return in_frame(frame, seen_by_lens(frame, i));
    }
    /// Removes the camera's motion from a frame as it was read.
    void stabilise(std::size_t frame, cv::Mat& grey) const {
        if (!camera.poses.empty()) tracking::stabilise(grey, camera.poses[frame]);
    }
    TrackScale scale() const;  // for series_of()
};

/// Throws Failure with the likely cause, and Interrupted.
TrackedVideo track_video(const TrackingSettings& settings);

/// The rims alone, their times, and the sizes. The path is not a circle, in general.
TrackedVideo track_container(const TrackingSettings& settings);

/// The mean motion of the container, in the plane of the discs if the camera is tilted and the
/// discs were tracked. The errors include that of the lens. Throws Failure.
RecordedMotion record_motion(const TrackedVideo& tracked);

}  // namespace swirl::tracking
