// How parameters are read and written that are not simply a number (parameter_table.cpp).
#pragma once

#include "swirl/run/parameters.hpp"

namespace swirl {

ParameterReader read_preset, read_mu, read_frictionless, read_body, read_inertia, read_floor,
    read_initial, read_mixture, read_sizes, read_speed, read_path, read_direction, read_sides,
    read_periods, read_warmup, read_ramp, read_length_unit, read_time_unit;
ParameterWriter write_initial, write_frictionless, write_body, write_floor, write_mixture,
    write_sizes, write_speed, write_omega, write_path, write_direction, write_sides, write_events,
    write_warmup, write_ramp, write_length_unit, write_time_unit;
ParameterFormatter format_inertia, format_mixture;

}  // namespace swirl
