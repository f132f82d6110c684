// Every text of the page, for who wants to translate it. In English remain what the engine says for the
// command line, too: what it refuses, names of parameters, the keys of files.

import type {Rate} from "./engine";

/** What index.html has in {{braces}}, put there when the page is built. */
export const pageTexts = {
    language: "en",
    title: "swirl: marbles in a swirled dish",
    name: "swirl",
    noScript: "The laboratory runs in this page, by JavaScript, which is turned off here.",
    dish: "The dish",
    sameBits: "The engine, the parameters and the averages are those of the command line; the same dish " +
        "has the same bits there:",
    copy: "Copy",
    after: "After",
    theStateIs: "events the state is",
};

/** As the paper has them. */
export const symbols = {
    rotation: "ϖ/Ω", rigidRotation: "ϖ/Ω, rigid body", rotationM: "ϖ_M/Ω", theta: "θ", discs: "N", friction: "μ",
    swirl: "S", dish: "C", farthest: "M", // points: the swirl's centre, the dish's, the wall's farthest
};

export const texts = {
    play: "Play",
    pause: "Pause",
    step: "One event",
    restart: "From the beginning",
    picture: "Save picture",
    table: "Save ϖ per swirl (CSV)",
    result: "Save result (JSON)",
    record: "Record",
    recordEnds: "End recording",
    film: "Save film (WebM)",
    positions: "Save positions (XYZ)",
    beside: "Keep this dish beside",
    besideHas: (name: string, rotation: string): string => `${name}: ${symbols.rotation} = ${rotation}`,
    besideEnds: "End the dish beside",
    backwards: "Time backwards",
    forwards: "Time forwards",
    backwardsHow: "Only without any friction and without loss: else collisions cannot be undone",
    dragHow: "Discs can be dragged in the laboratory's view; time stands still meanwhile. " +
        "By keys: [ and ] take a disc, arrows move it, Escape lets it go",
    holds: (disc: number) => `Disc ${disc} is held; arrows move it, Escape lets it go.`,
    speed: "Swirls per second",
    view: "View",
    views: {lab: "Laboratory", m: "M-frame", both: "Both"},
    color: "Colour",
    colors: {spin: "spin", speed: "speed", pinned: "pinned", id: "disc"},
    colorMeans: {
        spin: "Orange spins with the swirl, blue against it, grey hardly.",
        speed: "Blue is at rest in the dish, grey as fast as the dish goes, orange twice as fast.",
        pinned: "Orange is pinned at the wall near M (the paper's criterion), blue is not.",
        id: "Each has a colour of its own.",
    },
    forces: "Forces",
    forcesHow: "In the M-frame: centrifugal (away from S) and Coriolis (to the right of where it goes)",
    trails: "Trails",
    keep: "Keep the discs",
    keepHow: "Changed frictions, restitutions and paths act on the same discs, from the next swirl on",
    hand: "Swirl by hand",
    handEnds: "End swirling by hand",
    handSays: (turns: string): string => `Move the dish with the pointer. The pack has turned ${turns} times.`,
    turned: "turned",
    turns: (turns: string): string => `${turns} turns`,
    noCommand: "none: the dish was changed while it moved",
    maps: "Maps: density, flow and profile",
    density: "Density in the M-frame; dark is dense",
    flow: "Flow relative to the dish",
    theta: "angle θ in the M-frame, M is at 270°",
    discs: "discs",
    wall: "wall",
    study: "Rotation against the number of discs (the paper's Figure 5b)",
    studyHow: "A run for every N and friction, on all cores, with the other parameters as they are " +
        "set here. Numbers and ranges FROM:STEP:TO, with commas between; a friction DISC:WALL is one " +
        "between discs and another at the wall.",
    start: "Start",
    stop: "Stop",
    stopped: "Stopped.",
    numberOfDiscs: "number of discs N",
    studyTable: "Save the table (CSV)",
    studyWrong: (most: number): string => "N and μ must be numbers or ranges FROM:STEP:TO, " +
        "or for μ pairs DISC:WALL, with commas between, for example N 5:6:53 and μ 0.1, 1, 1:0; " +
        `together at most ${most} runs.`,
    friction: (disc: number, wall: number): string =>
        disc === wall ? `${symbols.friction} = ${disc}`
            : `${symbols.friction}_d = ${disc}, ${symbols.friction}_w = ${wall}`,
    swirlsWrong: (text: string): string =>
        `The length of a run is '${text}', but it must be a whole number of swirls from 10 to 100000.`,
    studyProgress: (done: number, all: number): string => `${done} of ${all} runs done.`,
    crossing: (discs: string, lower: number, upper: number): string =>
        `${discs} (95 %: ${lower.toFixed(1)} to ${upper.toFixed(1)})`,
    bracket: (lower: number, upper: number): string => `between ${lower} and ${upper}`,
    noCrossing: "none",
    crossings: (friction: string, of: Record<Rate, string>): string =>
        `${friction}: N_c, where the direction of rotation changes. Mean over the discs: ${of.by_time} by time, ` +
        `${of.by_event} by event. Rigid body: ${of.rigid_by_time} by time, ${of.rigid_by_event} by event.`,
    collapsed: (runs: string): string => "Collapsed, and left out, since the model has no state after " +
        `it: ${runs}.`,
    runOf: (discs: number, friction: string): string => `N = ${discs} at ${friction}`,
    presets: "Presets",
    copied: "Copied",
    noWebAssembly: "This browser has no WebAssembly with vectors (SIMD), which the engine needs; " +
        "Chrome 91, Firefox 113, Safari 16.4 and later have it.",
    unknownName: (name: string): string => `The address has '${name}', but there is no such parameter.`,
    badEvents: (text: string): string =>
        `The address has events=${text}, but it must be a whole number from 0 to 10000000.`,
    warmup: (swirls: number): string => `Averages begin after ${swirls} swirls.`,
    notYet: "not known yet",
    grows: "Without friction the energy grows without bound on the polygon; the averages belong to no " +
        "steady state.",
    placing: (them: string): string => `Placing ${them}…`,
    running: (done: number, all: number): string => `${done} of ${all} events done.`,
    byTime: `${symbols.rotation} by time`,
    byEvent: `${symbols.rotation} by event`,
    mean: "mean",
    swirls: "swirls",
    /** One of them, several; a coin is a disc on a floor. */
    bodies: {disc: ["disc", "discs"], coin: ["coin", "coins"], sphere: ["sphere", "spheres"]},
    counted: (n: number, [one, several]: readonly string[]): string => `${n} ${n === 1 ? one : several}`,
    rotates: (n: number, them: string): string => `${them} ${n === 1 ? "rotates" : "rotate"} with the swirl.`,
    counterrotates: (n: number, them: string): string => `${them} ${n === 1 ? "turns" : "turn"} against the swirl.`,
    undecided: (them: string): string => `${them}: the sense of rotation is not decided yet.`,
    dish: (them: string, view: string): string => `${them} in a swirled dish, ${view}`,
    lesson: "A lesson in six steps",
    next: "Next",
    back: "Back",
    /** Of parameters, where they are not to be called as the command line calls them. */
    groups: {} as Record<string, string>,
    descriptions: {} as Record<string, string>,
};

/** What the engine's worker says: apart, so that it need not carry the page's texts. */
export const workerTexts = {
    stopped: (error: string): string => `The engine stopped: ${error}. Reload the page.`,
    control: (name: string, code: number): string => `--${name.replaceAll("_", "-")} contains the control ` +
        `character U+${code.toString(16).toUpperCase().padStart(4, "0")}, but a value is one line of text.`,
    tooMany: (discs: string, most: number): string => `${discs} discs are too many for a page, which ` +
        `takes ${most} at most; the command line has no such limit: ./swirl run --discs ${discs}.`,
};

export interface Step {
    title: string;
    text: string;
    given: Record<string, string>;
    view: "lab" | "m" | "both";
}

export const lesson: Step[] = [
    {title: "A few marbles", view: "lab", given: {discs: "8"},
     text: "Move a dish round in circles without turning it. A few marbles in it gather on one side " +
         "and run round with the swirl: the pack rotates the way the dish goes."},
    {title: "Many marbles", view: "lab", given: {discs: "48"},
     text: "Add marbles. When the dish is nearly full the pack turns the other way, against the " +
         "swirl. Nothing else has changed. Why?"},
    {title: "A frame that turns along", view: "both", given: {discs: "48"},
     text: "Look at it from a frame that turns with the swirl (right): there the dish stands still " +
         "and its wall runs clockwise past the marbles, like a belt. M is the point of the wall " +
         "farthest from the centre of the swirl; there the marbles are pressed against it."},
    {title: "Without friction", view: "both", given: {discs: "48", mu: "0"},
     text: "Take friction away, between marbles and at the wall. Now nothing holds a marble to the " +
         "wall, and nothing turns the pack against the swirl."},
    {title: "Frustration", view: "both", given: {discs: "48", mu: "1"},
     text: "With friction a marble at the wall would like to roll along it. But neighbours that " +
         "touch would have to turn in opposite senses, like gears, and three in a triangle cannot. " +
         "The more there are, the less they roll and the more they are dragged along by the wall: " +
         "backwards, seen from the room."},
    {title: "Do it yourself", view: "lab", given: {discs: "28"},
     text: "Film a dish from above with a telephone: 5 mm marbles, a lid of a jar. Count how far " +
         "the pack turns in ten swirls, add a marble, and film again. At which number does it stand " +
         "still?"},
];

export const presets: {name: string; given: Record<string, string>}[] = [
    {name: "48 discs, μ = 1 (the paper)", given: {discs: "48"}},
    {name: "28 discs, μ = 1", given: {discs: "28"}},
    {name: "48 discs, μ = 0.5", given: {discs: "48", mu: "0.5"}},
    {name: "48 discs, μ = 0.1", given: {discs: "48", mu: "0.1"}},
    {name: "48 discs, no friction between discs", given: {discs: "48", mu_disc: "0", mu_wall: "1"}},
    {name: "48 discs, no friction at the wall", given: {discs: "48", mu_disc: "1", mu_wall: "0"}},
    {name: "One large ball", given: {discs: "1", radius: "4"}},
    {name: "Two sizes", given: {discs: "40", mixture: "20:0.6"}},
    {name: "36 spheres that roll (the experiment)", given: {preset: "experiment", discs: "36"}},
    {name: "2000 small discs", given: {discs: "2000", radius: "0.14", inertia: "solid"}},
];
