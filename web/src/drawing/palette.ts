// The colours of the drawing, in light and in dark. Those with a meaning come from the table of the
// program (src/swirl/render/theme.hpp), so that movies, figures and the page agree.
import look from "./look.json";

export interface Palette {
    ink: string;
    paper: string;
    floor: string; // floor of the container
    quiet: string;
    with: string;
    against: string;
    pinned: string;
    loose: string;
    centrifugal: string;
    coriolis: string;
}
const palettes: Record<"light" | "dark", Palette> = {
    light: {ink: "#1d2328", paper: "#fbf9f6", floor: "#ffffff", quiet: "#6b737a", ...look.light},
    dark: {ink: "#ebe8e3", paper: "#121517", floor: "#1d2226", quiet: "#98a1a8", ...look.dark},
};
export const paletteOf = (isDark: boolean): Palette => palettes[isDark ? "dark" : "light"];

type Shade = [number, number, number];
const shade = (hex: string): Shade =>
    [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)) as Shade;
const mixed = (a: Shade, b: Shade, share: number): Shade =>
    a.map((x, k) => Math.round(x + share * (b[k]! - x))) as Shade;

/** A colour on its way to black or white. */
export const toned = (hex: string, towards: "black" | "white", share: number): string =>
    `rgb(${mixed(shade(hex), towards === "black" ? [0, 0, 0] : [255, 255, 255], share).join(" ")})`;

const [with_, against, grey] = [look.light.with, look.light.against, look.light.neutral].map(
    shade,
) as [Shade, Shade, Shade];
/** From against the swirl, or clockwise, to grey to with the swirl. */
export function diverging(x: number): Shade {
    const t = Math.max(-1, Math.min(1, x));
    return mixed(grey, t < 0 ? against : with_, Math.abs(t));
}

const stops = look.sequential.map(shade);
/** 0…1 → dark blue, green, yellow. */
export function sequential(x: number): Shade {
    const at = Math.max(0, Math.min(1, x)) * (stops.length - 1),
        below = Math.min(Math.floor(at), stops.length - 2);
    return mixed(stops[below]!, stops[below + 1]!, at - below);
}

/** Sectors of a cluster, around the circle. */
export const sectorColors = look.sectors;
export const idColors = look.ids;
export const slidingColor = "#d0202a";
