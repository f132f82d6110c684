// What distinguishes two settings: all parameters except the number of discs, the length of the run
// and the seed.

/** Parameters that do not distinguish settings. */
const ofNoSetting = ["discs", "events", "periods", "seed"];

/** A name for the parameters except the number of discs, which is empty for the defaults. */
export function settingOf(given: Record<string, string>): string {
    const named = Object.entries(given).filter(
        ([name, value]) => value !== "" && !ofNoSetting.includes(name),
    );
    return new URLSearchParams(named.sort(([a], [b]) => (a < b ? -1 : 1))).toString();
}
