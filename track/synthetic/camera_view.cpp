#include "track/synthetic/camera_view.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr double rim_width = 0.35;  // disc radii
constexpr int waves_per_texture = 14;

struct Preset {
    const char* name;
    CameraSettings settings;
};

std::vector<Preset> presets() {
    CameraSettings phone, bad, steel, student;
    phone.size = {568, 520}, phone.scale = 21.0, phone.frames_per_period = 128;
    phone.glare = 70.0, phone.distortion = 0.03, phone.noise = 4.0, phone.blur = 1.0;
    phone.exposure = 0.25, phone.flicker = 0.03, phone.table = 150.0;
    bad.size = {400, 400}, bad.scale = 15.0, bad.frames_per_period = 32;
    bad.disc = 125.0, bad.floor = 70.0, bad.rim = 105.0, bad.gloss = 50.0, bad.texture = 0.2;
    bad.ambient = 0.7, bad.diffuse = 0.3, bad.noise = 5.0, bad.blur = 1.3, bad.exposure = 0.35;
    bad.flicker = 0.04;
    steel.size = {600, 600}, steel.scale = 21.0, steel.frames_per_period = 128;
    steel.table = 170.0, steel.floor = 215.0, steel.rim = 90.0, steel.disc = 55.0;
    steel.gloss = 200.0, steel.shininess = 25.0, steel.texture = 0.2, steel.glare = 20.0;
    steel.noise = 3.0, steel.blur = 0.9, steel.exposure = 0.2;
    // 30 frames per second at 2 periods per second.
    student.size = {640, 480}, student.scale = 20.0, student.frames_per_period = 15;
    student.noise = 3.0, student.blur = 0.9, student.exposure = 0.15, student.flicker = 0.01;
    student.table = 150.0, student.gloss = 60.0;
    return {
        {"laboratory", {}}, {"phone", phone}, {"bad", bad}, {"steel", steel}, {"student", student}};
}

constexpr double coin_edge = 0.88;  // radii: the raised edge begins

/// Between −1 and 1, well mixed, for each disc.
double variation_of(std::size_t disc) {
    constexpr double golden = 0.61803398875;
    const double turns = golden * double(disc + 1);
    return 2.0 * (turns - std::floor(turns)) - 1.0;
}

/// The floor through a glass sphere at this distance from its centre, in radii: dark at the edge,
/// where light is reflected away.
double seen_through(double floor, double distance) {
    const double square = distance * distance;
    return floor * (1.15 - 0.75 * square * square * square);
}

Rotation product(const Rotation& a, const Rotation& b) {
    Rotation c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return c;
}

/// Approximately normal with variance 1: the sum of four uniform numbers.
double nearly_normal(Random& random) {
    const std::uint64_t bits = random.bits();
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += double((bits >> (16 * k)) & 0xffff);
    constexpr double root_3 = 1.7320508;  // 1 over the standard deviation of the sum
    return (sum / 65536.0 - 2.0) * root_3;
}

}  // namespace

std::array<double, 3> light_direction(double from, double elevation) {
    const Vec2 side = unit_circle(from / 360.0), rise = unit_circle(elevation / 360.0);
    return {rise.x * side.x, rise.x * side.y, rise.y};
}

std::optional<CameraSettings> camera_preset(const std::string& name) {
    for (const Preset& preset : presets())
        if (preset.name == name) return preset.settings;
    return std::nullopt;
}

std::vector<std::string> camera_presets() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.emplace_back(preset.name);
    return names;
}

CameraView::CameraView(const CameraSettings& settings)
    : settings_(settings),
      middle_{0.5 * (settings.size.width - 1), 0.5 * (settings.size.height - 1)},
      random_(settings.seed) {
    centre_ = settings.centre.value_or(middle_);
    const Vec2 side = unit_circle(settings.towards / 360.0);
    side_ = {side.x, -side.y};
    nearness_ = std::tan(settings.view_angle * pi / 360.0) / (0.5 * settings.size.height);
    const double tilt = settings.tilt * pi / 180.0;
    lean_at_middle_ = std::tan(tilt) * side_;
    lean_per_pixel_ = nearness_ / std::cos(tilt);
    const std::size_t pixels = std::size_t(settings.size.width) * std::size_t(settings.size.height);
    grain_.resize(pixels);
    for (float& g : grain_) g = float(nearly_normal(random_));
    exposed_ = grain_;
    blur(exposed_);  // unblurred grain of one pixel would be noise
    grain_ = exposed_;
    positions_.resize(pixels);
    std::size_t at = 0;
    for (int row = 0; row < settings.size.height; ++row)
        for (int column = 0; column < settings.size.width; ++column)
            positions_[at++] = middle_ + in_plane(undistorted({double(column), double(row)}));
    image_.resize(pixels);
}

Vec2 CameraView::undistorted(const Vec2& seen) const {
    const Vec2 q = seen - middle_;
    const double half = 0.5 * settings_.size.height;
    return (1.0 + settings_.distortion * dot(q, q) / (half * half)) * q;
}

Vec2 CameraView::in_plane(const Vec2& undistorted) const {
    if (settings_.tilt == 0.0) return undistorted;
    const double angle = settings_.tilt * pi / 180.0;
    const Vec2 across = perpendicular(side_);
    const double a = dot(undistorted, side_), b = dot(undistorted, across);
    const double u = a / (std::cos(angle) + a * std::sin(angle) * nearness_);
    return u * side_ + (b * (1.0 - u * std::sin(angle) * nearness_)) * across;
}

Vec2 CameraView::lean(const Vec2& ideal) const {
    return lean_at_middle_ - lean_per_pixel_ * (ideal - middle_);
}

Vec2 CameraView::seen(const Vec2& ideal) const {
    constexpr int iterations = 60;  // of a fixed point
    Vec2 p = ideal;
    for (int k = 0; k < iterations; ++k) p = p + (ideal - middle_ - in_plane(undistorted(p)));
    return p;
}

Vec2 CameraView::ideal(const Vec2& lab) const {
    return centre_ + settings_.scale * Vec2{settings_.mirrored ? -lab.x : lab.x, -lab.y};
}

void CameraView::rotate_discs(const Snapshot& s) {
    const std::size_t known = orientations_.size();
    for (std::size_t i = known; i < s.size(); ++i) {
        const double azimuth = 2.0 * pi * random_.uniform(), turn = 2.0 * pi * random_.uniform();
        orientations_.push_back(
            rotation_by({turn * std::cos(azimuth), turn * std::sin(azimuth), 0.3 * turn}));
        rotation_.push_back({0.0, 0.0, 0.0});
        last_angle_.push_back(s.orientation(i));
        std::vector<Wave> waves;
        for (int k = 0; k < waves_per_texture; ++k) {
            const Vec2 a = random_.in_disc(7.0), b = random_.in_disc(7.0);
            waves.push_back({{a.x, a.y, b.x}, 2.0 * pi * random_.uniform()});
        }
        textures_.push_back(waves);
    }
    if (known == 0) return;
    const double step = s.period / double(settings_.frames_per_period);
    for (std::size_t i = 0; i < s.size(); ++i) {
        std::array<double, 3> w{0.0, 0.0, s.orientation(i) - last_angle_[i]};
        last_angle_[i] = s.orientation(i);
        if (s.are_spheres()) {
            w[0] = s.spin_x[i] * step;
            w[1] = s.spin_y[i] * step;
        } else if (settings_.rolls) {
            const Vec2 v = s.velocity(i) - s.container_velocity;
            w[0] = -v.y / s.radius[i] * step;
            w[1] = v.x / s.radius[i] * step;
        }
        rotation_[i] = w;
        orientations_[i] = product(rotation_by(w), orientations_[i]);
    }
}

std::vector<double> CameraView::delays() const {
    constexpr int steps = 16;  // of a rolling shutter: discs hardly turn in between
    if (settings_.interlaced) return {-0.25, 0.0, 0.25};
    std::vector<double> all;
    for (int k = 0; k <= steps; ++k)
        all.push_back(settings_.rolling_shutter * (double(k) / steps - 0.5));
    return settings_.rolling_shutter > 0.0 ? all : std::vector<double>{0.0};
}

Vec2 CameraView::at_row(const std::vector<Vec2>& way, int row) const {
    if (settings_.interlaced) return row % 2 == 0 ? way.front() : way.back();
    const double at = double(way.size() - 1) * row / settings_.size.height;
    const auto k = std::size_t(at);
    return k + 1 < way.size() ? way[k] + (at - double(k)) * (way[k + 1] - way[k]) : way[k];
}

double CameraView::floor_level(const Vec2& from_container) const {
    if (settings_.floor_pattern == 0.0) return settings_.floor;
    const double square = 1.3 * settings_.scale;
    const bool odd =
        (std::lround(from_container.x / square) + std::lround(from_container.y / square)) % 2 != 0;
    return settings_.floor + (odd ? 0.5 : -0.5) * settings_.floor_pattern;
}

void CameraView::draw_background(const std::vector<Vec2>& container, double radius,
                                 std::vector<float>& light) const {
    const double inner = radius * settings_.scale, outer = inner + rim_width * settings_.scale;
    const double height = settings_.rim_height * settings_.scale;
    for (std::size_t k = 0; k < light.size(); ++k) {
        const int row = int(k / std::size_t(settings_.size.width));
        const Vec2 d = positions_[k] + height * lean(positions_[k]) - at_row(container, row);
        const double distance = std::sqrt(dot(d, d));
        double level = floor_level(d);
        if (distance > inner - 1.0) {
            // The wall is brighter on the side of the light.
            const double wall = settings_.rim * (1.0 + 0.3 * (d.x - d.y) / (1.42 * distance));
            const double in = std::clamp(distance - inner + 0.5, 0.0, 1.0);
            const double out = std::clamp(distance - outer + 0.5, 0.0, 1.0);
            level = (1.0 - in) * level + (in - out) * wall + out * settings_.table;
        }
        light[k] = float(level + settings_.clutter * grain_[k]);
    }
}

void CameraView::draw_disc(const std::vector<Vec2>& way, double radius, const Rotation& orientation,
                           std::size_t i, std::vector<float>& light) const {
    const double a = radius * settings_.scale;
    const Vec2 centre = way[way.size() / 2], around = seen(centre);
    double farthest = 0.0;
    for (const Vec2& p : way) farthest = std::max(farthest, std::sqrt(dot(p - centre, p - centre)));
    const int reach = int(std::ceil(a * 1.4 + farthest)) + 2;
    const int left = std::max(0, int(around.x) - reach);
    const int right = std::min(settings_.size.width - 1, int(around.x) + reach);
    const int top = std::max(0, int(around.y) - reach);
    const int bottom = std::min(settings_.size.height - 1, int(around.y) + reach);
    // y points up here, and down in the image.
    const auto [lx, ly, lz] = settings_.light;
    const Vec2 leaning = lean(centre);
    const double upright = 1.0 / std::sqrt(1.0 + dot(leaning, leaning));
    const double ex = upright * leaning.x, ey = -upright * leaning.y,
                 ez = upright;  // direction to the camera
    const double half =
        std::sqrt((lx + ex) * (lx + ex) + (ly + ey) * (ly + ey) + (lz + ez) * (lz + ez));
    const double side = settings_.mirrored ? -1.0 : 1.0;
    const double base = i % 2 == 1 ? settings_.other_disc.value_or(settings_.disc) : settings_.disc;
    const double own = base * (1.0 + settings_.disc_variation * variation_of(i));
    for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column) {
            const std::size_t k =
                std::size_t(row) * std::size_t(settings_.size.width) + std::size_t(column);
            const Vec2 d = positions_[k] - at_row(way, row);
            // Distance of the line of sight from the disc's centre.
            const double along = d.x * ex - d.y * ey;
            const double distance = std::sqrt(std::max(0.0, dot(d, d) - along * along));
            const double cover = std::clamp(a - distance + 0.5, 0.0, 1.0);
            if (cover <= 0.0) continue;
            const double up = std::sqrt(std::max(0.0, a * a - distance * distance)) - along;
            const double nx = (d.x + up * ex) / a, ny = (up * ey - d.y) / a, nz = up * ez / a;
            // To the disc's axes: the inverse of its orientation is the transpose.
            const double mx = side * nx;
            const double ox = orientation[0] * mx + orientation[3] * ny + orientation[6] * nz;
            const double oy = orientation[1] * mx + orientation[4] * ny + orientation[7] * nz;
            const double oz = orientation[2] * mx + orientation[5] * ny + orientation[8] * nz;
            double pattern = 0.0;
            if (settings_.texture > 0.0) {
                for (const Wave& wave : textures_[i])
                    pattern += double(std::cos(
                        float(wave.k[0] * ox + wave.k[1] * oy + wave.k[2] * oz + wave.phase)));
                pattern *= std::sqrt(2.0 / waves_per_texture);
            }
            const double albedo = own * (1.0 + settings_.texture * 0.6 * pattern);
            double lit =
                settings_.ambient + settings_.diffuse * std::max(0.0, nx * lx + ny * ly + nz * lz);
            if (settings_.flat) lit = distance > coin_edge * a ? 1.2 : 1.0;
            const double mirror =
                std::max(0.0, (nx * (lx + ex) + ny * (ly + ey) + nz * (lz + ez)) / half);
            double level = albedo * lit;
            if (settings_.transparency > 0.0)
                level += settings_.transparency * (seen_through(light[k], distance / a) - level);
            if (mirror > 0.7 && !settings_.flat)
                level += settings_.gloss * std::pow(mirror, 4.0 * settings_.shininess);
            light[k] = float((1.0 - cover) * light[k] + cover * level);
        }
}

/// The hand comes from the right, and is drawn back in the last of its frames.
void CameraView::draw_hand() {
    const std::int64_t from_end =
        std::min(frame_, std::max<std::int64_t>(settings_.frames - 1 - frame_, 0));
    if (from_end >= settings_.hand_frames) return;
    constexpr double skin = 90.0;  // grey level
    const double inside = 1.0 - double(from_end) / double(settings_.hand_frames);
    const double width = settings_.size.width, half_height = 0.5 * settings_.size.height;
    const double tip = width * (1.0 - 0.45 * inside), thick = 0.3 * half_height;
    for (int row = 0; row < settings_.size.height; ++row)
        for (int column = 0; column < settings_.size.width; ++column) {
            const Vec2 d{std::min(0.0, column - tip - thick), row - 1.1 * half_height};
            if (dot(d, d) < thick * thick)
                exposed_[std::size_t(row) * std::size_t(settings_.size.width) +
                         std::size_t(column)] = float(skin);
        }
}

/// A soft shadow, as of a person, that goes to and fro along the lower edge of the image.
void CameraView::draw_shadow() {
    constexpr double there_and_back = 2.3;  // periods
    const double turns = double(frame_) / (there_and_back * double(settings_.frames_per_period));
    const double wide = 0.2 * settings_.size.height;
    const Vec2 centre{settings_.size.width * (0.5 - 0.4 * std::cos(2.0 * pi * turns)),
                      0.95 * settings_.size.height};
    for (std::size_t k = 0; k < exposed_.size(); ++k) {
        const Vec2 d = positions_[k] - centre;
        exposed_[k] -= float(settings_.shadow * std::exp(-dot(d, d) / (2.0 * wide * wide)));
    }
}

double CameraView::brightness() {
    constexpr double adjustment = 1.7;  // periods of the slow variation
    const double slow =
        std::sin(2.0 * pi * double(frame_) / (adjustment * double(settings_.frames_per_period)));
    return (1.0 + settings_.flicker * nearly_normal(random_)) *
           (1.0 + settings_.auto_exposure * slow);
}

/// Seen at an angle, discs hide those behind them: the most distant discs are drawn first.
void CameraView::sort_by_distance(const Snapshot& s) {
    order_.resize(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) order_[i] = i;
    if (settings_.tilt == 0.0 && settings_.view_angle == 0.0) return;
    const auto distance = [&](std::size_t i) {
        const Vec2 leaning = lean(ideal(s.position(i)));
        return dot(leaning, leaning);
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) > distance(b); });
}

/// Convolves with a Gaussian, first along rows, then along columns.
void CameraView::blur(std::vector<float>& light) const {
    if (!(settings_.blur > 0.05)) return;
    const int reach = int(std::ceil(3.0 * settings_.blur));
    std::vector<float> weights(std::size_t(2 * reach + 1));
    float sum = 0.0f;
    for (int k = -reach; k <= reach; ++k)
        sum += weights[std::size_t(k + reach)] =
            float(std::exp(-0.5 * k * k / (settings_.blur * settings_.blur)));
    const int width = settings_.size.width, height = settings_.size.height;
    const auto pass = [&](const std::vector<float>& from, std::vector<float>& into, int x, int y) {
        for (int row = 0; row < height; ++row)
            for (int k = -reach; k <= reach; ++k) {
                const float weight = weights[std::size_t(k + reach)] / sum;
                const int at = row * width, of = std::clamp(row + k * y, 0, height - 1) * width;
                for (int column = 0; column < width; ++column)
                    into[std::size_t(at + column)] +=
                        weight * from[std::size_t(of + std::clamp(column + k * x, 0, width - 1))];
            }
    };
    std::vector<float> blurred_rows(light.size(), 0.0f);
    pass(light, blurred_rows, 1, 0);
    std::fill(light.begin(), light.end(), 0.0f);
    pass(blurred_rows, light, 0, 1);
}

const std::vector<std::uint8_t>& CameraView::render(const std::vector<Snapshot>& states) {
    const Snapshot& s = states[states.size() / 2];
    rotate_discs(s);
    sort_by_distance(s);
    // Discs move on straight lines during the exposure: one sample per pixel of their way.
    const double open = settings_.exposure * s.period / double(settings_.frames_per_period);
    double fastest = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i)
        fastest = std::max(fastest, dot(s.velocity(i), s.velocity(i)));
    const int exposures = std::clamp(int(std::sqrt(fastest) * open * settings_.scale + 0.8), 1, 9);
    std::vector<Vec2> way(states.size());
    exposed_.assign(image_.size(), 0.0f);
    light_.resize(image_.size());
    for (int e = 0; e < exposures; ++e) {
        const double after = open * ((e + 0.5) / exposures - 0.5);
        const auto set_way = [&](const auto& position) {
            for (std::size_t n = 0; n < way.size(); ++n) way[n] = ideal(position(states[n]));
        };
        set_way([&](const Snapshot& at) {
            return at.container_centre + after * at.container_velocity;
        });
        draw_background(way, s.container_radius, light_);
        for (const std::size_t i : order_) {
            set_way([&](const Snapshot& at) { return at.position(i) + after * at.velocity(i); });
            draw_disc(way, s.radius[i], orientations_[i], i, light_);
        }
        for (std::size_t k = 0; k < light_.size(); ++k) exposed_[k] += light_[k] / float(exposures);
    }
    if (settings_.glare > 0.0) {
        const Vec2 spot{0.62 * settings_.size.width, 0.33 * settings_.size.height};
        const double wide = 0.12 * settings_.size.height;
        for (std::size_t k = 0; k < exposed_.size(); ++k) {
            const Vec2 d = positions_[k] - spot;
            const double far = dot(d, d) / (2.0 * wide * wide);
            if (far < 12.0) exposed_[k] += float(settings_.glare * std::exp(-far));
        }
    }
    if (settings_.shadow > 0.0) draw_shadow();
    if (settings_.hand_frames > 0) draw_hand();
    blur(exposed_);
    const double illumination = brightness();
    ++frame_;
    for (std::size_t k = 0; k < exposed_.size(); ++k) {
        const double level =
            illumination * double(exposed_[k]) + settings_.noise * nearly_normal(random_);
        image_[k] = std::uint8_t(std::clamp(level + 0.5, 0.0, 255.0));
    }
    return image_;
}

}  // namespace swirl
