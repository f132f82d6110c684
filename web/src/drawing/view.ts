// How a frame is shown, and where its points are in the image.
import type {Contact} from "./contacts";
import type {MapLayer} from "./maps";

export type View = "lab" | "m";
export type Coloring = "sector" | "spin" | "contacts" | "speed" | "pinned" | "id";

export interface DrawOptions {
    view: View;
    coloring: Coloring;
    sectors: readonly number[]; // a sector for each disc, for the colouring by sector
    omega: number; // frequency of the path; above 0, forces are drawn in the M-frame
    dark: boolean;
    extent: number; // largest distance of the wall from S, for the scale of the lab frame
    turns: number; // turns of the cluster, an arc in the lab frame
    held: number | undefined; // the disc selected by keys
    contacts?: readonly Contact[]; // used by the colouring by contacts
    isSmall?: boolean; // a thumbnail, without marks
    map?: MapLayer | undefined; // averages behind the discs, in the M-frame
    note?: string; // text in the lower right corner
}

export interface Frame {
    centre: [number, number];
    radius: number;
    down: [number, number];
    discs: number;
}

/** The container in a frame. */
export function head(f: Float64Array): Frame {
    return {centre: [f[3]!, f[4]!], radius: f[7]!, down: [f[8]!, f[9]!], discs: f[10]!};
}

/** A point of the lab frame in the frame of the view. */
export function shown(frame: Frame, view: View, x: number, y: number): [number, number] {
    if (view === "lab") return [x, y];
    const [dx, dy] = [x - frame.centre[0], y - frame.centre[1]];
    const [ex, ey] = frame.down;
    return [-dx * ey + dy * ex, -(dx * ex + dy * ey)];
}
