#include "swirl/tracking/live_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "swirl/io/tracks.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/render/numbered_frames.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/tracking/container_path_fit.hpp"
#include "swirl/tracking/tracking_steps.hpp"

namespace swirl {

namespace {

/// Frames read by a thread of their own, so that none is lost while others are searched.
class FrameQueue {
  public:
    explicit FrameQueue(LiveVideo& video) : video_(video), reader_([this] { read(); }) {}
    ~FrameQueue() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        changed_.notify_all();
        reader_.join();
    }
    FrameQueue(const FrameQueue&) = delete;
    FrameQueue& operator=(const FrameQueue&) = delete;

    /// Waits for a frame, and returns all that are there, at most `maximum`. Empty at the end.
    std::vector<cv::Mat> take(std::size_t maximum) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !frames_.empty() || ended_; });
        if (frames_.empty() && failure_) std::rethrow_exception(failure_);
        std::vector<cv::Mat> taken;
        for (; !frames_.empty() && taken.size() < maximum; frames_.pop_front())
            taken.push_back(std::move(frames_.front()));
        changed_.notify_all();
        return taken;
    }

  private:
    void read() {
        constexpr std::size_t capacity = 64;  // frames: then the source waits
        std::exception_ptr failure;
        try {
            for (cv::Mat grey; video_.next(grey); grey = cv::Mat()) {
                std::unique_lock lock(mutex_);
                changed_.wait(lock, [&] { return frames_.size() < capacity || closed_; });
                if (closed_) break;
                frames_.push_back(std::move(grey));
                changed_.notify_all();
            }
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        ended_ = true;
        failure_ = failure;
        changed_.notify_all();
    }

    LiveVideo& video_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<cv::Mat> frames_;
    bool ended_ = false, closed_ = false;
    std::exception_ptr failure_;
    std::thread reader_;  // last: it uses the others
};

/// Links each frame to the one before it, and measures ϖ. The unit of time is a frame.
class LiveLinks {
  public:
    LiveLinks(const TrackedVideo& surveyed, const Lens& lens) : tracked_(surveyed), lens_(lens) {
        for (const TrackedSpecies& species : tracked_.species) {
            settings_.radii.push_back(species.radius);
            settings_.numbers.push_back(species.number);
            number_of_discs_ += species.number;
        }
        linker_ = disc_linker(tracked_.path, settings_);
    }

    void add(const FrameDetections& found, LiveFrame& frame) {
        std::vector<DetectedDisc> discs;
        for (const Particle& p : found.particles) discs.push_back({ideal(p), p.species, p.sure});
        if (found.rim.good) add_rim(found.rim, frame);
        const std::vector<int> tracks = linker_(discs, double(frame.number));
        measure(discs, tracks, frame.number);
        for (std::size_t d = 0; d < discs.size(); ++d)
            if (tracks[d] >= 0 || discs[d].sure)
                frame.discs.push_back(
                    {found.particles[d].centre, settings_.radii[discs[d].species], tracks[d]});
        frame.surveyed = true;
        frame.number_of_discs = number_of_discs_;
        frame.period = 2.0 * pi / tracked_.path.omega;
        frame.rotation = rotation();
    }

    LiveRotation rotation() const {
        LiveRotation result;
        result.periods = blocks_;
        result.last_period = last_period_;
        if (blocks_ > 0) result.mean = rotation_.estimates().by_time;
        return result;
    }

  private:
    Vec2 ideal(const Particle& p) const {
        return lens_.ideal({p.centre, settings_.radii[p.species]}).centre;
    }

    /// Fits the path again from time to time: an error of Ω shifts the phase more and more.
    void add_rim(const CircleFit& rim, LiveFrame& frame) {
        constexpr std::size_t interval = 32, fitted = 1024;  // rims
        frame.rim_centre = rim.centre;
        frame.rim_radius = rim.radius;
        centres_.push_back(lens_.ideal({rim.centre, rim.radius}).centre);
        times_.push_back(double(frame.number));
        if (times_.size() % interval != 0) return;
        if (times_.size() >= 2 * fitted) {
            centres_.erase(centres_.begin(), centres_.end() - fitted);
            times_.erase(times_.begin(), times_.end() - fitted);
        }
        if (const auto path = fit_container_path(centres_, times_)) tracked_.path = *path;
    }

    /// ϖ in the frame before this one, from the discs that are in all three.
    void measure(const std::vector<DetectedDisc>& discs, const std::vector<int>& tracks,
                 std::int64_t number) {
        TrackFrame now;
        now.number = number;
        std::vector<std::pair<int, Vec2>> linked;
        for (std::size_t d = 0; d < discs.size(); ++d)
            if (tracks[d] >= 0) linked.emplace_back(tracks[d], discs[d].position);
        std::sort(linked.begin(), linked.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [id, position] : linked) {
            now.id.push_back(id);
            now.position.push_back(position);
        }
        last_.push_back(std::move(now));
        if (last_.size() < 3) return;
        Tracks three;
        three.y_down = true;
        three.frames.assign(last_.begin(), last_.end());
        last_.pop_front();
        TrackFrame& middle = three.frames[1];
        const TrackFrame all = middle;
        middle.id.clear();
        middle.position.clear();
        const auto has = [](const TrackFrame& f, std::int64_t id) {
            return std::binary_search(f.id.begin(), f.id.end(), id);
        };
        for (std::size_t i = 0; i < all.id.size(); ++i)
            if (has(three.frames[0], all.id[i]) && has(three.frames[2], all.id[i])) {
                middle.id.push_back(all.id[i]);
                middle.position.push_back(all.position[i]);
            }
        constexpr std::size_t min_discs = 2;  // one is at the centre of mass
        if (middle.id.size() >= min_discs)
            rotation_.sample_by_time(series_of(std::move(three), tracked_.scale()).frame(1));
        turns_ += tracked_.path.omega / (2.0 * pi);
        if (turns_ < 1.0) return;
        turns_ -= 1.0;
        last_period_ = rotation_.open_means()[default_rate];
        rotation_.close_block();
        ++blocks_;
    }

    TrackedVideo tracked_;  // its path, species and radius are used
    Lens lens_;
    LinkSettings settings_;
    DiscLinker linker_;
    std::size_t number_of_discs_ = 0;
    std::vector<Vec2> centres_;
    std::vector<double> times_;
    std::deque<TrackFrame> last_;
    ClusterRotation rotation_;
    double turns_ = 0.0, last_period_ = 0.0;
    std::size_t blocks_ = 0;
};

/// One run of track_live().
class LiveTracking {
  public:
    LiveTracking(LiveVideo& video, TrackingSettings settings, const LiveSettings& live)
        : video_(video), settings_(std::move(settings)), live_(live), queue_(video) {}

    LiveResult result() {
        collect_survey();
        if (all_.empty()) throw Failure("no frame arrived");
        const std::size_t batch = 2 * thread_count(settings_);
        for (std::vector<cv::Mat> images = queue_.take(batch); !images.empty();
             images = queue_.take(batch))
            add(images);
        const std::int64_t surveyed = surveyed_;
        const LiveRotation rotation = links_->rotation();
        VideoTimes times;
        times.frame_count = video_.count();
        times.fps = settings_.fps.value_or(video_.camera_fps());
        settings_.readable_again = images_are_there();
        if (settings_.readable_again) settings_.video = video_.pattern();
        if (!video_.problem().empty()) tracked_.warnings.push_back(video_.problem());
        finish_tracking(settings_, *survey_, times, all_, tracked_);
        return {std::move(tracked_), surveyed, rotation};
    }

  private:
    /// Collects frames until a survey of them succeeds, and finds the discs in them.
    void collect_survey() {
        constexpr std::size_t max_bytes = std::size_t(2) << 30;  // of memory
        std::vector<cv::Mat> images;
        auto enough = static_cast<std::size_t>(live_.survey_frames);
        for (bool ended = false;;) {
            while (images.size() < enough && !ended) {
                std::vector<cv::Mat> more = queue_.take(enough - images.size());
                ended = more.empty();
                for (cv::Mat& image : more) {
                    LiveFrame frame;
                    frame.number = static_cast<std::int64_t>(images.size());
                    frame.grey = image;
                    if (live_.show) live_.show(frame);
                    images.push_back(std::move(image));
                }
            }
            if (images.empty()) throw Failure("no frame arrived before the end");
            const bool last = ended || 2 * enough * images[0].total() > max_bytes;
            if (survey(images, last)) return;
            enough *= 2;
        }
    }

    /// False if the images do not suffice. If they are the `last`, throws the cause.
    bool survey(const std::vector<cv::Mat>& images, bool last) {
        const auto frames = static_cast<std::int64_t>(images.size());
        const std::int64_t every = survey_stride(frames);
        std::vector<cv::Mat> part;
        for (std::int64_t k = 0; k < frames && part.size() < max_survey_images; k += every)
            part.push_back(images[static_cast<std::size_t>(k)].clone());
        try {
            survey_.emplace(survey_images(settings_, std::move(part)));
        } catch (const Failure&) {
            if (last) throw;
            return false;
        }
        all_.clear();
        const std::vector<FrameDetections> found = detect(images);
        RimCentres rims;
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (!found[k].rim.good) continue;
            const CircleFit& rim = found[k].rim;
            rims.centres.push_back(survey_->appearance.lens.ideal({rim.centre, rim.radius}).centre);
            rims.times.push_back(double(k));
        }
        const auto path = fit_container_path(rims.centres, rims.times);
        if (!path) {
            if (!last) return false;
            throw Failure(fmt::format(
                "the container was found, but its centre does not move along a circle\n{}",
                no_circle_hint));
        }
        TrackedVideo surveyed;
        surveyed.path = *path;
        surveyed.container_radius = survey_->rim.radius;
        set_species(settings_, survey_->appearance, found, surveyed);
        links_.emplace(surveyed, survey_->appearance.lens);
        surveyed_ = frames;
        append(images, found);
        return true;
    }

    std::vector<FrameDetections> detect(const std::vector<cv::Mat>& images) {
        const std::size_t begin = all_.size();
        std::vector<FrameDetections> found(images.size());
        for (const cv::Mat& image : images)
            if (image.size() != survey_->size)
                throw Failure(fmt::format("a frame of '{}' differs in size from the first frame",
                                          settings_.video));
        parallel_for(
            images.size(),
            [&](std::size_t k) {
                // A clone, since the camera's motion is removed in place.
                found[k] = detect_frame(settings_, *survey_, begin + k,
                                        k > 0 ? images[k - 1] : previous_, images[k].clone());
            },
            settings_.threads);
        return found;
    }

    void add(const std::vector<cv::Mat>& images) { append(images, detect(images)); }

    void append(const std::vector<cv::Mat>& images, const std::vector<FrameDetections>& found) {
        for (std::size_t k = 0; k < images.size(); ++k) {
            LiveFrame frame;
            frame.number = static_cast<std::int64_t>(all_.size());
            frame.grey = images[k];
            links_->add(found[k], frame);
            if (found[k].pose) {
                for (LiveDisc& disc : frame.discs)
                    disc.position = found[k].pose->seen(disc.position);
                if (frame.rim_centre) frame.rim_centre = found[k].pose->seen(*frame.rim_centre);
            }
            if (live_.show) live_.show(frame);
            all_.push_back(found[k]);
        }
        if (!images.empty()) previous_ = images.back();
    }

    /// True if all frames are files that still exist.
    bool images_are_there() const {
        if (video_.pattern().empty()) return false;
        const NumberedFrames names(video_.pattern());
        const std::int64_t first = first_number(video_.pattern());
        for (std::int64_t k = 0; k < video_.count(); ++k)
            if (!names.has_file(first + k)) return false;
        return true;
    }

    LiveVideo& video_;
    TrackingSettings settings_;
    const LiveSettings& live_;
    FrameQueue queue_;
    std::optional<VideoSurvey> survey_;
    std::optional<LiveLinks> links_;
    std::int64_t surveyed_ = 0;
    cv::Mat previous_;
    Detections all_;
    TrackedVideo tracked_;
};

}  // namespace

LiveResult track_live(LiveVideo& video, TrackingSettings settings, const LiveSettings& live) {
    cv::setNumThreads(1);  // the frames are distributed over our threads
    return LiveTracking(video, std::move(settings), live).result();
}

}  // namespace swirl
