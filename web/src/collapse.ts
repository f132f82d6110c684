// A collapse is told from a busy dish as `swirl run` tells it (src/run/run.cpp): by how many events
// pass in how little of the swirl, and so at the same event on every machine, however fast it is.

/** Events between two looks. */
export const betweenLooks = 256;
const tooFast = 1e8; // events per disc and swirl
const leastWindow = 500; // events

/** What is looked at. */
export interface Clocked {
    readonly events: number;
    readonly time: number;
}

interface Mark {
    events: number;
    swirls: number;
}

/** Of one dish, from its first event on. */
export class CollapseWatch {
    private mark: Mark = {events: 0, swirls: 0}; // the last time that a collapse was looked for
    private lately: [Mark, Mark] = [this.mark, this.mark]; // some hundreds of events ago, and fewer
    private readonly window: number;

    constructor(private readonly dish: Clocked, private readonly period: number,
                private readonly discs: number) {
        // Some two hundred events for each disc: the two that collapse may be among thousands.
        this.window = Math.max(20_000, 200 * discs);
    }

    /** Between events, now and then: has it collapsed? */
    look(): boolean {
        const now = this.now();
        if (now.events - this.mark.events >= this.window) {
            if (this.collapsedSince(this.mark)) return true;
            this.mark = now;
        }
        if (now.events - this.lately[1].events >= leastWindow) this.lately = [this.lately[1], now];
        return false;
    }

    /** At the end, of the last few hundred events alone: those before may have been healthy. */
    lookAtTheEnd(): boolean {
        const {events} = this.now();
        const mark = [...this.lately].reverse().find((each) => events - each.events >= leastWindow);
        return mark !== undefined && this.collapsedSince(mark);
    }

    private now(): Mark {
        return {events: this.dish.events, swirls: this.dish.time / this.period};
    }
    private collapsedSince(mark: Mark): boolean {
        const now = this.now();
        return now.events - mark.events > tooFast * this.discs * (now.swirls - mark.swirls);
    }
}
