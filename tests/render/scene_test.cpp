#include "swirl/render/scene.hpp"

#include <gtest/gtest.h>

#include "pixels.hpp"
#include "swirl/render/sheet.hpp"

namespace swirl {
namespace {

SceneStyle plain_style() {
    SceneStyle style;
    style.orientation = false;
    style.points = false;
    style.path = false;
    return style;
}

View view_of(const Canvas& canvas, Frame frame) {
    return fitting_view({0.0, 0.0, double(canvas.size().width), double(canvas.size().height)},
                        frame, 8.6, 1.892);
}

/// The direction from `from` to `to` on the page, in radians counter-clockwise from the right.
double direction(const Vec2& from, const Vec2& to) {
    return std::atan2(-(to.y - from.y), to.x - from.x);
}

double turned_by(double from, double to) { return std::remainder(to - from, 2.0 * pi); }

TEST(Scene, DiscHasItsPositionAndSize) {
    Snapshot s = container(0.1);
    add_disc(s, {3.25, -2.5});
    Canvas canvas(Size{600, 600});
    const SceneStyle style = plain_style();
    const View view = view_of(canvas, Frame::lab);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {s});

    const Patch patch = patch_of(canvas, style.theme.disc);
    const Vec2 expected = view.on_page({3.25, -2.5});
    // The centroid of about 2000 pixels; the edge is symmetric.
    EXPECT_NEAR(patch.middle.x, expected.x, 0.1);
    EXPECT_NEAR(patch.middle.y, expected.y, 0.1);
    // The rim has another colour. With half of the blended edge it is at most 3 pixels wide.
    const double radius = view.pixels_per_unit;
    EXPECT_LT(patch.count, pi * radius * radius);
    EXPECT_GT(patch.count, pi * (radius - 3.0) * (radius - 3.0));
    EXPECT_TRUE(is(pixel(canvas, expected + Vec2{radius + 2.0, 0.0}), style.theme.floor));
}

TEST(Scene, DiscCirclingWithTheSwirlRestsInTheMFrame) {
    const SceneStyle style = plain_style();
    Canvas canvas(Size{400, 400});
    const View view = view_of(canvas, Frame::m);
    for (double turns : {0.0, 0.2, 0.55, 0.9}) {
        Snapshot s = container(turns);
        // Three units from C towards M.
        add_disc(s, (1.892 + 3.0) * unit_circle(turns));
        canvas.fill_page(style.theme.page);
        draw_scene(canvas, view, style, {s});
        const Patch patch = patch_of(canvas, style.theme.disc);
        EXPECT_NEAR(patch.middle.x, 200.0, 0.2) << turns;
        EXPECT_NEAR(patch.middle.y, 200.0 + 3.0 * view.pixels_per_unit, 0.2) << turns;
    }
}

TEST(Scene, OrientationMarkFollowsTheAngle) {
    SceneStyle style = plain_style();
    style.orientation = true;
    style.theme.disc = {1.0, 1.0, 1.0};
    Canvas canvas(Size{800, 800});
    const View view = view_of(canvas, Frame::lab);
    for (double angle : {0.0, 0.5, 1.7, 3.0, -2.0}) {
        Snapshot s = container(0.0);
        add_disc(s, {1.0, 2.0}, angle);
        canvas.fill_page(style.theme.page);
        draw_scene(canvas, view, style, {s});
        // Only the mark is dark within 0.8 of the radius.
        const Vec2 centre = view.on_page({1.0, 2.0});
        const double reach = 0.8 * view.pixels_per_unit;
        Vec2 dark{0.0, 0.0};
        for (int y = int(centre.y - reach); y <= centre.y + reach; ++y)
            for (int x = int(centre.x - reach); x <= centre.x + reach; ++x) {
                const Vec2 arm = Vec2{x + 0.5, y + 0.5} - centre;
                if (dot(arm, arm) > reach * reach) continue;
                dark = dark + (255.0 - pixel(canvas, x, y).red) * arm;
            }
        EXPECT_NEAR(turned_by(angle, direction({0.0, 0.0}, dark)), 0.0, 0.02) << angle;
    }
}

/// The pixel in the centre of a sphere with this orientation.
Pixel top_of_ball(const Quaternion& orientation) {
    Snapshot s = container(0.0);
    s.resize_for_spheres(1);
    s.set(0, {{2.0, 1.0}, {0.0, 0.0}, 0.0, 0.0, s.clock, 1.0, 1.0, 0.4});
    s.turned = {orientation};
    SceneStyle style = plain_style();
    style.orientation = true;
    Canvas canvas(Size{600, 600});
    const View view = view_of(canvas, Frame::lab);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {s});
    return pixel(canvas, view.on_page({2.0, 1.0}));
}

// Each pole has a dark dot. It is visible from above when the pole is up, and half a turn later,
// but not after a quarter turn.
TEST(Scene, PatternOfASphereRollsWithIt) {
    const Pixel up = top_of_ball({});
    const Pixel quarter = top_of_ball(turn_by(0.5 * pi + 0.3, 0.3, 0.0));
    const Pixel half = top_of_ball(turn_by(pi, 0.0, 0.0));
    EXPECT_GT(quarter.red + quarter.green + quarter.blue, 60 + up.red + up.green + up.blue);
    EXPECT_EQ(half.red, up.red);
    EXPECT_EQ(half.green, up.green);
}

TEST(Scene, DiscOfUnknownOrientationHasNoMark) {
    Snapshot s = container(0.0);
    add_disc(s, {0.0, 0.0}, std::nan(""));
    SceneStyle style = plain_style();
    style.orientation = true;
    Canvas marked(Size{300, 300}), plain(Size{300, 300});
    const View view = view_of(marked, Frame::lab);
    marked.fill_page(style.theme.page);
    draw_scene(marked, view, style, {s});
    style.orientation = false;
    plain.fill_page(style.theme.page);
    draw_scene(plain, view, style, {s});
    const auto a = marked.pixels(), b = plain.pixels();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
}

TEST(Scene, WallRestsInTheLabAndTurnsClockwiseInTheMFrame) {
    const SceneStyle style = plain_style();
    for (const Frame frame : {Frame::lab, Frame::m}) {
        double before = 0.0;
        for (int k = 0; k < 9; ++k) {
            const double turns = k / 8.0;
            const Snapshot s = container(turns);
            Canvas canvas(Size{500, 500});
            const View view = view_of(canvas, frame);
            canvas.fill_page(style.theme.page);
            draw_scene(canvas, view, style, {s});
            // One mark on the wall has the accent colour.
            const Vec2 centre = view.on_page(FrameTransform(s, frame).position(s.container_centre));
            const double now = direction(centre, patch_of(canvas, style.theme.accent).middle);
            const double step = turned_by(before, now);
            if (k > 0) {
                EXPECT_NEAR(step, frame == Frame::lab ? 0.0 : -2.0 * pi / 8.0, 0.02) << k;
            } else {
                EXPECT_NEAR(now, frame == Frame::lab ? 0.0 : -0.5 * pi, 0.02);
            }
            before = now;
        }
    }
}

TEST(Scene, MIsBelowCAndSAboveItInTheMFrame) {
    for (int k = 0; k < 16; ++k) {
        const Snapshot s = container(k / 16.0);
        const FrameTransform at = FrameTransform(s, Frame::m);
        const Vec2 m = s.container_centre + (8.6 / 1.892) * s.container_centre;
        EXPECT_NEAR(at.position(m).x, 0.0, 1e-14 * 20.0);
        EXPECT_NEAR(at.position(m).y, -8.6, 1e-14 * 20.0);
        EXPECT_NEAR(at.position({0.0, 0.0}).x, 0.0, 1e-14);
        EXPECT_NEAR(at.position({0.0, 0.0}).y, 1.892, 1e-14);
        // The same on the page, where y points down.
        const View view{Frame::m, {100.0, 100.0}, 10.0};
        EXPECT_GT(view.on_page(at.position(m)).y, 100.0);
    }
}

TEST(Scene, VelocityInTheMFrameIsTheDerivativeOfThePosition) {
    // A disc on a straight line in the lab. The error of the central difference is of order h².
    const Vec2 start{2.0, -1.0}, v{0.3, 0.7};
    const auto at = [&](double turns) {
        Snapshot s = container(turns);
        add_disc(s, start + (turns * s.period) * v);
        s.vx[0] = v.x;
        s.vy[0] = v.y;
        return s;
    };
    const double h = 1e-5;
    const Snapshot before = at(0.3 - h), now = at(0.3), after = at(0.3 + h);
    const Vec2 difference = FrameTransform(after, Frame::m).position(after.position(0)) -
                            FrameTransform(before, Frame::m).position(before.position(0));
    const Vec2 expected = (1.0 / (2.0 * h * now.period)) * difference;
    const Vec2 found = FrameTransform(now, Frame::m).velocity(now.position(0), now.velocity(0));
    EXPECT_NEAR(found.x, expected.x, 1e-7);
    EXPECT_NEAR(found.y, expected.y, 1e-7);
}

TEST(Scene, ColoursShowTheirQuantity) {
    Snapshot s = container(0.0);
    add_disc(s, {-3.0, 0.0}, 0.0, 1.0, -2.0);
    add_disc(s, {0.0, 0.0}, 0.0, 1.0, 0.0);
    add_disc(s, {3.0, 0.0}, 0.0, 1.0, 2.0);
    SceneStyle style = plain_style();
    style.full_spin = 2.0;
    style.full_speed = 1.0;
    s.vx = {0.0, 0.5, 4.0};
    const std::vector<std::uint8_t> pinned{1, 0, 1};
    Canvas canvas(Size{400, 400});
    const View view = view_of(canvas, Frame::lab);
    const auto expect = [&](Coloring coloring, const std::vector<Color>& colors) {
        style.coloring = coloring;
        canvas.fill_page(style.theme.page);
        draw_scene(canvas, view, style, {.now = s, .pinned = pinned});
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(is(pixel(canvas, view.on_page(s.position(i))), colors[i]))
                << int(coloring) << " " << i;
    };
    const Theme& t = style.theme;
    expect(Coloring::none, {t.disc, t.disc, t.disc});
    expect(Coloring::pinned, {t.pinned, t.loose, t.pinned});
    expect(Coloring::id, {distinct_colors[0], distinct_colors[1], distinct_colors[2]});
    expect(Coloring::spin, {t.against, t.neutral, t.with});
    expect(Coloring::speed, {sequential_color(0.0), sequential_color(0.5), sequential_color(1.0)});
}

TEST(Scene, TrailLeadsFromEarlierPositionsToTheDisc) {
    std::vector<Snapshot> past(9, container(0.0));
    for (int k = 0; k < 9; ++k) add_disc(past[k], {-6.0 + 0.5 * k, 1.0});
    Snapshot now = container(0.0);
    add_disc(now, {-1.5, 1.0});
    std::vector<const Snapshot*> pointers;
    for (const Snapshot& s : past) pointers.push_back(&s);
    const SceneStyle style = plain_style();
    Canvas canvas(Size{600, 600});
    const View view = view_of(canvas, Frame::lab);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {.now = now, .past = pointers});
    const auto strength = [&](double x) {
        return pixel(canvas, view.on_page({x, 1.0})).blue - 255.0 * style.theme.floor.blue;
    };
    EXPECT_GT(strength(-5.7), 10.0);
    EXPECT_GT(strength(-2.8), strength(-5.7));
    EXPECT_TRUE(is(pixel(canvas, view.on_page({0.0, 1.0})), style.theme.floor));
    EXPECT_TRUE(is(pixel(canvas, view.on_page({-4.0, 1.5})), style.theme.floor));
}

TEST(Scene, ForcesHaveTheirDirections) {
    Snapshot s = container(0.0);
    add_disc(s, {1.892, -4.0});  // position C + (0, −4)
    const FrameTransform at = FrameTransform(s, Frame::m);
    SceneStyle style = plain_style();
    style.forces = true;
    Canvas canvas(Size{700, 700});
    const View view = view_of(canvas, Frame::m);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {s});
    const Vec2 p = at.position(s.position(0)), swirl_centre = at.position({0.0, 0.0});
    const Vec2 v = at.velocity(s.position(0), s.velocity(0));
    const Vec2 tail = view.on_page(p);
    const auto page_angle = [](const Vec2& u) { return std::atan2(u.y, u.x); };
    const double centrifugal = direction(tail, patch_of(canvas, style.theme.centrifugal).middle);
    const double coriolis = direction(tail, patch_of(canvas, style.theme.coriolis).middle);
    EXPECT_NEAR(turned_by(page_angle(p - swirl_centre), centrifugal), 0.0, 0.05);
    EXPECT_NEAR(turned_by(page_angle(v) - 0.5 * pi, coriolis), 0.0, 0.05);
}

TEST(Scene, ArcOfTheTurnsRunsLeftForRotation) {
    const Snapshot s = container(0.25);
    const SceneStyle style = plain_style();
    Canvas canvas(Size{500, 500});
    const View view = fitting_view({0, 0, 500, 500}, Frame::lab, 8.6, 1.892, 0.1);
    const Vec2 centre = view.on_page(s.container_centre);
    for (const double turns : {0.2, -0.2, 1.2, -3.2}) {
        canvas.fill_page(style.theme.page);
        const bool clockwise = std::abs(turns) > 1.0;
        draw_scene(canvas, view, style, {.now = s, .turns = turns, .clockwise = clockwise});
        // Orange with the swirl, blue against it, like the spins.
        const double sign = (turns < 0.0) == clockwise ? 1.0 : -1.0;
        const Color color = style.theme.direction(sign > 0.0);
        EXPECT_GT(sign * (color.red - color.blue), 0.0);
        const Patch arc = patch_of(canvas, color);
        ASSERT_GT(arc.count, 100.0);
        // The arc covers 0.2 turns from the top, so its centroid is at about 0.1 turns. The
        // arrowhead shifts the centroid by up to 0.12 rad.
        const double expected = 0.5 * pi + (turns < 0.0 ? -1.0 : 1.0) * 0.1 * 2.0 * pi;
        EXPECT_NEAR(turned_by(expected, direction(centre, arc.middle)), 0.0, 0.12) << turns;
    }
}

TEST(Scene, WholeTurnsAreRingsBesideTheArc) {
    const Snapshot s = container(0.25);
    const SceneStyle style = plain_style();
    Canvas canvas(Size{1600, 1600});
    const View view = fitting_view({0, 0, 1600, 1600}, Frame::lab, 8.6, 1.892, 0.1);
    const Vec2 centre = view.on_page(s.container_centre);
    const auto count_of = [&](double turns) {
        canvas.fill_page(style.theme.page);
        draw_scene(canvas, view, style, {.now = s, .turns = turns});
        return patch_of(canvas, style.theme.with).count;
    };
    // The number next to the arc is +0.00, so there is no arrow.
    EXPECT_EQ(count_of(0.004), 0.0);
    EXPECT_GT(count_of(0.006), 0.0);
    // Below the centre there are only the rings, since the arc begins at the top.
    const auto rings = [&](double turns) {
        count_of(turns);
        int found = 0;
        bool inside = false;
        for (int y = static_cast<int>(centre.y); y < canvas.size().height; ++y) {
            const Pixel p = pixel(canvas, static_cast<int>(centre.x), y);
            const bool colored = p.red > p.blue + 20;
            found += colored && !inside;
            inside = colored;
        }
        return found;
    };
    EXPECT_EQ(rings(0.2), 0);
    EXPECT_EQ(rings(1.2), 1);
    EXPECT_EQ(rings(2.2), 2);
    EXPECT_EQ(rings(7.2), 3);
}

TEST(Scene, GhostsAreBelowTheDiscs) {
    Snapshot now = container(0.0), before = container(0.0);
    add_disc(now, {2.0, 0.0});
    add_disc(before, {-2.0, 0.0});
    const Snapshot* ghosts[] = {&before, &now};
    const SceneStyle style = plain_style();
    Canvas canvas(Size{400, 400});
    const View view = view_of(canvas, Frame::lab);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {.now = now, .ghosts = ghosts});
    EXPECT_TRUE(is(pixel(canvas, view.on_page({2.0, 0.0})), style.theme.disc));
    const Pixel faint = pixel(canvas, view.on_page({-2.0, 0.0}));
    EXPECT_GT(faint.blue, 255.0 * style.theme.floor.blue + 5.0);
    EXPECT_LT(faint.blue, 255.0 * style.theme.disc.blue - 50.0);
}

TEST(Scene, SliceIsAtItsAngle) {
    Snapshot s = container(0.4);
    SceneStyle style = plain_style();
    style.slice = 0.75 * pi;  // up and to the left
    Canvas canvas(Size{400, 400});
    const View view = view_of(canvas, Frame::m);
    canvas.fill_page(style.theme.page);
    draw_scene(canvas, view, style, {s});
    const auto green_over_red = [&](double x, double y) {
        const Pixel p = pixel(canvas, view.on_page({x, y}));
        return p.green - p.red;
    };
    EXPECT_GT(green_over_red(-4.0, 4.0), 30);
    EXPECT_LT(green_over_red(4.0, 4.0), 30);
    EXPECT_LT(green_over_red(-4.0, -4.0), 30);
}

TEST(Sheet, EverySizeCanBeDrawnInBothThemes) {
    Snapshot s = container(0.3);
    add_disc(s, {0.0, 0.0});
    const std::vector<Vec2> path{{1.892, 0.0}, {0.0, 1.892}, {-1.892, 0.0}, {0.0, -1.892}};
    for (const Theme& theme : {dark_theme(), light_theme()}) {
        for (const Size size : {Size{16, 16}, Size{64, 48}, Size{17, 400}, Size{1920, 1080},
                                Size{8192, 64}, Size{33, 2000}}) {
            SheetSpec spec;
            spec.size = size;
            spec.style.theme = theme;
            spec.style.coloring = Coloring::spin;
            spec.title = "A title that is far too long for a narrow page and continues";
            spec.parameters = {"$N$ = 48", "$μ_{d}$ = 1"};
            spec.panels = {{Frame::lab, "lab frame", 8.6, 1.892},
                           {Frame::m, "M-frame", 8.6, 1.892}};
            spec.plot =
                PlotStyle{.from = 0.0, .to = 1.0, .lowest = -1.0, .highest = 1.0, .em = 1.0};
            const Sheet sheet(spec);
            Canvas canvas(size);
            sheet.draw_static(canvas);
            const std::vector<SceneContent> contents{{s, path}, {s, path}};
            sheet.draw_frame(canvas, contents, {}, 0.3);
            EXPECT_EQ(cairo_status(canvas.cairo()), CAIRO_STATUS_SUCCESS);
            EXPECT_TRUE(is(pixel(canvas, 0, 0), theme.page));
            EXPECT_GT(patch_of(canvas, theme.floor).count, 0.0) << size.width << "x" << size.height;
        }
    }
}

TEST(Sheet, FrameDoesNotDependOnEarlierFramesOfTheCanvas) {
    // Workers draw frames of a movie in any distribution, so a frame may be the first or the
    // hundredth of its canvas, and its bytes must be the same.
    Snapshot s = container(0.3), before = container(0.25);
    add_disc(s, {1.0, 2.0}, 0.4);
    add_disc(before, {0.5, 2.0}, 0.2);
    const Snapshot* past[] = {&before};
    const std::vector<Vec2> path{{1.892, 0.0}, {0.0, 1.892}, {-1.892, 0.0}, {0.0, -1.892}};
    SheetSpec spec;
    spec.size = {400, 300};
    spec.style.forces = true;
    spec.title = "A title";
    spec.panels = {{Frame::lab, "lab frame", 8.6, 1.892, true}, {Frame::m, "M-frame", 8.6, 1.892}};
    spec.plot = PlotStyle{.from = 0.0, .to = 1.0, .lowest = -1.0, .highest = 1.0, .em = 1.0};
    const Sheet sheet(spec);
    const std::vector<SceneContent> contents{{.now = s, .path = path, .past = past, .turns = 0.3},
                                             {.now = s, .path = path}};
    const auto draw = [&](Canvas& canvas) {
        sheet.draw_static(canvas);
        sheet.draw_frame(canvas, contents, {}, 0.3);
    };
    Canvas fresh(spec.size), used(spec.size);
    draw(fresh);
    draw(used);
    draw(used);
    const auto a = fresh.pixels(), b = used.pixels();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
}

TEST(Sheet, ContainersHaveOneScaleAndDoNotOverlap) {
    SheetSpec spec;
    spec.panels = {{Frame::lab, "", 8.6, 1.892}, {Frame::m, "", 8.6, 1.892}};
    const Sheet sheet(spec);
    EXPECT_EQ(sheet.view(0).pixels_per_unit, sheet.view(1).pixels_per_unit);
    const double reach = 8.6 * (1.0 + wall_thickness);
    EXPECT_GT(sheet.view(1).centre.x - sheet.view(0).centre.x,
              (2.0 * reach + 1.892) * sheet.view(0).pixels_per_unit);
}

TEST(Sheet, NumbersOfTurnsCaptionsAndClockDoNotTouch) {
    const Snapshot s = container(0.3);
    const auto drawn = [](const Pixel& p, const Pixel& page) {
        return p.red != page.red || p.green != page.green || p.blue != page.blue;
    };
    for (const Size size : {Size{440, 276}, Size{640, 480}, Size{1280, 720}, Size{500, 900}}) {
        SheetSpec spec;
        spec.size = size;
        spec.parameters = {"$N$ = 48"};
        spec.panels = {{Frame::lab, "20 discs", 8.6, 1.892, true},
                       {Frame::lab, "48 discs", 8.6, 1.892, true}};
        const Sheet sheet(spec);
        // The canvas of the frame has no page, so only what changes in time is drawn on it.
        Canvas fixed(size), moving(size);
        sheet.draw_static(fixed);
        const std::vector<SceneContent> contents{{.now = s, .turns = 12.34},
                                                 {.now = s, .turns = -12.53}};
        sheet.draw_frame(moving, contents, {}, 123.45);
        const Pixel page = pixel(fixed, 0, 0);
        int touching = 0;
        // Four pixels are a third of a letter on the smallest page.
        for (int y = 0; y < size.height; ++y)
            for (int x = 4; x < size.width - 4; ++x)
                for (int k = -4; k <= 4 && drawn(pixel(fixed, x, y), page); ++k)
                    touching += drawn(pixel(moving, x + k, y), {0, 0, 0});
        EXPECT_EQ(touching, 0) << size.width << "x" << size.height;
    }
}

TEST(Sheet, ShortTitleLeavesMoreSpaceForContainers) {
    const auto scale = [](const std::string& title) {
        SheetSpec spec;
        spec.size = {1280, 720};
        spec.title = title;
        spec.style.points = false;  // their legend takes a line
        spec.parameters = {"$N$ = 48"};
        spec.panels = {{Frame::lab, "lab frame", 8.6, 1.892}, {Frame::m, "M-frame", 8.6, 1.892}};
        spec.plot = PlotStyle{.from = 0.0, .to = 1.0, .lowest = -1.0, .highest = 1.0, .em = 1.0};
        return Sheet(spec).view(0).pixels_per_unit;
    };
    const double short_title = scale("48 discs");
    EXPECT_GT(short_title, 1.05 * scale("A title that is too long for the line of the captions"));
    EXPECT_GT(2.0 * 8.6 * short_title, 0.54 * 720);
}

TEST(Sheet, LegendFitsOnThePage) {
    for (const int width : {200, 320, 1280}) {
        SheetSpec spec;
        spec.size = {width, 900};
        spec.style.coloring = Coloring::spin;
        spec.style.forces = true;
        spec.panels = {{Frame::m, "M-frame", 8.6, 1.892}};
        const Sheet sheet(spec);
        Canvas canvas(spec.size);
        sheet.draw_static(canvas);
        for (int y = 0; y < 900; ++y)
            EXPECT_TRUE(is(pixel(canvas, width - 1, y), spec.style.theme.page)) << width;
    }
}

TEST(Scene, PointsHaveLettersInASmallContainer) {
    Canvas canvas(Size{220, 220});
    canvas.fill_page(dark_theme().page);
    const View view = view_of(canvas, Frame::m);
    const Snapshot s = container(0.0);
    SceneStyle style = plain_style();
    style.points = true;
    draw_scene(canvas, view, style, {.now = s});
    const double unit = view.pixels_per_unit * 8.6;
    EXPECT_LT(unit, 110.0);
    // The letter S is to the left of its cross.
    const Vec2 S = view.on_page(FrameTransform(s, Frame::m).position({0.0, 0.0}));
    int ink = 0;
    for (int x = int(S.x - 15.0); x < int(S.x - 0.03 * unit - 2.0); ++x)
        for (int y = int(S.y - 16.0); y < int(S.y); ++y) ink += pixel(canvas, x, y).green > 150;
    EXPECT_GT(ink, 15);
}

TEST(Theme, InkHasContrastToThePage) {
    for (const Theme& theme : {dark_theme(), light_theme()}) {
        const double contrast = std::abs(brightness(theme.ink) - brightness(theme.page));
        EXPECT_GT(contrast, 0.75);
        EXPECT_GT(std::abs(brightness(theme.faint_ink) - brightness(theme.page)), 0.4);
        EXPECT_GT(std::abs(brightness(theme.pinned) - brightness(theme.loose)), 0.05);
    }
}

}  // namespace
}  // namespace swirl
