// The steps of track_video(), in their order; a heading names the file that contains the step.
// Other layers use tracking.hpp alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "track/video/camera_motion.hpp"
#include "track/video/container_rim.hpp"
#include "track/video/floor_pattern.hpp"
#include "track/video/link.hpp"
#include "track/video/particle_detection.hpp"
#include "track/video/rim_view.hpp"
#include "track/video/tilt.hpp"
#include "track/video/tracking.hpp"
#include "track/video/video.hpp"

namespace swirl::tracking {

unsigned thread_count(const TrackingSettings& settings);

// video_survey.cpp

/// Frames of a survey: enough to cover a period and all sides of the container.
inline constexpr std::int64_t survey_frames = 48;

struct VideoSurvey {
    ContainerRim rim;
    RimView view;
    ParticleAppearance appearance;
    Tilt tilt;
    std::shared_ptr<const StaticBackground> background;  // set if the camera moves
    std::shared_ptr<const FloorPattern> floor;           // set if it is removed from all frames
    cv::Size size;                                       // of the frames
    Vec2 shading{0.0, 0.0};   // gradient of a disc's brightness, of its contrast per radius
    bool both_signs = false;  // some discs are darker and some brighter than the floor

    static constexpr double vote_radius = 12.0;  // of a disc, pixels: more only costs time
    /// Reduction of the frames in which votes for discs are counted.
    double reduction() const { return std::min(1.0, vote_radius / appearance.radius()); }
};
/// `frame_count` may be an estimate. Sets `settings.reading.plane`.
VideoSurvey survey_video(TrackingSettings& settings, std::int64_t frame_count);

// frame_detection.cpp

struct FrameDetections {
    CircleFit rim;
    std::vector<DetectedParticle> particles;
    /// False for a frame without a time of its own, a duplicate, and one to be skipped.
    bool used = true;
    std::optional<CameraPose> pose;  // of the frame, if the camera moves
    double change = -1.0;  // of the pixels since the frame before, grey levels; −1: unknown

    /// Drops all that was found in the frame.
    void discard() {
        rim = {};
        particles.clear();
        used = false;
        pose.reset();
    }
};
using Detections = std::vector<FrameDetections>;  // for each frame
/// Positions as seen through the lens. `expected` frames, for the progress; 0: unknown.
Detections detect_frames(const TrackingSettings& settings, const VideoSurvey& survey,
                         std::int64_t expected, TrackedVideo& tracked);

/// Sets the final lens, corrects all positions by it, and sets the radius of the rim.
void correct_lens(const VideoSurvey& survey, Detections& all, TrackedVideo& tracked);

// container_motion.cpp

/// Sets the camera's motion from the poses of the frames. Frames without one are not used.
void collect_camera_motion(Detections& all, TrackedVideo& tracked);
/// If the camera shakes and the background does not show it, takes the motion from the rim: removes
/// its deviation from the path from all positions. True if it did.
bool remove_shake_of_rim(Detections& all, TrackedVideo& tracked);

// wandering.cpp

/// If the centre of the container's path wanders, as by hand, moves all positions so that the rim
/// goes round one circle. True if it did.
bool remove_wandering(Detections& all, TrackedVideo& tracked);
/// If the centre of the container's path moves on a line at a constant rate, as with a camera that
/// drifts, removes this from all positions. True if it did.
bool remove_drift(Detections& all, TrackedVideo& tracked);

// frame_times.cpp

/// Sets the time of every frame; returns whether these are the video's own because they are uneven.
/// Steps that differ by no more than the rounding of the video's clock count as equal. Throws
/// Failure if too few frames have valid times.
bool set_frame_times(const TrackingSettings& settings, const VideoTimes& times, Detections& all,
                     TrackedVideo& tracked);

/// Throws Failure if the video's clock advances by half a period or more between two frames.
void reject_time_gaps(const TrackingSettings& settings, const RimCentres& rims,
                      const TrackedVideo& tracked);
/// Warns of a few dropped or duplicated frames. If they are many, throws Failure, or corrects the
/// times if the settings accept them. Duplicates are then no longer used. True if times changed.
bool check_frame_jumps(const TrackingSettings& settings, const RimCentres& rims, Detections& all,
                       TrackedVideo& tracked);
/// If the container moves unevenly, as by hand, sets times by its phase, and warns. True if it did.
bool set_times_by_phase(const TrackingSettings& settings, const RimCentres& rims,
                        TrackedVideo& tracked);

// container_motion.cpp

RimCentres rim_centres(const Detections& all, const TrackedVideo& tracked);
/// Moves all positions of each frame by −shift(k), as for a camera that moves by it. The shift may
/// be none if the frame does not show it.
template <typename Shift>
void remove_shifts(Detections& all, TrackedVideo& tracked, Shift&& shift) {
    Vec2 last{0.0, 0.0};
    tracked.camera.poses.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        FrameDetections& found = all[k];
        last = shift(k).value_or(last);
        CameraPose& pose = tracked.camera.poses[k];
        pose.shift = pose.shift + last;
        found.rim.centre = found.rim.centre - last;
        for (DetectedParticle& p : found.particles) p.centre = p.centre - last;
    }
    tracked.camera.from_rim = true;
    measure_camera_motion(tracked.camera);
}
/// Moves a position from the time at which its row was read to that of the frame, with the
/// container. Returns by how much later it was read. put_back() moves it back.
double remove_delay(const TrackedVideo& tracked, std::size_t frame, Vec2& position);
Vec2 put_back(const TrackedVideo& tracked, std::size_t frame, const Vec2& position);
/// Sets all that the rim determines: path, shake. Throws Failure.
void fit_container_motion(const TrackingSettings& settings, const ContainerRim& survey,
                          bool uneven_times, Detections& all, TrackedVideo& tracked);

// track_repair.cpp

/// Links the particles of all frames. Adds discs that were missed. `all` gets
/// the added ones.
Links link_detections(const TrackingSettings& settings, const VideoSurvey& survey, Detections& all,
                      TrackedVideo& tracked);
/// Calls use(frame, track, index) for every particle that belongs to a track, frame by frame.
template <typename Use>
void for_each_linked(const Links& links, Use&& use) {
    for (std::size_t k = 0; k < links.track.size(); ++k)
        for (std::size_t d = 0; d < links.track[k].size(); ++d)
            if (const int t = links.track[k][d]; t >= 0) use(k, static_cast<std::size_t>(t), d);
}

// track_assembly.cpp, wall_bounces.cpp, wall_fit.cpp, track_quality.cpp, tracking_warnings.cpp
/// Writes the tracks, with short gaps filled.
void assemble_tracks(const Detections& all, const Links& links, std::int64_t first_frame,
                     TrackedVideo& tracked);

/// Positions of one disc in the frames that show it.
struct SeenDisc {
    std::vector<std::size_t> frames;
    std::vector<Vec2> positions;
    double radius = 0.0;
    std::int64_t id = 0;
};

std::vector<SeenDisc> seen_discs(const TrackedVideo& tracked);

/// A disc bounced off the wall, or off another disc, between `frame` and the next one.
struct Bounce {
    std::size_t frame;
    std::int64_t disc;
    double radius;
    Vec2 from_centre;  // position of the disc's centre relative to the container's
};
std::vector<Bounce> find_bounces(const TrackedVideo& tracked);

/// Finds the wall from the discs that it stops: removes their shift by light from one side from all
/// positions, and moves the path of a rim that is displaced.
void find_wall(const VideoSurvey& survey, TrackedVideo& tracked);
/// Sets the contact distance of discs, and the error of positions that the distances imply.
void find_contacts(TrackedVideo& tracked);
/// Sets the errors, the shares, and how far out discs come.
void measure_quality(const Detections& all, TrackedVideo& tracked);
/// Sets the container's radius from the rim and the discs; corrects the radii of discs in contact.
void set_radii(TrackedVideo& tracked);
/// Share of the rim outside the frame: the mean over the frames where it was found.
double share_outside(const TrackedVideo& tracked);
/// True if at least half of a disc would be in the frame wherever it is in the container.
bool is_whole(const TrackedVideo& tracked, double disc_radius, std::size_t frame);
/// Share of the frames that is enough to count discs: reached by no accident.
inline constexpr double counted_frames = 1.0 / 7.0;
inline constexpr double complete_rim = 0.005;  // share outside that is no warning
/// Throws UncertainDiscs if the frames contradict the discs that were found, or their number.
void reject_contradicted_discs(const TrackedVideo& tracked);
/// Throws Failure if discs move so far between frames that their IDs mean nothing.
void reject_confused_discs(const TrackedVideo& tracked);
/// "40, 41, 60 and 12 more".
std::string first_of(const std::vector<std::string>& items);
/// Adds warnings about what looks wrong, with the likely cause.
void add_warnings(TrackedVideo& tracked);

}  // namespace swirl::tracking
