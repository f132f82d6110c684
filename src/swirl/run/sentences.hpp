// The English sentences of the errors that a run can have, one for each code. The program prints
// them (message.hpp). The browser page has a sentence in each of its other languages, with the same
// codes and values (web/src/texts/texts.engine.de.json).
//
// {name} stands for a value. {name|one|several} is the first text if the value is 1. A hint begins
// with a line break. The sentence of a phrase is a part of another sentence.
#pragma once

#include <string_view>

namespace swirl {

struct Sentence {
    const char* code;
    const char* english;
};

// clang-format off
inline constexpr Sentence sentences[] = {
    // Words of a value.
    {"not_a_number", "{name} is '{text}', but it must be a finite number, for example 0.5 or 1e3."},
    {"not_whole",
     "{name} is '{text}', but it must be a whole number below 10^18, for example 48 or 1e6."},
    {"not_a_seed",
     "{name} is '{text}', but it must be a whole number from 0 to 18446744073709551615."},
    {"negative", "{name} is '{text}', but it must be 0 or more."},
    {"not_a_choice", "{name} is '{text}', but it must be {choices}."},
    {"not_a_floor",
     "{name} is '{text}', but it must be none or sliding: on a perfectly rough floor spheres would "
     "collide without end.\nhint: a large --floor-friction, 100 for example, has the same effect."},
    {"not_an_inertia",
     "{name} is '{text}', but it must be a number above 0, or paper (10 m r^2), ring (m r^2), solid "
     "(m r^2 / 2), sphere (2/5 m r^2) or shell (2/3 m r^2)."},
    {"not_a_mixture",
     "{name} is '{text}', but it must be COUNT:RADIUS or COUNT:RADIUS:MASS, for example 12:1.4 for "
     "twelve discs of radius 1.4 or 25%:1.4 for a quarter of the discs."},
    {"not_a_speed", "{name} is '{text}', but it must be from 0 (a container at rest) to 1e6."},
    {"not_a_warmup",
     "{name} is '{text}', but it must be a whole number of periods, for example 20, or auto."},
    {"out_of_range", "{name} is {value}, but it must be a number from {from} to {to}."},
    {"out_of_whole_range", "{name} is {value}, but it must be a whole number from {from} to {to}."},

    // Which parameters are given.
    {"unknown_parameter", "there is no parameter '{name}'."},
    {"given_twice", "{name} is given twice."},
    {"two_lengths",
     "--events {events} and --periods {periods} both set the length of the run.\n"
     "hint: omit one of them."},
    {"smooth_wall",
     "--frictionless is wall, but --mu-wall is {value}.\nhint: omit one of the two."},
    {"preset_needs_gravity",
     "--preset {preset} needs --gravity with {given}: its gravity is that for r = 1 and a container "
     "speed of 1.\nhint: give lengths and times with units, such as 3mm and 0.532s (gravity is then "
     "9.81 m/s2), or add --gravity."},
    {"speed_contradicts",
     "--speed is {speed}, but --amplitude {amplitude} and --period {period} give a speed of "
     "{actual}.\nhint: omit one of the three."},
    {"speed_is_zero",
     "--speed is {speed}, but with --amplitude {amplitude} the container moves.\n"
     "hint: set both to 0, or neither."},
    {"speed_at_rest",
     "--speed is {speed}, but with --amplitude {amplitude} the container is at rest.\n"
     "hint: set both to 0, or neither."},
    {"circle_has_no_sides",
     "--sides is {sides}, but --motion circle has no sides.\nhint: omit one of the two."},
    {"path_has_its_sides",
     "--sides is {sides}, but the file of --motion defines its segments.\n"
     "hint: omit one of the two."},
    {"ramp_without_floor",
     "--ramp changes {name}, but there is no floor.\nhint: add --floor sliding."},
    {"no_floor", "{name} is {text}, but there is no floor.\nhint: add --floor sliding."},
    {"only_for_spheres",
     "{name} is {value}, but it is for spheres only.\nhint: add --body sphere."},
    {"frictionless_only_discs",
     "--frictionless is only for discs without a floor.\n"
     "hint: use --mu-disc 0 or --mu-wall 0."},
    {"unit_of_radius",
     "--length-unit is {unit}, which is what the radius is, but --radius is {radius} instead of 1.\n"
     "hint: give values with units, such as --radius 3mm."},

    // Values that depend on others.
    {"short_period",
     "the period is {period}, which is shorter than the default contact duration, {duration}.\n"
     "hint: use --contact-duration with a value from 0 to {period}, or a longer period."},
    {"floor_friction_too_large",
     "--floor-friction {friction} times --gravity {gravity} is too large for --contact-duration "
     "{duration}: in that time, floor friction changes velocities by {change} times the container's "
     "speed.\nhint: keep the product below {most}."},
    {"rolling_resistance_too_large",
     "--rolling-resistance is {resistance}, but it must not exceed --floor-friction, {friction}: "
     "the spheres would slide instead of rolling."},
    {"warmup_of_all_periods",
     "--warmup is {warmup} periods, but the whole run is only --periods {periods}: the warm-up must "
     "be shorter than the run."},
    {"warmup_of_all_events",
     "--warmup is {warmup} periods, but a run of --events {events} has at most {periods} periods: "
     "the warm-up must be shorter than the run."},

    // The number of the particles and their sizes.
    {"mixture_share",
     "the share in --mixture is {percent} %, but it must be above 0 and at most 100 %."},
    {"mixture_of_none",
     "the share in --mixture is {percent} %, which rounds to none of {discs} {body}{discs||s}.\n"
     "hint: use a larger share or more {body}s."},
    {"mixture_count",
     "the count in --mixture is {count}, but it must be a whole number from 1 to {discs}.\n"
     "hint: a share, such as --mixture 50%:{radius}, is possible for any number of {body}s."},
    {"too_much_area",
     "{discs} {body}{discs||s} {discs|does|do} not fit into a container of radius {container}: "
     "together they would cover {percent} % of it."},
    {"too_many_known",
     "{discs} {body}{discs||s} {discs|does|do} not fit into a container of radius {container}: no "
     "known arrangement holds more than {most}."},
    {"too_many",
     "{discs} {body}{discs||s} {discs|does|do} not fit into a container of radius {container}: no "
     "arrangement holds more than {most}."},
    {"not_placed",
     "{discs} {body}{discs||s} of {radii} could not be placed in a container of radius {container} "
     "without overlap."},
    {"placement_may_fail_known",
     " No known arrangement holds more than {most}, and close to that number the placement may "
     "fail."},
    {"placement_may_fail",
     " No arrangement holds more than {most}, and close to that number the placement may fail."},
    {"particle_too_large",
     "a {body} of radius {radius} does not fit into a container of radius {container}: "
     "--container-radius must be larger than {what}."},
    {"container_too_large",
     "a container of radius {container} is more than {times} times as large as a {body} of radius "
     "{radius}, which exceeds the accuracy of the neighbour search.\n"
     "hint: use a smaller --container-radius."},
    {"not_sizes",
     "--sizes is '{text}', but it must be uniform:MIN:MAX, normal:MEAN:SD, "
     "lognormal:MEDIAN:SD, power:EXPONENT:MIN:MAX or file:FILE."},
    {"not_of_this_form", "--sizes is '{text}', but it must be {form}, in finite numbers."},
    {"not_a_size",
     "entry {entry} of --sizes is '{text}', but it must be a radius or RADIUS:MASS, in finite "
     "numbers."},
    {"no_sizes", "--sizes lists no particles."},
    {"too_many_sizes", "--sizes lists {listed} particles, but it may be at most {most}."},
    {"other_number_of_sizes",
     "--sizes lists {listed} particles, but --discs is {discs}.\n"
     "hint: omit --discs to use all of them."},
    {"sizes_and_mixture",
     "--sizes and --mixture are both given, but both define the radii.\n"
     "hint: omit one of them, or list all particles with --sizes file:FILE."},
    {"wide_sizes",
     "--sizes has the mean {mean} and the standard deviation {deviation}, but radii reach {most} "
     "standard deviations below the mean and must be above 0."},
    {"largest_below_smallest",
     "the largest radius in --sizes is {value}, but it must be a number from the smallest, {from}, "
     "to {to}."},


    // The path of the container.
    {"not_a_path",
     "--motion is '{text}', but it must be polygon, circle, line, ellipse:RATIO, "
     "lissajous:P:Q[:DEGREES] or a file."},
    {"not_an_ellipse",
     "--motion is '{text}', but an ellipse needs the ratio of its y axis to its x axis, a number from "
     "0 to {most}, for example ellipse:0.5."},
    {"not_a_lissajous_figure",
     "--motion is '{text}', but a Lissajous figure needs its cycles along x and y in a period, whole "
     "numbers from 1 to {most}, and may have the lead of y from -360 to 360 degrees, for example "
     "lissajous:2:3 or lissajous:1:2:45."},
    {"not_a_point", "point {point} of --motion is '{text}', but it must be T:X:Y."},
    {"point_without_number",
     "point {point} of --motion has '{text}', but it must be a finite number."},
    {"point_out_of_range",
     "point {point} of --motion has {value}, but it must be a number from {from} to {to}."},
    {"point_too_early",
     "point {point} of --motion is at time {time}, but the point before it is at {before}: times must "
     "increase."},
    {"too_few_points",
     "--motion has {points} {points|point|points}, but a closed path needs at least three: the last "
     "one repeats the first at the end of the period."},
    {"too_many_points",
     "--motion has {points} points, but at most {most} are allowed.\n"
     "hint: keep fewer points per period."},
    {"open_path",
     "--motion is not closed: it starts at ({x}, {y}) and ends at ({x_end}, {y_end}).\n"
     "hint: the last point repeats the first at the end of the period."},
    {"points_at_origin",
     "--amplitude is {amplitude}, but the points of --motion are all at the origin."},
    {"circle_with_floor",
     "--motion is circle, but on it floor friction changes direction while a particle slides, so its "
     "trajectory is not a parabola.\nhint: use --motion polygon."},
    {"few_sides_of_lissajous_figure",
     "--sides is {sides}, but a Lissajous figure with {cycles} cycles needs at least {least}."},
    {"wide_ellipse", "the y axis of --motion ellipse is {axis}, but it must not exceed {most}."},

    // During a run.
    {"inelastic_collapse",
     "the last {events} events took {duration} (collapse after {periods} periods): with restitution "
     "{restitution} the {body}s collide ever faster (inelastic collapse).\nhint: use a "
     "--contact-duration longer than {contact}."},
    {"frictional_collapse",
     "the last {events} events took {duration} (collapse after {periods} periods): friction has "
     "dissipated the relative motion of {body}s that are pressed together, and they collide ever "
     "faster (frictional collapse; docs/explanation/physics.md). The model has no state after it.\n"
     "hint: another --seed than {seed} may avoid it."},
    {"overlap",
     "after {periods} periods a disc overlaps another disc or the wall by {overlap} of the smallest "
     "radius: rounding errors are too large for such small discs in such a wide container or on "
     "such a long path.\nhint: reduce --container-radius, --amplitude or --events."},

    // The browser page.
    {"page_without_parameter", "the page has no {name}.\nhint: use the program swirl."},
    {"page_without_frictionless",
     "the page has no --frictionless boundary or bulk.\nhint: use the program swirl."},
    {"page_needs_circle", "the page needs a path that is nearly a circle, counter-clockwise."},

    // Hints that several errors have.
    {"did_you_mean", "\nhint: did you mean '{name}'?"},
    {"see_help", "\nhint: see `swirl help run all`."},
    {"units", "\nhint: units are um, mm, cm, m, in; us, ms, s, min, rpm, Hz; mm/s, m/s, m/s2."},
    {"decimal_point",
     "\nhint: use a decimal point, {whole}.{decimals}; `swirl sweep` takes lists and ranges."},
    {"one_number", "\nhint: give one number; `swirl sweep` takes lists and ranges."},
    {"fewer_particles", "\nhint: use fewer {body}s or a larger --container-radius."},

    // A sentence of a part of the program that the page does not have (failure.hpp).
    {"without_code", "{text}"},

    // Phrases.
    {"disc", "disc"},
    {"sphere", "sphere"},
    {"one_radius", "radius {radius}"},
    {"two_radii", "radius {radius} and {second}"},
    {"radii_of_law", "radii of {law}"},
    {"radii_between", "radii from {from} to {to}"},
    {"mixture_radius", "the radius in --mixture"},
    {"mixture_mass", "the mass in --mixture"},
    {"size_radius", "a radius in --sizes"},
    {"size_mass", "a mass in --sizes"},
    {"size_smallest", "the smallest radius in --sizes"},
    {"size_largest", "the largest radius in --sizes"},
    {"size_deviation", "the standard deviation in --sizes"},
    {"size_exponent", "the exponent in --sizes"},
    {"largest_size", "the largest radius in --sizes"},
    {"short_time", "only {periods} periods"},
    {"no_time", "no measurable time"},
};
// clang-format on

}  // namespace swirl
