// The collisions of the last part of a period, for the drawing: those in which friction stopped the
// slip, and those in which the surfaces slid on each other.
import type {Frame} from "../engine/messages";

/** Time, the two discs (equal for the wall), 1 if friction stopped the slip. */
const width = 4;
const shownPeriods = 1 / 15;

export interface Contact {
    i: number;
    j: number;
    sticks: boolean;
}

export class Contacts {
    private times: number[] = [];
    private all: Contact[] = [];

    get recent(): readonly Contact[] {
        return this.all;
    }

    /** Adds those of a frame and forgets the earlier ones. */
    add({frame, contacts}: Frame, period: number): void {
        if (!contacts) {
            this.times = this.all = [];
            return;
        }
        for (let k = 0; k < contacts.length; k += width) {
            this.times.push(contacts[k]!);
            this.all.push({
                i: contacts[k + 1]!,
                j: contacts[k + 2]!,
                sticks: contacts[k + 3] === 1,
            });
        }
        const [now, discs] = [frame[0]!, frame[10]!];
        const isShown = this.times.map(
            (time, k) =>
                time <= now &&
                time >= now - shownPeriods * period &&
                Math.max(this.all[k]!.i, this.all[k]!.j) < discs,
        );
        this.times = this.times.filter((_, k) => isShown[k]);
        this.all = this.all.filter((_, k) => isShown[k]);
    }
}
