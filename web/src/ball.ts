// A sphere seen from above, as the program draws it in films (src/swirl/render/ball.cpp): lit from the upper left,
// with a beach ball's eight patches in its colour and in a paler one, and a dot on each pole.

/** A unit vector: x to the right, y upwards, z towards the eye. */
export type Direction = readonly [number, number, number];
/** A unit quaternion, the real part first. */
export type Turn = readonly [number, number, number, number];

/** A direction of the sphere's own axes, where the sphere is turned like that. */
export function turnedBy([w, x, y, z]: Turn, [a, b, c]: Direction): Direction {
    // d + 2 w (q × d) + 2 q × (q × d)
    const [cx, cy, cz] = [y * c - z * b, z * a - x * c, x * b - y * a];
    return [a + 2 * (w * cx + y * cz - z * cy), b + 2 * (w * cy + z * cx - x * cz),
            c + 2 * (w * cz + x * cy - y * cx)];
}

/** The same, looked at from axes that are turned by this angle about z. */
export function seenFrom(angle: number, [w, x, y, z]: Turn): Turn {
    const c = Math.cos(angle / 2), s = -Math.sin(angle / 2);
    return [c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w];
}

const stepsOfAnEdge = 5;
/** The outlines of the four pale patches: octants of which an even number of coordinates is negative. */
const patches: Direction[][] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(
    ([x, y, z]) => {
        const corners: Direction[] = [[x!, 0, 0], [0, y!, 0], [0, 0, z!]];
        return corners.flatMap((from, k) => {
            const to = corners[(k + 1) % 3]!;
            return Array.from({length: stepsOfAnEdge}, (_, step): Direction => {
                const a = 0.5 * Math.PI * step / stepsOfAnEdge, [c, s] = [Math.cos(a), Math.sin(a)];
                return [c * from[0] + s * to[0], c * from[1] + s * to[1], c * from[2] + s * to[2]];
            });
        });
    });

/** Of an outline on the sphere, convex there, what is in front, as a polygon in the plane. Where it goes
 *  behind, it follows the sphere's limb from there to where it comes back. */
export function visiblePart(outline: readonly Direction[]): [number, number][] {
    const part: [number, number][] = [], n = outline.length;
    const first = outline.findIndex(([, , z], k) => z > 0 && outline[(k + n - 1) % n]![2] <= 0);
    if (first < 0) return outline[0]![2] > 0 ? outline.map(([x, y]) => [x, y]) : [];
    const limb = (a: Direction, b: Direction): number => { // the angle at which an edge crosses it
        const t = a[2] / (a[2] - b[2]);
        return Math.atan2(a[1] + t * (b[1] - a[1]), a[0] + t * (b[0] - a[0]));
    };
    const comesBack = limb(outline[(first + n - 1) % n]!, outline[first]!);
    for (let k = first; k < first + n; ++k) {
        const [here, next] = [outline[k % n]!, outline[(k + 1) % n]!];
        part.push([here[0], here[1]]);
        if (next[2] > 0) continue;
        const leaves = limb(here, next);
        const way = Math.atan2(Math.sin(comesBack - leaves), Math.cos(comesBack - leaves));
        for (let step = 0; step <= stepsOfAnEdge; ++step) {
            const a = leaves + way * step / stepsOfAnEdge;
            part.push([Math.cos(a), Math.sin(a)]);
        }
        break;
    }
    return part;
}

/** Of the picture of light and shade that is laid over every ball, in pixels. */
const shadeSize = 96;
let shade: HTMLCanvasElement | undefined;

/** Black where it is dark and white where it shines, transparent else; the first row is the lowest. */
function shadeOf(): HTMLCanvasElement {
    const made = document.createElement("canvas");
    made.width = made.height = shadeSize;
    const context = made.getContext("2d")!, image = context.createImageData(shadeSize, shadeSize);
    // Towards the light; halfway between it and the eye it shines.
    const [lx, ly, lz] = [-0.45, 0.55, 0.7], half = Math.hypot(lx, ly, lz + 1);
    for (let k = 0; k < shadeSize * shadeSize; ++k) {
        const x = 2 * (k % shadeSize + 0.5) / shadeSize - 1, y = 2 * (Math.floor(k / shadeSize) + 0.5) / shadeSize - 1;
        const z = Math.sqrt(Math.max(1 - x * x - y * y, 0));
        const light = 0.38 + 0.67 * Math.max(x * lx + y * ly + z * lz, 0);
        const glint = 0.55 * Math.max((x * lx + y * ly + z * (lz + 1)) / half, 0) ** 60;
        const through = Math.min(light, 1) * (1 - glint); // of the ball's own colour
        image.data.fill(255 * glint / Math.max(1 - through, 1e-9), 4 * k, 4 * k + 3);
        image.data[4 * k + 3] = 255 * (1 - through);
    }
    context.putImageData(image, 0, 0);
    return made;
}

/** `turn` takes the sphere's axes to those of the picture. Whoever calls has set the colour, and the
 *  coordinates of the dish, y upwards. */
export function drawBall(context: CanvasRenderingContext2D, x: number, y: number, r: number,
                         turn: Turn): void {
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
        for (const [u, v] of visiblePart(patch.map((point) => turnedBy(turn, point)))) context.lineTo(u, v);
        context.fill();
    }
    const cap = 0.93; // of the distance from the centre: 21° about the pole
    const pole = turnedBy(turn, [0, 0, 1]), side = pole[2] < 0 ? -cap : cap;
    context.fillStyle = "rgb(0 0 0 / 0.72)";
    context.beginPath();
    context.ellipse(side * pole[0], side * pole[1], Math.sqrt(1 - cap * cap) * Math.abs(pole[2]),
                    Math.sqrt(1 - cap * cap), Math.atan2(pole[1], pole[0]), 0, 2 * Math.PI);
    context.fill();
    shade ??= shadeOf();
    context.drawImage(shade, -1, -1, 2, 2);
    context.restore();
}
