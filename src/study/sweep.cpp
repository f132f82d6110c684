#include "swirl/study/sweep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "swirl/files/checksum.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/files/result_writer.hpp"
#include "swirl/files/whole_file.hpp"
#include "swirl/math/random.hpp"
#include "swirl/measure/several_runs.hpp"
#include "swirl/run/all_cores.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/version.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int result_format = 1;
constexpr std::size_t most_points = 10'000'000;

std::string number_of(std::size_t point) { return fmt::format("{:06}", point); }
/// Of the plan as it is now: what was measured less is another run.
fs::path part_of(const fs::path& folder, const char* part, const SweepPlan& plan) {
    return folder / (plan.generation > 1 ? fmt::format("{}-{}", part, plan.generation) : part);
}
fs::path result_file(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    return part_of(folder, "results", plan) / (number_of(point) + ".json");
}

/// Calls visit(place) for the places in the whole plan of those points that a stage adds to the one
/// before it, in order.
template <class Visit>
void each_new_place(const SweepPlan& plan, const SweepStage& stage, const SweepStage* before,
                    const Visit& visit) {
    std::vector<std::size_t> at(stage.values.size(), 0);
    for (;;) {
        std::size_t place = 0;
        bool was_there = before != nullptr;
        for (std::size_t a = 0; a < at.size(); ++a) {
            place = place * plan.axes[a].values.size() + at[a];
            was_there = was_there && at[a] < before->values[a];
        }
        const auto replicas = static_cast<std::size_t>(plan.replicas);
        for (std::size_t r = was_there ? std::size_t(before->replicas) : 0;
             r < std::size_t(stage.replicas); ++r)
            visit(place * replicas + r);
        std::size_t a = at.size();
        while (a > 0 && ++at[a - 1] == stage.values[a - 1]) at[--a] = 0;
        if (a == 0) return;
    }
}

SweepStage size_of(const SweepPlan& plan) {
    SweepStage stage{{}, plan.replicas};
    for (const SweepAxis& axis : plan.axes) stage.values.push_back(axis.values.size());
    return stage;
}

std::vector<std::size_t> places_in(const SweepPlan& plan) {
    std::vector<std::size_t> places;
    if (plan.before.empty()) return places;
    const SweepStage now = size_of(plan);
    const SweepStage* before = nullptr;
    const auto add = [&](const SweepStage& stage) {
        each_new_place(plan, stage, before, [&](std::size_t place) { places.push_back(place); });
        before = &stage;
    };
    for (const SweepStage& stage : plan.before) add(stage);
    add(now);
    return places;
}

/// The numbers of the files NUMBER.ending in a folder; one look at the folder, whatever its size.
std::vector<bool> present(const fs::path& folder, std::string_view ending, std::size_t points) {
    std::vector<bool> there(points, false);
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::size_t point = 0;
        const auto [stop, wrong] = std::from_chars(name.data(), name.data() + name.size(), point);
        if (wrong == std::errc() && point < points &&
            std::string_view(stop, std::size_t(name.data() + name.size() - stop)) == ending)
            there[point] = true;
    }
    return there;
}

/// Who works on what: as long as a process does a point, it has the point's byte of one file
/// locked. One file for all, because a file system may take its time for files that come and go.
/// Only a courtesy: work done twice does no harm.
class Claims {
  public:
    explicit Claims(const fs::path& folder)
        : handle_(::open((folder / "claims").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (handle_ < 0)
            throw FileError(fmt::format("'{}' could not be written: {}.",
                                        (folder / "claims").string(), system_reason()));
    }
    ~Claims() { ::close(handle_); }
    Claims(const Claims&) = delete;
    Claims& operator=(const Claims&) = delete;

    /// False if another process works on the point.
    bool take(std::size_t point) {
        struct flock lock = on(point, 1, F_WRLCK);
        return ::fcntl(handle_, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
    }
    void give_back(std::size_t point) {
        struct flock lock = on(point, 1, F_UNLCK);
        ::fcntl(handle_, F_OFD_SETLK, &lock);
    }

    /// The points that somebody works on.
    static std::vector<bool> taken(const fs::path& folder, std::size_t points) {
        std::vector<bool> taken(points, false);
        const int handle = ::open((folder / "claims").c_str(), O_RDWR | O_CLOEXEC);
        for (std::size_t from = 0; handle >= 0 && from < points;) {
            struct flock lock = on(from, points - from, F_WRLCK);
            if (::fcntl(handle, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) break;
            const auto first = static_cast<std::size_t>(lock.l_start);
            const std::size_t end =
                lock.l_len > 0 ? std::min(points, first + static_cast<std::size_t>(lock.l_len))
                               : points;
            std::fill(taken.begin() + std::ptrdiff_t(std::min(first, points)),
                      taken.begin() + std::ptrdiff_t(end), true);
            from = std::max(end, from + 1);
        }
        if (handle >= 0) ::close(handle);
        return taken;
    }

  private:
    static struct flock on(std::size_t point, std::size_t count, int type) {
        struct flock lock {};
        lock.l_type = static_cast<short>(type);
        lock.l_whence = SEEK_SET;
        lock.l_start = static_cast<off_t>(point);
        lock.l_len = static_cast<off_t>(count);
        return lock;
    }

    int handle_;
};

/// One point's claim, given back in the end.
class Claim {
  public:
    static std::shared_ptr<Claim> on(const std::shared_ptr<Claims>& claims, std::size_t point) {
        if (!claims->take(point)) return nullptr;
        return std::make_shared<Claim>(claims, point);
    }
    Claim(std::shared_ptr<Claims> claims, std::size_t point)
        : claims_(std::move(claims)), point_(point) {}
    ~Claim() { claims_->give_back(point_); }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

  private:
    std::shared_ptr<Claims> claims_;
    std::size_t point_;
};

Json plan_json(const SweepPlan& plan) {
    Json axes = Json::object();
    for (const SweepAxis& axis : plan.axes) axes[axis.name] = axis.values;
    Json json{{"format", result_format}, {"axes", axes}, {"replicas", plan.replicas}};
    if (!plan.measure.empty()) json["measure"] = plan.measure;
    if (plan.frames > 0) json["frames"] = plan.frames;
    if (plan.generation > 1) json["generation"] = plan.generation;
    for (const SweepStage& stage : plan.before)
        json["before"].push_back({{"values", stage.values}, {"replicas", stage.replicas}});
    return json;
}

/// The call that does one point by itself.
std::string command_of(const SweepPlan& plan, std::size_t point, std::uint64_t seed) {
    std::string command = "swirl run";
    for (const auto& [name, value] : plan.parameters(point))
        if (name != "seed") command += fmt::format(" {} {}", option_name(name), value);
    if (!plan.measure.empty())
        command += fmt::format(" --measure {}", fmt::join(plan.measure, ","));
    return command + fmt::format(" --seed {}", seed);
}

std::string with_digits(double value) { return fmt::format("{:.12g}", value); }

std::vector<std::string> range(std::string_view name, std::string_view text) {
    const auto refuse = [&](const char* why) {
        throw WrongCall(fmt::format(
            "{} is '{}', but {}; a range is FROM:TO or FROM:STEP:TO, for example 5:48 or "
            "0:0.25:1.",
            option_name(name), text, why));
    };
    std::vector<double> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        const auto part = read_number(text.substr(begin, end - begin));
        if (!part) refuse("a part of it is not a number");
        parts.push_back(*part);
        begin = end + 1;
    }
    if (parts.size() > 3) refuse("it has more than three parts");
    const double from = parts.front(), to = parts.back();
    const double step = parts.size() == 3 ? parts[1] : 1.0;
    if (!(step > 0.0) || to < from) refuse("it does not lead upwards");
    const double count = std::floor((to - from) / step + 1e-9) + 1.0;
    if (count > 1e6) refuse("it has more than a million values");
    std::vector<std::string> values;
    for (double k = 0.0; k < count; k += 1.0) values.push_back(with_digits(from + k * step));
    return values;
}

class SweepWork {
  public:
    SweepWork(const fs::path& folder, const SweepPlan& plan, const SweepShare& share,
              const SweepControl& control)
        : folder_(folder),
          plan_(plan),
          share_(share),
          control_(control),
          claims_(std::make_shared<Claims>(folder)),
          writer_(part_of(folder, "results", plan)) {}

    SweepOutcome operator()() {
        std::vector<std::size_t> mine, others;
        const std::vector<bool> done =
            present(part_of(folder_, "results", plan_), ".json", plan_.points());
        for (std::size_t point = 0; point < plan_.points(); ++point)
            if (!done[point])
                (point % share_.parts == share_.part - 1 ? mine : others).push_back(point);
        all_ = double(mine.size() + (share_.rest ? others.size() : 0));
        work_on(mine);
        if (share_.rest) work_on(others);
        writer_.finish();
        outcome_.stopped = control_.stop && control_.stop->load();
        return outcome_;
    }

  private:
    void work_on(const std::vector<std::size_t>& points) {
        on_all_cores(
            points.size(), [&](std::size_t k) { try_point(points[k]); }, share_.threads);
    }

    void try_point(std::size_t point) {
        if (control_.stop && control_.stop->load(std::memory_order_relaxed)) return;
        const std::shared_ptr<Claim> claim = Claim::on(claims_, point);
        if (!claim) {
            const std::lock_guard lock(mutex_);
            ++outcome_.elsewhere;
            return;
        }
        // Done by somebody else in the meantime?
        if (::access(result_file(folder_, plan_, point).c_str(), F_OK) == 0) return count(0, 0);
        std::string failure;
        try {
            if (!do_point(point, claim)) return;
        } catch (const FileError& error) {
            throw;  // the folder is in trouble, not the point
        } catch (const Interrupted&) {
            return;
        } catch (const std::exception& error) {
            failure = error.what();
        }
        const fs::path note = folder_ / "failures" / (number_of(point) + ".txt");
        if (failure.empty()) {
            if (failed_before_[point]) ::unlink(note.c_str());
            return;
        }
        write_whole_file(note, failure + "\n");
        const std::lock_guard lock(mutex_);
        if (outcome_.failed++ == 0)
            outcome_.first_failure = fmt::format("point {}: {}", point, failure);
    }

    /// False if it was stopped before its end.
    bool do_point(std::size_t point, const std::shared_ptr<Claim>& claim) {
        const RunConfig config = plan_.config(point);
        RunFiles files;
        files.checkpoint =
            part_of(folder_, "checkpoints", plan_) / (number_of(point) + ".checkpoint");
        files.resume = true;
        files.overwrite = true;  // all that lies in there is of this very point
        if (plan_.frames > 0)
            files.trajectory = folder_ / "trajectories" / (number_of(point) + ".h5");
        files.frames.per_swirl = std::max(plan_.frames, 1);
        Observation observation = observation_of(config, plan_.measure);
        RunControl run_control;
        run_control.stop = control_.stop;
        double counted = 0.0;
        std::uint64_t counted_events = 0;
        run_control.progress = [&](const RunProgress& p) {
            count(p.fraction - counted, p.events - counted_events);
            counted = p.fraction;
            counted_events = p.events;
        };
        if (!observation.empty()) run_control.observation = &observation;
        const std::string command = command_of(plan_, point, config.seed);
        Provenance provenance;  // only recordings need it
        if (plan_.frames > 0) provenance = provenance_of(config, command, plan_text_);
        const RunResult result = run_recorded(config, files, run_control, provenance);
        if (!result.complete) return false;
        count(1.0 - counted, result.events.total() - counted_events);

        Json json{{"format", result_format}, {"point", point}, {"replica", plan_.replica(point)}};
        Json found = result_json(result);
        for (auto& [name, value] : found.items()) json[name] = std::move(value);
        json["command"] = command;
        if (!plan_.measure.empty()) json["measured"] = measured_json(observation.report());
        writer_.write(number_of(point) + ".json", json.dump() + "\n",
                      [files, claim] { forget_checkpoint(files); });
        const std::lock_guard lock(mutex_);
        ++outcome_.done;
        return true;
    }

    void count(double points, std::uint64_t events) {
        const std::lock_guard lock(mutex_);
        done_ += points;
        events_ += events;
        if (control_.progress) control_.progress(done_, all_, events_);
    }

    const fs::path folder_;
    const SweepPlan& plan_;
    const std::string plan_text_ = plan_json(plan_).dump();
    const SweepShare share_;
    const SweepControl& control_;
    const std::shared_ptr<Claims> claims_;
    const std::vector<bool> failed_before_ = present(folder_ / "failures", ".txt", plan_.points());
    ResultWriter writer_;
    std::mutex mutex_;
    SweepOutcome outcome_;
    double done_ = 0.0, all_ = 0.0;
    std::uint64_t events_ = 0;
};

constexpr const char* estimators[] = {"by_event", "by_time", "rigid_by_event", "rigid_by_time"};

struct PointResult {
    bool there = false, has_whole_swirl = true;
    /// The four estimators of the rotation, then the numbers that were measured.
    std::vector<MeasuredNumber> quantities;
    double energy = 0.0, periods = 0.0;
    std::string state_hash, steadiness, version;

    /// The quantity of this name; nearly always it is the one in this place.
    Estimate quantity(std::size_t place, const std::string& name) const {
        if (place < quantities.size() && quantities[place].name == name)
            return quantities[place].estimate;
        for (const MeasuredNumber& other : quantities)
            if (other.name == name) return other.estimate;
        return {.mean = not_known, .error = not_known};
    }
};

/// Keeps what a table needs of a result; building the rest would take most of the time.
bool needed(int depth, Json::parse_event_t event, Json& parsed) {
    if (event != Json::parse_event_t::key || (depth != 1 && depth != 3)) return true;
    static constexpr std::string_view parts[] = {"format",   "version",    "point",       "replica",
                                                 "config",   "state_hash", "periods",     "energy",
                                                 "rotation", "measured",   "steady_state"};
    const auto& key = parsed.get_ref<const std::string&>();
    if (depth == 3) return key != "blocks";  // of a rotation
    return std::find(std::begin(parts), std::end(parts), key) != std::end(parts);
}

/// A result that was copied to another point, or into another sweep, would be believed otherwise.
void refuse_result_of_another_point(const fs::path& file, const Json& json, const SweepPlan& plan,
                                    std::size_t point) {
    const bool ours = json.at("point") == point && json.at("replica") == plan.replica(point) &&
                      json.at("config").at("seed") == plan.config(point).seed;
    if (!ours)
        throw FileError(fmt::format(
            "'{}' is the result of another run than point {} of this sweep; remove it and call "
            "`swirl sweep` again.",
            file.string(), point));
}

PointResult read_result(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    const fs::path file = result_file(folder, plan, point);
    const Json json = Json::parse(read_regular_file(file), needed, false);
    if (json.is_discarded() || !json.is_object())
        throw FileError(
            fmt::format("'{}' is damaged; remove it and call `swirl sweep` again.", file.string()));
    PointResult result;
    result.there = true;
    result.quantities.reserve(std::size(estimators));
    const auto number = [](const Json& value) {
        return value.is_null() ? not_known : value.get<double>();  // throws for a text
    };
    try {
        if (json.value("format", 0) != result_format)
            throw FileError(fmt::format(
                "'{}' is in format {} of swirl {}, but this program reads format {}; remove it and "
                "call `swirl sweep` again, or collect with the program that wrote it.",
                file.string(), json.value("format", 0), json.value("version", std::string("?")),
                result_format));
        refuse_result_of_another_point(file, json, plan, point);
        for (const char* name : estimators) {
            const Json& found = json.at("rotation").at(name);
            result.quantities.push_back(
                {name, Estimate{.mean = number(found.at("mean")),
                                .error = number(found.at("error")),
                                .effective_samples = number(found.at("effective_samples"))}});
        }
        if (const auto measured = json.find("measured"); measured != json.end())
            for (auto& quantity : measured_numbers(*measured))
                result.quantities.push_back(std::move(quantity));
        // A single disc never has a rotation.
        result.has_whole_swirl = json.at("config").at("discs") == 1 ||
                                 !std::isnan(result.quantities.front().estimate.mean);
        result.energy = number(json.at("energy"));
        result.periods = number(json.at("periods"));
        result.state_hash = json.at("state_hash").get<std::string>();
        result.version = json.at("version").get<std::string>();
        result.steadiness = json.at("steady_state").at("verdict").get<std::string>();
    } catch (const nlohmann::json::exception&) {
        throw FileError(
            fmt::format("'{}' lacks a part of a result, or holds a text where a number belongs; "
                        "remove it and call `swirl sweep` again.",
                        file.string()));
    }
    return result;
}

/// How many runs it is, however many: a plan from a file may hold anything.
double product(const SweepPlan& plan) {
    double count = double(plan.replicas);
    for (const SweepAxis& axis : plan.axes) count *= double(axis.values.size());
    return count;
}

/// What a run with these parameters is. Without restitution and floor nobody asks for the contact
/// duration.
std::uint64_t run_of(const ParameterTexts& texts) {
    RunConfig config = resolve(texts);
    if (config.restitution == 1.0 && !config.floor)
        config.contact_duration = RunConfig{}.contact_duration;
    return checksum(config_text(config));
}

/// Whether two values of an axis make a difference where another axis has one of its other values.
bool differ_elsewhere(const SweepPlan& plan, const SweepAxis& axis, const std::string& one,
                      const std::string& two) {
    for (const SweepAxis& other : plan.axes) {
        if (other.name == axis.name) continue;
        for (const std::string& value : other.values) {
            ParameterTexts a = plan.parameters(0), b = a;
            a[other.name] = b[other.name] = value;
            a[axis.name] = one;
            b[axis.name] = two;
            try {
                if (run_of(a) != run_of(b)) return true;
            } catch (const WrongCall&) {  // shows when its turn comes
            }
        }
    }
    return false;
}

/// Every value of an axis must make another run; a run that is wanted again is a replica.
void refuse_useless(const SweepPlan& plan, const SweepAxis& axis) {
    ParameterTexts texts = plan.parameters(0);
    std::map<std::uint64_t, std::string> seen;
    for (const std::string& value : axis.values) {
        texts[axis.name] = value;
        const auto [before, is_new] = seen.emplace(run_of(texts), value);
        if (!is_new && !differ_elsewhere(plan, axis, before->second, value))
            throw WrongCall(fmt::format(
                "{0} {1} and {0} {2} are the same run here; leave one of them away, or the "
                "parameter that takes its place (for several runs of each there is --seeds).",
                option_name(axis.name), before->second, value));
    }
}

/// A mistake in one value shows before anything is run; combinations show when their turn comes.
void refuse_useless(const SweepPlan& plan) {
    if (const double count = product(plan); count > double(most_points))
        throw WrongCall(fmt::format("The sweep would have {:.3g} runs; at most {} are possible.",
                                    count, most_points));
    for (const SweepAxis& axis : plan.axes) refuse_useless(plan, axis);
}

/// What a stage counts must be there in the next.
void refuse_shrinking(const fs::path& file, const SweepPlan& plan) {
    std::vector<SweepStage> stages = plan.before;
    stages.push_back(size_of(plan));
    for (std::size_t k = 0; k + 1 < stages.size(); ++k) {
        const SweepStage &stage = stages[k], &next = stages[k + 1];
        bool good = stage.values.size() == plan.axes.size() && stage.replicas >= 1 &&
                    stage.replicas <= next.replicas;
        for (std::size_t a = 0; good && a < stage.values.size(); ++a)
            good =
                stage.values[a] >= 1 && a < next.values.size() && stage.values[a] <= next.values[a];
        if (!good)
            throw FileError(
                fmt::format("'{}' is damaged: what it was before it grew is no part of what it is.",
                            file.string()));
    }
}

/// The places in the order of a table: that of the values as they were given, and where a plan has
/// grown and an axis is of numbers, theirs.
std::vector<std::size_t> rows_of(const SweepPlan& plan) {
    std::vector<std::size_t> rows{0};
    for (const SweepAxis& axis : plan.axes) {
        std::vector<std::size_t> order(axis.values.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::vector<double> numbers;
        for (const std::string& value : axis.values)
            if (const auto number = read_number(value)) numbers.push_back(*number);
        if (!plan.before.empty() && numbers.size() == order.size())
            std::stable_sort(order.begin(), order.end(),
                             [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
        std::vector<std::size_t> longer;
        longer.reserve(rows.size() * order.size());
        for (const std::size_t row : rows)
            for (const std::size_t k : order) longer.push_back(row * order.size() + k);
        rows = std::move(longer);
    }
    return rows;
}

Table::Cell cell_of(const std::string& text) {
    if (const auto whole = read_whole_number(text)) return *whole;
    if (const auto number = read_number(text)) return *number;
    return text;
}

/// Of all replicas together: steady if all are, drifting if any is.
std::string steadiness_of(const std::vector<const PointResult*>& replicas) {
    for (const char* verdict : {"drifting", "too short to tell"})
        for (const PointResult* r : replicas)
            if (r->steadiness == verdict) return verdict;
    return replicas.front()->steadiness;
}

}  // namespace

std::size_t SweepPlan::points() const {
    auto count = static_cast<std::size_t>(replicas);
    for (const SweepAxis& axis : axes) count *= axis.values.size();
    return count;
}

std::int64_t SweepPlan::replica(std::size_t point) const {
    return static_cast<std::int64_t>(place(point) % static_cast<std::size_t>(replicas));
}

ParameterTexts SweepPlan::parameters(std::size_t point) const {
    ParameterTexts texts;
    std::size_t rest = place(point) / static_cast<std::size_t>(replicas);
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        texts[axis->name] = axis->values[rest % axis->values.size()];
        rest /= axis->values.size();
    }
    return texts;
}

RunConfig SweepPlan::config(std::size_t point) const {
    RunConfig config = resolve(parameters(point));
    const std::string identity = fmt::format("{} replica {}", config_text(config), replica(point));
    config.seed = Random(checksum(identity)).bits() >> 11;  // exact in every JSON reader
    return config;
}

std::vector<std::string> list_of_values(std::string_view name, std::string_view text) {
    std::vector<std::string> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        if (part.empty())
            throw WrongCall(fmt::format("{} is '{}', but a value in the list is empty.",
                                        option_name(name), text));
        if (part.find(':') != part.npos && name != "mixture") {
            const auto more = range(name, part);
            values.insert(values.end(), more.begin(), more.end());
        } else {
            values.emplace_back(part);
        }
        begin = end + 1;
    }
    return values;
}

SweepPlan make_plan(const ParameterTexts& given, std::int64_t replicas) {
    SweepPlan plan;
    plan.replicas = replicas;
    ParameterTexts texts;
    for (const auto& [name, text] : given) texts[plain_name(name)] = text;
    for (const Parameter& p : run_parameters)
        if (const auto found = texts.find(p.name); found != texts.end() && p.can_be_given()) {
            plan.axes.push_back({p.name, list_of_values(p.name, found->second)});
            texts.erase(found);
        }
    if (!texts.empty()) resolve(texts);  // says which is not known
    refuse_useless(plan);
    return plan;
}

SweepPlan grown(const SweepPlan& plan, const ParameterTexts& more, std::int64_t replicas,
                const std::vector<std::string>& measure) {
    SweepPlan larger = plan;
    for (const auto& [given, text] : more) {
        const std::string name = plain_name(given);
        const auto axis = std::find_if(larger.axes.begin(), larger.axes.end(),
                                       [&](const SweepAxis& a) { return a.name == name; });
        if (axis == larger.axes.end()) {
            resolve({{name, list_of_values(name, text).front()}});  // if it is none at all
            throw WrongCall(
                fmt::format("{} is no parameter of this sweep, whose points have its default; "
                            "another folder is "
                            "right for a sweep over it.",
                            option_name(name)));
        }
        for (const std::string& value : list_of_values(name, text))
            if (std::find(axis->values.begin(), axis->values.end(), value) == axis->values.end())
                axis->values.push_back(value);
    }
    if (replicas > 0 && replicas < plan.replicas)
        throw WrongCall(
            fmt::format("--seeds is {}, but the sweep has {} already; it can only grow.", replicas,
                        plan.replicas));
    larger.replicas = std::max(replicas, plan.replicas);
    for (const std::string& name : measure)
        if (std::find(larger.measure.begin(), larger.measure.end(), name) == larger.measure.end())
            larger.measure.push_back(name);
    if (larger.measure != plan.measure) ++larger.generation;
    refuse_useless(larger);
    if (size_of(larger) != size_of(plan)) larger.before.push_back(size_of(plan));
    larger.places = places_in(larger);
    return larger;
}

SweepPlan read_plan(const fs::path& folder) {
    const fs::path file = folder / "plan.json";
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        throw FileError(fmt::format("'{}' is not the folder of a sweep: it holds no plan.json.",
                                    folder.string()));
    const Json json = Json::parse(read_whole_file(file), nullptr, false);
    SweepPlan plan;
    try {
        if (json.at("format") != result_format)
            throw FileError(fmt::format("'{}' is in format {}, but this program reads format {}.",
                                        file.string(), json.at("format").dump(), result_format));
        for (const auto& [name, values] : json.at("axes").items())
            plan.axes.push_back({plain_name(name), values.get<std::vector<std::string>>()});
        plan.replicas = json.at("replicas").get<std::int64_t>();
        plan.measure = json.value("measure", std::vector<std::string>());
        plan.frames = json.value("frames", 0);
        plan.generation = json.value("generation", 1);
        for (const Json& stage : json.value("before", Json::array()))
            plan.before.push_back({stage.at("values").get<std::vector<std::size_t>>(),
                                   stage.at("replicas").get<std::int64_t>()});
    } catch (const nlohmann::json::exception&) {
        throw FileError(fmt::format("'{}' is damaged: it is no plan of a sweep.", file.string()));
    }
    for (const SweepAxis& axis : plan.axes)
        if (axis.values.empty())
            throw FileError(fmt::format("'{}' is damaged: {} has no values, but it must have one.",
                                        file.string(), axis.name));
    if (const double count = product(plan); !(count >= 1.0 && count <= double(most_points)))
        throw FileError(
            fmt::format("'{}' is damaged: it asks for {:.3g} runs with {} replicas of "
                        "each point, but from 1 to {} runs are possible.",
                        file.string(), count, plan.replicas, most_points));
    refuse_shrinking(file, plan);
    plan.places = places_in(plan);
    return plan;
}

void write_plan(const fs::path& folder, const SweepPlan& plan, bool grows) {
    std::error_code error;
    std::vector<fs::path> parts{part_of(folder, "results", plan), folder / "failures",
                                part_of(folder, "checkpoints", plan)};
    if (plan.frames > 0) parts.push_back(folder / "trajectories");
    for (const fs::path& part : parts)
        if (fs::create_directories(part, error); error)
            throw Failure(
                fmt::format("The folder '{}' cannot be made: {}.", part.string(), error.message()));
    if (grows || !fs::exists(folder / "plan.json")) {
        write_whole_file(folder / "plan.json", plan_json(plan).dump(1) + "\n");
        return;
    }
    if (read_plan(folder) != plan)
        throw Failure(
            fmt::format("'{}' holds another sweep (its plan.json says which); choose another "
                        "folder, go on with "
                        "that one by giving nothing but --out, or add to it with --grow.",
                        folder.string()));
}

SweepStatus sweep_status(const fs::path& folder, const SweepPlan& plan) {
    SweepStatus status;
    status.points = plan.points();
    const std::vector<bool> done =
        present(part_of(folder, "results", plan), ".json", status.points);
    const std::vector<bool> failed = present(folder / "failures", ".txt", status.points);
    const std::vector<bool> claimed = Claims::taken(folder, status.points);
    for (std::size_t point = 0; point < status.points; ++point) {
        if (done[point])
            ++status.done;
        else if (claimed[point])
            ++status.running;
        else if (failed[point])
            ++status.failed;
    }
    return status;
}

SweepOutcome run_sweep(const fs::path& folder, const SweepPlan& plan, const SweepShare& share,
                       const SweepControl& control) {
    for (const fs::path& part : {folder, part_of(folder, "results", plan), folder / "failures",
                                 part_of(folder, "checkpoints", plan)})
        remove_leftovers(part);
    return SweepWork(folder, plan, share, control)();
}

CollectedSweep collect_sweep(const fs::path& folder, const SweepPlan& plan) {
    const std::vector<bool> done =
        present(part_of(folder, "results", plan), ".json", plan.points());
    std::vector<PointResult> results(plan.points());
    constexpr std::size_t batch = 256;
    on_all_cores((results.size() + batch - 1) / batch, [&](std::size_t b) {
        for (std::size_t p = b * batch; p < std::min(results.size(), (b + 1) * batch); ++p)
            if (done[p]) results[plan.place(p)] = read_result(folder, plan, p);
    });
    std::vector<std::size_t> points(plan.places.empty() ? 0 : results.size());
    for (std::size_t p = 0; p < points.size(); ++p) points[plan.places[p]] = p;

    std::vector<std::string> columns, quantities(std::begin(estimators), std::end(estimators));
    std::vector<bool> is_direction;
    for (const SweepAxis& axis : plan.axes) columns.push_back(axis.name);
    columns.insert(columns.end(), {"replicas", "periods", "energy", "steady_state", "scatter"});
    if (const auto some = std::find_if(results.begin(), results.end(),
                                       [](const PointResult& r) { return r.there; });
        some != results.end()) {
        for (const MeasuredNumber& quantity : some->quantities)
            is_direction.push_back(quantity.direction);
        for (std::size_t k = quantities.size(); k < some->quantities.size(); ++k)
            quantities.push_back(some->quantities[k].name);
    }
    for (const std::string& name : quantities) {
        columns.push_back(name);
        columns.push_back(name + "_error");
    }
    columns.push_back("state_hash");
    CollectedSweep collected{.table = Table(columns)};
    for (const PointResult& result : results) {
        if (!result.there) continue;
        if (!result.has_whole_swirl) ++collected.without_swirl;
        collected.versions.insert(result.version);
    }

    const auto replicas = static_cast<std::size_t>(plan.replicas);
    for (const std::size_t of : rows_of(plan)) {
        const std::size_t first = of * replicas;
        std::vector<const PointResult*> there;
        for (std::size_t r = 0; r < replicas; ++r)
            if (results[first + r].there) there.push_back(&results[first + r]);
        const auto n = static_cast<double>(there.size());
        if (there.empty()) continue;
        std::vector<Table::Cell> row;
        const ParameterTexts texts = plan.parameters(points.empty() ? first : points[first]);
        for (const SweepAxis& axis : plan.axes) row.push_back(cell_of(texts.at(axis.name)));
        double periods = 0.0, energy = 0.0;
        std::string hashes;
        for (const PointResult* r : there) {
            periods += r->periods / n;
            energy += r->energy / n;
            hashes += r->state_hash;
        }
        row.emplace_back(std::int64_t(there.size()));
        row.emplace_back(periods);
        row.emplace_back(energy);
        row.emplace_back(steadiness_of(there));
        collected.not_steady += steadiness_of(there) == "steady" ? 0 : 1;
        const std::size_t place_of_scatter = row.size();
        row.emplace_back(not_known);
        for (std::size_t k = 0; k < quantities.size(); ++k) {
            std::vector<Estimate> found;
            for (const PointResult* r : there) found.push_back(r->quantity(k, quantities[k]));
            const SeveralRuns together =
                is_direction[k] ? several_directions(found) : several_runs(found);
            row.emplace_back(together.estimate.mean);
            row.emplace_back(together.estimate.error);
            if (quantities[k] != "by_time") continue;
            collected.rows.push_back({texts, together.estimate});
            row[place_of_scatter] = together.scatter;
            collected.disagreeing += together.disagree ? 1 : 0;
        }
        row.emplace_back(there.size() == 1 ? hashes : fmt::format("{:016x}", checksum(hashes)));
        collected.table.add(std::move(row));
    }
    return collected;
}

Table crossings_in(const SweepPlan& plan, const CollectedSweep& collected) {
    std::vector<std::string> others;
    for (const SweepAxis& axis : plan.axes)
        if (axis.name != "discs") others.push_back(axis.name);
    if (others.size() == plan.axes.size())
        throw WrongCall(
            "The rotation is to change its sign with the number of discs, but --discs is no "
            "parameter of this sweep.");
    std::vector<ParameterTexts> groups;  // in the order of the rows
    std::map<ParameterTexts, std::vector<RotationPoint>> curves;
    for (const CollectedRow& row : collected.rows) {
        ParameterTexts group = row.parameters;
        group.erase("discs");
        auto& curve = curves[group];
        if (curve.empty()) groups.push_back(group);
        curve.push_back({read_number(row.parameters.at("discs")).value_or(not_known),
                         row.by_time.mean, row.by_time.error});
    }
    std::vector<std::string> columns = others;
    for (const std::string& name : crossing_columns()) columns.push_back(name);
    columns.emplace_back("points");
    Table table(columns);
    for (const ParameterTexts& group : groups) {
        std::vector<Table::Cell> row;
        for (const std::string& name : others) row.push_back(cell_of(group.at(name)));
        const auto& curve = curves.at(group);
        add_crossing(row, find_crossing(curve));
        row.emplace_back(std::int64_t(curve.size()));
        table.add(std::move(row));
    }
    return table;
}

}  // namespace swirl
