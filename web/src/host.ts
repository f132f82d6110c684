// The part of the page that its panels use.
import type {Parameter} from "./engine";
import type {Dish} from "./dish";
import type {Laboratory} from "./laboratory";
import type {Player} from "./player";
import type {View} from "./scene";
import type {Transport} from "./transport";

export type Values = Record<string, string>;

export interface Host {
    /** The table of parameters. */
    parameters(): Parameter[];
    /** The parameters that were set; all others have their defaults. */
    given(): Values;
    /** All parameters of the present simulation. */
    configuration(): Values;
    /** Sets the parameters and starts their simulation; `isPaused`: shows its start only. */
    show(given: Values, view?: View | "both", isPaused?: boolean): void;
    /** Lets time advance, unless the reader wants less motion. */
    play(): void;
    /** Whether time advances. */
    playing(): boolean;
    /** A worker that gets the engine. */
    newWorker(): Worker;
    /** Shows a recorded frame instead of the simulation, or the simulation again. */
    replay(recorded: Recorded | undefined): void;
}

/** A recorded frame in the engine's layout (engine.ts), and the largest distance of the container from S. */
export interface Recorded {
    frame: Float64Array;
    room: number;
}

export function hostOf(lab: Laboratory, dish: Dish, player: Player, transport: Transport): Host {
    let isReplaying = false, wasPlaying = false;
    return {
        parameters: () => lab.parameters,
        given: () => lab.given,
        configuration: () => lab.configuration,
        show: (given, view, isPaused = false) => {
            if (view) transport.setView(view);
            player.setPlaying(!isPaused && !player.reducedMotion);
            lab.set(given, {all: true, restart: true});
        },
        play: () => player.setPlaying(!player.reducedMotion),
        playing: () => player.isPlaying,
        newWorker: () => lab.newWorker(),
        replay: (recorded) => {
            if (recorded && !isReplaying) {
                wasPlaying = player.isPlaying;
                player.setPlaying(false);
            }
            dish.replay(recorded);
            if (!recorded && isReplaying) player.setPlaying(wasPlaying);
            isReplaying = recorded !== undefined;
        },
    };
}

/** Options of a command line for these parameters, in the order of the table. */
export function optionsOf(given: Values, parameters: readonly {name: string}[]): string {
    return parameters.map(({name}) => name).filter((name) => given[name])
        .map((name) => `--${name.replaceAll("_", "-")} ${shellWord(given[name]!)}`).join(" ");
}

/** Quotes a word for a shell if necessary. */
export function shellWord(word: string): string {
    return /^[\w.,:+=/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
