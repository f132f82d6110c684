// The colours of the drawing, in light and in dark.

export interface Palette {
    ink: string;
    paper: string;
    floor: string; // floor of the container
    quiet: string;
    with: string;
    against: string;
}
const palettes: Record<"light" | "dark", Palette> = {
    light: {
        ink: "#1d2328",
        paper: "#fbf9f6",
        floor: "#ffffff",
        quiet: "#6b737a",
        with: "#cc5c0a",
        against: "#24639e",
    },
    dark: {
        ink: "#ebe8e3",
        paper: "#121517",
        floor: "#1d2226",
        quiet: "#98a1a8",
        with: "#f5a860",
        against: "#86bdf2",
    },
};
export const paletteOf = (isDark: boolean): Palette => palettes[isDark ? "dark" : "light"];

/** From blue (against the swirl) to grey to orange (with the swirl); suited to colour-blind
 *  readers. */
export function diverging(x: number): [number, number, number] {
    const t = Math.max(-1, Math.min(1, x));
    const from = t < 0 ? [36, 99, 158] : [204, 92, 10];
    const grey = [196, 198, 200];
    return grey.map((g, k) => Math.round(g + Math.abs(t) * (from[k]! - g))) as [
        number,
        number,
        number,
    ];
}

export const slidingColor = "#d0202a";

export const idColors = [
    "#0072b2",
    "#e69f00",
    "#009e73",
    "#cc79a7",
    "#56b4e9",
    "#d55e00",
    "#f0e442",
];
export const pinnedColor = "#d55e00",
    looseColor = "#56b4e9";
