// How long a task will still take, from its progress so far.
//
//     RemainingTime estimate({{"finding discs", 1.0}, {"measuring spins", 0.4}});
//     estimate.add(seconds, "finding discs", share);     at any rate, in order of time
//     estimate.seconds_left();
//
// Rate. The share done per second is that of the last half of the present stage, but of at least
// `shortest_window` seconds. So a slow beginning no longer counts after the stage has lasted twice
// as long. The time before the first progress of a stage (opening files, placing discs) does not
// count, once the stage has progressed for `settled` seconds.
//
// Stages. Each has a weight, its expected duration relative to the others. The estimate for a later
// stage is its weight times the seconds per weight of the stages so far. A name that is not in the
// list, or a share that falls, starts an extra stage. The estimate then assumes that no other stage
// follows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swirl {

struct ProgressStage {
    std::string name;
    double weight;
};

class RemainingTime {
  public:
    static constexpr double shortest_window = 2.0, settled = 1.0;  // seconds

    explicit RemainingTime(std::vector<ProgressStage> stages = {}) : stages_(std::move(stages)) {}

    /// `seconds` since the start of the task; `share` of the stage, from 0 to 1.
    void add(double seconds, std::string_view stage, double share) {
        share = std::clamp(share, 0.0, 1.0);
        if (!has_begun_ || stage != name_ || share < now_.share) begin(seconds, stage, share);
        now_ = {seconds, share};
        if (share > (samples_.empty() ? first_ : samples_.back()).share) samples_.push_back(now_);
        if (samples_.size() > max_samples) thin_out();
    }

    /// The share done of all stages if their weights are known, otherwise of the present stage.
    double fraction() const {
        const double all = done_weight_ + weight_ + weight_to_come();
        return all > 0.0 ? (done_weight_ + weight_ * now_.share) / all : now_.share;
    }

    /// Nothing without progress in the present stage.
    std::optional<double> seconds_left() const {
        if (samples_.empty() || !(samples_.back().seconds > first_.seconds)) return {};
        const double here = seconds_left_in_stage();
        if (weight_ == 0.0) return here;
        const double expected = (now_.seconds - stage_begin_) + here;
        return here + weight_to_come() * (done_seconds_ + expected) / (done_weight_ + weight_);
    }

  private:
    struct Sample {
        double seconds = 0.0, share = 0.0;
    };
    static constexpr std::size_t max_samples = 512;

    void begin(double seconds, std::string_view stage, double share) {
        // Whatever follows the last report of a stage belongs to that stage.
        if (has_begun_ && weight_ > 0.0) {
            done_weight_ += weight_;
            done_seconds_ += seconds - stage_begin_;
        }
        // A task whose first share is large continues an earlier one: its time does not count.
        constexpr double largest_first_step = 0.02;
        const bool continues = share > largest_first_step;
        stage_begin_ = has_begun_ || continues ? seconds : 0.0;
        first_ = {stage_begin_, continues ? share : 0.0};
        name_ = stage;
        weight_ = 0.0;
        next_ = 0;
        for (std::size_t k = 0; k < stages_.size(); ++k)
            if (stages_[k].name == stage) {
                weight_ = stages_[k].weight;
                next_ = k + 1;
            }
        samples_.clear();
        has_begun_ = true;
    }
    double weight_to_come() const {
        double sum = 0.0;
        if (weight_ > 0.0)
            for (std::size_t k = next_; k < stages_.size(); ++k) sum += stages_[k].weight;
        return sum;
    }
    double seconds_left_in_stage() const {
        const Sample &last = samples_.back(), from = reference();
        const double done = last.share - from.share, idle = now_.seconds - last.seconds;
        const double per_share = (last.seconds - from.seconds) / done;
        // Progress in steps, as by whole runs of a sweep: the next step is under way.
        const double usual = per_share * (last.share - before_last().share);
        if (idle <= 2.0 * usual) return std::max(per_share * (1.0 - last.share) - idle, 0.0);
        return (now_.seconds - from.seconds) / done * (1.0 - last.share);
    }
    const Sample& before_last() const {
        return samples_.size() > 1 ? samples_[samples_.size() - 2] : first_;
    }
    /// The progress since then, until the last one, gives the rate.
    const Sample& reference() const {
        const double since = now_.seconds - samples_.front().seconds;
        if (since < settled) return first_;
        const double begin = now_.seconds - std::max(shortest_window, 0.5 * since);
        const auto after = std::upper_bound(
            samples_.begin(), samples_.end(), begin,
            [](double time, const Sample& sample) { return time < sample.seconds; });
        if (after == samples_.end()) return before_last();
        if (after != samples_.begin()) return *std::prev(after);
        return samples_.size() > 1 ? samples_.front() : first_;
    }
    /// Omits every second sample but the first.
    void thin_out() {
        std::size_t kept = 1;
        for (std::size_t k = 2; k < samples_.size(); k += 2) samples_[kept++] = samples_[k];
        samples_.resize(kept);
    }

    std::vector<ProgressStage> stages_;
    bool has_begun_ = false;
    std::string name_;
    double weight_ = 0.0, done_weight_ = 0.0, done_seconds_ = 0.0, stage_begin_ = 0.0;
    std::size_t next_ = 0;
    Sample first_, now_;
    std::vector<Sample> samples_;  // each with progress since the last
};

}  // namespace swirl
