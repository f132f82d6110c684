// Draws a sphere seen from above, as the program does (src/swirl/render/ball.cpp): lit from the
// upper left, with eight octants alternately in its colour and a paler one, and a dot on each pole.

/** A unit vector: x to the right, y upwards, z towards the eye. */
export type Direction = readonly [number, number, number];
/** A unit quaternion, the real part first. */
export type Orientation = readonly [number, number, number, number];

/** A direction in the sphere's own axes, rotated to its orientation. */
export function rotated([w, x, y, z]: Orientation, [a, b, c]: Direction): Direction {
    // d + 2 w (q × d) + 2 q × (q × d)
    const [cx, cy, cz] = [y * c - z * b, z * a - x * c, x * b - y * a];
    return [
        a + 2 * (w * cx + y * cz - z * cy),
        b + 2 * (w * cy + z * cx - x * cz),
        c + 2 * (w * cz + x * cy - y * cx),
    ];
}

/** The orientation relative to axes that are rotated by this angle about z. */
export function inRotatedAxes(angle: number, [w, x, y, z]: Orientation): Orientation {
    const c = Math.cos(angle / 2),
        s = -Math.sin(angle / 2);
    return [c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w];
}

const stepsOfAnEdge = 5;
/** The outlines of the four pale octants: those with an even number of negative coordinates. */
const patches: Direction[][] = [
    [1, 1, 1],
    [1, -1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
].map(([x, y, z]) => {
    const corners: Direction[] = [
        [x!, 0, 0],
        [0, y!, 0],
        [0, 0, z!],
    ];
    return corners.flatMap((from, k) => {
        const to = corners[(k + 1) % 3]!;
        return Array.from({length: stepsOfAnEdge}, (_, step): Direction => {
            const a = (0.5 * Math.PI * step) / stepsOfAnEdge,
                [c, s] = [Math.cos(a), Math.sin(a)];
            return [c * from[0] + s * to[0], c * from[1] + s * to[1], c * from[2] + s * to[2]];
        });
    });
});

/** The visible part of a convex outline on the sphere, as a polygon in the plane. Where the outline
 *  is hidden, the polygon follows the sphere's rim. */
export function visiblePart(outline: readonly Direction[]): [number, number][] {
    const part: [number, number][] = [],
        n = outline.length;
    const first = outline.findIndex(([, , z], k) => z > 0 && outline[(k + n - 1) % n]![2] <= 0);
    if (first < 0) return outline[0]![2] > 0 ? outline.map(([x, y]) => [x, y]) : [];
    const rimAngle = (a: Direction, b: Direction): number => {
        // angle at which an edge crosses the rim
        const t = a[2] / (a[2] - b[2]);
        return Math.atan2(a[1] + t * (b[1] - a[1]), a[0] + t * (b[0] - a[0]));
    };
    const comesBack = rimAngle(outline[(first + n - 1) % n]!, outline[first]!);
    for (let k = first; k < first + n; ++k) {
        const [here, next] = [outline[k % n]!, outline[(k + 1) % n]!];
        part.push([here[0], here[1]]);
        if (next[2] > 0) continue;
        const leaves = rimAngle(here, next);
        const way = Math.atan2(Math.sin(comesBack - leaves), Math.cos(comesBack - leaves));
        for (let step = 0; step <= stepsOfAnEdge; ++step) {
            const a = leaves + (way * step) / stepsOfAnEdge;
            part.push([Math.cos(a), Math.sin(a)]);
        }
        break;
    }
    return part;
}

/** Size in pixels of the shading that is drawn over each sphere. */
const shadeSize = 96;
let shade: HTMLCanvasElement | undefined;

/** Black in the shadow, white at the highlight, transparent elsewhere. The first row is the lowest.
 *  */
function shadeOf(): HTMLCanvasElement {
    const made = document.createElement("canvas");
    made.width = made.height = shadeSize;
    const context = made.getContext("2d")!,
        image = context.createImageData(shadeSize, shadeSize);
    // The direction of the light. The highlight is halfway between it and the eye.
    const [lx, ly, lz] = [-0.45, 0.55, 0.7],
        half = Math.hypot(lx, ly, lz + 1);
    for (let k = 0; k < shadeSize * shadeSize; ++k) {
        const x = (2 * ((k % shadeSize) + 0.5)) / shadeSize - 1,
            y = (2 * (Math.floor(k / shadeSize) + 0.5)) / shadeSize - 1;
        const z = Math.sqrt(Math.max(1 - x * x - y * y, 0));
        const light = 0.38 + 0.67 * Math.max(x * lx + y * ly + z * lz, 0);
        const glint = 0.55 * Math.max((x * lx + y * ly + z * (lz + 1)) / half, 0) ** 60;
        const through = Math.min(light, 1) * (1 - glint); // share of the sphere's own colour
        image.data.fill((255 * glint) / Math.max(1 - through, 1e-9), 4 * k, 4 * k + 3);
        image.data[4 * k + 3] = 255 * (1 - through);
    }
    context.putImageData(image, 0, 0);
    return made;
}

/** `orientation` takes the sphere's axes to those of the image. The caller sets the colour and a
 *  coordinate system with y upwards. */
export function drawBall(
    context: CanvasRenderingContext2D,
    x: number,
    y: number,
    r: number,
    orientation: Orientation,
): void {
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.fill();
    context.save();
    context.clip();
    context.translate(x, y);
    context.scale(r, r);
    context.fillStyle = "rgb(255 255 255 / 0.78)";
    for (const patch of patches) {
        context.beginPath();
        for (const [u, v] of visiblePart(patch.map((point) => rotated(orientation, point))))
            context.lineTo(u, v);
        context.fill();
    }
    const cap = 0.93; // share of the distance from the centre: 21° about the pole
    const pole = rotated(orientation, [0, 0, 1]),
        side = pole[2] < 0 ? -cap : cap;
    context.fillStyle = "rgb(0 0 0 / 0.72)";
    context.beginPath();
    context.ellipse(
        side * pole[0],
        side * pole[1],
        Math.sqrt(1 - cap * cap) * Math.abs(pole[2]),
        Math.sqrt(1 - cap * cap),
        Math.atan2(pole[1], pole[0]),
        0,
        2 * Math.PI,
    );
    context.fill();
    shade ??= shadeOf();
    context.drawImage(shade, -1, -1, 2, 2);
    context.restore();
}
