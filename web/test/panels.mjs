// Unit tests of discovery, explorer, search, lesson, opened files, plots and texts: node panels.mjs
// PARAMETERS.json SWIRL.wasm [FOLDER]. PARAMETERS is the engine's table; FOLDER has files of the
// command line. Exits with 1 and a message if a test fails.
import assert from "node:assert/strict";
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {runsOf} from "./background.mjs";
import {filesWith, loader, textOf} from "./sources.mjs";

const [table, wasm, files] = process.argv.slice(2);
const parameters = JSON.parse(readFileSync(table, "utf-8"));
const folder = mkdtempSync(join(tmpdir(), "swirl-panels-"));
const load = loader(folder, {
    loader: {".gz": "empty"},
    external: ["./worker?worker&inline", "*.gz?url"],
});

/** All keys of an object with those of its objects. */
const shapeOf = (value, path = "") =>
    typeof value !== "object" || value === null
        ? [[path, value]]
        : Object.entries(value).flatMap(([key, each]) => shapeOf(each, `${path}.${key}`));
/** Numbers, names of options and parameters, and commands in a text. */
const marksIn = (text) =>
    (
        text
            .replace(/(\d),(?=\d)/g, "$1.")
            .match(/\d+(?:\.\d+)?|--[a-z-]+|\bmu_\w+|N_c|\.\/swirl \w+|ϖ/g) ?? []
    ).sort();
/** Words that are the same in both languages. */
const sameInBoth =
    /^[\W\d_]*$|^(?:swirl|CSV|Link|Start|Name|Amplitude|\.\/swirl .*|sphere|N_c.*|[A-Zμe](?:_\w)?|Frustration|s = .*γ.*)$/;

try {
    // Both languages have the same keys, and their texts the same numbers and names.
    const [en, de] = ["en", "de"].map((each) => JSON.parse(textOf(`texts.${each}.json`)));
    const [english, german] = [en, de].map((each) => new Map(shapeOf(each)));
    // The English names and descriptions of parameters come from the engine.
    const ofParameters = (key) => /^\.texts\.(?:labels|descriptions)\b/.test(key);
    assert.deepEqual(
        [...german.keys()].filter((key) => !ofParameters(key)).sort(),
        [...english.keys()].filter((key) => !ofParameters(key)).sort(),
    );
    /** The names in braces. */
    const valuesIn = (text) => (text.match(/\{\w+(?=[|}])/g) ?? []).sort();
    const {fill} = await load("worker_texts");
    assert.equal(
        fill("{n|{n} disc is|{n} discs are} {x}, {y}", {n: 1, x: "a{n}", y: 2.5}),
        "1 disc is a{n}, 2.5",
    );
    assert.equal(fill("{n|{n} disc is|{n} discs are} {other}", {n: 2}), "2 discs are {other}");
    const untranslated = [];
    for (const [key, a] of english) {
        const b = german.get(key);
        if (typeof a !== "string" || key.endsWith("language")) continue;
        assert.deepEqual(
            [...new Set(valuesIn(b))],
            [...new Set(valuesIn(a))],
            `${key}: '${b}' and '${a}' have other values`,
        );
        assert.deepEqual(
            marksIn(b),
            marksIn(a),
            `${key}: '${b}' and '${a}' have other numbers or names`,
        );
        if (a === b && !key.includes(".given.") && !sameInBoth.test(a.replace(/\{\w+\}/g, "")))
            untranslated.push(`${key}: ${a}`);
    }
    // Each text with values is filled where the page uses it, with exactly these values.
    const all = filesWith(".ts")
        .map((each) => readFileSync(each, "utf-8"))
        .join("\n");
    for (const [key, text] of english) {
        const names = [...new Set(valuesIn(String(text)).map((each) => each.slice(1)))],
            name = key.split(".").at(-1);
        if (names.length === 0 || /opened|running/.test(key)) continue; // chosen by a key
        const calls = [
            ...all.matchAll(
                new RegExp(`(?:fill|withElements)\\((?:\\w+\\.)*${name}, \\{([^]*?)\\}\\)`, "g"),
            ),
        ].map(([, given]) => given);
        assert.ok(
            calls.some((given) =>
                names
                    .filter((each) => !/^(one|other|direction)$/.test(each))
                    .every((each) => new RegExp(`\\b${each}\\b`).test(given)),
            ),
            `${key} needs ${names}; the page gives ${calls}`,
        );
    }
    assert.deepEqual(untranslated, []);
    // Names that the page does not show would never be read. A parameter without a German name has
    // the English one.
    const shown = parameters.filter((row) => row.page_group !== null);
    assert.ok(
        shown.every(
            ({settable, label, page_group}) =>
                settable && label && (page_group === "main" || en.texts.groups[page_group]),
        ),
    );
    const labels = Object.fromEntries(shown.map((row) => [row.name, row.label]));
    for (const name of Object.keys({...de.texts.descriptions, ...de.texts.labels}))
        assert.ok(labels[name], `texts.de.json names '${name}', which the page does not show`);

    // A pancake on the wall of the dish: the direction changes where s = R_c/R
    // (docs/explanation/why.md).
    const {pancakeGamma} = await load("cause");
    assert.deepEqual(
        [
            [1, 0.8],
            [0.8, 0.8],
            [0, 0.8],
        ].map(([slip, size]) => 1 - pancakeGamma(slip, size)),
        [-0.25, 0, 1],
    );

    const {Engine, perRate} = await load("engine"),
        module = await WebAssembly.compile(readFileSync(wasm));
    // A dish in millimetres gives the parameters of the presets, which are the two readings of the
    // paper's experiment.
    const {givenFor, pooled} = await load("my_dish"),
        experiment = {container: 25.5, particle: 3, rate: 11.81 / (2 * Math.PI)};
    assert.deepEqual(givenFor({...experiment, amplitude: 11.5}), {
        preset: "experiment",
        container_radius: "8.5",
        amplitude: "3.8333",
        period: "24.086",
        gravity: "1.5955",
    });
    assert.deepEqual(givenFor({...experiment, amplitude: 5.75}).gravity, "6.382");
    // Counted turns have the error of two readings of a mark; wrong lines are named.
    const {measuredFrom, measuredFromLink, measuredText, rateOf} = await load("measured");
    const counted = measuredFrom("8 4.5 20\n48 −0.7  20\n\n");
    assert.deepEqual(counted, {
        rows: [
            [8, 4.5, 20],
            [48, -0.7, 20],
        ],
        wrong: undefined,
    });
    assert.deepEqual(measuredFromLink(measuredText(counted.rows)), counted);
    assert.equal(rateOf([8, 4.5, 20])[0], 0.225);
    assert.ok(Math.abs(rateOf([8, 4.5, 20])[1] - 0.0059) < 1e-4); // √2/12 of a turn in 20 circles
    for (const wrong of [
        "8 4",
        "x 4 20",
        "8 4 0",
        "8 1 1e-300",
        "8.5 4 20",
        "8 4 20 1",
        "8 1e99 20",
        "8 900 20",
        "-1 0 20",
        "8 4 Infinity",
    ])
        assert.deepEqual(measuredFrom(`8 4 20\n${wrong}`), {rows: [[8, 4, 20]], wrong}, wrong);
    // Results of a class: each seed counts once, the error is that between pupils, and other
    // parameters are omitted.
    const isKnown = (name) => ["discs", "mu", "seed"].includes(name),
        link = (seed, points, more = "") =>
            `https://x.org/lab.html?seed=${seed}${more}#points=${points}`;
    const shared = [
        link(11, "8_0.1_0.01_200,48_-0.04_0.01_50"),
        link(12, "8_0.2_0.01_200", "&lang=de"),
        link(12, "8_0.2_0.01_200"),
        link(13, "8_0.9_0.01_200", "&mu=0.1"),
        "nonsense",
        "?seed=14",
    ].join("\n");
    const engine = new Engine(module),
        {Runs} = await load("runs");
    const runs = runsOf(Runs, engine, perRate);
    const {
        points: ofClass,
        pupils,
        omitted,
    } = await pooled(shared, "", isKnown, (all) => runs.estimates(all));
    assert.deepEqual([pupils, omitted, [...ofClass.keys()]], [2, 3, [8, 48]]);
    assert.ok(Math.abs(ofClass.get(8).mean - 0.15) < 1e-12);
    assert.ok(
        Math.abs(ofClass.get(8).error - (12.7062 / 1.95996) * 0.05) < 1e-5,
        `${ofClass.get(8).error}`,
    ); // Student's t of two values
    assert.deepEqual([ofClass.get(8).periods, ofClass.get(48).error], [400, 0.01]);

    // Each sentence of the engine is in German, too, with the same values, numbers and options.
    const table = readFileSync(
        new URL("../../src/swirl/run/sentences.hpp", import.meta.url),
        "utf-8",
    );
    const sentences = Object.fromEntries(
        [...table.matchAll(/^ {4}\{"(\w+)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)\}/gm)].map(
            ([, code, parts]) => [
                code,
                parts
                    .match(/"(?:[^"\\]|\\.)*"/g)
                    .map((each) => JSON.parse(each))
                    .join(""),
            ],
        ),
    );
    assert.equal(Object.keys(sentences).length, table.match(/^ {4}\{"/gm).length);
    const germanOf = JSON.parse(textOf("texts.engine.de.json"));
    assert.ok(Object.keys(sentences).length > 90);
    assert.deepEqual(Object.keys(germanOf).sort(), Object.keys(sentences).sort());
    const optionsIn = (text) => text.match(/--[a-z-]+/g) ?? [];
    for (const [code, a] of Object.entries(sentences)) {
        const b = germanOf[code];
        const values = [a, b].map((text) => [...new Set(valuesIn(text))].sort());
        assert.deepEqual(values[1], values[0], `${code}: '${b}' and '${a}' have other values`);
        assert.equal(/\nTipp: /.test(b), /\nhint: /.test(a), `${code}: only one has a hint`);
        for (const option of optionsIn(b))
            assert.ok(optionsIn(a).includes(option) || option === "--period", `${code}: ${option}`);
        assert.ok(b !== a || code === "without_code", code);
    }
    // Values in German: a decimal comma, words, phrases, and a number that has an exponent.
    const {inGerman} = await load("texts");
    const said = (code, values) =>
        inGerman({text: "", sentences: [{code, values}]}, de.texts.labels);
    assert.equal(
        said("out_of_range", {name: "--mu", value: -0.5, from: 0, to: 1e18}),
        "Reibung ist -0,5, muss aber eine Zahl von 0 bis 1e+18 sein.",
    );
    assert.equal(
        said("not_a_choice", {name: "--body", text: "x", choices: {words: "a\nb\nc"}}),
        "Körper ist „x“, muss aber a, b oder c sein.",
    );
    assert.equal(
        said("mixture_of_none", {percent: 0.1, discs: 1, body: [{code: "sphere", values: {}}]}),
        "Zweite Sorte: Der Anteil ist 0,1 %; das ist keine von 1 Kugel.\n" +
            "Tipp: Nimm einen größeren Anteil oder mehr Kugeln.",
    );
    // The advice against a decimal comma does not show one.
    assert.match(said("decimal_point", {whole: "0", decimals: "5"}), /statt des Kommas: 0\.5\. /);

    // Messages of the engine, in German with their numbers.
    const numbersIn = (sentences) =>
        sentences
            .flatMap(({values}) => Object.values(values))
            .flatMap((value) => (Array.isArray(value) ? numbersIn(value) : [value]))
            .filter((value) => typeof value === "number");
    const rejected = new Map();
    // Every parameter that the page shows, of four scenes, with values that most of them cannot
    // have; one message of each form.
    const values = [
        "",
        "0",
        "-1",
        "x",
        "1e999",
        "1e308",
        "1e-300",
        "0.5",
        "1000000",
        "3,5",
        "1:2:3",
        "200%:1",
        "1%:1",
        "5:1e9",
        "5:1:1e99",
        "auto",
        "circle",
        "sphere",
        "normal:1:0.5",
        "uniform:0:1",
        "power:1:2",
        "ellipse:2",
    ];
    for (const scene of [{}, {preset: "experiment"}, {mixture: "20:0.6"}, {amplitude: "0"}])
        for (const name of Object.keys(de.texts.labels))
            for (const value of values)
                try {
                    if (name !== "discs" || Number(value) !== 1000000)
                        new Engine(module).begin({discs: "12", ...scene, [name]: value}); // it would place them
                } catch ({message, said: sentence}) {
                    const form = message.replace(/'.*?'/g, "").replace(/[-\d.e+]+/g, "#");
                    rejected.set(form, sentence);
                }
    assert.ok(rejected.size > 40, `only ${rejected.size} messages`);
    // A line break or an invisible character in a value could add or hide a part of the command.
    for (const [character, code] of [
        ["\n", "000A"],
        ["\r", "000D"],
        ["\0", "0000"],
        ["\x1b[2J", "001B"],
        ["\u202e", "202E"],
        ["\u2028", "2028"],
    ])
        assert.throws(
            () => new Engine(module).begin({discs: `5${character}seed=7`}),
            new RegExp(`control character U\\+${code},`),
        );
    for (const message of [
        ...JSON.parse(readFileSync(join(files, "messages.json"), "utf-8")),
        ...rejected.values(),
    ]) {
        const shown = inGerman(message, de.texts.labels);
        assert.doesNotMatch(
            shown,
            /\b(?:the|is|are|must|but|with|use|hint|container|discs)\b|--|[{}]|undefined/,
            message.text,
        );
        const numbers = numbersIn(message.sentences);
        const missing = numbers.filter((number) => !shown.includes(fill("{x}", {x: number}, true)));
        assert.deepEqual(missing, [], `'${shown}' lacks numbers of '${message.text}'`);
    }
    // Pupils read names of fields instead of options, and in German decimal commas.
    const {labelled} = await load("symbols");
    const fit = "60 discs do not fit …\nhint: use fewer discs or a larger --container-radius.";
    assert.match(labelled(fit, labels), /\nhint: use fewer discs or a larger container radius\.$/);
    assert.equal(
        labelled("--mu-disc is -1, but --mu is 2.", labels),
        "Friction between discs is -1, but friction is 2.",
    );
    for (const [key, value] of [...german, ...english]) {
        const said = typeof value === "function" ? String(value) : String(value);
        if (
            !/valuesHelp|curvesHelp|spheresHelp|explorer\.invalid|opened\.unknown|team\.|worker\.control|descriptions/.test(
                key,
            )
        )
            assert.doesNotMatch(said, /(?<!-)--[a-z]/, `${key} has an option of the command line`);
    }
    // One word for each thing, and a decimal comma, in German.
    for (const [key, value] of german)
        assert.doesNotMatch(
            String(value),
            /Schwenksinn|Behälter|Explorer|Unterrichtsstunde|(?<!ul)stunde beenden|Zufallszahl|Amplitude|Dezimalpunkt/,
            `${key} has another word than the rest of the page`,
        );
    for (const [key, value] of german)
        if (typeof value === "string" && !/noWebAssembly|given|team\.commands/.test(key))
            assert.doesNotMatch(value, /\d\.\d/, `${key} has a decimal point`);

    // The lesson teaches what the engine measures: the slip within three errors of 100 periods, and
    // no spin correlation of gears.
    const measured = [8, 48].map((discs) => {
        const dish = new Engine(module);
        dish.begin({discs: String(discs)});
        while (!dish.advanceTo(120 * Number(dish.configuration().period), 1000));
        return {discs, ...dish.cause()};
    });
    for (const {spinCorrelation} of measured)
        assert.ok(Math.abs(spinCorrelation) < 0.3, `${spinCorrelation}`);
    for (const {lessonSteps} of [en, de]) {
        const all = JSON.stringify(lessonSteps);
        assert.doesNotMatch(
            all,
            /roll along the wall|rollen an der Wand entlang|every single push|ball bearing|Kugel" \+|block each other.*behaves/,
        );
        const last = lessonSteps[5].explanation.replaceAll(",", ".");
        for (const {discs, slip} of measured) {
            const said = Number(new RegExp(`(0\\.\\d+) (?:for|bei) ${discs}\\b`).exec(last)?.[1]);
            assert.ok(Math.abs(said - slip) < 0.03, `${said} for ${slip} at N = ${discs}`);
        }
    }

    const {parameterOf} = await load("engine");
    for (const [message, name] of [
        ["--mu-disc is -1, but …", "mu_disc"],
        ["60 discs do not fit into …", "discs"],
        ["the count in --mixture is 3, but …", "mixture"],
        [
            "a disc does not fit: --container-radius must be larger than --radius.",
            "container_radius",
        ],
        ["the last 100 events …\nhint: another --seed", undefined],
    ])
        assert.equal(parameterOf(message), name, message);

    const {languageOf} = await load("start");
    assert.equal(languageOf("de", ["en"]), "de");
    assert.equal(languageOf(null, ["de-AT", "en"]), "de");
    assert.equal(languageOf(null, ["fr", "de"]), "de");
    assert.equal(languageOf("en", ["de"]), "en");
    assert.equal(languageOf("xx", ["de"]), "en");
    assert.equal(languageOf(null, []), "en");

    const {ticksOf, labelsOf} = await load("chart");
    assert.deepEqual(ticksOf(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
    assert.deepEqual(ticksOf(-0.31, 0.29, 6), [-0.3, -0.2, -0.1, 0, 0.1, 0.2]);
    assert.deepEqual(ticksOf(7, 53, 5), [10, 20, 30, 40, 50]);
    assert.deepEqual(ticksOf(3, 3, 5), []);
    assert.deepEqual(labelsOf([-0.5, 0, 0.25]), ["−0.50", "0.00", "0.25"]);

    const {parseNumbers, parseCurves, merged, listOf, proposedValues, tableOf, densestSearch} =
        await load("explorer");
    assert.deepEqual(parseNumbers("5, 8:2:12"), [5, 8, 10, 12]);
    assert.deepEqual(parseNumbers("0:0.1:0.3, 0.3"), [0, 0.1, 0.2, 0.3]);
    for (const wrong of ["", "5:x", "1:0:5", "1:2", ":1:3", "1::3", "1:1:3:5", "1:1:1000"])
        assert.equal(parseNumbers(wrong), undefined, wrong);
    const curves = (parameter, text) => parseCurves(parameter, text)?.map((each) => each.given);
    assert.deepEqual(curves("mu", "0.1, 0:0.5:1, 1:0 ,1:1"), [
        {mu: "0.1"},
        {mu: "0"},
        {mu: "0.5"},
        {mu: "1"},
        {mu_disc: "1", mu_wall: "0"},
    ]);
    assert.deepEqual(curves("radius", "0.5, 1"), [{radius: "0.5"}, {radius: "1"}]);
    assert.deepEqual(curves("", "what"), [{}]);
    for (const wrong of ["", " , ", "1:x", ":1", "x", "1:2:3:4", "0.1, 1:y"])
        assert.equal(parseCurves("mu", wrong), undefined, wrong);
    assert.equal(parseCurves("radius", "1:0"), undefined);
    assert.deepEqual(merged({mu: "1", seed: "2"}, {mu_disc: "1", mu_wall: "0"}, {discs: "5"}), {
        mu: "1",
        seed: "2",
        mu_disc: "1",
        mu_wall: "0",
        discs: "5",
    });
    assert.deepEqual(merged({mu_disc: "0.2"}, {mu: "1"}), {mu: "1"});
    assert.equal(listOf([5, 11, 17]), "5:6:17");
    assert.equal(listOf([0.1, 0.2, 0.3]), "0.1:0.1:0.3");
    assert.equal(listOf([1, 2, 4]), "1,2,4");
    assert.equal(listOf([3]), "3");
    for (const row of parameters.filter(({slider}) => slider)) {
        const values = parseNumbers(proposedValues(row));
        assert.ok(values?.length >= 4, row.name);
        const isLimited = row.highest > row.lowest; // the seed is not
        assert.ok(
            !isLimited || values.every((each) => each >= row.lowest && each <= row.highest),
            row.name,
        );
    }
    assert.equal(densestSearch({container_radius: "8.6", radius: "1"}), 48);
    const estimates = (mean) =>
        Object.fromEntries(
            ["mean_by_time", "mean_by_event", "rigid_by_time", "rigid_by_event"].map((rate, k) => [
                rate,
                {mean: mean + k, error: 0.5, effective_samples: 10, blocks: 10},
            ]),
        );
    const [curve] = parseCurves("mu", "0.5");
    assert.equal(
        tableOf(
            [
                {
                    curve,
                    x: 5,
                    given: {},
                    done: true,
                    rotation: estimates(1),
                    command: "./swirl run --discs 5",
                },
                {curve, x: 6, given: {}, done: true, collapsed: true, command: "c"},
                {curve, x: 7, given: {}},
            ],
            "discs",
            "rotation",
        ),
        "mu,discs,runs,collapsed,varpi_mean_by_time,varpi_mean_by_time_error,varpi_mean_by_event,varpi_mean_by_event_error,varpi_rigid_by_time," +
            "varpi_rigid_by_time_error,varpi_rigid_by_event,varpi_rigid_by_event_error,command\n" +
            '0.5,5,4,0,1,0.5,2,0.5,3,0.5,4,0.5,"./swirl run --discs 5"\n0.5,6,4,1,,,,,,,,,"c"\n',
    );

    const {optionsOf, shellWord} = await load("host");
    assert.equal(
        optionsOf({mu_disc: "0.5", discs: "5", seed: ""}, [
            {name: "discs"},
            {name: "mu_disc"},
            {name: "seed"},
        ]),
        "--discs 5 --mu-disc 0.5",
    );
    assert.equal(shellWord("it's"), "'it'\\''s'");

    const {settingFrom, linkTextOf, tableOf: pointsTable} = await load("discovery"),
        {settingOf} = await load("settings");
    assert.equal(settingOf({discs: "48", mu: "0.5", events: "3", seed: ""}), "mu=0.5");
    assert.equal(settingOf({radius: "2", mu: "1"}), settingOf({mu: "1", radius: "2"}));
    assert.equal(settingOf({seed: "2", mu: "1"}), "mu=1"); // a point has several seeds
    const points = new Map([
        [48, {mean: -0.0372, error: 0.0013, periods: 200}],
        [8, {mean: 0.25, error: 0.03, periods: 50}],
    ]);
    const read = settingFrom(linkTextOf(points));
    assert.deepEqual([[...read.setting].sort(), read.invalid], [[...points].sort(), 0]);
    for (const wrong of [
        "",
        "x",
        "8_1_2",
        "8_1_0_50",
        "-1_1_1_50",
        "8_Infinity_1_50",
        "8_NaN_1_50",
        "8.5_1_1_50",
        "8__1_50",
        "8_1e300_1_50",
        "8_1_1e300_50",
        "1e9_1_1_50",
        "8_1_1_1e99",
        "8_1_1_50_7",
    ])
        assert.deepEqual(
            [settingFrom(wrong).setting.size, settingFrom(wrong).invalid],
            [0, 1],
            wrong,
        );
    const many = settingFrom(Array.from({length: 70}, (_, k) => `${k + 1}_1_1_50`).join(","));
    assert.deepEqual([many.setting.size, many.invalid], [60, 10]);
    const {seedsFrom} = await load("runs");
    assert.deepEqual(
        [seedsFrom(), seedsFrom("7"), seedsFrom("18446744073709551615")[1], seedsFrom("x")[3]],
        [["1", "2", "3", "4"], ["7", "8", "9", "10"], "0", "x"],
    );
    const ofSeeds = (...means) =>
        runs.estimates(
            means.map((mean) => ({
                discs: 5,
                periods: 50,
                rotation: Object.fromEntries(
                    ["mean_by_time", "mean_by_event", "rigid_by_time", "rigid_by_event"].map(
                        (rate) => [rate, {mean, error: 9}],
                    ),
                ),
            })),
        );
    // The error is that between the seeds, with Student's t; the runs' own errors do not count.
    const {mean: between, error: spread} = (await ofSeeds(1, 2, 3, 4)).mean_by_event;
    assert.ok(
        between === 2.5 && Math.abs((1.96 * spread) / (3.182 * Math.sqrt(5 / 12)) - 1) < 0.01,
        `${spread}`,
    );
    assert.equal((await ofSeeds(1, 2, 3, null)).mean_by_time.mean, 2); // a run without a mean is omitted
    assert.equal(
        pointsTable(new Map([["mu=0.5", points]])),
        'discs,varpi,varpi_error,runs,periods,other_parameters\n8,0.25,0.03,4,50,"mu=0.5"\n48,-0.0372,0.0013,4,200,"mu=0.5"\n',
    );

    const {directionOf, rangeOf, ranges, steps} = await load("lesson");
    // A step shows the colours that its text names, and a moving wall is not shown with one image
    // per period.
    for (const [k, {text}] of en.lessonSteps.entries())
        if (/Colours show the direction of the spin/.test(text))
            assert.match(steps[k].coloring, /^(spin|contacts)$/);
    assert.equal(steps.filter(({coloring}) => coloring === "contacts").length, 1);
    assert.equal(steps[3].isSlow, true);
    assert.deepEqual([steps[4].next.mu_disc, steps[4].next.mu_wall], ["0", "1"]);
    assert.deepEqual(
        [directionOf(0.1, 0.01), directionOf(-0.1, 0.01), directionOf(0.015, 0.01)],
        [0, 1, 2],
    );
    assert.deepEqual([10, 19.6, 38.4, 44.4, 44.6].map(rangeOf), [0, 1, 2, 2, 3]);
    assert.equal(ranges.length, 4);
    assert.equal(steps.length, 6);
    assert.deepEqual(
        [en, de].map((each) => each.lessonSteps.length),
        [6, 6],
    );
    for (const [k, {kind}] of steps.entries())
        if (typeof kind === "number") assert.ok(kind < en.lessonSteps[k].options.length);

    // The search for N_c: runs of a known line ϖ = slope (38.4 − N), with errors of white noise.
    const {searchCrossing, usualSearch} = await load("crossing_search"),
        {searchedNumbers} = await load("runs");
    const line = (n) => 0.004 * (38.4 - n);
    const searched = async (mean, settings = {}) => {
        const calls = [];
        const found = await searchCrossing(
            {...usualSearch, ...settings},
            {
                run: async (discs, seed, periods) => {
                    calls.push([discs, seed, periods]);
                    const one = {
                        mean: mean(discs),
                        error: 0.02 / Math.sqrt(periods),
                        effective_samples: periods,
                        blocks: periods,
                    };
                    return {rotation: perRate(() => one)};
                },
                search: async (rules, made) =>
                    new Engine(module).search(rules, searchedNumbers(made)),
                crossings: async (runs) =>
                    perRate(() =>
                        new Engine(module).crossing(
                            runs.map(
                                ({
                                    discs,
                                    periods,
                                    rotation: {
                                        mean_by_time: {mean, error},
                                    },
                                }) => [discs, mean, error, periods, periods],
                            ),
                        ),
                    ),
            },
        );
        return {found, calls};
    };
    const {found, calls} = await searched(line);
    assert.ok(Math.abs(found.crossings.mean_by_time.discs - 38.4) < 1e-9); // rounding
    assert.ok(found.withinTolerance && found.crossings.mean_by_time.error <= usualSearch.tolerance);
    assert.equal(found.runs, calls.length);
    // A number gets each seed once, and runs of whole multiples of the first length. Each makes its
    // total at most four times as long.
    assert.equal(new Set(calls.map(String)).size, calls.length);
    for (const n of new Set(calls.map(([discs]) => discs))) {
        const own = calls.filter(([discs]) => discs === n);
        assert.deepEqual(
            own.map(([, seed]) => seed),
            own.map((_, k) => 1 + k),
        );
        let total = 0;
        for (const [, , periods] of own) {
            const length = periods / usualSearch.periods;
            assert.ok(Number.isInteger(length) && length >= 1, `${periods}`);
            assert.ok(total === 0 ? length === 1 : length <= 3 * total, `${periods}`);
            total += length;
        }
    }
    assert.deepEqual((await searched(line)).calls, calls); // reproducible
    // One sign only: the coarse scan is enough.
    const positive = await searched(() => 0.5);
    assert.deepEqual(
        [
            positive.found.crossings.mean_by_time.verdict,
            positive.calls.length,
            positive.found.withinTolerance,
        ],
        ["always_rotates", 8, true],
    );
    // A tolerance that cannot be reached ends after the rounds.
    const strict = await searched(line, {tolerance: 1e-9, rounds: 2});
    assert.equal(strict.found.withinTolerance, false);
    assert.equal(
        Math.max(...strict.calls.map(([, , periods]) => periods)),
        12 * usualSearch.periods, // after 1 and 3
    );

    const {givenFrom, maxBytes, readFile} = await load("opened_file");
    const configured = {
        discs: 40,
        mu_disc: 0.5,
        mu_wall: 0.5,
        inertia: 10.0,
        mass: 1.0,
        radius: 1.0,
        restitution: 1.0,
        mixture: {count: 20, radius: 0.6, mass: 1},
        speed: 1.0000001,
        omega: 0.5,
        path: "circle",
        periods: 3,
        seed: 7,
    };
    assert.deepEqual(givenFrom(configured, parameters), {
        discs: "40",
        mu: "0.5",
        mixture: "20:0.6:1",
        path: "circle",
        seed: "7",
    });
    assert.deepEqual(givenFrom({discs: 48, mu_disc: 1, mu_wall: 0}, parameters), {
        mu_disc: "1",
        mu_wall: "0",
    });
    const bytes = (text) => new TextEncoder().encode(text).buffer;
    for (const [text, problem] of [
        ["hello", "unknown"],
        ["", "unknown"],
        ['{"a": 1}', "unknown"],
        ['{"config": ', "damaged"],
        ["swirl checkpoint 9\n0123", "unknown"],
        ["\x89HDF\r\n\x1a\n", "unknown"],
        ["\u0001", "unknown"],
        ["[1]", "unknown"],
    ])
        assert.throws(() => readFile(bytes(text), parameters), {problem}, text);
    // A file of 45 MB is refused before it is read, and so is a long value.
    assert.ok(maxBytes < 45e6);
    const long = "x".repeat(45e6);
    assert.throws(() => readFile(bytes(long), parameters), {problem: "unknown"});
    assert.throws(
        () =>
            readFile(bytes(`{"config": {"body": "${long}"}, "events": {"total": 1}}`), parameters),
        {problem: "wrongValue", what: `body = ${long.slice(0, 60)} …`},
    );
    // A value of another kind is named. JSON has no NaN; 1e999 is read as infinity.
    for (const [wrong, what] of [
        ['"events": {}', "events.total = undefined"],
        ['"events": {"total": "5"}', 'events.total = "5"'],
        ['"events": {"total": -1}', "events.total = -1"],
        ['"events": {"total": 1e300}', "events.total = 1e+300"],
        ['"events": {"total": 1}, "warmup": {"periods": "x"}', 'warmup.periods = "x"'],
        ['"events": {"total": 1}, "state_hash": 7', "state_hash = 7"],
        [
            '"events": {"total": 1}, "rotation": {"mean_by_event": {"mean": "0.1"}}',
            'rotation.mean_by_event.mean = "0.1"',
        ],
        [
            '"events": {"total": 1}, "rotation": {"mean_by_time": {"error": 1e999}}',
            "rotation.mean_by_time.error = null",
        ],
    ])
        assert.throws(
            () => readFile(bytes(`{"config": {}, ${wrong}}`), parameters),
            {problem: "wrongValue", what},
            wrong,
        );
    assert.equal(
        readFile(
            bytes('{"config": {"discs": [1, {}]}, "events": {"total": 1}, "rotation": 3}'),
            parameters,
        ).given.discs,
        "1,[object Object]",
    ); // the engine rejects it
    if (files) {
        const read = (name) => {
            const all = readFileSync(join(files, name));
            return readFile(
                all.buffer.slice(all.byteOffset, all.byteOffset + all.length),
                parameters,
            );
        };
        assert.deepEqual(read("run.json").given, {discs: "12", mu: "0.3", warmup: "2"});
    }
} finally {
    rmSync(folder, {recursive: true});
}
