// Paints each disc by the sector of the cluster in which it is. The colours stay with the discs, so
// the pattern shows how far the cluster has turned, and how it mixes.
import {frameDisc, frameHead} from "../engine/engine";
import {sectorColors} from "./palette";
import {centreOf} from "./strobe";

export class SectorPaint {
    /** A sector for each disc. */
    readonly sectors: number[] = [];

    /** Paints all discs by their angle about the centre of mass. */
    apply(f: Float64Array): void {
        this.sectors.length = 0;
        this.extend(f);
    }

    /** Paints the discs that are new; the others keep their colours. */
    extend(f: Float64Array): void {
        const turns = anglesOf(f),
            begin = Math.min(this.sectors.length, turns.length);
        this.sectors.length = turns.length;
        for (let i = begin; i < turns.length; ++i)
            this.sectors[i] =
                Math.floor((turns[i]! + 1) * sectorColors.length) % sectorColors.length;
    }

    /** Whether the colours have mixed so much that the pattern shows no rotation. */
    isMixed(f: Float64Array): boolean {
        const turns = anglesOf(f),
            sums = sectorColors.map(() => [0, 0, 0] as [number, number, number]);
        for (const [i, turn] of turns.entries()) {
            const sum = sums[this.sectors[i] ?? 0]!;
            sum[0] += Math.cos(2 * Math.PI * turn);
            sum[1] += Math.sin(2 * Math.PI * turn);
            sum[2] += 1;
        }
        // The mean resultant length of the angles in each colour, weighted with its discs.
        const order = sums.reduce((total, [x, y]) => total + Math.hypot(x, y), 0) / turns.length;
        return turns.length > sectorColors.length && order < minOrder;
    }
}

const minOrder = 0.62; // a sector of 60° has 0.95, all angles alike 0

/** The angle of each disc about the centre of mass, in turns. */
function anglesOf(f: Float64Array): number[] {
    const [x, y] = centreOf(f);
    return Array.from({length: f[10]!}, (_, i) => {
        const k = frameHead + frameDisc * i;
        return Math.atan2(f[k + 1]! - y, f[k]! - x) / (2 * Math.PI);
    });
}
