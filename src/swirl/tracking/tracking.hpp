// From a film to tracks: what `swirl track` does, without a word on the terminal.
//
//   1  a survey of a few dozen pictures: the rim and about its path, the discs' sizes and number
//   2  every picture, on all cores: the rim, the discs
//   3  the path of the dish, fitted to all pictures; the lens, if that asks for it
//   4  the discs linked to tracks, short gaps filled
//   5  what is to be thought of it: errors, and sentences on what looks wrong
//
// Lengths in pixels, y down; times in units of the time between two pictures unless the film's own
// rate is known.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "swirl/tracking/lens.hpp"
#include "swirl/tracking/tilt.hpp"
#include "swirl/tracking/tracked_path.hpp"

namespace swirl {

struct TrackingSettings {
    std::string video;
    std::optional<double> fps;  // otherwise as the film says
    std::optional<std::int64_t> discs;
    KnownCamera camera;
    std::int64_t max_pictures = 0;  // 0: all
    unsigned threads = 0;           // 0: one for each core
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& what, double share)> progress;

    /// Throws Interrupted if it is to stop.
    void listen() const;
};

struct TrackedKind {
    double radius = 0.0, scatter = 0.0;
    std::size_t number = 0;
};

struct TrackedVideo {
    int width = 0, height = 0;
    std::int64_t pictures = 0;
    double fps = 0.0;           // pictures per second; 0: not known, and times are in pictures
    std::vector<double> times;  // ascending
    double step() const;        // the usual one between two times

    Lens lens;  // all places and radii are those of an ideal lens that looks straight down
    Tilt tilt;
    TrackedPath path;  // per second, or per picture
    PathPolygon polygon;
    double rim_radius = 0.0, reach = 0.0, container_radius = 0.0;
    bool stopped = false;  // discs are hardly ever beyond `reach`: it is the wall
    std::size_t rims_missed = 0;
    double shake = 0.0;        // of the camera from frame to frame, rms of a coordinate
    Vec2 rim_shift{0.0, 0.0};  // of the path's centre from the rim's to the discs', pixels
    double rim_support = 0.0;
    /// How far from the path the rim's centre was in each picture; below 0 where it was not seen.
    std::vector<double> rim_off;

    bool bright = true;  // discs on a darker floor
    std::vector<TrackedKind> kinds;
    double radius = 0.0;  // of the commonest kind: the unit of length

    Tracks tracks;                                // ids from 0; radius for each disc
    std::vector<std::vector<double>> errors;      // of a coordinate, for each disc of each frame
    std::vector<std::vector<std::uint8_t>> seen;  // 0: put there between two that were seen
    std::size_t number = 0;
    double touching = 0.0;  // distance of discs in contact, in sums of radii

    double complete = 0.0;        // share of pictures in which every disc was seen
    double position_error = 0.0;  // rms of errors, those of the edges or the larger ones of
    double overlap_error = 0.0;   // distances that hard discs cannot have; without the tail
    std::uint64_t filled = 0;
    std::uint64_t rejected = 0, crowded = 0;  // discs beyond the number, and frames with such
    double jitter = 0.0;                      // of the film's times, in steps
    std::vector<std::string> warnings;

    TrackScale scale() const;  // for series_of()
};

/// Throws Failure, with the likely cause, and Interrupted.
TrackedVideo track_video(const TrackingSettings& settings);

}  // namespace swirl
