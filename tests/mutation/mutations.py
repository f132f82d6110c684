"""The mutations of mutate.py: (file, text before, text after, the defect). A fifth entry explains
why no test can notice: the mutated program is equivalent."""

STATISTICS = "src/swirl/statistics/block_average.hpp"
STUDENT = "src/swirl/statistics/student.hpp"
STEADY = "src/swirl/statistics/steady_state.hpp"
SEVERAL = "src/swirl/statistics/replicates.hpp"
CIRCULAR = "src/swirl/statistics/circular_mean.hpp"
CELLS = "src/swirl/measure/cell_averages.hpp"
RATES = "src/swirl/measure/collision_rates.hpp"
TEMPERATURE = "src/swirl/measure/granular_temperature.hpp"
SLIP = "src/swirl/measure/slip.cpp"
PINNED = "src/swirl/measure/pinned_loose.cpp"
RESIDENCES = "src/swirl/measure/wall_residence.cpp"
LONG = "src/swirl/measure/long_residence.hpp"
FRAME_HPP = "src/swirl/measure/m_frame.hpp"
FRAME = "src/swirl/measure/m_frame.cpp"
ROTATION = "src/swirl/measure/cluster_rotation.cpp"
KERNEL = "src/swirl/measure/cluster_rotation_kernel.hpp"
FOLLOWER = "src/swirl/physics/rotation_follower.hpp"
OBSERVER = "src/swirl/engine/rotation_observer.hpp"
PROFILE = "src/swirl/measure/angular_profile.cpp"
CENTRE = "src/swirl/measure/cluster_centre.hpp"
HULL = "src/swirl/measure/convex_hull.hpp"
VORONOI = "src/swirl/measure/voronoi.cpp"
HEXATIC = "src/swirl/measure/hexatic_order.hpp"
DIFFUSION = "src/swirl/measure/diffusion.hpp"
ENERGY = "src/swirl/measure/energy_budget.cpp"
STRESS = "src/swirl/measure/wall_stress.hpp"
RADIAL = "src/swirl/measure/radial_density.hpp"
FRUSTRATION = "src/swirl/measure/spin_frustration.cpp"
LAW = "src/swirl/physics/collision_law.hpp"
TIME = "src/swirl/physics/contact_time.hpp"
ARC = "src/swirl/physics/arc_contact.hpp"
PATH = "src/swirl/physics/container_path.hpp"
DISC = "src/swirl/physics/disc.hpp"
TURNED = "src/swirl/physics/orientation.hpp"
SNAPSHOT = "src/swirl/physics/snapshot.hpp"
BALL = "src/swirl/physics/rolling_ball.hpp"
PINNED_HPP = "src/swirl/measure/pinned_loose.hpp"
RESIDENCES_HPP = "src/swirl/measure/wall_residence.hpp"
PINNED_FRAMES = "src/swirl/measure/pinned_frames.hpp"
TIMES = "src/swirl/measure/sample_times.hpp"
FIELDS = "src/swirl/measure/fields.hpp"

MUTATIONS = [
    # Means and their errors.
    (STATISTICS, "pair = std::min(pair, last);", "", "Geyer's sequence is not made monotone"),
    (
        STATISTICS,
        "if (!(pair > 0.0)) break;",
        "if (pair < -variance) break;",
        "Geyer's sequence does not end at the first negative pair",
    ),
    (
        STATISTICS,
        "double sum = -variance, last",
        "double sum = 0.0, last",
        "the autocorrelation time counts lag 0 twice",
    ),
    (STATISTICS, "sum += 2.0 * pair;", "sum += pair;", "the autocorrelation time has half its sum"),
    (
        STATISTICS,
        "return std::max(1.0, sum / variance);",
        "return sum / variance;",
        "the autocorrelation time may be below 1",
    ),
    (
        STATISTICS,
        "e.error = std::sqrt(tau * variance * n * used / (used - 1.0))",
        "e.error = std::sqrt(tau * variance * n)",
        "the error has n instead of n - 1",
    ),
    (
        STATISTICS,
        " e.effective_samples = used / tau;",
        " e.effective_samples = used;",
        "correlated blocks count as independent samples",
    ),
    (
        STATISTICS,
        "run.blocks[b].sum - mean * run.blocks[b].weight",
        "run.blocks[b].sum - mean",
        "residuals ignore the weight of a block",
    ),
    (
        STATISTICS,
        "b + lag < run.blocks.size(); ++b",
        "b + lag + 1 < run.blocks.size(); ++b",
        "the autocovariance omits the last product",
    ),
    (STATISTICS, "periods_per_block *= 2;", "", "coarsened blocks claim to cover one period"),
    (
        STEADY,
        "if (d > n / 2 || n - d < 2) continue;",
        "if (n - d < 2) continue;",
        "MSER-5 may cut more than half",
    ),
    (STEADY, "squares / (left * left)", "squares / left", "MSER-5 minimises the variance"),
    (
        STEADY,
        "if (score <= minimum) {",
        "if (score < minimum) {",
        "MSER-5 prefers the later of two equal cuts",
    ),
    (
        STEADY,
        "batch[i] += blocks[5 * i + k] / 5.0;",
        "batch[i] += blocks[5 * i] / 5.0;",
        "MSER-5 uses one block of five",
    ),
    (
        STUDENT,
        "(5.0 * z5 + 16.0 * z3 + 3.0 * z)",
        "(5.0 * z5 + 16.0 * z3 - 3.0 * z)",
        "Student's quantile has a wrong term",
    ),
    (
        STEADY,
        "slope *= n > 1.0 ? 12.0 / (n * (n * n - 1.0)) : 0.0;",
        "slope *= n > 1.0 ? 12.0 / (n * n * n) : 0.0;",
        "the trend is fitted with a wrong norm",
    ),
    (
        STATISTICS,
        "open_.sum += value * weight;",
        "open_.sum += value;",
        "a weighted mean forgets the weight",
    ),
    # Several runs.
    (
        SEVERAL,
        "sum += w[i] * runs[i].mean;",
        "sum += runs[i].mean;",
        "runs are averaged without their weights",
    ),
    (
        SEVERAL,
        "p[i] * p[i] * (1.0 - 2.0 * p[i] + squares)",
        "p[i] * p[i] * (1.0 - p[i] + squares)",
        "the variance between seeds has a wrong norm",
    ),
    (SEVERAL, "std::max(within, between)", "within", "the scatter between seeds is ignored"),
    (
        SEVERAL,
        "all.scatter = std::sqrt(chi_square / others);",
        "all.scatter = std::sqrt(chi_square / (others + 1.0));",
        "scatter over n instead of n - 1",
    ),
    (SEVERAL, "* student_95(freedom) / student_95(1e9)", "", "few runs have the error of many"),
    (SEVERAL, "2.0 / (9.0 * freedom)", "2.0 / (3.0 * freedom)", "Wilson and Hilferty's 9 is a 3"),
    (
        SEVERAL,
        "360.0 * std::round((e.mean - known->mean) / 360.0)",
        "360.0 * std::floor((e.mean - known->mean) / 360.0)",
        "directions are unwrapped one-sided",
    ),
    # Circular means.
    (CIRCULAR, "c_ += v.x * inverse;", "c_ += v.x;", "a direction counts with its length"),
    (
        CIRCULAR,
        "CC_ * S_ * S_ - 2.0 * CS_ * C_ * S_ + SS_ * C_ * C_",
        "CC_ * C_ * C_ + 2.0 * CS_ * C_ * S_ + SS_ * S_ * S_",
        "the scatter along the mean direction",
    ),
    (
        CIRCULAR,
        "* used_ / (used_ - 1.0) / square)",
        "/ square)",
        "the error has n instead of n - 1",
    ),
    (
        CIRCULAR,
        "square_root(C_ * C_ + S_ * S_) / N_",
        "(C_ * C_ + S_ * S_) / (N_ * N_)",
        "the concentration is squared",
    ),
    # Cells.
    (
        CELLS,
        "ss - 2.0 * e.mean * sw + e.mean * e.mean * ww",
        "ss - e.mean * e.mean * ww",
        "the error of a cell ignores the scatter of its visits",
    ),
    (
        CELLS,
        "* n / (n - 1.0)) / std::abs(w)",
        ") / std::abs(w)",
        "the error has n instead of n - 1",
    ),
    (
        CELLS,
        "t.sw[k] += o.sum[k] * o.visits;",
        "t.sw[k] += o.sum[k];",
        "a sum of products forgets the visits",
    ),
    (CELLS, "sw[c] += open[c] * weight_;", "sw[c] += open[c];", "the same of rates"),
    (STATISTICS, "e.error *= std::abs(factor);", "e.error *= factor;", "an error becomes negative"),
    # Collision rates and the granular temperature.
    (
        RATES,
        "e.error /= e.mean * e.mean;",
        "e.error /= e.mean;",
        "the error of the mean free time is divided by the mean",
    ),
    (RATES, "disc_ += 2.0;", "disc_ += 1.0;", "a collision of two discs counts once"),
    (
        RATES,
        "rate_.add(disc_ + wall_, weight);",
        "rate_.add(disc_, weight);",
        "the mean free time ignores the wall",
    ),
    (
        TEMPERATURE,
        "sum += cells_.visits(c) * temperature(c);\n            visits += cells_.visits(c);",
        "sum += temperature(c);\n            visits += 1.0;",
        "cells are not weighted by their visits",
    ),
    (
        TEMPERATURE,
        "(x * x + y * y) / cells_.mean(cell, 0)",
        "(x * x + y * y)",
        "the mean flow is not divided by the mass",
    ),
    (
        TEMPERATURE,
        "e.mean -= spins_.mean(0, 1) * spins_.mean(0, 1) / spins_.mean(0, 0);",
        "",
        "the mean spin counts as temperature",
    ),
    (TEMPERATURE, "sum / visits + missing_", "sum / visits", "missing energy is not added"),
    # Slip and the convex hull.
    (
        SLIP,
        "|| dot(d, d) < view.radius[i] * view.radius[i]) continue;",
        ") continue;",
        "discs near the centre of mass count",
    ),
    (SLIP, "+ 2.0 * pi * radius;", "+ pi * radius;", "the band round the cluster is too short"),
    (
        SLIP,
        "average.add((omega - sum / count) * factor);",
        "average.add(magnitude(omega - sum / count) * factor);",
        "the slip parameter of noise adds up",
    ),
    (
        SLIP,
        "of_pinned.add_slip_to(pinned_, omega, factor);",
        "all.add_slip_to(pinned_, omega, factor);",
        "the pinned region is the whole cluster",
    ),
    (
        SLIP,
        "pending_factor_ = factor;",
        "pending_factor_ = 1.0;",
        "resident discs have another perimeter",
    ),
    (
        HULL,
        "p - hull.back()) <= 0.0)",
        "p - hull.back()) < 0.0)",
        "points on a side remain corners of the hull",
    ),
    (
        HULL,
        "(k + 1) % polygon.size()",
        "k + 1 < polygon.size() ? k + 1 : k",
        "the perimeter is not closed",
    ),
    # Pinned and loose.
    (
        PINNED,
        "const double parallel = rotation < 0.0 ? along : 0.0;",
        "const double parallel = rotation > 0.0 ? along : 0.0;",
        "pinned is against the wall's motion",
    ),
    (
        PINNED,
        "const double long_enough = frames > half_width ? 1.0 : 0.0;",
        "const double long_enough = frames >= half_width ? 1.0 : 0.0;",
        "pinned after seven frames",
    ),
    (
        PINNED,
        "slope[i] += (h + 1.0) * oldest[i] + h * now[i] - sum[i];",
        "slope[i] += h * oldest[i] + h * now[i] - sum[i];",
        "the running fit forgets a frame",
    ),
    (
        PINNED,
        "turned_sharply[i] = sharp * (1.0 - now);",
        "turned_sharply[i] = sharp;",
        "sharp turns of pinned discs count",
    ),
    (
        PINNED,
        "const double loose = parallel > 0.0 ? 0.0 : since;",
        "const double loose = since;",
        "a disc that is parallel again has left",
    ),
    (PINNED, "ax[i] - 2.0 * x[i] + bx[i]", "ax[i] - bx[i]", "the velocity instead of its change"),
    (
        PINNED,
        "std::abs(step - step_) <= 0.01 * step_",
        "std::abs(step - step_) <= 10.0 * step_",
        "uneven frames count as even ones",
    ),
    (
        PINNED,
        "if (time - last.time > longest_[disc].duration)",
        "if (true)",
        "the last flight instead of the longest",
    ),
    (
        PINNED,
        "depinning_.add(flight.begin);\n            pinning_.add(flight.end);",
        "depinning_.add(flight.end);\n            pinning_.add(flight.begin);",
        "begin and end of a flight are exchanged",
    ),
    # Residences at the wall.
    (
        RESIDENCES,
        "pinned[d] += lasted - step < required ? residence.samples : 1.0;",
        "pinned[d] += 1.0;",
        "the beginning of a residence does not count",
    ),
    (
        RESIDENCES,
        "if (seen < least_length(minimum[d], step, period)) continue;",
        "if (seen < least_length(minimum[d], step, period) + 2.0 * step) continue;",
        "residences must be longer by two samples",
    ),
    (
        RESIDENCES,
        "if (residence.knows_begin != 0.0) a.begin.add(residence.begin);",
        "a.begin.add(residence.begin);",
        "a beginning that was not seen counts",
    ),
    (
        RESIDENCES,
        "a.end.add(residence.last);",
        "a.end.add(residence.begin);",
        "a residence ends where it began",
    ),
    (
        RESIDENCES,
        "length_.add(length / period);",
        "length_.add(length);",
        "lengths are not in periods",
    ),
    (
        LONG,
        "const double inner = view.container_radius - radii * view.radius[i];",
        "const double inner = view.container_radius - radii;",
        "the layer ignores the disc's radius",
    ),
    (
        LONG,
        "if (last_ - begin_[i] >= minimum_) long_begin_[i]",
        "long_begin_[i]",
        "a short residence is remembered as a long one",
    ),
    (
        LONG,
        "return !sees(time) || last_ - time >= minimum_;",
        "return !sees(time) || last_ > time;",
        "residences are known too early",
    ),
    # The M-frame.
    (
        FRAME_HPP,
        "return relative_velocity(lab_velocity) - omega *",
        "return relative_velocity(lab_velocity) + omega *",
        "the frame turns the wrong way",
    ),
    (
        FRAME_HPP,
        "const double rate = cross(r, u - velocity) / square;",
        "const double rate = cross(r, u) / square;",
        "ϖ ignores the velocity of the centre of mass",
    ),
    (
        FRAME_HPP,
        "double spin(double lab) const { return lab - omega; }",
        "double spin(double lab) const { return lab; }",
        "spins are those of the lab",
    ),
    (FRAME, "mu += mass[i] * ux[i];", "mu += ux[i];", "the centre of mass ignores masses"),
    (
        FRAME,
        ": unit_circle(s.clock / s.period);",
        ": unit_circle(0.0);",
        "the frame of a still container does not turn",
    ),
    (
        FRAME,
        "const double elapsed = clock - held_at[i];",
        "const double elapsed = 0.0;",
        "states are not brought up to date",
    ),
    # The rotation of the cluster.
    (
        FOLLOWER,
        "velocity = velocity - Vec2{impulse_on_wall.x / mass, impulse_on_wall.y / mass};",
        "velocity = velocity + Vec2{impulse_on_wall.x / mass, impulse_on_wall.y / mass};",
        "the wall pushes the centre of mass outwards",
    ),
    (KERNEL, "if (q <= closest_square) continue;", "", "a disc on the centre of mass counts"),
    (
        KERNEL,
        "mass += masses[i];\n        r = r + masses[i] * disc.position;",
        "mass += masses[i];\n        r = r + disc.position;",
        "few discs: the centre ignores masses",
    ),
    (
        ROTATION,
        "const double per_omega = period / (2.0 * pi) * weight_of_a_sample;",
        "const double per_omega = period * weight_of_a_sample;",
        "results are per period",
    ),
    (
        KERNEL,
        "individual = individual + (a.l * b.q + b.l * a.q) / (a.q * b.q);",
        "individual = individual + (a.l * b.q + b.l * b.q) / (a.q * b.q);",
        "every other group of discs has a wrong rate",
    ),
    (
        KERNEL,
        "square = square + a.q * counts;",
        "square = square + a.q;",
        "the last discs count twice",
    ),
    (
        KERNEL,
        "const Eight half_square = Eight::all(0.5) * elapsed * elapsed;",
        "const Eight half_square = elapsed * elapsed;",
        "spheres are accelerated twice",
    ),
    (
        KERNEL,
        "minimum = smaller_of(b.q, smaller_of(a.q, minimum));",
        "minimum = smaller_of(a.q, minimum);",
        "a disc on the centre of mass is overlooked",
    ),
    (
        OBSERVER,
        "period_ended || (event.kind == EventKind::path_vertex && copies.ax != nullptr);",
        "period_ended;",
        "spheres that a new segment of the path accelerates are sampled with the old acceleration",
    ),
    (OBSERVER, "if (!s.pauses) continue;", "continue;", "a series misses all samples by time"),
    (OBSERVER, "*s.left = s.interval;", "*s.left = 1;", "every event is sampled after the first"),
    # Profiles, shape and structure.
    (
        PROFILE,
        "if (square < view.radius[i] * view.radius[i]) continue;",
        "",
        "discs near the centre of mass count",
    ),
    (
        PROFILE,
        "(ay * c.velocity.x - ax * c.velocity.y)",
        "(ay * c.velocity.x + ax * c.velocity.y)",
        "the wall passes the centre of mass at a wrong rate",
    ),
    (
        PROFILE,
        "view.relative_velocity(i) - centre.velocity - view.frame.omega * perpendicular(d);",
        "view.relative_velocity(i) - centre.velocity;",
        "speeds are those of the lab's directions",
    ),
    (
        CENTRE,
        "if (view.size() > 2 && mean - difference > in_a_line * mean)",
        "if (view.size() > 2)",
        "discs on a line have an elongation",
    ),
    (
        CENTRE,
        "const Vec2 from_S = p - Vec2{0.0, amplitude};",
        "const Vec2 from_S = p;",
        "the centrifugal force is about C",
    ),
    (CENTRE, "xy += d.x * d.y;", "", "the elongation is that along x and y"),
    (
        VORONOI,
        "(square + r * r - view.radius[neighbour] * view.radius[neighbour]) / (2.0 * distance);",
        "square / (2.0 * distance);",
        "borders lie half-way between discs of several sizes",
    ),
    (
        VORONOI,
        "next_.push_back({cut, da <= 0.0 ? neighbour : a.beyond});",
        "next_.push_back({cut, da <= 0.0 ? a.beyond : neighbour});",
        "borders have wrong neighbours",
    ),
    (
        VORONOI,
        "if (enter > 0.0) area += sector * angle_between(a, p);",
        "",
        "cells at the wall lose area",
    ),
    (HEXATIC, "total += b->length;", "total += 1.0;", "borders are not weighted with their length"),
    (
        HEXATIC,
        "im += b->length * (four.x * two.y + four.y * two.x);",
        "",
        "ψ6 depends on the direction of the lattice",
    ),
    (DIFFUSION, "e.error *= square_root(blocks);", "", "overlapping lags count as independent"),
    (
        DIFFUSION,
        "e.mean -= rotations_.mean(k, 0) * rotations_.mean(k, 0);",
        "",
        "the mean rotation counts as its variance",
    ),
    (
        DIFFUSION,
        "s.position(i) - s.container_centre",
        "s.position(i)",
        "displacements are those of the lab",
    ),
    # Energy, stress, density, spins.
    (
        ENERGY,
        "normal_after - 0.5 * J.normal * inverse_masses",
        "normal_after - J.normal * inverse_masses",
        "the loss of a collision is wrong",
    ),
    (
        ENERGY,
        "dot(change.push, after.container_velocity);",
        "-dot(change.push, after.container_velocity);",
        "the wall's work has the wrong sign",
    ),
    (ENERGY, "* excess;", "* 0.0;", "the rounding of a normal is not in the budget"),
    (
        STRESS,
        "tangential_.add(slice, -event.impulse.tangential);",
        "tangential_.add(slice, event.impulse.tangential);",
        "the traction has the wrong sign",
    ),
    (
        RADIAL,
        "pi * (outer - inner) * (outer + inner)",
        "pi * (outer - inner) * (outer - inner)",
        "rings have a wrong area",
    ),
    (
        FRUSTRATION,
        "is_pinned(pinned, pair.i) && is_pinned(pinned, pair.j)",
        "is_pinned(pinned, pair.i)",
        "pairs of which one is pinned count",
    ),
    (FRUSTRATION, "coordination_.add(2.0 *", "coordination_.add(1.0 *", "a pair is one neighbour"),
    # The physics.
    (
        LAW,
        "surface.restitution < 1.0 && since_last < surface.contact_duration;",
        "surface.restitution < 1.0 && since_last >= surface.contact_duration;",
        "the TC model is inverted",
    ),
    (
        LAW,
        "return surface.restitution < 1.0 && since_last",
        "return since_last",
        "the TC model of elastic discs",
    ),
    (
        LAW,
        "i.spin = i.spin + i.radius * J.tangential * spins_i;",
        "i.spin = i.spin - i.radius * J.tangential * spins_i;",
        "friction turns a disc the wrong way",
    ),
    (
        DISC,
        "return can_spin / inertia;",
        "return 1.0 / inertia;",
        "a disc that cannot spin does spin",
    ),
    (
        LAW,
        "return {1.0 / (inverse_masses + lever)};",
        "return {1.0 / inverse_masses};",
        "friction ignores the moments of inertia",
    ),
    (
        TIME,
        "larger(c, Real(0.0)) / (square_root(discriminant) - b);",
        "c / (square_root(discriminant) - b);",
        "overlapping discs collide in the past",
    ),
    (
        TIME,
        "const auto touch = (b < Real(0.0)) & (discriminant >= Real(0.0));",
        "const auto touch = discriminant >= Real(0.0);",
        "separating discs collide",
    ),
    (
        TIME,
        "smaller(c, Real(-0x1p-52) * square)",
        "c",
        "a disc that slides along the wall collides without end",
    ),
    (
        ARC,
        "more < 0.0 || 4.0 * A * B > more * more",
        "true",
        "a later contact on an arc counts as the first",
    ),
    (
        ARC,
        "const double c = f.c - (gap + start.c);",
        "const double c = f.c;",
        "a disc at the wall of an arc ignores its gap",
    ),
    (
        PATH,
        "if (t < segment.end) return segment;",
        "if (t <= segment.end) return segment;",
        "the end of a segment belongs to the segment before",
    ),
    (
        PATH,
        "(1.0 / turn_rate) * (u.y * velocity + (1.0 - u.x) * across)",
        "(1.0 / turn_rate) * (u.y * velocity - (1.0 - u.x) * across)",
        "an arc bends the wrong way",
    ),
    (DISC, "d.angle = angle + (t - time) * spin;", "", "a synchronised disc does not rotate"),
    (
        DISC,
        "d.inertia * dot(d.rolling_spin, d.rolling_spin)",
        "0.0",
        "the energy of rolling is missing",
    ),
    (
        DISC,
        "return 0.5 * mass * radius * radius;",
        "return 0.5 * mass * radius;",
        "the inertia of a solid disc ignores its size",
    ),
    (
        TURNED,
        "step * vertical + b * z) *",
        "step * vertical) *",
        "the fourth order of Magnus' series is missing",
    ),
    (
        TURNED,
        "const Vec2 half = unit_circle(angle / (4.0 * pi));",
        "const Vec2 half = unit_circle(angle / (2.0 * pi));",
        "a sphere turns twice as far",
    ),
    (
        SNAPSHOT,
        "return {vx[i] + elapsed * ax[i], vy[i] + elapsed * ay[i]};",
        "return {vx[i], vy[i]};",
        "the velocity of a sphere is not that at the clock",
    ),
    (
        SNAPSHOT,
        "const double half_square = 0.5 * elapsed * elapsed;",
        "const double half_square = elapsed * elapsed;",
        "a sphere is accelerated twice",
    ),
    (
        SNAPSHOT,
        "angle[i] + (clock - held_at[i]) * spin[i]",
        "angle[i]",
        "an orientation is not that at the clock",
    ),
    (
        SNAPSHOT,
        "return period_start() + clock;",
        "return clock;",
        "time begins again in every period",
    ),
    (
        BALL,
        "phase - ball.lag / (2.0 * pi)",
        "phase + ball.lag / (2.0 * pi)",
        "the ball settles ahead of M",
    ),
    # Survivors of random mutations: definitions that were tested only where they could not fail.
    (PINNED_HPP, "sharp_turn = 0.5;", "sharp_turn = 0.6;", "a sharp turn needs a larger change"),
    (
        PINNED_HPP,
        "deviation = pi / 18.0;",
        "deviation = pi / 17.0;",
        "parallel is within 10.6° of the wall",
    ),
    (
        PINNED_HPP,
        "return last_.size() == longest_.size();",
        "return last_.size() != longest_.size();",
        "a valid checkpoint of pinned discs is rejected",
    ),
    (
        STEADY,
        "early.effective_samples - 2.0, b",
        "early.effective_samples - 3.0, b",
        "a straight line costs three degrees of freedom",
    ),
    (
        STEADY,
        "all.effective_samples - 4.0",
        "all.effective_samples - 5.0",
        "two straight lines cost five degrees of freedom",
    ),
    (RESIDENCES_HPP, "layers{1.3,", "layers{1.4,", "the narrow wall layer is wider"),
    (
        RESIDENCES_HPP,
        "minimum{0.5 * long_residence",
        "minimum{0.55 * long_residence",
        "the shortest pinned residence is longer",
    ),
    (CENTRE, "int every = 8", "int every = 9", "the centre takes every ninth sample"),
    (DIFFUSION, "samples_ < 2 ||", "samples_ < 3 ||", "the third sample may come at any time"),
    (DIFFUSION, "0.01 * step_", "0.011 * step_", "unequal time steps pass as equal"),
    (SNAPSHOT, "on_floor = false;", "on_floor = true;", "discs are on a floor unless said"),
    (
        FIELDS,
        "grid.grid().side != side_) return false",
        "grid.grid().side == side_) return false",
        "a valid checkpoint of fields is rejected",
    ),
    (
        TIMES,
        "return periods == periods_",
        "return periods != periods_",
        "the next sample is due in another period",
    ),
    (
        PINNED_FRAMES,
        "recent_(delay() + 1)",
        "recent_(delay() - 1)",
        "the frame of which the pinned discs are known is no longer stored",
    ),
]
