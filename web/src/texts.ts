// All texts of the page, in one place for translators. The engine's texts remain English, as on the
// command line: error messages, names of parameters, keys of files.

import type {Rate} from "./engine";

/** The texts for the {{names}} in index.html, inserted when the page is built. */
export const pageTexts = {
    language: "en",
    title: "swirl: discs in a swirled container",
    name: "swirl",
    noScript: "This page needs JavaScript, which is turned off here.",
    container: "Container",
    commandLine: "The page uses the engine, the parameters and the averages of the command line. This command " +
        "reproduces the state exactly:",
    copy: "Copy",
    after: "After",
    stateHashIs: "events the hash of the state is",
};

/** As in the paper. */
export const symbols = {
    rotation: "ϖ/Ω", rigidRotation: "ϖ/Ω, rigid body", rotationM: "ϖ_M/Ω", theta: "θ", discs: "N", friction: "μ",
    // Points: the centre of the path, the centre of the container, the point of the wall farthest from S.
    swirl: "S", container: "C", farthest: "M",
};

export const texts = {
    play: "Play",
    pause: "Pause",
    step: "Next event",
    restart: "Restart",
    image: "Save image (PNG)",
    table: "Save ϖ per period (CSV)",
    result: "Save result (JSON)",
    record: "Record",
    recordStop: "Stop recording",
    movie: "Save movie (WebM)",
    positions: "Save positions (XYZ)",
    compare: "Compare",
    compareHelp: "Keeps this container next to the next one",
    comparedResult: (name: string, rotation: string): string => `${name}: ${symbols.rotation} = ${rotation}`,
    closeCompared: "Close the compared container",
    backwards: "Reverse time",
    forwards: "Time forwards",
    backwardsHelp: "Needs zero friction and restitution 1: otherwise collisions cannot be reversed",
    dragHelp: "Drag a disc in the lab frame; time pauses meanwhile. " +
        "Keys: [ and ] select a disc, arrows move it, Escape deselects it",
    selected: (disc: number) => `Disc ${disc} is selected. Arrows move it, Escape deselects it.`,
    speed: "Periods per second",
    view: "View",
    views: {lab: "Lab frame", m: "M-frame", both: "Both"},
    color: "Colour",
    colors: {spin: "spin", speed: "speed", pinned: "pinned", id: "disc"},
    colorKey: {
        spin: "Orange: spin with the swirl. Blue: against it. Grey: little spin.",
        speed: "Speed in the container. Blue: at rest. Grey: as fast as the container. Orange: twice as fast.",
        pinned: "Orange: pinned at the wall near M (the paper's criterion). Blue: not pinned.",
        id: "Each disc has its own colour.",
    },
    forces: "Forces",
    forcesHelp: "In the M-frame: centrifugal force (away from S) and Coriolis force (to the right of the velocity)",
    trails: "Trails",
    keep: "Keep the discs",
    keepHelp: "New friction coefficients, restitutions and paths apply to the same discs, from the next period on",
    hand: "Move by hand",
    byHandStop: "Stop moving by hand",
    byHandHeadline: (turns: string): string =>
        `Move the container with the pointer. The cluster has rotated by ${turns} turns.`,
    clusterRotation: "rotation of the cluster",
    turns: (turns: string): string => `${turns} turns`,
    noCommand: "none, because the simulation was changed while it ran",
    maps: "Maps: density, flow and profile",
    density: "Density in the M-frame; dark regions are dense",
    flow: "Flow relative to the container",
    theta: "angle θ in the M-frame, M is at 270°",
    discs: "discs",
    wall: "wall",
    study: "Rotation against the number of discs (the paper's Figure 5b)",
    studyHelp: "One run for each N and friction coefficient, on all cores, with the other parameters as set here. " +
        "Enter numbers and ranges FROM:STEP:TO, separated by commas. DISC:WALL sets the friction coefficients " +
        "between discs and at the wall separately.",
    start: "Start",
    stop: "Stop",
    stopped: "Stopped.",
    numberOfDiscs: "number of discs N",
    studyTable: "Save table (CSV)",
    invalidStudy: (most: number): string => "N and μ must be numbers or ranges FROM:STEP:TO, separated by commas; " +
        `μ can have pairs DISC:WALL. The limit is ${most} runs.\nhint: try N 5:6:53 and μ 0.1, 1, 1:0.`,
    friction: (disc: number, wall: number): string =>
        disc === wall ? `${symbols.friction} = ${disc}`
            : `${symbols.friction}_d = ${disc}, ${symbols.friction}_w = ${wall}`,
    invalidPeriods: (text: string): string =>
        `The length of a run is '${text}', but it must be a whole number of periods from 10 to 100000.`,
    studyProgress: (done: number, all: number): string => `${done} of ${all} runs done.`,
    crossing: (discs: string, lower: number, upper: number): string =>
        `${discs} (95 %: ${lower.toFixed(1)} to ${upper.toFixed(1)})`,
    bracket: (lower: number, upper: number): string => `between ${lower} and ${upper}`,
    noCrossing: "none",
    crossings: (friction: string, of: Record<Rate, string>): string =>
        `${friction}: N_c, where the direction of rotation changes. Mean over the discs: ${of.by_time} by time, ` +
        `${of.by_event} by event. Rigid body: ${of.rigid_by_time} by time, ${of.rigid_by_event} by event.`,
    collapsed: (runs: string): string => `Omitted, because the run collapsed: ${runs}.`,
    runOf: (discs: number, friction: string): string => `N = ${discs} at ${friction}`,
    presets: "Presets",
    copied: "Copied",
    noWebAssembly: "This browser does not support WebAssembly with SIMD, which the engine needs.\n" +
        "hint: use Chrome 91, Firefox 113, Safari 16.4 or later.",
    unknownParameter: (name: string): string => `The address contains '${name}', but there is no such parameter.`,
    invalidEvents: (text: string): string =>
        `The address contains events=${text}, but it must be a whole number from 0 to 10000000.`,
    warmup: (periods: number): string => `Averages start after ${periods} periods.`,
    notYet: "n/a",
    grows: "Without friction the energy grows without bound on the polygon. The averages do not belong to a " +
        "steady state.",
    placing: (particles: string): string => `Placing ${particles}…`,
    running: (done: number, all: number): string => `${done} of ${all} events done.`,
    byTime: `${symbols.rotation} by time`,
    byEvent: `${symbols.rotation} by event`,
    mean: "mean",
    periods: "periods",
    /** Singular and plural. */
    bodies: {disc: ["disc", "discs"], sphere: ["sphere", "spheres"]},
    counted: (n: number, [one, several]: readonly string[]): string => `${n} ${n === 1 ? one : several}`,
    rotates: (n: number, particles: string): string =>
        `${particles} ${n === 1 ? "rotates" : "rotate"} with the swirl.`,
    counterrotates: (n: number, particles: string): string =>
        `${particles} ${n === 1 ? "rotates" : "rotate"} against the swirl.`,
    undecided: (particles: string): string => `${particles}: the direction of rotation is not determined yet.`,
    container: (particles: string, view: string): string => `${particles} in a swirled container, ${view}`,
    lesson: "Lesson in six steps",
    next: "Next",
    back: "Back",
    /** Translations of parameter groups and descriptions; the command line's texts are the default. */
    groups: {} as Record<string, string>,
    descriptions: {} as Record<string, string>,
};

/** The texts of the engine's worker, separate so that the worker does not contain those of the page. */
export const workerTexts = {
    stopped: (error: string): string => `The engine stopped: ${error}.\nhint: reload the page.`,
    control: (name: string, code: number): string => `--${name.replaceAll("_", "-")} contains the control ` +
        `character U+${code.toString(16).toUpperCase().padStart(4, "0")}, but a value must be one line of text.`,
    tooMany: (discs: string, most: number): string => `${discs} discs are too many for the page, whose limit is ` +
        `${most}.\nhint: use the command line: ./swirl run --discs ${discs}.`,
};

export interface Step {
    title: string;
    text: string;
    given: Record<string, string>;
    view: "lab" | "m" | "both";
}

export const lesson: Step[] = [
    {title: "A few discs", view: "lab", given: {discs: "8"},
     text: "The container moves on a circle without rotating. The few discs in it gather on one side and move " +
         "along the wall with the swirl. The cluster rotates in the direction of the container's motion."},
    {title: "Many discs", view: "lab", given: {discs: "48"},
     text: "Add discs. When the container is nearly full, the cluster rotates against the swirl. Nothing else " +
         "was changed. Why does the direction change?"},
    {title: "The M-frame", view: "both", given: {discs: "48"},
     text: "The view on the right rotates with the swirl. In this frame the container is at rest, and its wall " +
         "moves clockwise past the discs like a belt. M is the point of the wall farthest from the centre of " +
         "the swirl. The discs are pressed against the wall there."},
    {title: "Without friction", view: "both", given: {discs: "48", mu: "0"},
     text: "Set the friction coefficients between discs and at the wall to zero. Then no force holds a disc at " +
         "the wall, and no force rotates the cluster against the swirl."},
    {title: "Frustration", view: "both", given: {discs: "48", mu: "1"},
     text: "With friction, a disc at the wall tends to roll along it. Discs in contact would have to spin in " +
         "opposite directions, like gears. Three discs in a triangle cannot do that. With more discs there is " +
         "less rolling, and the wall drags the discs along: backwards in the lab frame."},
    {title: "Your own experiment", view: "lab", given: {discs: "28"},
     text: "Record a video of a dish from above with a phone. Use 5 mm spheres in the lid of a jar. Measure how " +
         "far the cluster rotates in ten periods, add a sphere, and record again. At which number does the " +
         "rotation stop?"},
];

export const presets: {name: string; given: Record<string, string>}[] = [
    {name: "48 discs, μ = 1 (the paper)", given: {discs: "48"}},
    {name: "28 discs, μ = 1", given: {discs: "28"}},
    {name: "48 discs, μ = 0.5", given: {discs: "48", mu: "0.5"}},
    {name: "48 discs, μ = 0.1", given: {discs: "48", mu: "0.1"}},
    {name: "48 discs, no friction between discs", given: {discs: "48", mu_disc: "0", mu_wall: "1"}},
    {name: "48 discs, no friction at the wall", given: {discs: "48", mu_disc: "1", mu_wall: "0"}},
    {name: "One large disc", given: {discs: "1", radius: "4"}},
    {name: "Two species", given: {discs: "40", mixture: "20:0.6"}},
    {name: "36 rolling spheres (the experiment)", given: {preset: "experiment", discs: "36"}},
    {name: "2000 small discs", given: {discs: "2000", radius: "0.14", inertia: "solid"}},
];
