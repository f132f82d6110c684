// Helpers of the file tests: a temporary folder, small scenes, frames of known values, and readers
// of other programs.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/math/random.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// A folder that is removed after the test.
class Scratch {
  public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "swirl-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Scratch(const Scratch&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
};

/// Writes without a sync.
inline void write_quickly(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// The paper's container with discs at random positions and small random velocities.
inline InitialState paper_container(int discs, std::uint64_t seed) {
    InitialState scene;
    const std::vector<double> radii(std::size_t(discs), 1.0);
    const auto positions = place_discs(radii, paper_container_radius, seed);
    Random random(seed + 1);
    scene.path = polygon_path(paper_amplitude, paper_period, paper_sides);
    scene.container_radius = paper_container_radius;
    for (const Vec2& position : *positions)
        scene.discs.push_back({position + scene.path.segments[0].start,
                               random.in_disc(0.1) + scene.path.segments[0].velocity, 0.0, 0.0, 0.0,
                               1.0, 1.0, paper_inertia});
    return scene;
}

/// Frame k with a different, known value for each quantity and disc.
inline Snapshot known_frame(std::size_t discs, std::uint64_t k) {
    Snapshot s;
    s.resize(discs);
    s.period = 11.866071;
    s.periods = std::int64_t(k / 8);
    s.clock = s.period * double(k % 8) / 8.0;
    s.container_radius = 8.6;
    s.container_centre = {0.1 * double(k), -0.2};
    s.container_velocity = {0.3, 0.4 + double(k)};
    for (std::size_t i = 0; i < discs; ++i) {
        const double u = double(i) + double(k) / 3.0;
        s.set(i, {{u / 7.0, -u / 11.0},
                  {u / 13.0, u / 17.0},
                  u / 19.0,
                  -u / 23.0,
                  s.clock,
                  i % 2 ? 1.0 : 1.25,
                  i % 2 ? 1.0 : 1.5625,
                  10.0 + double(i)});
    }
    return s;
}

/// known_frame() for spheres, with all spins and a different orientation for each.
inline Snapshot known_frame_of_spheres(std::size_t discs, std::uint64_t k) {
    Snapshot s = known_frame(discs, k);
    s.resize_for_spheres(discs);
    s.turned.resize(discs);
    s.on_floor = true;
    for (std::size_t i = 0; i < discs; ++i) {
        const double u = double(i) + double(k) / 3.0;
        s.set_floor_motion(i, {u / 29.0, -u / 31.0}, {0.0, 0.0});
        s.turned[i] = unit({1.0 + u, -2.0, 3.0 - u, 4.0});
    }
    return s;
}

/// Runs a command. Returns its output and its exit code (128 + n after signal n).
struct Ran {
    int code;
    std::string output;
};
inline Ran run_command(const std::string& command) {
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    std::string output;
    char block[4096];
    std::size_t got;
    while ((got = std::fread(block, 1, sizeof block, pipe)) > 0) output.append(block, got);
    const int status = ::pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output};
}

/// Reads a file with another program (independent_readers.py) and compares it with
/// known_frame(discs, 0 … frames − 1), or known_frame_of_spheres() for bodies "spheres". Skips the
/// test if that program is not installed.
#define EXPECT_READER_AGREES(reader, file, discs, frames, bodies)                               \
    do {                                                                                        \
        const auto ran = run_command(                                                           \
            "/usr/bin/python3 " SWIRL_SOURCE_DIR "/tests/io/independent_readers.py " +          \
            std::string(reader) + " '" + (file).string() + "' " + std::to_string(discs) + " " + \
            std::to_string(frames) + " " + std::string(bodies));                                \
        if (ran.code == 77) GTEST_SKIP() << ran.output;                                         \
        EXPECT_EQ(ran.code, 0) << ran.output;                                                   \
    } while (false)

}  // namespace swirl
