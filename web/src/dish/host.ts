// The part of the page that its panels use.
import type {Dish} from "./dish";
import type {Parameter} from "../engine/engine";
import type {Laboratory} from "../engine/laboratory";
import type {Player} from "./player";
import type {Coloring, View} from "../drawing/view";
import type {Transport} from "./transport";
import {optionOf} from "../texts/symbols";

export type Values = Record<string, string>;

/** How a simulation is shown; omitted parts stay as they are. */
export interface Shown {
    view?: View | "both";
    coloring?: Coloring;
    /** Shows its start only. */
    isPaused?: boolean;
    /** Shows another container with this number of discs next to it; none if it is omitted. */
    beside?: string | undefined;
}

/** What the panels need of the page. */
export type Host = ReturnType<typeof hostOf>;

export function hostOf(lab: Laboratory, dish: Dish, player: Player, transport: Transport) {
    return {
        /** The table of parameters. */
        parameters: (): Parameter[] => lab.parameters,
        isParameter: lab.isParameter,
        /** The parameters that were set; all others have their defaults. */
        given: (): Values => lab.given,
        /** These values with the present seed. */
        withSeed: (given: Values): Values => lab.withSeed(given),
        /** All parameters of the present simulation. */
        configuration: (): Values => lab.configuration,
        /** Sets the parameters and starts their simulation. */
        show: (given: Values, {view, coloring, isPaused = false, beside}: Shown = {}): void => {
            const {discs: _, ...others} = given;
            if (beside)
                dish.compare({...others, discs: beside}, lab.counted(Number(beside), given), true);
            else if (dish.compared) dish.compare();
            if (view) transport.setView(view);
            if (coloring) transport.setColoring(coloring);
            player.setPlaying(!isPaused && !player.reducedMotion);
            lab.set(given, {all: true, restart: true});
        },
        /** Whether the page shows the motion within a period; see Player. */
        setSlow: (on: boolean): void => {
            player.isSlow = on;
        },
        /** Lets time advance, unless the reader wants less motion. */
        play: (): void => player.setPlaying(!player.reducedMotion),
        playing: (): boolean => player.isPlaying,
        /** A worker that gets the engine. */
        newWorker: (): Worker => lab.newWorker(),
    };
}

/** Options of a command line for these parameters, in the order of the table. */
export function optionsOf(given: Values, parameters: readonly {name: string}[]): string {
    return parameters
        .map(({name}) => name)
        .filter((name) => given[name])
        .map((name) => `${optionOf(name)} ${shellWord(given[name]!)}`)
        .join(" ");
}

/** Quotes a word for a shell if necessary. */
export function shellWord(word: string): string {
    return /^[\w.,:+=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
