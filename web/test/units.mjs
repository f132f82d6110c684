// Unit tests of the page's own computations: node units.mjs. Exits with 1 and a message if a test
// fails.
import assert from "node:assert/strict";
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import ts from "typescript";
import {filesWith, loader} from "./sources.mjs";

const folder = mkdtempSync(join(tmpdir(), "swirl-units-"));
const load = loader(folder);
const frame = (discs, {time = 0, centre = [0, 0], radius = 8.6} = {}) =>
    new Float64Array([
        time,
        0,
        0,
        ...centre,
        0,
        0,
        radius,
        1,
        0,
        discs.length,
        ...discs.flatMap(([x, y, r = 1]) => [x, y, 0.25, -0.5, 1, 2, r, 0]),
    ]);

/** Finds visible texts in a source other than symbols.ts: letters in the text, name or label of an
 *  element or canvas; elsewhere strings of several words, or with letters that identifiers cannot
 *  have. */
const shownBy = (source) => {
    const found = [],
        file = ts.createSourceFile("a.ts", source, ts.ScriptTarget.ES2022, true);
    const shown = [
        "textContent",
        "innerText",
        "innerHTML",
        "title",
        "label",
        "alt",
        "placeholder",
        "ariaLabel",
    ];
    const nameOf = (node) => node.name?.text ?? node.text ?? "";
    /** The arguments of a call that are shown. */
    const shownOf = ({expression, arguments: given = []}) =>
        ({
            __proto__: null,
            element: given.slice(2),
            append: given,
            prepend: given,
            button: given.slice(0, 1),
            field: given.slice(0, 1),
            choice: given.slice(1, 2),
            figure: given.slice(1),
            alert: given,
            showError: given,
            UsageError: given,
            fillText: given.slice(0, 1),
            strokeText: given.slice(0, 1),
            setAttribute: /^(aria-label|aria-description|title|alt|placeholder)$/.test(
                given[0]?.text,
            )
                ? given.slice(1)
                : [],
        })[nameOf(expression)] ?? [];
    const hidden = (node) =>
        ts.isImportDeclaration(node) ||
        ts.isTypeNode(node) ||
        (ts.isNewExpression(node) && nameOf(node.expression) === "Error") || // a programming error, not shown to users
        (ts.isBinaryExpression(node) && nameOf(node.left) === "font") ||
        (ts.isCallExpression(node) &&
            nameOf(node.expression) === "setAttribute" &&
            shownOf(node).length === 0) ||
        (ts.isCallExpression(node) &&
            /^(matches|closest|querySelector(All)?)$/.test(nameOf(node.expression)));
    const visit = (node, isShown) => {
        if (hidden(node)) return;
        if (
            ts.isStringLiteralLike(node) ||
            [
                ts.SyntaxKind.TemplateHead,
                ts.SyntaxKind.TemplateMiddle,
                ts.SyntaxKind.TemplateTail,
            ].includes(node.kind)
        ) {
            if (
                (/[^\p{L}]*\p{L}/u.test(node.text) && isShown) ||
                /\p{L}{2,},? \p{L}{2,}/u.test(node.text) ||
                /[^\P{L}a-zA-Z]/u.test(node.text)
            )
                found.push(node.text);
            return;
        }
        const calls = ts.isCallExpression(node) || ts.isNewExpression(node),
            args = calls ? shownOf(node) : [];
        const gives =
            (ts.isPropertyAssignment(node) && shown.includes(nameOf(node))) ||
            (ts.isBinaryExpression(node) &&
                node.operatorToken.kind === ts.SyntaxKind.EqualsToken &&
                shown.includes(nameOf(node.left)));
        // Conditions, names of elements and keys are not shown.
        const decides = (child) =>
            (ts.isConditionalExpression(node) && child === node.condition) ||
            (ts.isElementAccessExpression(node) && child === node.argumentExpression);
        ts.forEachChild(node, (child) =>
            visit(
                child,
                calls
                    ? args.includes(child)
                    : !decides(child) &&
                          (isShown || gives) &&
                          !(gives && child === (node.name ?? node.left)),
            ),
        );
    };
    visit(file, false);
    return found;
};
/** Finds visible texts in HTML, where names in double braces stand for texts. */
const shownByPage = (html) =>
    html
        .replace(/<!.*?>|\{\{[\w.]+\}\}|<script.*?<\/script>/gs, "")
        .replace(/<[^>]*>/g, (tag) =>
            (/\b(?:aria-label|title|alt|placeholder)="[^"]*"/.exec(tag) ?? [""])[0].replace(
                /^.*?=/,
                "",
            ),
        )
        .match(/\p{L}+/gu) ?? [];

try {
    for (const [source, wanted] of [
        ['element("p", {id: "said", textContent: "Wait"})', ["Wait"]],
        ['element("label", {}, box, ` Trails ${n}`)', [" Trails "]],
        ['button("Go", () => tell({kind: "skip"}), "skip")', ["Go"]],
        ['byId("a").textContent = x === "lab" ? "Dish" : "…"', ["Dish"]],
        ['a.setAttribute("aria-label", "The dish")', ["The dish"]],
        ['a.setAttribute("aria-keyshortcuts", "ArrowLeft ArrowRight")', []],
        ['context.fillText("M", 0, 0)', ["M"]],
        ["const said = `${n} runs done`", [" runs done"]],
        ['axes = [{label: "μ", stroke: "red"}]', ["μ"]],
        [
            'element("p", {textContent: texts.wait, id: "wait"}, texts.groups["a"], given["discs"])',
            [],
        ],
    ])
        assert.deepEqual(shownBy(source), wanted, source);
    const classes = new Set(
        filesWith(".css").flatMap((each) =>
            readFileSync(each, "utf-8").match(/(?<=\.)[a-z][a-z-]*/g),
        ),
    );
    for (const name of filesWith(".ts").filter((each) => !each.endsWith("symbols.ts"))) {
        const stray = shownBy(readFileSync(name, "utf-8")).filter(
            (each) => !each.split(" ").every((word) => classes.has(word)),
        );
        assert.deepEqual(stray, [], `${name} has texts that belong in texts.en.json`);
    }
    assert.deepEqual(shownByPage('<a title="So {{b}}" id="x">{{a}} <b>yes</b></a>'), ["So", "yes"]);
    for (const page of ["../index.html", "../laboratory.html"])
        assert.deepEqual(
            shownByPage(readFileSync(new URL(page, import.meta.url), "utf-8")),
            [],
            page,
        );

    // The notices at the end of the pages name each library in them.
    const notices = readFileSync(new URL("../notices.txt", import.meta.url), "utf-8");
    for (const source of filesWith(".ts"))
        for (const [, library] of readFileSync(source, "utf-8").matchAll(/ from "(\w[\w-]*)"/g))
            assert.ok(notices.includes(` ${library},`), `${library} of ${source} has no notice`);

    const {discAt, extentOf} = await load("scene");
    const cluster = [
        [0, 0],
        [2, 0],
        [1, 3],
        [-4, 2],
    ];
    assert.equal(discAt(frame(cluster), 2.5, 0.5), 1);
    assert.equal(discAt(frame(cluster), 2.9, 0.9), undefined);
    // An image reaches to the farthest position of the container, or to the one where a hand moved it.
    assert.equal(extentOf(frame(cluster, {centre: [3, 4]}), 2), 13.6);
    assert.equal(extentOf(frame(cluster, {centre: [0, 1]}), 2), 10.6);

    // Sectors stay with the discs: a rotated cluster keeps its colours, and new discs get those of
    // their place.
    const {SectorPaint} = await load("paint"),
        {paletteOf, sectorColors, diverging} = await load("palette"),
        {drawTurns} = await load("turns");
    const ring = (count, by = 0) =>
        Array.from({length: count}, (_, k) => {
            const angle = (2 * Math.PI * (k + 0.5)) / count + by;
            return [3 + 5 * Math.cos(angle), 4 + 5 * Math.sin(angle)];
        });
    const paint = new SectorPaint(),
        sectors = sectorColors.length;
    paint.apply(frame(ring(3 * sectors)));
    assert.deepEqual(
        [...paint.sectors],
        ring(3 * sectors).map((_, k) => Math.floor(k / 3)),
    );
    paint.extend(frame(ring(3 * sectors, 2)));
    assert.deepEqual(
        [...paint.sectors],
        ring(3 * sectors).map((_, k) => Math.floor(k / 3)),
    );
    assert.equal(paint.isMixed(frame(ring(3 * sectors, 2))), false);
    // Each colour opposite itself: the resultants cancel.
    assert.equal(
        paint.isMixed(
            frame(ring(3 * sectors).map((at, k) => (k % 3 ? at : [6 - at[0], 8 - at[1]]))),
        ),
        true,
    );
    paint.extend(frame(ring(2)));
    assert.deepEqual([...paint.sectors], [0, 0]);

    // The arc of the turns has the colour of its direction and one ring for each whole turn, and
    // there is none while the number is 0.00.
    const arcOf = (turns) => {
        const said = {colors: new Set(), circles: 0, heads: 0};
        const context = new Proxy(
            {
                arc: (x, y, r, from, to) => (said.circles += to - from === 2 * Math.PI),
                fill: () => (said.heads += 1),
            },
            {
                get: (own, name) => own[name] ?? (() => {}),
                set: (own, name, value) => {
                    if (/Style$/.test(name)) said.colors.add(value);
                    return true;
                },
            },
        );
        const palette = paletteOf(false);
        drawTurns(context, {centre: [0, 0], radius: 8.6}, turns, palette, 0.02);
        const named = [...said.colors].map((color) =>
            ["with", "against"].find((name) => palette[name] === color),
        );
        return [named.join(), said.circles, said.heads];
    };
    assert.deepEqual(arcOf(0.004), ["", 0, 0]);
    assert.deepEqual(arcOf(0.2), ["with", 0, 1]);
    assert.deepEqual(arcOf(-0.2), ["against", 0, 1]);
    assert.deepEqual(arcOf(1.51), ["with", 1, 1]);
    assert.deepEqual(arcOf(-7.5), ["against", 3, 1]);
    const hex = (shade) => "#" + shade.map((x) => x.toString(16).padStart(2, "0")).join("");
    assert.equal(hex(diverging(1)), paletteOf(false).with);
    assert.equal(hex(diverging(-1)), paletteOf(false).against);

    // The run on display has an error from 50 periods on.
    const {liveEstimate} = await load("estimates");
    const rotation = (blocks, {early = 0, periods = 1, mean = 0.1} = {}) => ({
        mean_by_time: {mean, blocks: blocks.length - early},
        blocks,
        warmup_blocks: early,
        periods_per_block: [1, periods],
    });
    const wave = (length, slow = 1) =>
        Array.from({length}, (_, k) => 0.1 + 0.01 * (Math.floor(k / slow) % 2 ? 1 : -1));
    assert.deepEqual(liveEstimate(rotation(wave(49))), {mean: 0.1, error: null});
    assert.ok(liveEstimate(rotation(wave(50))).error < 1e-3);
    // A run that remembers for a quarter has 1.15 times the scatter of its quarters, not that of
    // its periods. Student's t for three degrees of freedom is 3.1824, and the standard deviation
    // of 0.09, 0.11, 0.09 and 0.11 is 0.01 √(4/3).
    assert.ok(
        Math.abs(
            liveEstimate(rotation(wave(52, 13))).error -
                (((1.15 * 3.182446) / 1.959964) * 0.01) / Math.sqrt(3),
        ) < 1e-12,
    );
    assert.equal(liveEstimate(rotation(wave(60), {early: 20})).error, null); // the warm-up does not count
    assert.ok(liveEstimate(rotation(wave(13), {periods: 4})).error > 0); // blocks of four periods do
    assert.equal(liveEstimate(rotation(Array(80).fill(null), {mean: null})).error, null);

    // The verdict: from all periods while there is no average, firm when the 95 % interval excludes
    // zero.
    const {findingOf} = await load("finding");
    const nothing = {error: null, isFirm: false};
    assert.deepEqual(findingOf(undefined, 0.02, 0.1), {
        mean: null,
        direction: undefined,
        ...nothing,
    });
    assert.deepEqual(findingOf(undefined, -0.1, 0.5), {
        mean: -0.2,
        direction: "against",
        ...nothing,
    });
    assert.deepEqual(findingOf(rotation([9, 9, 0.25, 0.75], {early: 4, mean: null}), 0, 4), {
        mean: 0.5,
        direction: "with",
        ...nothing,
    }); // the later half of the warm-up
    assert.deepEqual(findingOf(rotation(wave(49)), 0, 49), {
        mean: 0.1,
        direction: "with",
        ...nothing,
    });
    assert.equal(findingOf(rotation(wave(50)), 0, 50).isFirm, true);
    const slow = wave(52, 13),
        half = 1.96 * liveEstimate(rotation(slow)).error;
    assert.equal(findingOf(rotation(slow, {mean: -0.99 * half}), 0, 52).isFirm, false);
    assert.deepEqual(
        [findingOf(rotation(slow, {mean: -1.01 * half}), 0, 52)].map(({isFirm, direction}) => [
            isFirm,
            direction,
        ]),
        [[true, "against"]],
    );

    // The page stores nothing in the browser, so that tabs have nothing in common and nothing can
    // be damaged.
    for (const name of filesWith(".ts"))
        assert.doesNotMatch(
            readFileSync(name, "utf-8"),
            /localStorage|sessionStorage|indexedDB|BroadcastChannel|SharedWorker|serviceWorker|\.cookie/,
            name,
        );

    // In any orientation the eight octants of a sphere cover its visible half exactly once.
    const {inRotatedAxes, rotated, visiblePart} = await load("ball");
    const areaOf = (outline) =>
        outline.reduce((sum, [x, y], k) => {
            const [u, v] = outline[(k + 1) % outline.length];
            return sum + 0.5 * (x * v - y * u);
        }, 0);
    const edge = (from, to) =>
        Array.from({length: 200}, (_, k) =>
            from.map(
                (x, axis) =>
                    x * Math.cos((Math.PI * k) / 400) + to[axis] * Math.sin((Math.PI * k) / 400),
            ),
        );
    for (const raw of [
        [1, 0, 0, 0],
        [1, 1, 1, 1],
        [1, 2, 3, 4],
        [0.3, -1, 0.2, 0.7],
        [1, 1e-3, 0, 0],
    ]) {
        const turn = raw.map((x) => x / Math.hypot(...raw));
        let seen = 0;
        for (const x of [-1, 1])
            for (const y of [-1, 1])
                for (const z of [-1, 1]) {
                    const corners = [
                        [x, 0, 0],
                        [0, y, 0],
                        [0, 0, z],
                    ];
                    const outline = corners.flatMap((corner, k) =>
                        edge(corner, corners[(k + 1) % 3]),
                    );
                    seen += Math.abs(
                        areaOf(visiblePart(outline.map((point) => rotated(turn, point)))),
                    );
                }
        // The rim of a part has five straight pieces. Its area is smaller than the circle's by at
        // most a sixth of (π/2/5)²; nothing else may be missing.
        assert.ok(
            seen < Math.PI * (1 + 1e-12) && seen > Math.PI * (1 - 0.1 / 6),
            `${seen} for ${turn}`,
        );
    }
    const [q0, q1] = [0, 0.3].map((angle) =>
        rotated(inRotatedAxes(angle, [0.5, 0.5, 0.5, 0.5]), [0.6, 0, 0.8]),
    );
    assert.ok(Math.abs(q1[0] - (q0[0] * Math.cos(0.3) + q0[1] * Math.sin(0.3))) < 1e-15);
    assert.ok(Math.abs(q1[1] - (q0[1] * Math.cos(0.3) - q0[0] * Math.sin(0.3))) < 1e-15);
    assert.deepEqual(rotated([0.5, 0.5, 0.5, 0.5], [1, 0, 0]), [0, 1, 0]); // x to y, y to z, z to x

    const {isWholePeriod} = await load("strobe");
    assert.deepEqual(
        [0, 1e-9, 0.5, 1 - 1e-9].map((phase) => isWholePeriod([0, 0, 12 * phase], 12)),
        [true, true, false, true],
    );

    // Contacts of the last fifteenth of a period are drawn; those of discs that were removed are
    // not.
    const {Contacts} = await load("contacts"),
        shownContacts = new Contacts();
    shownContacts.add(
        {
            frame: frame(
                [
                    [0, 0],
                    [2, 0],
                ],
                {time: 1},
            ),
            contacts: new Float64Array([0.5, 0, 1, 1, 0.99, 1, 1, 0, 0.99, 0, 2, 1]),
        },
        15,
    );
    assert.deepEqual(shownContacts.recent, [
        {i: 0, j: 1, sticks: true},
        {i: 1, j: 1, sticks: false},
    ]);
    shownContacts.add(
        {
            frame: frame(
                [
                    [0, 0],
                    [2, 0],
                ],
                {time: 1.9},
            ),
            contacts: new Float64Array(),
        },
        15,
    );
    assert.deepEqual(shownContacts.recent, [{i: 1, j: 1, sticks: false}]);
    shownContacts.add({frame: frame([[0, 0]])}, 15);
    assert.deepEqual(shownContacts.recent, []);

    const {periodsOf, meansOf, tableOf} = await load("series");
    const short = {
        warmup: 2,
        warmup_blocks: 2,
        periods_per_block: [1, 1],
        blocks: [5, 7, 1, 3, null],
        rigid_blocks: [6, 8, 2, 4, null],
    };
    assert.deepEqual(periodsOf(short), [1, 2, 3, 4, 5]);
    assert.deepEqual(meansOf(short), [null, null, 1, 2, 4 / 3]);
    assert.equal(tableOf(short), "period,varpi,varpi_rigid\n1,5,6\n2,7,8\n3,1,2\n4,3,4\n5,,\n");
    assert.equal(tableOf(undefined), "period,varpi,varpi_rigid\n");
    // After a change the periods continue, with a gap in the lines.
    const {joined} = await load("curve");
    assert.deepEqual(joined([[], [], []], undefined), [[], [], []]);
    assert.deepEqual(
        joined(
            [
                [1, 2],
                [8, 9],
                [null, 9],
            ],
            {...short, blocks: [5, 7, 1]},
        ),
        [
            [1, 2, 2, 3, 4, 5],
            [8, 9, null, 5, 7, 1],
            [null, 9, null, null, null, 1],
        ],
    );
    // A long run with merged blocks: two periods each in the warm-up, four after it.
    const long = {warmup: 5, warmup_blocks: 2, periods_per_block: [2, 4], blocks: [1, 1, 3, 5]};
    assert.deepEqual(periodsOf(long), [2, 4, 9, 13]);
    assert.deepEqual(meansOf(long), [null, null, 3, 4]);

    const {withError} = await load("page");
    assert.equal(withError(-0.0412, 0.0013, "?"), "−0.0412 ± 0.0013");
    assert.equal(withError(0.5, 0.04, "?"), "0.500 ± 0.040");
    assert.equal(withError(12.34, 3, "?"), "12.3 ± 3.0");
    assert.equal(withError(null, null, "?"), "?");
    assert.equal(withError(0.25, null, "?"), "0.250");

    // German numbers have a decimal comma, in and out; a list is then separated by semicolons.
    globalThis.name = "de"; // as in a worker
    const german = await load("page", "page.de");
    delete globalThis.name;
    assert.equal(german.withError(-0.0412, 0.0013, "?"), "−0,0412 ± 0,0013");
    assert.equal(german.localized("mu 0.5, discs 5"), "mu 0,5, discs 5");
    assert.equal(german.typedNumber("0,35"), "0.35");
    assert.equal(german.typedList("0,1; 1; 5:0,5:7"), "0.1, 1, 5:0.5:7");
    assert.equal(german.shownList("0.1, 1"), "0,1; 1");
} finally {
    rmSync(folder, {recursive: true});
}
