// The English texts of the page. texts.de.ts has the same keys; a test compares them. The engine's error
// messages are translated by texts.engine.de.ts. Names of parameters and keys of files are English in both languages.

import type {Crossing, Rate} from "./engine";
import {symbols} from "./symbols";

/** The texts for the {{names}} in index.html, inserted when the page is built. */
export const pageTexts = {
    language: "en",
    title: "Pancake rotation: why marbles in a swirled dish turn backwards",
    description: "Swirl a dish: a few marbles turn with the swirl, many turn backwards. Move the slider and find the number at which " +
        "the direction changes, in an exact simulation.",
    name: "swirl",
    noScript: "This page needs JavaScript, which is turned off here.",
    dish: "Simulated container",
    controls: "Result and controls",
    lesson: "Lesson",
    gallery: "Examples",
    panels: "More views",
    tagline: "Marbles in a swirled dish turn with the swirl, or against it.",
    commandLine: "The page uses the engine, the parameters and the averages of the command line. This command " +
        "reproduces the state exactly:",
    copy: "Copy",
    after: "After",
    stateHashIs: "events the hash of the state is",
};

export const texts = {
    play: "Play (space)",
    pause: "Pause (space)",
    share: "Save and share",
    link: "Copy the link",
    send: "Send the link…",
    copy: "Copy",
    step: "Next event (.)",
    lapse: "Fast-forward to the averages, one image per period (F)",
    strobe: "Stroboscope",
    strobeHelp: "One image per period: this hides the sloshing and shows the slow rotation (S)",
    restart: "Restart (R)",
    image: "Save image (PNG)",
    table: "Save ϖ per period (CSV)",
    result: "Save result (JSON)",
    record: "Record",
    recordStop: "Stop recording",
    movie: (form: string): string => `Save movie (${form})`,
    positions: "Save positions (XYZ)",
    compare: "Compare",
    compareHelp: "Keeps this container on the page, next to a new one",
    comparedResult: (name: string, rotation: string): string => `${name}: ${symbols.rotation} = ${rotation}`,
    closeCompared: "Close the compared container",
    backwards: "Reverse time",
    forwards: "Time forwards",
    backwardsHelp: "Needs zero friction and restitution 1: otherwise collisions cannot be reversed",
    dragHelp: "Drag a disc in the lab frame; time pauses meanwhile. " +
        "Keys: [ and ] select a disc, arrows move it, Escape deselects it",
    selected: (disc: number) => `Disc ${disc} is selected. Arrows move it, Escape deselects it.`,
    options: "Move by hand, compare and more",
    speed: "Pace",
    speedHelp: "Periods per second",
    view: "View",
    views: {lab: "Lab frame", m: "M-frame", both: "Both", density: "Map of density", flow: "Map of flow",
        spin: "Map of spin"},
    color: "Colour",
    colors: {sector: "by sector", spin: "by spin", speed: "by speed", pinned: "pinned or loose", id: "by disc"},
    pinned: "pinned: moves with the wall",
    loose: "loose",
    sparse: "empty",
    dense: "dense",
    spinAgainst: "spin against",
    spinWith: "with",
    atRest: "at rest",
    fast: "fast",
    flowKey: "arrow one cell long: speed of the container",
    lapseNote: "time-lapse: one image per period",
    strobeNote: "stroboscope: one image per period",
    forces: "Forces",
    forcesHelp: "In the M-frame: centrifugal force (away from S) and Coriolis force (to the right of the velocity)",
    trails: "Trails",
    trailsHelp: "The last third of a period; with the stroboscope, the last twelve periods (T)",
    keep: "Keep the discs",
    keepHelp: "New friction coefficients, restitutions and paths apply to the same discs, from the next period on",
    hand: "Move by hand",
    byHandStop: "Stop moving by hand",
    byHandHeadline: (turns: string): string =>
        `Move the container with the pointer. The cluster has rotated by ${turns} turns.`,
    turned: "turned",
    turnedHelp: "Angle by which the cluster has rotated: ϖ summed over time. The arc shows this angle",
    rotationHelp: "Rotation rate of the cluster relative to the rate at which the container moves around its path: mean over discs and " +
        "time. The error appears after 50 periods. The band on the gauge is the 95 % interval, 1.96 errors to each side.",
    periodsHelp: "Turns of the container on its path",
    differ: (rigid: string): string => `With more weight on outer discs, as in a rigid body, the cluster has turned by ${rigid} turns: ` +
        "inner and outer discs rotate at different rates.",
    sides: {with: "with the swirl", against: "against the swirl"},
    /** The text before and after the direction. */
    verdict: (n: number, particles: string): [string, string] => [`${particles} ${n === 1 ? "turns" : "turn"} `, "."],
    soFar: (particles: string): [string, string] => [`${particles}, so far: `, "."],
    nearZero: (particles: string): [string, string] => [`${particles} hardly turn; if at all, `, "."],
    perPeriod: "Rotation rate in each period, and the mean since the warm-up",
    /** Symbols of parameters where the page has little room. */
    symbolOf: {discs: "N", mu_disc: "μ_d", mu_wall: "μ_w", amplitude: "A", restitution: "e"} as Record<string, string>,
    clipped: (n: number, at: number): string => `${n === 1 ? "One period is" : `${n} periods are`} beyond ±${at}: ` +
        "a disc passed close to the centre of mass.",
    labels: {discs: "Number of discs", mu: "Friction", amplitude: "Amplitude", mu_disc: "Friction between discs",
        mu_wall: "Friction at the wall", preset: "Preset", body: "Body", radius: "Disc radius", mass: "Disc mass",
        inertia: "Moment of inertia", mixture: "Second species", sizes: "Distribution of sizes", restitution: "Bounciness",
        tangential_restitution: "Tangential bounciness", contact_duration: "Contact duration", floor: "Floor",
        floor_friction: "Friction of the floor", gravity: "Gravity", rolling_resistance: "Rolling resistance",
        vertical_disc: "Vertical slip, discs", vertical_wall: "Vertical slip, wall", container_radius: "Container radius",
        period: "Period", speed: "Speed", path: "Path", sides: "Sides of the path",
        direction: "Direction of the path", path_phase: "Start on the path", warmup: "Warm-up", seed: "Seed",
    } as Record<string, string>,
    spheres: "Rolling spheres",
    spheresHelp: "Spheres that roll on a floor, as in the paper's experiment\n--preset experiment",
    more: "More parameters",
    turns: (turns: string): string => `${turns} turns`,
    noCommand: "none, because the simulation was changed while it ran",
    maps: {density: "density, mean so far", flow: "flow relative to the container", spin: "mean spin"},
    mapEmpty: "no averages yet",
    profile: "Rotation against the angle in the M-frame (the paper's Figure 3)",
    theta: "angle θ in the M-frame, M is at 270°",
    discs: "discs",
    wall: "wall",
    start: "Start",
    stop: "Stop",
    stopped: "Stopped.",
    numberOfDiscs: "number of discs N",
    invalidPeriods: (text: string): string =>
        `The length of a run is '${text}', but it must be a whole number of periods from 10 to 100000.`,
    studyProgress: (done: number, all: number): string => `${done} of ${all} points done.`,
    crossing: (discs: string, lower: number, upper: number): string =>
        `${discs} (95 %: ${lower.toFixed(1)} to ${upper.toFixed(1)})`,
    bracket: (lower: number, upper: number): string => `between ${lower} and ${upper}`,
    collapsed: (runs: string): string => `Omitted, because the run collapsed: ${runs}.`,
    verdicts: {always_rotates: "none: the cluster always rotates with the swirl",
               always_counterrotates: "none: the cluster always rotates against the swirl",
               undecided: "not determined"} as Record<Exclude<Crossing["verdict"], "crosses">, string>,
    rateNames: {by_time: "by time", by_event: "by event", rigid_by_time: "by time, rigid body",
                rigid_by_event: "by event, rigid body"} as Record<Rate, string>,
    discovery: {
        title: "Rotation against the number of discs",
        about: "About this plot",
        help: "For each number of discs that you select, the page makes four separate runs in the background: first of 50 " +
            "periods, then of 200 and 800. Bars are 95 % intervals from the scatter between the runs. The dashed line marks the present number, the ring its live average. " +
            "The points stay until you close the page; the link contains them.",
        description: (points: number, finding: string): string =>
            `Plot of the rotation rate against the number of discs with ${points} points. ${finding}`,
        defaults: "default parameters",
        noCrossing: "Move the slider of the number of discs. Where does the direction of rotation change?",
        bracket: (lower: number, upper: number): string =>
            `The direction changes between N = ${lower} and N = ${upper}. Select the numbers in between.`,
        crossing: (discs: string): string => `From your points: the direction changes at N_c = ${discs}.`,
        invalid: (points: number): string => `The address contains ${points} ${points === 1 ? "point that is" : "points that are"} ` +
            "damaged. The page omits them.\nhint: copy the whole link.",
        table: "CSV",
        tableHelp: "Save the points as a table",
        link: "Link",
        linkHelp: "Copy a link with the parameters and the points",
        linkCopied: "The link was copied. It contains the parameters and your points.",
        linkIs: "Copy this link: ",
        clear: "Clear",
        clearHelp: "Remove all points",
    },
    explorer: {
        title: "Explorer: rotation or N_c against any parameter",
        help: "Each point has four runs, which use all cores of this computer. The other parameters are those of the page. Points appear with their " +
            "95 % intervals. With the number of discs on the axis, this is the paper's Figure 5b. N_c is the number of discs at which the direction changes.",
        quantity: "Show",
        crossing: "N_c",
        against: "against",
        values: "values",
        valuesHelp: "Numbers and ranges FROM:STEP:TO, separated by commas",
        curves: "one curve for each value of",
        curvesHelp: "As for the axis. For mu, DISC:WALL sets the coefficients between discs and at the wall separately",
        oneCurve: "(one curve)",
        invalid: (most: number): string => "Values must be numbers or ranges FROM:STEP:TO, separated by commas; " +
            `mu can have pairs DISC:WALL. The limit is ${most} points.\nhint: try discs 5:6:53 and mu 0.1, 1, 1:0.`,
        sameParameter: (name: string): string =>
            `The parameter ${name} is on the axis and in the curves.\nhint: choose another one for the curves.`,
        searches: (done: number, all: number, runs: number): string =>
            `${done} of ${all} searches done, ${runs} runs so far.`,
        imprecise: "The error is above the target of 0.25.",
        description: (points: number, name: string): string => `Plot against ${name} with ${points} points.`,
        command: "The same on the command line:",
        table: "Save table (CSV)",
        picture: "Save plot (PNG)",
    },
    opened: {
        choose: "Open a file of swirl…",
        help: "A result (JSON) or a checkpoint. You can also drop it on the page. It stays on this computer.",
        drop: "Drop a result or checkpoint of swirl here",
        close: "Close the file",
        unknown: (name: string): string => `'${name}' is not a result or checkpoint of swirl.\n` +
            "hint: open a file that swirl run wrote with --json or --checkpoint. Notebooks read recordings.",
        tooLarge: (name: string, most: number): string => `'${name}' is larger than ${most} MB.\n` +
            "hint: use the command line.",
        damaged: (name: string): string => `'${name}' cannot be read: it is damaged or incomplete.`,
        wrongValue: (name: string, what: string): string => `'${name}' is damaged: ${what}, which is not possible.`,
        noParameters: (name: string): string => `'${name}' contains no parameters of a run.`,
        result: (name: string): string => `Result ${name}`,
        checkpoint: (name: string, events: number): string => `Checkpoint ${name}, after ${events} events`,
        parametersSet: "The page now has the parameters of the file.",
        comparing: "The page repeats the run…",
        sameHash: "The page repeated the run. The state after its last event is bitwise identical.",
        otherHash: "The page repeated the run. The state after its last event differs.\n" +
            "hint: the file may come from another version of swirl.",
        tooLong: (events: number, most: number): string =>
            `The run has ${events} events; the page repeats runs of up to ${most}.`,
        quantity: "Quantity",
        inFile: "File",
        onPage: "Page",
        events: "events",
        hash: "hash of the state",
    },
    lesson: {
        start: "Lesson for one school hour",
        next: "Next",
        back: "Back",
        close: "End the lesson",
        step: (step: number, all: number, title: string): string => `Step ${step} of ${all}: ${title}`,
        tryNext: "Try the opposite",
        predict: "Choose your prediction first.",
        watch: "Watch the container. The result appears when the page has measured it.",
        right: "Your prediction was right.",
        wrong: "Your prediction was different.",
        result: (text: string): string => `Result: ${text}`,
        rotation: (rotation: string, direction: string): string => `${symbols.rotation} = ${rotation}, ${direction}`,
        crossing: (discs: string): string => `the direction changes at N_c = ${discs} discs`,
        noCrossing: "the direction does not change in this range",
        directions: ["with the swirl", "against the swirl", "not at all, or too slowly to see"],
        ranges: (lower: number, upper: number): string =>
            lower <= 0 ? `below ${upper + 1} discs` : upper === Infinity ? `${lower} discs or more` : `${lower} to ${upper} discs`,
        teaching: "For teachers and tournament teams",
        worksheetHelp: "The lesson has six steps; in each, the class predicts, observes and explains. The worksheet has the " +
            "same questions, graph paper for the points, and an experiment with marbles.",
        worksheet: "Print the worksheet",
        team: "For tournament teams",
    },
    copied: "Copied",
    noWebAssembly: "This browser does not support WebAssembly with SIMD, which the engine needs.\n" +
        "hint: use Chrome 91, Firefox 113, Safari 16.4 or later.",
    invalidLesson: (text: string, steps: number): string =>
        `The address contains lesson=${text}, but the lesson has the steps 1 to ${steps}.`,
    invalidEvents: (text: string): string =>
        `The address contains events=${text}, but it must be a whole number from 0 to 10000000.`,
    warmup: (periods: number): string => `Averages start after ${periods} periods.`,
    notYet: "n/a",
    grows: "Without friction the energy grows without bound on the polygon. The averages do not belong to a " +
        "steady state.",
    noSimulation: "No simulation",
    tooDense: (particles: string, percent: number): string => `${particles} would cover ${percent} % of the container, and no ` +
        "arrangement without overlap was found within a second.\nhint: choose fewer discs, smaller ones, or a larger container.",
    paint: "Paint again",
    paintHelp: "Colours the discs by the sector in which they are now (P)",
    lapsesByItself: "Fast-forward automatically",
    lapsesHelp: "At the start, and three seconds after a change, time runs fast until there are averages",
    keys: "Keyboard",
    keysOn: "Single keys are shortcuts",
    close: "Close",
    keyNames: {
        " ": ["Space", "play and pause"], ".": [".", "next event"], r: ["R", "restart"], f: ["F", "fast-forward to the averages"],
        s: ["S", "stroboscope"], t: ["T", "trails"], v: ["V", "next view"], c: ["C", "next colouring"], p: ["P", "paint by sector again"],
        h: ["H", "move by hand"], "+": ["+", "one disc more"], "-": ["−", "one disc less"], m: ["M", "more parameters"],
        l: ["L", "lesson"], e: ["E", "explorer"], d: ["D", "save and share"], "?": ["?", "this list"],
    } as Record<string, [string, string]>,
    keysOfDish: "In the container: [ and ] select a disc, the arrows move it, Escape deselects it.",
    placing: (particles: string): string => `Placing ${particles}…`,
    running: {
        events: (done: number, all: number): string => `${done} of ${all} events done.`,
        periods: (done: number, all: number): string => `${done} of ${all} periods done.`,
    },
    periods: "periods",
    /** Singular and plural. */
    bodies: {disc: ["disc", "discs"], sphere: ["sphere", "spheres"]},
    counted: (n: number, [one, several]: readonly string[]): string => `${n} ${n === 1 ? one : several}`,
    undecided: (particles: string): string => `${particles}: the direction of rotation is not determined yet.`,
    container: (particles: string, view: string): string => `${particles} in a swirled container, ${view}`,
    /** Translations of parameter groups and descriptions; the command line's texts are the default. */
    groups: {friction: "Friction", particles: "Particles", collisions: "Collisions", floor: "Floor and rolling",
        container: "Container and path", run: "Run"} as Record<string, string>,
    descriptions: {} as Record<string, string>,
};

/** The texts of the engine's worker, separate so that the worker does not contain those of the page. */
export const workerTexts = {
    stopped: (error: string): string => `The engine stopped: ${error}.\nhint: reload the page.`,
    control: (name: string, code: number): string => `--${name.replaceAll("_", "-")} contains the control ` +
        `character U+${code.toString(16).toUpperCase().padStart(4, "0")}, but a value must be one line of text.`,
    tooMany: (discs: string, most: number): string => `${discs} discs are too many for the page, whose limit is ` +
        `${most}.\nhint: choose fewer discs; the program swirl has no such limit.`,
};

/** A step of the lesson; lesson.ts has its parameters. Steps that ask for a direction or for N_c have their
 *  options in texts.lesson. */
export interface StepTexts {
    title: string;
    text: string;
    question: string;
    options?: string[];
    explanation: string;
}

export const lessonSteps: StepTexts[] = [
    {title: "A few discs",
     text: "A round container moves on a circle, counter-clockwise, and does not rotate itself. There are 8 discs in it. " +
         "They gather on one side and move along the wall.",
     question: "Which way does the cluster of discs rotate?",
     explanation: "The cluster rotates with the swirl, as most people expect: the container goes round, and its content goes " +
         "round with it."},
    {title: "Many discs",
     text: "Now there are 48 discs in the same container. Nothing else was changed.",
     question: "Which way does the cluster rotate now?",
     explanation: "The cluster rotates against the swirl, although the container moves in exactly the same way as before. " +
         "The rest of the lesson looks for the reason."},
    {title: "The change of direction",
     text: "Somewhere between 8 and 48 discs the direction changes. This number is called N_c. After your prediction, move " +
         "the slider of the number of discs. Each number that you select adds a point to the plot.",
     question: "At which number of discs does the direction change?",
     explanation: "Near N_c the cluster sloshes around the container without rotating. The page has searched for N_c with " +
         "many runs. Do your own points agree with it?"},
    {title: "The container at rest",
     text: "This view rotates with the swirl (M-frame). Here the container is at rest, and its point M, which is " +
         "farthest from the centre of the swirl, is always at the bottom. The discs are pressed towards M.",
     question: "How does the wall move in this view?",
     options: ["clockwise, like a belt", "counter-clockwise, like a belt", "it is at rest"],
     explanation: "In the room the wall does not rotate. Seen from a frame that rotates counter-clockwise, it moves " +
         "clockwise past the discs, like a conveyor belt. Through friction this belt drags the discs at the wall along: " +
         "against the swirl."},
    {title: "Which friction matters",
     text: "The 48 discs keep their friction with each other, but now the wall is perfectly smooth.",
     question: "Which way does the cluster rotate without friction at the wall?",
     explanation: "A smooth belt cannot drag anything, so the cluster follows the swirl. Now try the opposite: friction " +
         "at the wall, but none between the discs. Then the wall can only spin the outermost discs, and they pass nothing " +
         "on. The cluster again follows the swirl. Counterrotation needs both kinds of friction."},
    {title: "Gears or grip?",
     text: "Gears that touch turn in opposite directions. Three gears in a triangle therefore block each other, which " +
         "physicists call frustration. Do the discs behave like gears? Colours show the direction of the spin.",
     question: "In which directions do two discs spin that touch each other?",
     options: ["in opposite directions, like gears", "there is hardly any rule", "in the same direction"],
     explanation: "Gears would have a spin correlation of −1. In the simulation it is between −0.04 and 0, so the " +
         "discs are not gears. The grip of the wall changes much more: discs at the wall move with 79 % of its speed in a " +
         "cluster of 24, and with 97 % in a cluster of 48. With many discs the belt hardly slips. The cluster then " +
         "rotates against the swirl, nearly like a pancake that rolls on the wall."},
];

export const worksheet = {
    title: "Discs in a swirled container",
    name: "Name",
    date: "Date",
    prediction: "My prediction",
    measured: "Measured",
    explanation: "My explanation",
    table: "Step 3: my points",
    graph: "Rotation rate against the number of discs",
    crossing: "The direction changes at N_c =",
    experiment: "Your own experiment",
    experimentText: "Put 5 mm spheres or marbles of one size into the lid of a jar. Move it in circles on the table, about two " +
        "circles per second, without rotating it. Measure how far the cluster rotates in 20 circles of the lid. " +
        "To see this, mark one sphere with a colour.",
    number: "number",
    turns: "turns of the cluster",
    direction: "with (+) or against (−) the swirl",
    question: "At which number of spheres does the rotation stop? Why can it differ from the number on the page?",
};

export const team = {
    intro: "Pancake Rotation was problem 15 of the International Young Physicists' Tournament 2023. A team can go from the " +
        "page to its own data:",
    points: [
        "Measure with a phone: fix it above the dish with the camera axis vertical, and record in slow motion (120 or 240 frames " +
            "per second). Light from the side, a matt dark floor, and a coloured mark on the dish help the tracking.",
        "Vary one quantity at a time: number and size of the spheres, radius and frequency of the path, material of the wall. " +
            "The explorer on this page shows which of them changes N_c.",
        "Turn videos into rotation rates with the program: the commands below find the dish and the spheres, and " +
            "give ϖ/Ω with its error.",
        "Errors: successive periods are not independent, so divide the video into blocks of several periods and use the " +
            "scatter of the block means. Repeat each number at least three times, each time with a new start. The scatter between " +
            "repeats shows errors that a single video hides. A tilted camera and a path that is not a circle give systematic " +
            "errors: swirl the empty dish with one mark on it and check that the path of the mark is round.",
        "Compare with the model: set the parameters of your dish on this page or with --preset experiment (rolling spheres). Friction " +
            "is the quantity that you know least, so plot N_c against it and find the value that fits.",
    ],
    commands: ["./swirl track dish.mp4 --out tracks.csv", "./swirl measure tracks.csv",
               "./swirl experiment N24.mp4 N36.mp4 N48.mp4 --out marbles"],
    more: "Details:",
    pages: {"explanation/why": "why it reverses", "how-to/record_experiment": "record an experiment", "tutorials/phone_video": "from a phone video to a rotation rate",
            "explanation/tracking_accuracy": "tracking accuracy", "explanation/statistics": "errors and steady state"} as
        Record<string, string>,
};

/** The gallery. */
export const examples: {name: string; help: string; given: Record<string, string>}[] = [
    {name: "A few", help: "8 discs", given: {discs: "8"}},
    {name: "Many", help: "48 discs, as in the paper", given: {}},
    {name: "Slippery wall", help: "48 discs without friction at the wall", given: {mu_disc: "1", mu_wall: "0"}},
    {name: "Slippery discs", help: "48 discs without friction between discs", given: {mu_disc: "0", mu_wall: "1"}},
    {name: "Rolling spheres", help: "36 spheres with the amplitude that the paper states, 1.15 cm. Its supplement implies half of it, but then spheres behave differently", given: {preset: "experiment", discs: "36"}},
    {name: "Two sizes", help: "20 discs and 20 smaller ones", given: {discs: "40", mixture: "20:0.6"}},
];
